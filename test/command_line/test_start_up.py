"""Imports of a program before it starts work: the fewer, the faster it responds."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from patience import PATIENCE

from vehicle_roll_sim.command_line.commands import COMMANDS
from vehicle_roll_sim.command_line.main import main

ROOT = Path(__file__).parents[2]
PACKAGE = "vehicle_roll_sim"
FIRST = "early_signals"
"""The module that installs the handlers."""
ENTRIES = {
    "command_line.entry": {"command_line"},
    "ros.executables": {"ros"},
    "examples.executables": {"examples"},
}
"""Modules of entry points, and the packages that they are in."""
NEVER_FOR_HELP = {"numba", "llvmlite", "scipy", "matplotlib", "rosbags", "mujoco", "control"}
"""Parameters are declared beside code that needs numpy; the compiler and figures take longer."""
HELP_OF_EACH = f"""
import contextlib, numpy, os
for name in sys.argv[1:]:
    if not os.fork():
        from {PACKAGE}.command_line.entry import main
        sys.argv[1:] = [name, "--help"]
        with contextlib.suppress(SystemExit):
            main()
        found = {NEVER_FOR_HELP} & {{each for each in sys.modules if sys.modules[each]}}
        print(*found, file=sys.stderr, end="", flush=True)
        sys.stdout.flush()
        os._exit(0)
    os.wait()
"""
"""Prints the help of the commands that it is given, each in a process that has only numpy, which
all need; and what they import that they should not."""
AFTERWARDS = (
    "import atexit, json, os, sys\n"
    "before = set(sys.modules)\n"
    "def note():\n"
    "    names = [name for name in sys.modules if sys.modules[name] and name not in before]\n"
    "    open({!r}, 'w').write(json.dumps(names))\n"
    "atexit.register(note)\n"
)


@pytest.fixture
def imports(tmp_path):
    """imports(program, *words): modules that a program imports, its status, and its result."""

    def call(program: str, *words: str, options=()):
        noted = str(tmp_path / "modules.json")
        command = [sys.executable, *options, "-c", AFTERWARDS.format(noted) + program, *words]
        result = subprocess.run(
            command, cwd=ROOT, capture_output=True, text=True, timeout=PATIENCE, check=False
        )
        return {*json.loads(Path(noted).read_text())}, result.returncode, result

    return call


def outside(modules: set[str]) -> set[str]:
    """The top-level packages that are neither Python's nor this one."""
    return {name.partition(".")[0] for name in modules} - {*sys.stdlib_module_names, PACKAGE}


@pytest.mark.parametrize("module", ENTRIES)
def test_an_entry_point_imports_nothing_but_the_handlers_before_they_are_installed(imports, module):
    """So that a signal can meet Python's own handler, with its traceback, only before that."""
    program = f"sys.path.insert(0, {str(ROOT)!r}); import {PACKAGE}.{module}"
    modules, status, _ = imports(program, options=("-I", "-S"))
    allowed = {PACKAGE, *(f"{PACKAGE}.{name}" for name in {FIRST, module, *ENTRIES[module]})}
    assert (status, modules) == (0, allowed)


def test_the_package_imports_what_is_asked_for_when_it_is_asked_for(imports):
    modules, status, _ = imports(f"import {PACKAGE}; {PACKAGE}.__all__; dir({PACKAGE})")
    assert (status, modules) == (0, {PACKAGE})
    modules, _, _ = imports(f"from {PACKAGE} import InputError, __version__")
    assert outside(modules) == set()
    modules, _, _ = imports(f"from {PACKAGE} import Simulation, Vehicle, run, series")
    assert "numpy" in outside(modules)
    assert not {"matplotlib", "rosbags", "mujoco", "control", "pandas"} & outside(modules)


def test_the_compiled_model_is_loaded_without_what_compiles_python(imports):
    """numba's implementations of Python and numpy (of numpy.sum, say) take longer than the rest."""
    program = f"from {PACKAGE} import Simulation, preset; Simulation(preset()).reset()"
    modules, status, _ = imports(program)
    assert (status, {"numba.np.arraymath", "scipy.linalg"} & modules) == (0, set())


@pytest.mark.parametrize(
    ("words", "expected"), [("--help", 0), ("--version", 0), ("rnu", 2), ("--hlep", 2), ("", 2)]
)
def test_what_names_no_command_is_answered_without_any_library(imports, words, expected):
    program = f"from {PACKAGE}.command_line.entry import main; sys.exit(main())"
    modules, status, _ = imports(program, *words.split())
    assert (status, outside(modules)) == (expected, set())


def test_the_help_of_a_command_is_the_same_without_the_compiler(imports, capsys):
    for name in COMMANDS:
        with pytest.raises(SystemExit):
            main([name, "--help"])
    _, status, result = imports(HELP_OF_EACH, *COMMANDS)
    assert (status, result.stderr, result.stdout) == (0, "", capsys.readouterr().out)
