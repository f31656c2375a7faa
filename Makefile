# Everything runs from a virtual environment inside the checkout; each target sets it up when needed.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready

.PHONY: demo test check lock clean

demo: $(READY)
	@mkdir -p out
	$(BIN)/motionlayer run examples/gantry/machine.toml --trace out/gantry.trace --plot out/gantry.html
	$(BIN)/motionlayer verify out/gantry.trace

test: $(READY)
	$(BIN)/python scripts/check.py --all

check: $(READY)
	$(BIN)/python scripts/check.py

$(READY): requirements.lock pyproject.toml
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements.lock
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation -e .
	@touch $(READY)

lock: $(READY)
	$(BIN)/python scripts/lock.py

clean:
	rm -rf $(VENV) out build dist .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .hypothesis
