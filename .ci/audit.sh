#!/usr/bin/env bash
# Ask the registries whether a dependency has a known weakness. One that does not answer is said, and is no failure.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

pip_audit="pip-audit==2.10.1"
patience=120 # [s]
failed=0

ask() { # name, words of an answer that found something, command...
    local name=$1 found=$2 said
    shift 2
    said=$(timeout "$patience" "$@" 2>&1)
    case $? in
    0) echo "$name: nothing known." ;;
    *)
        if grep --quiet --extended-regexp "$found" <<<"$said"; then
            echo "$said"
            failed=1
        else
            echo "$name: the registry did not answer, so nothing was looked at ($(head -n 1 <<<"$said"))."
        fi
        ;;
    esac
}

# It gets an environment of its own: its packages are none of ours.
if [[ -x build/audit/bin/pip-audit ]] ||
    { python3 -m venv build/audit && build/audit/bin/pip install --quiet "$pip_audit"; } >/dev/null 2>&1; then
    ask "Python packages" "Found [0-9]+ known vulnerabilit" \
        build/audit/bin/pip-audit --requirement requirements.lock --no-deps --disable-pip --progress-spinner off
else
    echo "Python packages: pip-audit could not be installed, so nothing was looked at."
fi
ask "Web packages" "severity|vulnerabilit(y|ies)\b.*(low|moderate|high|critical)" npm --prefix web audit --omit=dev

exit "$failed"
