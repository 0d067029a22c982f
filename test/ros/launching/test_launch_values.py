"""Spellings of launch arguments, and the values that reach each process."""

import launch_files
import launch_stand_in
import pytest
from launch_files import actions_of

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.ros.launching.values import ALWAYS_SET

DESCRIBED = {name: {} for name in launch_files.NAMES} | {
    "controller": {"controller": "roll_braking"},
}


def declared_in(name: str) -> list[str]:
    entities = launch_files.load(name).entities
    return [e.name for e in entities if isinstance(e, launch_stand_in.DeclareLaunchArgument)]


def commands_of(name: str, **given: str) -> dict[str, list[str]]:
    """Command lines by the names of their processes."""
    actions = actions_of(name, **given)
    return {key: action.cmd for key, action in actions.items() if hasattr(action, "cmd")}


def rows_of(actions) -> dict[str, tuple]:
    """All arguments of a process and, for nodes, its parameters."""
    return {
        name: (action.cmd, [sorted(map(str, given)) for given in getattr(action, "parameters", ())])
        for name, action in actions.items()
        if hasattr(action, "cmd")
    }


@pytest.mark.parametrize("name", launch_files.NAMES)
@pytest.mark.parametrize("spelt", ["none", "None"])
def test_whatever_can_be_switched_off_is_by_none(launching, name, spelt):
    """`none` replaces an empty value, which `ros2 launch` does not accept."""
    truths = {"lockstep", "use_rviz"}
    switched = [each for each in declared_in(name) if each not in {*ALWAYS_SET, *truths}]
    assert "params_file" in switched
    none = rows_of(actions_of(name, **dict.fromkeys(switched, spelt)))
    assert none == rows_of(actions_of(name, **dict.fromkeys(switched, "")))
    assert not any(spelt in word for cmd, _ in none.values() for word in cmd[1:])
    assert "recorder" not in none


@pytest.mark.parametrize(
    ("spelt", "meant"),
    [("True", True), ("TRUE", True), ("1", True), ("on", True), ("False", False), ("0", False)],
)
def test_truths_are_understood_in_any_case(launching, spelt, meant):
    command = commands_of("simulator", lockstep=spelt)["simulator"]
    assert ("mode:=lockstep" in command) is meant
    assert ("rviz2" in actions_of("rviz", use_rviz=spelt)) is meant
    driver = commands_of("manoeuvre", use_sim_time=spelt)["manoeuvre"]
    assert f"use_sim_time:={'true' if meant else 'false'}" in driver


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ({"lockstep": "maybe"}, "lockstep: 'maybe' is not allowed: true or false"),
        ({"lockstep": "none"}, "lockstep: 'none' is not allowed: true or false"),
        ({"use_sim_time": "simulated"}, "use_sim_time: 'simulated' is not allowed: true or false"),
        ({"log_level": "loud"}, "log_level: 'loud' is not allowed: debug, info, warn"),
        ({"log_level": "rclpy:=loud"}, "log_level: 'rclpy:=loud' is not allowed"),
    ],
)
def test_what_is_neither_is_refused_with_what_is_allowed(launching, given, named):
    with pytest.raises(InputError, match=named):
        actions_of("manoeuvre", **given)


@pytest.mark.parametrize(
    ("spelt", "passed"), [("DEBUG", "debug"), ("warn", "warn"), ("a.b:=info", "a.b:=info")]
)
@pytest.mark.parametrize("name", launch_files.NAMES)
def test_the_level_of_logs_reaches_every_node(launching, name, spelt, passed):
    commands = commands_of(name, log_level=spelt, **DESCRIBED[name])
    for command in commands.values():
        words = command[command.index("--ros-args") :]
        assert words[words.index("--log-level") + 1] == passed


def test_simulated_time_is_that_of_all_nodes_but_the_simulator_which_publishes_it(launching):
    given = {"controller": "roll_braking", "use_sim_time": "true"}
    commands = commands_of("controller", **given)
    simulator = commands.pop("simulator")
    assert "publish_clock:=true" in simulator
    assert not any("use_sim_time" in word for word in simulator)
    assert {"manoeuvre", "recorder", "roll_braking", "rollover_warning"} == set(commands)
    for command in commands.values():
        assert "use_sim_time:=true" in command[command.index("--ros-args") :]


def test_nodes_take_the_words_that_a_launch_gives_them(launching, domain, tmp_path):
    """No node of the package refuses the log level or the clock parameter."""
    results = launch_files.run(
        "manoeuvre",
        domain,
        options="--duration 0.2",
        lockstep="True",
        use_sim_time="TRUE",
        log_level="WARN",
        bag="none",
    )
    assert set(results) == {"simulator", "manoeuvre"}
    assert "0.200 s, complete" in results["manoeuvre"][1]
    assert "[INFO]" not in "".join(results["simulator"][1:])
