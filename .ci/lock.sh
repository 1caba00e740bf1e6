#!/usr/bin/env bash
# Write requirements.lock: the exact version of everything that pyproject.toml brings, asked of pip in a fresh environment.
# A build's own suffix (torch 2.13.0+cpu) and its CUDA packages are left out: which build fits is for the machine to say.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

fresh=$(mktemp -d)
trap 'rm -rf "$fresh"' EXIT
python=$(.ci/find-python.sh)
"$python" -m venv "$fresh/venv"
"$fresh/venv/bin/python" -m pip install --quiet --dry-run --report "$fresh/report.json" ".[test]"

"$fresh/venv/bin/python" - "$fresh/report.json" >"$fresh/requirements.lock" <<'PYTHON'
import json
import re
import sys

LEFT_OUT = re.compile(r"sldr$|nvidia-|cuda-|triton")

with open(sys.argv[1], encoding="utf-8") as file:
    found = [entry["metadata"] for entry in json.load(file)["install"]]
print("# Written by `make lock` from pyproject.toml.")
for package in sorted(found, key=lambda package: package["name"].lower()):
    if not LEFT_OUT.match(package["name"].lower()):
        print(f"{package['name']}=={package['version'].partition('+')[0]}")
PYTHON
cmp --silent "$fresh/requirements.lock" requirements.lock || mv "$fresh/requirements.lock" requirements.lock
echo "requirements.lock: $(grep -c == requirements.lock) packages"
