# make book, make test: the two commands of the README. `make help` lists the others.
PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
JOBS   ?= 2
LARGEST ?= 200000
COUNT  ?= 10000
SEED   ?= 0
FIRST  := notebooks/01_introduction.ipynb

.DEFAULT_GOAL := help
.PHONY: help book test lint unit chapters browser lab lite figures bench fuzz run lock clean

help:  ## list the commands
	@grep -E '^[a-z]+:.*##' Makefile | sed -E 's/:[^#]*## */|/' | awk -F'|' '{ printf "  make %-9s %s\n", $$1, $$2 }'

# The stamp is newer than the lock once everything in it is installed, so this runs only when the lock changes.
$(VENV)/.installed: requirements.lock
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || { \
	  echo "polyskel_lite needs Python 3.11 or newer; '$(PYTHON)' is $$($(PYTHON) -V 2>/dev/null || echo not there)." \
	       "Name another one, for example: make PYTHON=python3.12 $(or $(MAKECMDGOALS),book)"; exit 1; }
	@echo "Installing the packages of requirements.lock into $(VENV) (once, a minute or two) ..."
	@test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	@$(BIN)/python -m pip install --disable-pip-version-check -qq --require-hashes -r requirements.lock
	@$(BIN)/python -m pip install --disable-pip-version-check -qq --no-deps --no-build-isolation -e .
	@echo "Compiling the loops of the library (once, half a minute) ..."
	@$(BIN)/python -c 'from polyskel_lite.compiling import main; main()'
	@touch $@

book: $(VENV)/.installed  ## build the HTML book from book.toml and notebooks/
	@echo "Building the book (about half a minute the first time) ..."
	@$(BIN)/python -m sphinx -W --keep-going -q -b html -d _build/doctrees notebooks _build/html
	@$(BIN)/python tools/check_offline.py _build/html
	@echo "The book is ready. Open $(CURDIR)/_build/html/index.html"

test: lint unit chapters browser  ## run everything: ruff, tests, doctests, every notebook, every page in a browser
	@echo "All passed."

lint: $(VENV)/.installed  ## ruff: rules and format
	@$(BIN)/ruff check
	@$(BIN)/ruff format --check

unit: $(VENV)/.installed  ## unit and property tests, doctests
	@echo "Unit tests, property tests and doctests ..."
	@$(BIN)/python -m pytest -n $(JOBS) --mpl -rs --ignore tests/browser

# addopts is emptied because doctest has nothing to find in a notebook. A chapter is one process: --dist loadfile.
chapters: $(VENV)/.installed  ## run every notebook and compare with what is stored
	@echo "Every chapter from top to bottom, compared with its stored outputs ..."
	@env -u MPLBACKEND $(BIN)/python -m pytest -o addopts= -n $(JOBS) --dist loadfile --nbval --nbval-current-env \
	  --nbval-sanitize-with tests/nbval_sanitize.cfg --nbval-cell-timeout 600 notebooks

browser: book  ## every page, the viewer and the explorers in Chromium (skipped where there is none)
	@echo "Pages, viewer and explorers in Chromium ..."
	@BOOK=$(CURDIR)/_build/html $(BIN)/python -m pytest -n $(JOBS) --dist loadgroup tests/browser

lab: $(VENV)/.installed  ## open the first chapter in JupyterLab
	$(BIN)/jupyter lab $(FIRST)

lite: $(VENV)/.installed  ## build a site in which the chapters run in the browser, nothing to install
	@echo "Building the browser site (about ten seconds) ..."
	@$(BIN)/python tools/build_lite.py --output _build/lite
	@echo "The site is ready, for a web server. To try it: $(BIN)/python -m http.server --directory _build/lite"

figures: $(VENV)/.installed  ## write the paper's figures (PDF, SVG, PNG; two widths) and a manifest to figures/
	@echo "Drawing the paper's figures into figures/ ..."
	@$(BIN)/python -m polyskel_lite.figures figures/

bench: $(VENV)/.installed  ## measure every stage against scipy's Delaunay, and every target (see benchmarks/README.md)
	@$(BIN)/python benchmarks/stages.py --largest $(LARGEST)
	@$(BIN)/python benchmarks/targets.py $(if $(filter 200000,$(LARGEST)),,--largest $(LARGEST))

fuzz: $(VENV)/.installed  ## hostile arrays, files and shapes, COUNT of each from SEED (an hour)
	@PYTHONPATH=tests $(BIN)/python -m fuzz --count $(COUNT) --seed $(SEED) --report benchmarks/fuzz.csv

run: $(VENV)/.installed  ## maintainers: run every notebook and store its outputs
	@env -u MPLBACKEND $(BIN)/python tools/run_notebooks.py

lock: $(VENV)/.installed  ## maintainers: resolve pyproject.toml anew into requirements.lock (needs uv)
	@uv pip compile pyproject.toml --extra lab --extra book --extra lite --extra test --universal --python-version 3.11 \
	  --generate-hashes --no-emit-index-url --no-header -o requirements.lock

clean:  ## remove what the commands above made, except the environment
	rm -rf _build figures dist .pytest_cache .ruff_cache .hypothesis
	find . -name __pycache__ -not -path './.venv/*' -prune -exec rm -rf {} +
