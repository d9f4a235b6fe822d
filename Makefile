# make run | test | lint | docs | bench | lock. The first three need nothing but a Python and make: they fill .venv themselves.
PYTHON ?= python3

VENV := .venv/bin/python
# What is imported is compiled then, once, though the surroundings may forbid it: else each of the
# tests' hundred servers would compile it anew. To compile all that is installed takes twelve seconds.
unexport PYTHONDONTWRITEBYTECODE
PIP  := $(VENV) -m pip install --disable-pip-version-check --no-compile
# Written when an install has ended well: a .venv without it was interrupted, and is made anew.
RUNTIME := .venv/.requirements
TOOLS   := .venv/.requirements-dev

# An upgraded or removed system Python leaves a .venv that finds no packages.
BROKEN := $(shell test -e $(RUNTIME) && $(VENV) -c 'import pip' 2>/dev/null || echo broken)

.PHONY: run test lint docs bench lock broken
.DEFAULT_GOAL := run

run: $(RUNTIME)
	$(VENV) -m streamlit run app.py

# With the tools: a page of the documentation is made and looked at in a browser.
test: $(TOOLS)
	$(VENV) -m pytest -n auto

lint: $(TOOLS)
	$(VENV) -m ruff check
	$(VENV) -m ruff format --check
	$(VENV) -m pyright
	.venv/bin/lint-imports

bench: $(RUNTIME)
	$(VENV) -m pytest tests/benchmarks --benchmark-only

# The only target that needs uv. --upgrade: a lock is made to move; requirements.txt in git is what people install.
LOCK := uv pip compile --universal --python-version 3.11 --upgrade --quiet --no-emit-index-url \
	--no-annotate --custom-compile-command "make lock"
lock:
	$(LOCK) pyproject.toml --extra app --group test -o requirements.txt
	$(LOCK) --group dev -c requirements.txt -o requirements-dev.txt
	$(LOCK) pyproject.toml --extra app -c requirements.txt -o deploy/requirements.txt

$(RUNTIME): requirements.txt $(if $(BROKEN),broken)
	@$(PYTHON) -c 'import sys; sys.exit(not (3, 11) <= sys.version_info < (3, 15))' \
		|| { echo "rotorcalc needs Python 3.11 to 3.14: try make PYTHON=python3.13" >&2; exit 1; }
	@$(PYTHON) -m venv $(if $(BROKEN),--clear) .venv \
		|| { echo "$(PYTHON) -m venv failed; on Debian and Ubuntu: apt install python3-venv" >&2; exit 1; }
	@rm -f $(RUNTIME) $(TOOLS)
	$(PIP) -r requirements.txt
	@touch $@

$(TOOLS): requirements-dev.txt $(RUNTIME)
	$(PIP) -r requirements-dev.txt
	@touch $@

# Warnings are errors: a link that leads nowhere, a docstring that cannot be read.
docs: $(TOOLS)
	$(VENV) -m sphinx -W --keep-going -q docs build/docs
