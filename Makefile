# Everything runs in a virtual environment: a machine needs only Python 3.11.
# DISTRO=kilted uses ROS 2 Kilted instead of Jazzy.
PYTHON ?= python3
DISTRO ?= jazzy
VENV := $(if $(filter jazzy,$(DISTRO)),.venv,.venv-$(DISTRO))
BIN := $(VENV)/bin
# Nodes mostly wait for one another, so five test processes suit two cores.
PYTEST_OPTIONS := --numprocesses 5 --dist loadfile --no-loadscope-reorder
OLDEST := test/vehicle test/model/test_reference_conditions.py test/analysis/test_linear_model.py \
	$(patsubst %,test/command_line/test_%.py,version run_results run_refusals plot_command \
	replay_command linearize without_numba)
# What runs in the test process itself: the equations, vehicles, runs, session, messages and files.
QUICK := $(addprefix test/,vehicle model simulation runs live files messages offline \
	command_line/test_run_refusals.py command_line/test_usage.py)
KILTED := $(patsubst %,test/messages/test_%.py,messages topics) \
	$(patsubst %,test/ros/test_%.py,two_processes policy) \
	$(patsubst %,test/ros/simulator/test_%.py,lockstep waiting_in_lockstep parameters foreign_nodes)
PINNED := requirements/base.txt requirements/$(DISTRO).txt requirements/test.txt
export ROS_AUTOMATIC_DISCOVERY_RANGE ?= LOCALHOST
# Hundreds of processes need not compile the package and the tests each for itself.
export PYTHONDONTWRITEBYTECODE :=
# Nor need each have its threads of BLAS, which spin for 0.1 s whenever they are made.
export OPENBLAS_NUM_THREADS ?= 1

.PHONY: setup run test test-quick coverage oldest kilted audit bench soak mutations identification controllers score tables viewer docs lint format build clean

setup: $(VENV)/.ready

$(VENV)/.ready: requirements/build.txt $(PINNED) setup.py setup.cfg
	$(PYTHON) -m venv $(VENV)
	$(BIN)/pip install --quiet --requirement requirements/build.txt
	$(BIN)/pip install --quiet $(addprefix --requirement ,$(PINNED))
	PYTHONWARNINGS=ignore $(BIN)/pip install --quiet --no-deps --no-build-isolation --editable .
	touch $@

run: setup
	$(BIN)/demo

# COVERAGE=yes also measures line and branch coverage of the package, including subprocesses.
test: setup
ifdef COVERAGE
	$(BIN)/python -m coverage erase
	$(BIN)/python -m coverage run -m pytest $(PYTEST_OPTIONS) $(TESTS)
	$(BIN)/python -m coverage combine --quiet
	$(BIN)/python -m coverage report
else
	$(BIN)/python -m pytest $(PYTEST_OPTIONS) $(TESTS)
endif

# Under a minute on two cores, for use while editing. Left to `make test`: nodes, signals, start-up,
# compilation, bags, figures, manoeuvres of the standards, the paper, and all that is marked slow.
test-quick: setup
	$(BIN)/python -m pytest -q --numprocesses 2 --dist worksteal -m 'not slow and not unmeasured' $(QUICK)

coverage:
	$(MAKE) test COVERAGE=yes

# Test files, simulation and command line with the oldest versions that setup.py allows, without ROS.
# The slow properties of mutated tire files do not depend on versions.
oldest:
	$(PYTHON) -m venv .venv-oldest
	.venv-oldest/bin/pip install --quiet --requirement requirements/oldest.txt
	PYTHONWARNINGS=ignore .venv-oldest/bin/pip install --quiet --no-deps --no-build-isolation --editable .
	.venv-oldest/bin/pip check
	.venv-oldest/bin/python -m pytest -q --disable-warnings --ignore-glob '*_tire_files.py' $(OLDEST)

# What ROS 2 Kilted may do differently: messages, nodes, lockstep, parameters, security policies.
kilted:
	$(MAKE) test DISTRO=kilted TESTS="$(KILTED)"

# Check the packages from the package index, and their dependencies, for known vulnerabilities; a
# failed lookup is an error. ROS and its messages come from the distribution and are not checked.
audit:
	$(PYTHON) -m venv .venv-audit
	.venv-audit/bin/pip install --quiet --requirement requirements/audit.txt
	grep --no-filename --invert-match '^ros-' requirements/base.txt requirements/test.txt > .venv-audit/audited
	.venv-audit/bin/pip-audit --strict --requirement .venv-audit/audited

# Takes ten minutes. OPTIONS=--quick gives rougher numbers, OPTIONS="--only NAME ..." runs a part.
bench: setup
	$(BIN)/python -m benchmarks $(OPTIONS)

# A million random messages, then forty times the usual random cases for the model properties.
soak: setup
	$(BIN)/python -m benchmarks.soak $(OPTIONS)
	$(BIN)/python -m pytest --hypothesis-profile soak test/model/test_properties_of_rates.py \
		test/model/test_properties_of_runs.py

# Check that the tests catch deliberate faults: about fifteen minutes.
mutations: setup
	$(BIN)/python -m benchmarks.mutations $(OPTIONS)

# Identify 200 vehicles with hidden values from their logs, and update the tables in
# docs/identification.md: about half an hour on two cores; OPTIONS="--keep FILE" to go on later.
identification: setup
	OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 \
		$(BIN)/python -m benchmarks.identification docs/identification.md $(OPTIONS)

# Measure the effect of each example controller in lockstep, and update the table in docs/controllers.md.
controllers: setup
	$(BIN)/python -m benchmarks.controllers docs/controllers.md

# Score the example controllers, and update the tables in docs/scores.md. Interrupted, it goes on in .score.
score: setup
	$(BIN)/python -m benchmarks.scores docs/scores.md --out .score $(OPTIONS)

# Write the tables that are generated from declarations into the pages of docs/.
tables: setup
	$(BIN)/python docs/_extensions/tables.py

# Bundle what the viewer uses of three.js. Needs npm, and only after a change of three.entry.js or
# of these versions: the result is part of the package, and the same bytes for everyone.
THREE := vehicle_roll_sim/viewer/web/three
viewer:
	rm -rf .viewer && mkdir .viewer && cp $(THREE)/three.entry.js .viewer
	cd .viewer && npm install --silent --no-save three@0.187.0 esbuild@0.28.2
	.viewer/node_modules/.bin/esbuild .viewer/three.entry.js --bundle --minify --format=iife \
		--global-name=THREE --legal-comments=inline --log-level=warning --outfile=$(THREE)/three.min.js
	cp .viewer/node_modules/three/LICENSE $(THREE)/LICENSE
	rm -rf .viewer

# docs/_build/html. A warning is an error. Nothing is fetched but what requirements/docs.txt pins.
docs: $(VENV)/.docs-ready
	$(BIN)/python -m sphinx --fail-on-warning --keep-going --quiet $(OPTIONS) docs docs/_build/html

$(VENV)/.docs-ready: $(VENV)/.ready requirements/docs.txt
	$(BIN)/pip install --quiet --requirement requirements/docs.txt
	touch $@

lint: setup
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

format: setup
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

build: setup
	. $(BIN)/activate && colcon build

clean:
	rm -rf .venv .venv-* build install log run docs/_build .score
