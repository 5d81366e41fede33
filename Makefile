# `make demo` and `make test` each set everything up in .venv first, and compile the kernels, which
# later runs load; PYTHON chooses the interpreter.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
COMPILE := import midrib, shapely; midrib.collapse(shapely.box(0.0, 0.0, 3.0, 1.0))
.PHONY: demo test lint bench quality docs dev lock clean

$(VENV)/ready: pyproject.toml constraints.txt
	$(PYTHON) -m venv --clear $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r constraints.txt
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation -e .
	$(BIN)/python -c "$(COMPILE)"
	touch $@

demo: $(VENV)/ready
	$(BIN)/python examples/demo.py

test: $(VENV)/ready
	$(BIN)/python -m pytest

lint: $(VENV)/ready
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/codespell
	$(BIN)/mypy
	$(BIN)/lint-imports

bench: $(VENV)/ready
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r constraints-bench.txt
	$(BIN)/python benchmarks/speed.py
	$(BIN)/python benchmarks/batch.py
	$(BIN)/python benchmarks/methods.py
	$(BIN)/python benchmarks/scale.py
	$(BIN)/python benchmarks/scoreboard.py

quality: $(VENV)/ready
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r constraints-bench.txt
	$(BIN)/python benchmarks/scoreboard.py
	$(BIN)/python benchmarks/ribbons.py
	$(BIN)/python benchmarks/bays.py
	$(BIN)/python benchmarks/limit.py
	$(BIN)/python benchmarks/hatching.py
	$(BIN)/python benchmarks/hatching_limits.py
	$(BIN)/python benchmarks/drawn_by_others.py
	$(BIN)/python benchmarks/towers.py
	$(BIN)/python benchmarks/tower_kinks.py

# Warnings are errors, pages of names and figures that are gone among them: all are made anew.
docs: $(VENV)/ready
	rm -rf docs/api docs/gallery
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r constraints-docs.txt
	$(BIN)/python -m sphinx -W --keep-going -q -b html -d out/doctrees docs out/docs
	@echo "out/docs/index.html"

dev: $(VENV)/ready
	$(BIN)/pre-commit install

# Versions and hashes, no index address: they hold for whichever index pip is set up with.
lock:
	$(PYTHON) -m venv --clear $(VENV)-lock
	$(VENV)-lock/bin/python -m pip install --quiet pip-tools
	$(VENV)-lock/bin/python tools/lock.py
	rm -rf $(VENV)-lock

clean:
	rm -rf $(VENV) out docs/api docs/gallery
