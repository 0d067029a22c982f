"""The example controller in C++: its law is that in Python, and its node compiles.

rclcpp is missing from the wheels of ROS 2. The node is therefore not built: a compiler checks it
against the real headers of messages, and a stand-in for those of rclcpp.
"""

import dataclasses
import itertools
import re
import shutil
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from patience import PATIENCE

from vehicle_roll_sim.control_laws.lqr_roll_bar import FED_BACK, LqrRollBar
from vehicle_roll_sim.declaration import parameters_of

COMPILER = shutil.which("g++")
STRICT = ("-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-ffp-contract=off")
PROGRAM = """
#include <cstdio>
#include "lqr_roll_bar_cpp/roll_bar.hpp"
int main()
{
  lqr_roll_bar_cpp::Gains gains{%s};
  lqr_roll_bar_cpp::Motion motion;
  while (std::scanf("%%la %%la %%la %%la", &motion.v, &motion.yaw_rate, &motion.roll,
      &motion.roll_rate) == 4)
  {
    for (double force : lqr_roll_bar_cpp::forces(gains, motion)) {std::printf("%%a ", force);}
  }
}
"""

pytestmark = pytest.mark.skipif(not COMPILER, reason="g++ is not installed")


@pytest.fixture(scope="module")
def package(request) -> Path:
    return request.config.rootpath / "examples" / "lqr_roll_bar_cpp"


def compiled(*words) -> None:
    """Fails with what the compiler says."""
    command = [COMPILER, *STRICT, *map(str, words)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, check=False)
    assert done.returncode == 0, done.stderr


def test_the_law_is_that_of_python_to_the_bit(package, tmp_path):
    law = LqrRollBar()
    values = ", ".join(f"{value!r}" for value in dataclasses.astuple(law))
    (tmp_path / "main.cpp").write_text(PROGRAM % values)
    compiled("-I", package / "include", tmp_path / "main.cpp", "-o", tmp_path / "law")
    spread = np.random.default_rng(0).normal(size=(200, 4)) * (2.0, 0.5, 0.05, 0.3)
    text = "\n".join(" ".join(value.hex() for value in row) for row in spread.tolist())
    done = subprocess.run(
        [tmp_path / "law"], input=text, capture_output=True, text=True, timeout=PATIENCE, check=True
    )
    found = [float.fromhex(word) for word in done.stdout.split()]
    motions = [dict(zip(FED_BACK, row, strict=True)) for row in spread.tolist()]
    expected = [law.forces(motion) for motion in motions]
    assert found == list(itertools.chain(*expected))
    limited = np.abs(found) == law.largest_force
    assert limited.any()
    assert not limited.all()


def test_the_node_compiles_against_messages_and_a_stand_in_for_rclcpp(package):
    include = Path(sys.prefix) / "include"
    if not (include / "std_msgs").is_dir():
        pytest.skip("ROS 2 is not installed from wheels: there are no headers of messages")
    folders = [folder for each in sorted(include.iterdir()) for folder in ("-isystem", each)]
    own = ("-I", package / "include", "-I", Path(__file__).with_name("rclcpp_stand_in"))
    compiled("-fsyntax-only", *own, *folders, package / "src" / "lqr_roll_bar.cpp")


def test_its_parameters_are_those_that_the_design_script_writes(package):
    source = (package / "src" / "lqr_roll_bar.cpp").read_text(encoding="utf-8")
    declared = re.findall(r'declare_parameter<double>\("(\w+)"\)', source)
    assert declared == list(parameters_of(LqrRollBar))
    header = (package / "include" / "lqr_roll_bar_cpp" / "roll_bar.hpp").read_text("utf-8")
    fields = re.findall(r"^  double (.*);$", header.partition("struct Motion")[0], re.MULTILINE)
    assert ", ".join(fields).split(", ") == declared


def test_its_manifest_names_what_its_cmake_file_finds(package):
    manifest = ElementTree.parse(package / "package.xml").getroot()
    cmake = (package / "CMakeLists.txt").read_text(encoding="utf-8")
    assert manifest.findtext("name") == package.name == re.search(r"project\((\w+)", cmake)[1]
    depends = {each.text for tag in ("buildtool_depend", "depend") for each in manifest.iter(tag)}
    assert depends == {*re.findall(r"find_package\((\w+) REQUIRED\)", cmake)}
    assert (package / re.search(r"add_executable\(\w+ (\S+)\)", cmake)[1]).exists()
