"""Imports go one way, from the command line and the nodes down to the model."""

import ast
import functools
import re
import subprocess
import sys

import pytest
from patience import PATIENCE

PACKAGE = "vehicle_roll_sim"
SIMULATED = ("model", "files", "vehicle", "roads", "simulation", "runs")
"""From the bottom up; each may import those before it."""
MAY_IMPORT = {
    **{part: set(SIMULATED[:rank]) for rank, part in enumerate(SIMULATED)},
    "files": set(),
    "roads": {"model"},
    "live": {"model", "vehicle", "simulation"},
    "manoeuvres": {*SIMULATED},
    "logs": {*SIMULATED},
    "batch": {*SIMULATED, "manoeuvres"},
    "analysis": {*SIMULATED},
    "control_laws": {*SIMULATED, "analysis"},
    "comparison": {*SIMULATED, "logs", "batch", "analysis"},
    "identification": {*SIMULATED, "manoeuvres", "logs", "batch", "analysis", "comparison"},
    "paper": {*SIMULATED, "manoeuvres", "analysis"},
    "viewer": {*SIMULATED, "manoeuvres", "analysis"},
    "messages": {*SIMULATED, "live"},
    "bags": {*SIMULATED, "live", "messages"},
    "studies": {*SIMULATED, "manoeuvres", "batch", "analysis", "control_laws"},
    "scoring": {*SIMULATED, "live", "manoeuvres", "analysis", "viewer", "bags", "arguments"},
    "learning": {*SIMULATED, "live", "manoeuvres", "batch", "analysis", "control_laws", "studies"},
    "offline": {
        *SIMULATED,
        *(
            "manoeuvres",
            "batch",
            "analysis",
            "control_laws",
            "studies",
            "bags",
            "logs",
            "comparison",
        ),
        "identification",
    },
    "arguments": set(),
    "command_line": {
        *SIMULATED,
        *("manoeuvres", "batch", "analysis", "control_laws", "studies", "paper", "bags", "offline"),
        *("viewer", "logs", "comparison", "identification", "scoring", "arguments"),
    },
    "ros": {
        *SIMULATED,
        *("live", "manoeuvres", "analysis", "viewer", "messages", "bags", "scoring"),
        "arguments",
    },
    "controller": {"ros", "messages"},
    "examples": {"controller", "ros", "control_laws", "analysis"},
}
"""What a part may import beside itself."""
ROOMS_OF_ROS = ("simulator", "clients", "orchestration")
"""From the bottom up. Modules beside them are for all nodes, `launching` is beside them."""
EVERYONE_MAY_IMPORT = {"declaration", "early_signals", "input_errors", "version"}
MODEL_MAY_USE = {"numpy", "numba"}
OF_ROS = {"rclpy", "launch", "launch_ros", "ament_index_python"}
"""Beside the packages of messages, services and interfaces."""


@functools.cache
def imports_of(text: str) -> set[str]:
    """Dotted names of all modules that a source imports, names in them left out."""
    found = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
    return found


@pytest.fixture(scope="module")
def own_imports(sources) -> list[tuple[str, str]]:
    """(importing, imported) modules of the package, both without its name in front."""
    pairs = []
    for importing, text in sources.items():
        for imported in imports_of(text):
            while imported not in sources and "." in imported:
                imported = imported.rpartition(".")[0]
            if imported in sources:
                pairs.append((importing.partition(".")[2], imported.partition(".")[2]))
    return pairs


def is_within(module: str, part: str) -> bool:
    return module == part or module.startswith(f"{part}.")


def test_there_are_these_parts_and_no_others(sources):
    parts = {name.split(".")[1] for name in sources if name.count(".") >= 1}
    assert parts == {*MAY_IMPORT, *EVERYONE_MAY_IMPORT, "__main__"}


@pytest.mark.parametrize("part", MAY_IMPORT)
def test_a_part_imports_only_what_is_below_it(own_imports, part):
    allowed = {part, *MAY_IMPORT[part], *EVERYONE_MAY_IMPORT}
    for importing, imported in own_imports:
        if is_within(importing, part):
            assert any(is_within(imported, each) for each in allowed), (importing, imported)


def test_the_architecture_page_and_its_diagram_show_every_part(root):
    page = (root / "docs" / "architecture.md").read_text(encoding="utf-8")
    diagram = (root / "docs" / "architecture.svg").read_text(encoding="utf-8")
    rows = re.findall(r'y="(\d+)" class="name">(\w+)<', diagram)
    height = {part: -int(y) for y, part in rows}
    assert height.keys() - {"launch"} == MAY_IMPORT.keys() - {"arguments"}
    for part, below in MAY_IMPORT.items():
        assert f"`{part}`" in page
        for each in below - {"arguments"}:
            assert height[each] < height[part], (part, each)


def test_no_part_is_allowed_to_import_one_that_may_import_it():
    """Nor over others: what is allowed has no circle."""
    left = dict(MAY_IMPORT)
    while left:
        lowest = [part for part, below in left.items() if not below & left.keys()]
        assert lowest, left
        for part in lowest:
            del left[part]


def test_modules_import_each_other_in_no_circle(own_imports):
    imported = {}
    for importing, module in own_imports:
        if importing != module:
            imported.setdefault(importing, set()).add(module)
    while leaves := {each for below in imported.values() for each in below} - imported.keys():
        imported = {name: below - leaves for name, below in imported.items()}
        imported = {name: below for name, below in imported.items() if below}
    assert not imported


def test_rooms_of_the_ros_part_import_only_those_below_them(own_imports):
    for rank, room in enumerate(ROOMS_OF_ROS):
        for importing, imported in own_imports:
            above = [f"ros.{each}" for each in ROOMS_OF_ROS[rank + 1 :]]
            if is_within(importing, f"ros.{room}"):
                assert not any(is_within(imported, each) for each in above), (importing, imported)


def test_what_everyone_imports_depends_on_no_part_of_the_package(own_imports):
    theirs = {pair for pair in own_imports if pair[0] in EVERYONE_MAY_IMPORT}
    assert theirs == {("declaration", "input_errors")}


def test_the_model_is_mathematics_without_declarations_files_or_ros(sources, own_imports):
    for importing, imported in own_imports:
        if is_within(importing, "model"):
            assert is_within(imported, "model"), (importing, imported)
    for name, text in sources.items():
        if is_within(name, f"{PACKAGE}.model"):
            outside = {i.partition(".")[0] for i in imports_of(text)} - {PACKAGE}
            assert outside <= MODEL_MAY_USE | set(sys.stdlib_module_names), name


def test_ros_rosbags_and_gymnasium_are_each_imported_by_one_part_only(sources):
    for name, text in sources.items():
        roots = {imported.partition(".")[0] for imported in imports_of(text)}
        of_ros = {r for r in roots if r in OF_ROS or r.endswith(("_msgs", "_srvs", "_interfaces"))}
        assert not of_ros or is_within(name, f"{PACKAGE}.ros"), (name, of_ros)
        assert "rosbags" not in roots or is_within(name, f"{PACKAGE}.bags"), name
        assert "gymnasium" not in roots or is_within(name, f"{PACKAGE}.learning"), name


def test_only_the_comparison_with_the_multibody_engine_imports_it(sources):
    importing = {
        name
        for name, text in sources.items()
        if any(is_within(imported, "mujoco") for imported in imports_of(text))
    }
    assert importing == {f"{PACKAGE}.paper.{name}" for name in ("engine_model", "multibody")}


def test_nothing_imports_the_benchmarks(sources):
    for name, text in sources.items():
        assert not any(is_within(imported, "benchmarks") for imported in imports_of(text)), name


def test_library_and_command_run_where_there_is_neither_ros_nor_the_multibody_engine(tmp_path):
    program = (
        "import sys;"
        "sys.modules.update(dict.fromkeys(('rclpy', 'std_msgs', 'rosbags', 'mujoco')));"
        "from vehicle_roll_sim.command_line.main import main;"
        "sys.exit(main(['run', 'step_steer', '--duration', '0.1']))"
    )
    words = [sys.executable, "-c", program]
    result = subprocess.run(
        words, cwd=tmp_path, capture_output=True, text=True, timeout=PATIENCE, check=False
    )
    assert (result.returncode, result.stderr) == (0, "")
    assert "0.100 s, complete" in result.stdout
