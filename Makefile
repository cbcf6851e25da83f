# make run   sets up, runs the main job, prints the table and where the report is
# make test  sets up and runs every test, the slow physics included
# make long  kills, full disks, writers beside readers, flipped bits and signals, for an hour
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STUDY ?= pipelines/copeland_thesis.toml
MINUTES ?= 60

.PHONY: run test long check lock clean

run: $(VENV)/.core
	$(BIN)/vibroacoustics run $(STUDY)

test: $(VENV)/.dev
	$(BIN)/pytest -n auto --dist loadfile

long: $(VENV)/.dev
	$(BIN)/python -W ignore tests/robustness/torture.py --minutes $(MINUTES)

# Format, lint, types and the import contract.
check: $(VENV)/.dev
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports

$(VENV)/.core: requirements.lock pyproject.toml
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --require-hashes -r requirements.lock
	$(BIN)/python -m pip install --quiet --no-deps -e .
	touch $@

$(VENV)/.dev: requirements-dev.lock $(VENV)/.core
	$(BIN)/python -m pip install --quiet --require-hashes -r requirements-dev.lock
	touch $@

# Needs uv. The locks hold hashes and no address of any package index.
LOCK := uv pip compile pyproject.toml --universal --generate-hashes --no-header --no-annotate \
	--no-emit-index-url --no-emit-find-links --quiet
lock:
	$(LOCK) -o requirements.lock
	$(LOCK) --extra dev --extra docs -o requirements-dev.lock

clean:
	rm -rf $(VENV) .pytest_cache .mypy_cache .ruff_cache .hypothesis .import_linter_cache
