# Everything runs in a virtual environment of its own: Python 3.11 is all that a machine needs.
# DISTRO=kilted takes ROS 2 Kilted in place of Jazzy.
PYTHON ?= python3
DISTRO ?= jazzy
VENV := $(if $(filter jazzy,$(DISTRO)),.venv,.venv-$(DISTRO))
BIN := $(VENV)/bin
# Nodes wait for one another most of the time: three tests at once for two cores.
PYTEST_OPTIONS := --numprocesses 3 --dist loadfile --no-loadscope-reorder
# Done once, and not by each of them at the same time.
COMPILE := 'from vehicle_roll_sim.simulation.compilation import compile_model; compile_model()'
OLDEST := test/vehicle test/model/test_reference_conditions.py test/analysis/test_linear_model.py \
	$(patsubst %,test/command_line/test_%.py,version run_results run_refusals plot_command \
	replay_command linearize without_numba)
PINNED := requirements/base.txt requirements/$(DISTRO).txt requirements/test.txt
export ROS_AUTOMATIC_DISCOVERY_RANGE ?= LOCALHOST

.PHONY: setup run test coverage oldest audit bench soak mutations controllers lint format build clean

setup: $(VENV)/.ready

$(VENV)/.ready: requirements/build.txt $(PINNED) setup.py setup.cfg
	$(PYTHON) -m venv $(VENV)
	$(BIN)/pip install --quiet --requirement requirements/build.txt
	$(BIN)/pip install --quiet $(addprefix --requirement ,$(PINNED))
	PYTHONWARNINGS=ignore $(BIN)/pip install --quiet --no-deps --no-build-isolation --editable .
	touch $@

run: setup
	$(BIN)/demo

# With COVERAGE=yes also which lines and branches of the package run, in processes of their own, too.
test: setup
	$(BIN)/python -c $(COMPILE)
ifdef COVERAGE
	$(BIN)/python -m coverage erase
	$(BIN)/python -m coverage run -m pytest $(PYTEST_OPTIONS) $(TESTS)
	$(BIN)/python -m coverage combine --quiet
	$(BIN)/python -m coverage report
else
	$(BIN)/python -m pytest $(PYTEST_OPTIONS) $(TESTS)
endif

coverage:
	$(MAKE) test COVERAGE=yes

# Files, simulation and command line with the oldest versions that setup.py allows, without ROS.
oldest:
	$(PYTHON) -m venv .venv-oldest
	.venv-oldest/bin/pip install --quiet --requirement requirements/oldest.txt
	PYTHONWARNINGS=ignore .venv-oldest/bin/pip install --quiet --no-deps --no-build-isolation --editable .
	.venv-oldest/bin/pip check
	.venv-oldest/bin/python -m pytest -q --disable-warnings $(OLDEST)

# Published vulnerabilities of what comes from the package index, with what that needs in turn; fails
# also if one could not be looked up. ROS and its messages come from its distribution.
audit:
	$(PYTHON) -m venv .venv-audit
	.venv-audit/bin/pip install --quiet --requirement requirements/audit.txt
	grep --no-filename --invert-match '^ros-' requirements/base.txt requirements/test.txt > .venv-audit/audited
	.venv-audit/bin/pip-audit --strict --requirement .venv-audit/audited

# Ten minutes; OPTIONS=--quick is rougher, --only NAME ... does a part.
bench: setup
	$(BIN)/python -m benchmarks $(OPTIONS)

# A million random messages, then a hundred times as many random cases of the models' properties.
soak: setup
	$(BIN)/python -m benchmarks.soak $(OPTIONS)
	$(BIN)/python -m pytest --hypothesis-profile soak test/model/test_properties_of_rates.py \
		test/model/test_properties_of_runs.py

# Deliberate faults, and whether a test catches each: some fifteen minutes.
mutations: setup
	$(BIN)/python -m benchmarks.mutations $(OPTIONS)

# What each example controller does, in lockstep; brings the README's table up to date.
controllers: setup
	$(BIN)/python -m benchmarks.controllers README.md

lint: setup
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

format: setup
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

build: setup
	. $(BIN)/activate && colcon build

clean:
	rm -rf .venv .venv-* build install log run
