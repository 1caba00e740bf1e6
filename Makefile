# Everything is made from here: `make run` to use it, `make test` to check it, `make help` for the rest.
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
MAKEFLAGS += --no-builtin-rules --no-print-directory
.DELETE_ON_ERROR:

HOST ?= 127.0.0.1
PORT ?= 8000
# The parts of the check to run; see .ci/checks.sh.
PARTS ?= all
# Requests that `make fuzz` makes up for each operation, each sent as nobody and as three roles.
FUZZ ?= 70
# Options of `make chaos`; `make chaos CHAOS=--help` lists them.
CHAOS ?=
# Options of `make bench`; `make bench BENCH=--help` lists them.
BENCH ?=
# Locomotion models that `make pictures-3d` takes its pictures of.
MODELS ?=
# What the system packages are for: run, or test.
purpose := run

PIP := .venv/bin/python -m pip --disable-pip-version-check --quiet
WEB_SOURCES := $(shell find web/src web/public -type f -not -name '*.test.*' 2>/dev/null)
CLIENT := web/src/client/schema.gen.ts

.PHONY: run test test-all fuzz audit chaos bench pictures pictures-3d setup web client lock format clean help system

run: setup ## Set everything up and serve the page; HOST and PORT say where
	@exec .venv/bin/sldr serve --host $(HOST) --port $(PORT)

test: setup ## Set everything up and run every check; PARTS="lint pytest" runs some
	@.ci/checks.sh $(PARTS)

test-all: setup ## The same, and then all tests at their full sample sizes (an hour)
	@.ci/checks.sh all slow

fuzz: setup ## Ask the API about 40,000 things that nobody would, as each role (a quarter of an hour)
	@SLDR_FUZZ_EXAMPLES=$(FUZZ) .venv/bin/pytest -o addopts=--strict-markers tests/security/made_up_requests.py --timeout 0

audit: setup ## Ask the registries whether a dependency has a known weakness
	@.ci/audit.sh

chaos: setup ## Kill, crowd and hurry a service; the results go into docs/reliability.md (many minutes)
	@PYTHONPATH=tests .venv/bin/python tests/chaos --write docs/reliability.md $(CHAOS)

bench: setup ## Measure speed beside peers; the table goes into docs/performance.md (many minutes, quiet machine)
	@PYTHONPATH=tests .venv/bin/python tests/benchmarks --write docs/performance.md $(BENCH)

pictures: setup ## Take a picture of every page, light and dark, into docs/pictures (minutes)
	@SLDR_CHROMIUM=$$(.ci/find-chromium.sh) .venv/bin/python tests/pictures docs/pictures

pictures-3d: setup ## Make the inspector's pictures in docs/pictures; MODELS names locomotion.pt files
	@SLDR_CHROMIUM=$$(.ci/find-chromium.sh) .venv/bin/python tests/pictures/inspector.py $(MODELS)

setup: system .make/package web ## Make the Python environment and build the page

web: web/dist/index.html ## Build the page

client: .make/package web/node_modules/.package-lock.json ## Generate the page's client from the API
	@.venv/bin/python -m backend.api.schema build/openapi.json
	@cd web && npm run --silent client
	@echo "$(CLIENT) fits the API"

lock: ## Ask pip again for the exact version of everything
	@.ci/lock.sh

format: .make/package web/node_modules/.package-lock.json ## Format all code and repair what can be repaired
	@.venv/bin/ruff check --quiet --fix || true
	@.venv/bin/ruff format
	@cd web && npm run --silent fix

clean: ## Remove everything that was made; trained runs stay
	rm -rf .make .venv build web/dist web/node_modules web/client-generator/node_modules *.egg-info

help: ## List what can be made
	@sed -nE 's/^([a-z0-9-]+):.*## (.*)/  make \1\t\2/p' Makefile | expand -t 16

test test-all fuzz bench pictures pictures-3d: purpose := test
system:
	@.ci/system-packages.sh $(purpose)

# Stamps say what the environment was made from, so that nothing is made twice.

.venv/pyvenv.cfg: | system
	@python=$$(.ci/find-python.sh); "$$python" -m venv --clear .venv

.make/python: requirements.lock .venv/pyvenv.cfg
	@echo "Installing the Python packages (minutes, the first time)"
	@$(PIP) install --requirement requirements.lock
	@mkdir -p .make && touch $@

.make/package: pyproject.toml .make/python
	@$(PIP) install --no-deps --no-build-isolation --editable .
	@touch $@

web/node_modules/.package-lock.json: web/package-lock.json web/package.json web/client-generator/package.json | system
	@echo "Installing the web packages"
	@cd web && npm ci --no-fund --no-audit --loglevel=error >/dev/null
	@touch $@

web/dist/index.html: web/node_modules/.package-lock.json web/index.html web/vite.config.ts web/tsconfig.json $(WEB_SOURCES)
	@echo "Building the page"
	@cd web && npm run --silent build -- --logLevel warn
	@touch $@
