"""`pip install` without ROS 2: programs that need it say in one line what to install.

What is not installed is hidden from a process as Python itself does it: by None in its modules.
"""

import subprocess
import sys

import pytest
from patience import PATIENCE

NODES = ("simulator", "manoeuvre", "recorder", "live_view", "demo")
HIDING = """
import sys

for name in {hidden}:
    sys.modules[name] = None
"""
START = """
from vehicle_roll_sim.ros import executables

sys.argv = ["{name}", *{words}]
sys.exit(executables.{name}())
"""
OF_ANOTHER_PYTHON = """
class Broken:
    def find_spec(self, name, path=None, target=None):
        if name == "rclpy._rclpy_pybind11":
            raise ImportError("The C extension is not there for this Python.\\nSee above.")

sys.meta_path.insert(0, Broken())
"""


@pytest.fixture
def ends(tmp_path):
    """ends(program): the line on stderr with which a program ends at once, with status 2."""

    def call(program: str, *words: str) -> str:
        start = [sys.executable, *words] if words else [sys.executable, "-c", program]
        result = subprocess.run(
            start, cwd=tmp_path, capture_output=True, text=True, timeout=PATIENCE, check=False
        )
        assert (result.returncode, result.stdout) == (2, ""), result.stderr
        (line,) = result.stderr.splitlines()
        assert not list(tmp_path.glob("run*"))
        return line

    return call


@pytest.mark.parametrize("words", [[], ["--help"]])
@pytest.mark.parametrize("name", NODES)
def test_a_node_ends_in_one_line_that_says_what_to_install(ends, name, words):
    line = ends(HIDING.format(hidden=["rclpy"]) + START.format(name=name, words=words))
    assert line.startswith(f"{name}: error: ROS 2: no Python package rclpy: install ROS 2")
    assert "setup.bash" in line


@pytest.mark.parametrize("module", ["simulator.node", "executables"])
def test_so_does_a_module_that_is_run(ends, tmp_path, monkeypatch, module):
    (tmp_path / "sitecustomize.py").write_text(HIDING.format(hidden=["rclpy"]))
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    line = ends("", "-m", f"vehicle_roll_sim.ros.{module}", "recorder")
    assert line.startswith("vehicle_roll_sim: error: ROS 2: no Python package rclpy: ")


def test_a_package_of_messages_that_is_missing_is_named(ends):
    pytest.importorskip("rclpy", reason="the rest of ROS 2 is wanted here")
    hidden = HIDING.format(hidden=["diagnostic_msgs"])
    line = ends(hidden + START.format(name="simulator", words=[]))
    assert line.startswith("simulator: error: ROS 2: no Python package diagnostic_msgs")


def test_a_ros_of_another_python_is_one_line_too(ends):
    pytest.importorskip("rclpy", reason="a ROS 2 is wanted here that can be broken")
    program = "import sys\n" + OF_ANOTHER_PYTHON + START.format(name="manoeuvre", words=["j_turn"])
    line = ends(program)
    assert line.startswith("manoeuvre: error: ROS 2: ")
    assert "C extension" in line


def test_a_demo_that_could_not_record_names_the_library_before_it_starts_anything(ends):
    pytest.importorskip("rclpy", reason="nodes need ROS 2")
    hidden = HIDING.format(hidden=["rosbags"])
    line = ends(hidden + START.format(name="demo", words=["--output", "run"]))
    assert line == "demo: error: recorder: no Python package rosbags: pip install rosbags"
