#!/usr/bin/env bash
# Print the first Python that is new enough; PYTHON names one to use instead.
set -euo pipefail

oldest="3.11"
names=(python3 python3.14 python3.13 python3.12 python3.11)
[[ -z ${PYTHON:-} ]] || names=("$PYTHON")

found=()
for name in "${names[@]}"; do
    # A pyenv shim exists for versions that are not switched on: only running it tells.
    version=$("$name" -c 'import sys; print("%d.%d" % sys.version_info[:2])' 2>/dev/null) || continue
    if ((${version#*.} >= ${oldest#*.} && ${version%.*} == ${oldest%.*})); then
        echo "$name"
        exit 0
    fi
    found+=("$name is $version")
done

there="none of ${names[*]} runs"
((${#found[@]} == 0)) || there=$(IFS=,; echo "${found[*]}")
echo "Python $oldest or newer is needed, but $there: install it, or name one with 'make PYTHON=/path/to/python3 ...'." >&2
exit 1
