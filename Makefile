# make book, make test: the two commands of the README. `make help` lists the others.
PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
JOBS   ?= 2
LARGEST ?= 200000
COUNT  ?= 10000
SEED   ?= 0
LOCKED := --universal --python-version 3.11 --generate-hashes --no-emit-index-url --no-header --no-annotate -q
FIRST  := notebooks/01_introduction.ipynb
# What the pages are made of or link to; nothing is built again while all of it is older than the last build.
PARTS  := book.toml Makefile notebooks polyskel_lite tools tests benchmarks $(VENV)/.book
BUILT  := _build/html/.built
AS_ROOT = $(if $(filter 0,$(shell id -u)),--allow-root) # in a container, as a rule

.DEFAULT_GOAL := help
.PHONY: help book test lint unit chapters browser course grade course-test lab lite figures bench fuzz run lock clean

help:  ## list the commands
	@grep -E '^[a-z-]+:.*##' Makefile | sed -E 's/:[^#]*## */|/' | awk -F'|' '{ printf "  make %-11s %s\n", $$1, $$2 }'

# One environment; the packages of a lock come when a command needs them, and again when the lock changes.
LOCKS := $(VENV)/.book $(VENV)/.lab $(VENV)/.test $(VENV)/.lite $(VENV)/.course
$(LOCKS): $(VENV)/.%: requirements/%.lock
	@"$(PYTHON)" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || { \
	  echo "polyskel_lite needs Python 3.11 or newer; '$(PYTHON)' is $$("$(PYTHON)" -V 2>/dev/null || echo not there)." \
	       "Name another one, for example: make PYTHON=python3.12 $(or $(MAKECMDGOALS),book)"; exit 1; }
	@"$(PYTHON)" tools/environment.py $*

book: $(VENV)/.book  ## build the HTML book from book.toml and notebooks/
	@mkdir -p _build
	@test -e $(BUILT) && test -z "$$(find $(PARTS) -name __pycache__ -prune -o -newer $(BUILT) -print -quit)" || { \
	  echo "Building the book (about half a minute the first time) ..." && touch _build/.begun && \
	  $(BIN)/python -m sphinx -W --keep-going -q -b html -d _build/doctrees notebooks _build/html && \
	  $(BIN)/python tools/check_offline.py _build/html && mv _build/.begun $(BUILT); }
	@git diff --quiet HEAD -- notebooks/*.ipynb 2>/dev/null || echo "Note: these chapters differ from what is committed:" \
	  "$$(git diff --name-only HEAD -- notebooks/*.ipynb 2>/dev/null | tr '\n' ' ')"
	@echo "The book is ready. Open $(CURDIR)/_build/html/index.html"

test: lint unit chapters browser  ## run everything: ruff, tests, doctests, every notebook, every page in a browser
	@echo "All passed."

lint: $(VENV)/.test  ## ruff: rules and format; mypy: types
	@$(BIN)/ruff check
	@$(BIN)/ruff format --check
	@$(BIN)/mypy

unit: book $(VENV)/.test  ## unit and property tests, doctests
	@echo "Unit tests, property tests and doctests ..."
	@$(BIN)/python -m pytest -n $(JOBS) --mpl -rs --ignore tests/browser

# addopts is emptied because doctest has nothing to find in a notebook. A chapter is one process: --dist loadfile.
chapters: $(VENV)/.test  ## run every notebook and compare with what is stored
	@echo "Every chapter from top to bottom, compared with its stored outputs ..."
	@env -u MPLBACKEND $(BIN)/python -m pytest -o addopts= -n $(JOBS) --dist loadfile --nbval --nbval-current-env \
	  --nbval-sanitize-with tests/nbval_sanitize.cfg --nbval-cell-timeout 600 notebooks

browser: book $(VENV)/.test  ## every page, the viewer and the explorers in Chromium (skipped where there is none)
	@echo "Pages, viewer and explorers in Chromium ..."
	@BOOK="$(CURDIR)/_build/html" $(BIN)/python -m pytest -n $(JOBS) --dist loadgroup tests/browser

course: book $(VENV)/.course  ## write assignments, slides, handout and guide to _course/; ASSIGNMENT=a2, SECRET=word
	@$(BIN)/python tools/course.py --assignment "$(ASSIGNMENT)" --secret "$(SECRET)"

# It runs strangers' code, and nothing keeps that in: see tools/grading.py.
grade: $(VENV)/.course  ## mark the submissions in a folder, FROM=folder: in a container or a throw-away account
	@$(BIN)/python tools/grading.py $(if $(FROM),"$(FROM)")

course-test: $(VENV)/.test  ## mark through nbgrader, and under ten secrets (four minutes)
	@$(BIN)/python -m pytest -m slow tests/coursework

lab: book $(VENV)/.lab  ## open the first chapter in JupyterLab, as a copy that is yours to change
	@$(BIN)/python tools/working_copies.py _build/lab
	@$(BIN)/jupyter trust _build/lab/notebooks/*.ipynb >/dev/null # or pictures of lines are not shown
	$(BIN)/jupyter lab $(AS_ROOT) --ServerApp.root_dir=_build/lab _build/lab/$(FIRST)

lite: book $(VENV)/.lite  ## build a site in which the chapters run in the browser, nothing to install
	@echo "Building the browser site (about ten seconds) ..."
	@$(BIN)/python tools/build_lite.py --output _build/lite
	@echo "The site is ready, for a web server. To try it: $(BIN)/python -m http.server --directory _build/lite"

figures: $(VENV)/.lab  ## write the paper's figures (PDF, SVG, PNG; two widths) and a manifest to figures/
	@echo "Drawing the paper's figures into figures/ ..."
	@$(BIN)/python -m polyskel_lite.figures figures/

bench: $(VENV)/.lab  ## measure every stage against scipy's Delaunay, and every target (see benchmarks/README.md)
	@$(BIN)/python benchmarks/stages.py --largest $(LARGEST)
	@$(BIN)/python benchmarks/targets.py $(if $(filter 200000,$(LARGEST)),,--largest $(LARGEST))

fuzz: $(VENV)/.test  ## hostile arrays, files and shapes, COUNT of each from SEED (an hour)
	@PYTHONPATH=tests $(BIN)/python -m fuzz --count $(COUNT) --seed $(SEED) --report benchmarks/fuzz.csv

run: $(VENV)/.lab  ## maintainers: run every notebook and store its outputs
	@$(BIN)/python tools/register.py
	@env -u MPLBACKEND $(BIN)/python tools/run_notebooks.py

lock:  ## maintainers: resolve pyproject.toml anew into requirements/*.lock (needs uv)
	@uv pip compile pyproject.toml --extra lab --extra course --group install --group book --group lite --group test $(LOCKED) \
	  -o requirements/union.txt
	@for purpose in "book --group book" "lab pyproject.toml --extra lab --group install" \
	  "lite pyproject.toml --extra graph --group install --group lite" \
	  "course pyproject.toml --extra lab --extra course --group install" \
	  "test pyproject.toml --extra lab --extra course --group install --group lite --group test"; do \
	  set -- $$purpose; name=$$1; shift; uv pip compile "$$@" $(LOCKED) -c requirements/union.txt \
	    -o requirements/$$name.lock || exit 1; done
	@echo uv | uv pip compile - $(LOCKED) -o requirements/uv.lock
	@rm requirements/union.txt

clean:  ## remove what the commands above made, except the environment and your copies in _build/lab
	test ! -d _build || find _build -mindepth 1 -maxdepth 1 ! -name lab ! -name pyodide -exec rm -rf {} +
	rm -rf figures dist .pytest_cache .ruff_cache .hypothesis
	find . -name __pycache__ -not -path './.venv/*' -prune -exec rm -rf {} +
