"""package.xml, setup.py and the sources agree."""

import ast
import re
import subprocess
import sys
from xml.etree import ElementTree

import pytest
from patience import PATIENCE

from vehicle_roll_sim.messages.command_topics import COMMANDS
from vehicle_roll_sim.messages.topics import PUBLISHED

PACKAGE = "vehicle_roll_sim"
NOT_OF_ROS = {
    *("numpy", "scipy", "yaml", "tqdm", "matplotlib"),
    *("numba", "rosbags", "mujoco", "control", "pandas", "pyarrow", "gymnasium", "distributed"),
    *("selenium", "PIL", "pint", "asammdf", "pyopencrg", "cloudpickle"),
}
"""Libraries whose names in package.xml are rosdep keys, or that come from pip."""
RUN_BY_LAUNCH_FILES = {"ros2launch", "robot_state_publisher", "ros2bag", "rosbag2_storage_mcap"}
"""Run-time dependencies of the launch files that are not imported; RViz is optional."""
ROSDEP_KEYS = {
    "numpy": "python3-numpy",
    "scipy": "python3-scipy",
    "yaml": "python3-yaml",
    "tqdm": "python3-tqdm",
    "matplotlib": "python3-matplotlib",
    "PIL": "python3-pil",
    "numba": "python3-numba",
}
HAVE_NUMBA, HAVE_NOT = ("lyrical", "rolling"), ("jazzy", "kilted", "")
"""Distributions of ROS whose Ubuntu has a package of it, or not; "" where none is set up."""
NOBODYS = (".invalid", ".example", ".test", ".localhost")
"""Reserved domain suffixes, which belong to no real machine."""
REQUIREMENT = re.compile(r"([A-Za-z-]+)>=([\d.]+)")


@pytest.fixture(scope="module")
def manifest(root) -> ElementTree.Element:
    return ElementTree.parse(root / "package.xml").getroot()


@pytest.fixture(scope="module")
def imported(sources) -> set[str]:
    """Top-level names of all that is imported but the standard library and the package itself.

    Packages of messages are imported by the types of the topics.
    """
    names = {topic.type.partition("/")[0] for topic in (*COMMANDS, *PUBLISHED)}
    for text in sources.values():
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.Import):
                names |= {alias.name.partition(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom):
                assert node.level == 0, "imports are absolute"
                names.add(node.module.partition(".")[0])
    return names - set(sys.stdlib_module_names) - {PACKAGE}


def setup_says(root, *options: str) -> list[str]:
    words = [sys.executable, "setup.py", "--quiet", *options]
    return subprocess.run(
        words, cwd=root, capture_output=True, text=True, timeout=PATIENCE, check=True
    ).stdout.split("\n")[: len(options)]


def test_it_is_a_format_3_manifest_of_an_ament_python_package(manifest):
    assert manifest.tag == "package"
    assert manifest.get("format") == "3"
    assert manifest.findtext("name") == PACKAGE
    assert manifest.findtext("export/build_type") == "ament_python"
    assert manifest.findtext("description").strip()


def test_name_version_and_license_are_those_of_setup(manifest, root):
    name, version, license_name = setup_says(root, "--name", "--version", "--license")
    assert re.fullmatch(r"\d+\.\d+\.\d+", version)
    assert manifest.findtext("version") == version
    assert manifest.findtext("name") == name
    assert manifest.findtext("license") == license_name == "Apache-2.0"
    assert "Apache License" in (root / "LICENSE").read_text()


def test_author_maintainer_and_addresses_are_those_of_setup_and_have_a_valid_form(manifest, root):
    (author,), (maintainer,) = manifest.findall("author"), manifest.findall("maintainer")
    urls = {node.get("type"): node.text for node in manifest.findall("url")}
    found = [author.text, maintainer.text, maintainer.get("email"), urls["website"]]
    assert found == setup_says(root, "--author", "--maintainer", "--maintainer-email", "--url")
    assert set(urls) == {"website", "repository", "bugtracker"}
    for url in urls.values():
        assert re.fullmatch(r"https://[\w.-]+\.[a-z]{2,}(/[\w.-]+)+", url)
    assert re.fullmatch(r"[\w.-]+@[\w.-]+\.[a-z]{2,}", maintainer.get("email"))
    hosts = [maintainer.get("email"), *(url.split("/")[2] for url in urls.values())]
    assert not [host for host in hosts if host.endswith(NOBODYS)]


@pytest.mark.parametrize("distribution", [*HAVE_NUMBA, *HAVE_NOT])
def test_numba_is_wanted_of_rosdep_where_there_is_a_package_of_it(root, distribution):
    """Elsewhere the key would make `rosdep install` fail."""
    reading = pytest.importorskip("catkin_pkg.package", reason="catkin_pkg is not installed")
    package = reading.parse_package(root / "package.xml")
    package.evaluate_conditions({"ROS_DISTRO": distribution} if distribution else {})
    wanted = {each.name for each in package.exec_depends if each.evaluated_condition}
    assert ("python3-numba" in wanted) == (distribution in HAVE_NUMBA)
    assert "python3-numpy" in wanted


def test_the_oldest_versions_that_are_tested_are_those_that_setup_allows(root):
    pinned = dict(
        line.split("==")
        for line in (root / "requirements" / "oldest.txt").read_text().splitlines()
        if not line.startswith("#")
    )
    allowed = dict(REQUIREMENT.findall((root / "setup.py").read_text(encoding="utf-8")))
    assert {"numpy", "scipy", "matplotlib", "numba", "rosbags"} <= pinned.keys() & allowed.keys()
    for name, version in pinned.items():
        if name in allowed:
            assert re.fullmatch(rf"{re.escape(allowed[name])}(\.0)*", version), name


def test_every_package_of_ros_that_is_imported_is_depended_on_and_no_other(manifest, imported):
    declared = {node.text for node in manifest.findall("exec_depend")}
    of_ros = {name for name in declared if not name.startswith("python3-")}
    assert of_ros - imported == RUN_BY_LAUNCH_FILES
    assert imported - NOT_OF_ROS == of_ros & imported


def test_every_library_that_is_imported_is_depended_on_or_known_to_come_from_pip(
    manifest, imported
):
    declared = {node.text for node in manifest.findall("exec_depend")}
    for name, key in ROSDEP_KEYS.items():
        assert (name in imported) == (key in declared)


def test_a_dependency_is_declared_once(manifest):
    for kind in ("exec_depend", "test_depend"):
        names = [node.text for node in manifest.findall(kind)]
        assert len(names) == len(set(names))


def test_a_linter_of_ament_is_declared_if_a_test_runs_it_and_only_then(manifest, root):
    declared = {
        node.text for node in manifest.findall("test_depend") if node.text.startswith("ament_")
    }
    text = (root / "test" / "package" / "test_ament_linters.py").read_text(encoding="utf-8")
    assert declared == set(re.findall(r'importorskip\("(ament_\w+)\.', text))
