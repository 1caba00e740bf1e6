#!/usr/bin/env bash
# Run the checks named as arguments, or all; go on after a failure and name every one at the end.
# `slow` is asked for by name alone: the full sample sizes of tests that run with small ones otherwise.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Some machines ask Python to keep no compiled code; hundreds of processes would then compile all modules anew.
unset PYTHONDONTWRITEBYTECODE

every=(lint format imports types client web-check web-test pytest)
wanted=("$@")
[[ ${1:-all} != all ]] || wanted=("${every[@]}" "${@:2}")
# Tests wait for other processes much of the time, and these fill it; what they say is kept until their turn comes.
# They give way, as tests have deadlines and these have none.
beside_pytest=(types web-check web-test)
giving_way=(nice -n 10)
client="web/src/client/schema.gen.ts"

check_lint() { .venv/bin/ruff check; }
check_format() { .venv/bin/ruff format --check; }
check_imports() { .venv/bin/lint-imports; }
check_types() { "${giving_way[@]}" .venv/bin/pyright; }
check_web-check() { "${giving_way[@]}" npm --prefix web run --silent check; }
check_web-test() { "${giving_way[@]}" npm --prefix web run --silent test; }

check_pytest() {
    SLDR_CHROMIUM=$(.ci/find-chromium.sh) || return
    export SLDR_CHROMIUM
    # Many tests wait for other processes, so two more find time; tests/conftest.py says what stays together.
    .venv/bin/pytest --numprocesses $(($(nproc) + 2)) --dist loadfile --no-loadscope-reorder \
        --durations 25 --durations-min 5 && return
    # Deadlines can pass on a machine that is busy elsewhere, so what failed beside others is asked once more, alone.
    echo "== pytest, only what has just failed, one after the other"
    .venv/bin/pytest --last-failed --last-failed-no-failures none || return
    echo "These tests failed beside others and passed alone, see above: a deadline too short, or something shared." >&2
}

check_slow() {
    SLDR_CHROMIUM=$(.ci/find-chromium.sh) || return
    export SLDR_CHROMIUM
    .venv/bin/pytest -m slow --numprocesses "$(nproc)" --dist loadfile --timeout 1800 --durations 25 --durations-min 5
}

check_client() {
    mkdir -p build && cp "$client" build/client-before.ts || return
    make client && cmp --silent "$client" build/client-before.ts && return
    cp build/client-before.ts "$client"
    echo "The page's client is older than the API: run 'make client' and commit $client." >&2
    return 1
}

# Print what a check says, and leave how it ended and how long it took in a file.
run() {
    local started=$SECONDS result=ok
    echo "== $1"
    "check_$1" || result=FAILED
    echo "$result $((SECONDS - started))" >"$results/$1"
}

for part in "${wanted[@]}"; do
    if ! declare -F "check_$part" >/dev/null; then
        echo "No check is called '$part'. There are: ${every[*]} slow." >&2
        exit 2
    fi
done

results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT
begun=()
if [[ " ${wanted[*]} " == *" pytest "* ]]; then
    for part in "${wanted[@]}"; do [[ " ${beside_pytest[*]} " != *" $part "* ]] || begun+=("$part"); done
fi

for part in "${wanted[@]}"; do
    if [[ " ${begun[*]} " == *" $part "* ]]; then continue; fi
    if [[ $part == pytest ]]; then
        for other in "${begun[@]}"; do run "$other" >"$results/$other.said" 2>&1; done &
        run pytest
        wait
        for other in "${begun[@]}"; do cat "$results/$other.said"; done
    else
        run "$part"
    fi
done

failed=()
report=()
for part in "${wanted[@]}"; do
    read -r result seconds <"$results/$part"
    [[ $result == ok ]] || failed+=("$part")
    report+=("$(printf '%-10s %-6s %4d s' "$part" "$result" "$seconds")")
done

printf '\n%s\n' "== all checks"
printf '%s\n' "${report[@]}"
if ((${#failed[@]})); then
    echo "Failed: ${failed[*]}. Again, those only: make test PARTS=\"${failed[*]}\"" >&2
    exit 1
fi
