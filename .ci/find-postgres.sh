#!/usr/bin/env bash
# Print the directory of PostgreSQL's programs for the tests; SLDR_POSTGRES names one to use instead.
set -euo pipefail

# Debian keeps the server out of PATH, a directory per version.
root=${POSTGRES_ROOT:-/usr/lib/postgresql}
places=()
if [[ -n ${SLDR_POSTGRES:-} ]]; then
    places=("$SLDR_POSTGRES")
else
    ! path=$(command -v initdb) || places+=("${path%/*}")
    for path in "$root"/*/bin; do places=("$path" "${places[@]}"); done
fi

for place in "${places[@]}"; do
    if [[ -x $place/initdb && -x $place/postgres ]]; then
        echo "$place"
        exit 0
    fi
done

echo "The tests start PostgreSQL themselves, and its programs initdb and postgres are not here: install them with: sudo apt-get install -y postgresql, or name their directory with SLDR_POSTGRES=/path/to/bin." >&2
exit 1
