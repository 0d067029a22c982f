"""Input is never executed, its size is limited, and no file can be named while a node runs."""

import ast
import re

import pytest

FOLDERS = ("vehicle_roll_sim", "msg_examples", "benchmarks")
RUNS_WHAT_IT_READS = {
    *("eval", "exec", "compile", "__import__", "os.system", "os.popen"),
    *("pickle.load", "pickle.loads", "pickle.Unpickler", "marshal.loads", "shelve.open"),
    *("yaml.full_load", "yaml.unsafe_load", "yaml.load_all"),
}
OF_YAML = re.compile(r"yaml\..*load|_\w*Loader$", re.IGNORECASE)
READS_WHOLE_FILES = {"read_text", "read_bytes", "read", "readlines", "loadtxt", "genfromtxt"}
MAY_READ = {
    "vehicle_roll_sim/files/text_file.py": "which has the limit",
    "vehicle_roll_sim/model/compiled/code_cache.py": "its own sources, and what it has compiled",
    "vehicle_roll_sim/studies/fingerprint.py": "its own sources",
    "vehicle_roll_sim/vehicle/template.py": "the reference tire that is installed",
    "vehicle_roll_sim/viewer/page.py": "the parts of the page that are installed",
    "vehicle_roll_sim/simulation/open_crg.py": "files of a limited size, by the library",
    "vehicle_roll_sim/ros/launching/rviz.py": "the configuration of RViz that is installed",
    "vehicle_roll_sim/bags/unindexed_reader.py": "pieces of a bag, of any size by nature",
    "vehicle_roll_sim/ros/controller_scripts.py": "a script that is run",
    "vehicle_roll_sim/ros/orchestration/comparison.py": "what its own processes said",
    "vehicle_roll_sim/ros/orchestration/controller_processes.py": "what its own processes said",
    "vehicle_roll_sim/ros/orchestration/score.py": "scripts that are run",
    "vehicle_roll_sim/scoring/store.py": "the runs of a score that goes on",
    "vehicle_roll_sim/scoring/blocks.py": "the figures of the report that has just been written",
    "vehicle_roll_sim/ros/signals.py": "one byte of a pipe",
}


@pytest.fixture(scope="module")
def calls(root) -> list[tuple[str, str, ast.Call]]:
    """Every call in the sources: file, dotted name of what is called, and the call."""
    found = []
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*.py")):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Call):
                    name = ast.unparse(node.func)
                    found.append((path.relative_to(root).as_posix(), name, node))
    return found


MAY_UNPICKLE = {
    "vehicle_roll_sim/model/compiled/code_cache.py": "what this user has compiled, as numba has",
    "vehicle_roll_sim/studies/cluster.py": "a worker of Dask, which runs what it is sent anyway",
}


MAY_RUN = {"vehicle_roll_sim/studies/own_code.py": "the controller or manoeuvre that a study names"}


def argument(call: ast.Call, name: str):
    return next((each.value for each in call.keywords if each.arg == name), None)


def test_nothing_that_is_read_is_run(calls):
    for file, name, call in calls:
        is_own = file in MAY_UNPICKLE and name == "pickle.loads"
        is_named = file in MAY_RUN and name in ("exec", "compile")
        assert is_own or is_named or name not in RUNS_WHAT_IT_READS, (file, call.lineno)
        for risky in ("shell", "allow_pickle"):
            assert argument(call, risky) is None, (file, call.lineno)


def test_yaml_makes_plain_values_only(calls, sources):
    loaders = [(file, name) for file, name, _ in calls if OF_YAML.match(name)]
    assert loaders == [
        ("vehicle_roll_sim/files/yaml_file.py", "_Loader"),
        ("vehicle_roll_sim/ros/launching/rviz.py", "yaml.safe_load"),
    ]
    assert "class _Loader(yaml.SafeLoader)" in sources["vehicle_roll_sim.files.yaml_file"]


def test_no_file_is_read_whole_without_a_limit(calls):
    for file, name, call in calls:
        of_what, _, method = name.rpartition(".")
        if file.startswith("vehicle_roll_sim/") and of_what and method in READS_WHOLE_FILES:
            assert file in MAY_READ, (file, call.lineno)


def test_no_parameter_that_names_a_file_changes_while_the_node_runs():
    pytest.importorskip("rclpy", reason="the node's parameters need ROS 2")
    from vehicle_roll_sim.ros.simulator.parameters import PARAMETERS

    files = {name for name in PARAMETERS if name.endswith(("file", "tire"))}
    assert files == {
        *("road_file", "vehicle_file"),
        *("vehicle.tire", "vehicle.front_tire", "vehicle.rear_tire"),
    }
    assert not [name for name in files if PARAMETERS[name].tunable]
    of_any_text = [
        name
        for name, each in PARAMETERS.items()
        if each.kind is str and not each.choices and each.tunable
    ]
    assert of_any_text == ["snapshot"]  # a token: `SnapshotStore.find` refuses everything else
