#!/usr/bin/env bash
# Print the path of a browser for the tests; SLDR_CHROMIUM names one to use instead.
set -euo pipefail

names=(chromium chromium-browser google-chrome google-chrome-stable)
[[ -z ${SLDR_CHROMIUM:-} ]] || names=("$SLDR_CHROMIUM")

for name in "${names[@]}"; do
    # Ubuntu puts a stub in the place of its snap: only running it tells.
    if path=$(command -v "$name") && "$path" --version >/dev/null 2>&1; then
        echo "$path"
        exit 0
    fi
done

echo "The browser tests need Chromium, and none of ${names[*]} runs: install one, or name it with SLDR_CHROMIUM=/path/to/it." >&2
exit 1
