# make run   sets up, runs the calibrated study, prints the table and where the report is; STUDY=… runs another
# make test  sets up and runs every test, the slow physics included
# make long  tests that take longer, with some minutes of kills, full disks, flipped bits and signals
# make torture COUNT=200  those so often each; a later call goes on; ONLY=damage for those trials alone
# make coverage  400 synthetic machines a world: how often intervals hold the truth; half an hour
# make faults  200 changes of formulas, signs, factors and thresholds: which do the tests see; about an hour
# make evidence  evidence.json from what the tests claim; LONG=1 with the long tests; make docs shows it
# make docs  sets up and builds the site into docs/_build/html
# Compiled modules are kept: without them each start takes two seconds more.
unexport PYTHONDONTWRITEBYTECODE
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STUDY ?= pipelines/copeland_sources.toml
MINUTES ?= 10
COUNT ?= 200
ONLY ?=

.PHONY: run test long torture coverage faults evidence docs check lock clean versions newest

run: $(VENV)/.core
	$(BIN)/vibroacoustics run $(STUDY)

test: $(VENV)/.dev
	$(BIN)/pytest -n auto --dist loadfile --no-loadscope-reorder --durations=25

long: $(VENV)/.dev
	$(BIN)/pytest -n auto -m long
	$(BIN)/python -W ignore tests/robustness/torture.py --minutes $(MINUTES)

torture: $(VENV)/.dev
	$(BIN)/python -W ignore tests/robustness/torture.py --tries $(COUNT) --file build/torture.csv --only $(ONLY)

coverage: $(VENV)/.dev
	$(BIN)/pytest -n 0 -s -m long tests/invariants/test_coverage.py

# Goes on where it was stopped; SEED=2 changes other places.
SEED ?= 1
faults: $(VENV)/.dev
	$(BIN)/python tests/robustness/seeded_faults.py --seed $(SEED) --jobs 2

# Light tests on every Python that is promised, as far as it is here; not part of `make test`.
versions:
	$(PYTHON) tests/on_every_python.py

# The same and the radiation with the newest numpy, scipy, h5py, … beside k-Wave, which pins older ones.
newest:
	$(PYTHON) tests/on_every_python.py --newest

# Rows of tests that do not run stay as they are.
evidence: $(VENV)/.dev
	$(BIN)/pytest -n auto --dist loadfile --evidence $(if $(LONG),-m "") $$(grep -rl "import claim$$" tests)

# Offline; the pages of the gallery are run. A warning is an error.
docs: $(VENV)/.dev
	$(BIN)/sphinx-build -W --keep-going --quiet -b html docs docs/_build/html
	@echo "site: docs/_build/html/index.html"

# Format, lint, types, the import contracts and circles of imports.
check: $(VENV)/.dev
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/python tests/house/acyclic.py vibroacoustics

$(VENV)/.core: requirements.lock requirements-kwave.lock pyproject.toml
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --require-hashes -r requirements.lock
	$(BIN)/python -m pip install --quiet --require-hashes --no-deps -r requirements-kwave.lock
	$(BIN)/python -m pip install --quiet --no-deps -e .
	$(BIN)/vibroacoustics check pipelines/copeland_sources.toml > /dev/null  # compiles for all runs
	touch $@

$(VENV)/.dev: requirements-dev.lock $(VENV)/.core
	$(BIN)/python -m pip install --quiet --require-hashes -r requirements-dev.lock
	touch $@

# Needs uv. The locks hold hashes and no address of any package index. k-Wave has one of its own: where
# its pins have no wheels it is installed without them.
LOCK := uv pip compile --universal --python-version 3.11 --generate-hashes --no-header --no-annotate \
	--no-emit-index-url --no-emit-find-links --no-strip-extras --quiet
lock:
	$(LOCK) pyproject.toml -o requirements.lock
	$(LOCK) pyproject.toml --extra dev --extra docs -o requirements-dev.lock
	grep -o 'k-wave-python==[0-9.]*' pyproject.toml | $(LOCK) --no-deps - -o requirements-kwave.lock

clean:
	rm -rf docs/_build docs/examples docs/generated
	rm -rf $(VENV) .pytest_cache .mypy_cache .ruff_cache .hypothesis .import_linter_cache
