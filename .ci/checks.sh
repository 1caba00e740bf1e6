#!/usr/bin/env bash
# Run the checks named as arguments, or all, one after the other; go on after a failure and name every one at the end.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

every=(lint format imports types client web-check web-test pytest)
wanted=("$@")
[[ ${*:-all} != all ]] || wanted=("${every[@]}")
client="web/src/client/schema.gen.ts"

check_lint() { .venv/bin/ruff check; }
check_format() { .venv/bin/ruff format --check; }
check_imports() { .venv/bin/lint-imports; }
check_types() { .venv/bin/pyright; }
check_web-check() { npm --prefix web run --silent check; }
check_web-test() { npm --prefix web run --silent test; }

check_pytest() {
    SLDR_CHROMIUM=$(.ci/find-chromium.sh) || return
    export SLDR_CHROMIUM
    # Most tests wait for other processes, so a third one finds time; tests/conftest.py says what stays together.
    .venv/bin/pytest --numprocesses $(($(nproc) + 1)) --dist loadfile --no-loadscope-reorder \
        --durations 25 --durations-min 5 && return
    # Deadlines can pass on a machine that is busy elsewhere, so what failed beside others is asked once more, alone.
    echo "== pytest, only what has just failed, one after the other"
    .venv/bin/pytest --last-failed --last-failed-no-failures none || return
    echo "These tests failed beside others and passed alone, see above: a deadline too short, or something shared." >&2
}

check_client() {
    mkdir -p build && cp "$client" build/client-before.ts || return
    make client && cmp --silent "$client" build/client-before.ts && return
    cp build/client-before.ts "$client"
    echo "The page's client is older than the API: run 'make client' and commit $client." >&2
    return 1
}

failed=()
report=()
for part in "${wanted[@]}"; do
    if ! declare -F "check_$part" >/dev/null; then
        echo "No check is called '$part'. There are: ${every[*]}." >&2
        exit 2
    fi
    echo "== $part"
    started=$SECONDS
    if "check_$part"; then result=ok; else result=FAILED && failed+=("$part"); fi
    report+=("$(printf '%-10s %-6s %4d s' "$part" "$result" $((SECONDS - started)))")
done

printf '\n%s\n' "== all checks"
printf '%s\n' "${report[@]}"
if ((${#failed[@]})); then
    echo "Failed: ${failed[*]}. Again, those only: make test PARTS=\"${failed[*]}\"" >&2
    exit 1
fi
