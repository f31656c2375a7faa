# Everything runs from a virtual environment inside the checkout; each target sets it up when needed.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready

.PHONY: demo test check campaign profile reference lock clean

demo: $(READY)
	@mkdir -p out
	$(BIN)/motionlayer run examples/gantry/machine.toml --trace out/gantry.trace --plot out/gantry.html
	$(BIN)/motionlayer verify out/gantry.trace

test: $(READY)
	$(BIN)/python scripts/check.py --all

check: $(READY)
	$(BIN)/python scripts/check.py

# generated pages of the documentation, after a change of tables, options, keys or blocks
reference: $(READY)
	$(BIN)/python scripts/reference.py
	$(BIN)/python scripts/blocks.py
	$(BIN)/python scripts/layer_types.py
	$(BIN)/python scripts/ads_methods.py
	$(BIN)/python scripts/layer_states.py
	$(BIN)/python scripts/layer_picture.py
	$(BIN)/python scripts/motion_pictures.py

# make campaign NAME=planning|life|blocks|contract|ads|siege|mutation [COUNT=1e6] [SEED=1] [CASE=1234] [FRESH=1]
campaign: $(READY)
	$(BIN)/python scripts/campaign.py --name "$(NAME)" $(if $(COUNT),--count $(COUNT)) $(if $(SEED),--seed $(SEED)) \
		$(if $(CASE),--case $(CASE)) $(if $(FRESH),--fresh)

# make profile CASE=plan|cycle|override|trace|start
profile: $(READY)
	$(BIN)/python scripts/profile_case.py "$(CASE)"

$(READY): requirements.lock pyproject.toml
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements.lock
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation -e .
	@touch $(READY)

lock: $(READY)
	$(BIN)/python scripts/lock.py

clean:
	rm -rf $(VENV) out build dist .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .hypothesis
