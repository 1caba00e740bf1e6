#!/usr/bin/env bash
# Check what the system itself has to bring, and install what is missing where that is allowed.
# Use: system-packages.sh run|test
set -euo pipefail

purpose=${1:?"say what for: run or test"}
here=${BASH_SOURCE[0]%/*}
oldest_node="20.19"
rendering=(libegl1 libegl-mesa0 libgl1-mesa-dri)

required=() # packages without which nothing works
optional=() # packages without which only the pictures of tasks are missing

main() {
    local unmet=0
    check_python || unmet=1
    check_node || unmet=1
    ((unmet == 0)) || exit 1
    check_rendering
    if [[ $purpose == test ]]; then
        check_chromium
        check_postgres
    fi
    install_missing
    if [[ $purpose == test ]]; then
        "$here/find-chromium.sh" >/dev/null
        "$here/find-postgres.sh" >/dev/null
    fi
}

check_python() {
    local python
    python=$("$here/find-python.sh") || return 1
    "$python" -c 'import ensurepip, venv' 2>/dev/null || required+=("${python##*/}-venv")
}

check_node() {
    local version minor
    if ! version=$(node --version 2>/dev/null); then
        echo "Node.js $oldest_node or newer is needed, and there is none: install it from https://nodejs.org and run make again." >&2
        return 1
    fi
    version=${version#v}
    minor=${version#*.}
    minor=${minor%%.*}
    if ((${version%%.*} * 1000 + minor < ${oldest_node%.*} * 1000 + ${oldest_node#*.})); then
        echo "Node.js $oldest_node or newer is needed, but this one is $version: install a newer one from https://nodejs.org and run make again." >&2
        return 1
    fi
    command -v npm >/dev/null || required+=(npm)
}

check_rendering() {
    local package
    command -v dpkg-query >/dev/null || return 0
    for package in "${rendering[@]}"; do
        if [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) != installed ]]; then
            if [[ $purpose == test ]]; then required+=("$package"); else optional+=("$package"); fi
        fi
    done
}

check_chromium() {
    "$here/find-chromium.sh" >/dev/null 2>&1 && return
    # Ubuntu has it as a snap only, which containers cannot install: find-chromium.sh says what to do.
    [[ $(os_name) == ubuntu ]] || required+=(chromium)
}

check_postgres() {
    "$here/find-postgres.sh" >/dev/null 2>&1 || required+=(postgresql)
}

os_name() {
    (. "${OS_RELEASE:-/etc/os-release}" 2>/dev/null && echo "${ID:-unknown}")
}

install_missing() {
    local missing=("${required[@]}" "${optional[@]}")
    ((${#missing[@]})) || return 0
    if command -v apt-get >/dev/null && [[ $(id -u) == 0 ]]; then
        echo "Installing system packages: ${missing[*]}"
        apt_install "${missing[@]}" && return
    fi
    if ((${#required[@]})); then
        echo "System packages are missing; install them with: sudo apt-get install -y ${missing[*]}" >&2
        exit 1
    fi
    echo "Tasks will have no pictures; to see them: sudo apt-get install -y ${missing[*]}" >&2
}

apt_install() {
    export DEBIAN_FRONTEND=noninteractive
    apt-get update -qq </dev/null && apt-get install -y -qq "$@" </dev/null >/dev/null
}

main
