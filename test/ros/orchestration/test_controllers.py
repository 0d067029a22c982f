"""The example controllers in lockstep: their effects, as stated in docs/controllers.md."""

import re
from pathlib import Path

import numpy as np
import pytest
from forked import fork_nodes

from benchmarks.controllers import (
    CONTROLLERS,
    SCENARIOS,
    WITHOUT,
    program,
    row,
    warning_line,
)
from vehicle_roll_sim import Condition, Options, Simulation, preset
from vehicle_roll_sim.analysis.panels import SIDESLIP
from vehicle_roll_sim.batch.case import Case
from vehicle_roll_sim.batch.evaluate import outcome_of
from vehicle_roll_sim.control.catalogue import LAWS
from vehicle_roll_sim.manoeuvres.catalogue import manoeuvre_named
from vehicle_roll_sim.messages.topics import COMMANDS
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.ros.orchestration.comparison import Chain, Scenario, drive
from vehicle_roll_sim.ros.topics import message_class
from vehicle_roll_sim.runs.history import COLUMNS, MODEL_STATE_SIZE
from vehicle_roll_sim.runs.run import run

pytestmark = pytest.mark.unmeasured

ROOT = Path(__file__).parents[3]
EXAMPLES = ROOT / "msg_examples"
PAGE = (ROOT / "docs" / "controllers.md").read_text(encoding="utf-8")
NUMBER = re.compile(r"-?\d+\.\d+")
LAST_DIGIT = 1.01
"""Of what is shown: another machine may round the other way."""
STARTED_ELSEWHERE = ("active_roll_bar", "roll_braking", "rollover_warning", "yaw_control")
"""From scratch, by the tests of signals."""
WITHOUT_ROS = {
    "J-turn": {"vehicle": preset(), "manoeuvre": manoeuvre_named("j_turn")},
    "fishhook": {
        "vehicle": preset().with_values({"cg_height": 0.62}),
        "manoeuvre": manoeuvre_named("nhtsa_fishhook"),
        "speed": 20.1168,
    },
}
"""The cases of SCENARIOS."""
STATE_COLUMNS = COLUMNS[: 1 + MODEL_STATE_SIZE]
PERIODS = 50
ON_ITS_WHEELS = 2.5
"""s until which the vehicle without control is, in the sine with dwell."""
ANSWERS = {command for chain in CONTROLLERS.values() for command in chain.commands}
PROGRAMS = {Path(script).stem for chain in CONTROLLERS.values() for script, *_ in chain.programs}


@pytest.fixture(scope="module", params=SCENARIOS)
def manoeuvre(request) -> str:
    return request.param


@pytest.fixture
def in_domain(domain, monkeypatch):
    """What is driven has a domain of its own, and its nodes are forked: `compare` has its tests."""
    monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
    fork_nodes(monkeypatch)


_without = {}


@pytest.fixture
def without(in_domain, manoeuvre):
    """The run that is warned of only, driven once for each manoeuvre."""
    if manoeuvre not in _without:
        _without[manoeuvre] = drive(SCENARIOS[manoeuvre], WITHOUT)
    return _without[manoeuvre]


def assert_shown(text: str) -> None:
    """The page has a line with that text, and numbers that are the same but for rounding."""
    pattern = f"({NUMBER.pattern})".join(map(re.escape, NUMBER.split(text)))
    shown = re.search(f"^{pattern}$", PAGE, re.MULTILINE)
    assert shown, f"not on the page: {text}"
    for one, other in zip(shown.groups(), NUMBER.findall(text), strict=True):
        digit = 10.0 ** -len(other.partition(".")[2])
        assert float(one) == pytest.approx(float(other), abs=LAST_DIGIT * digit), text


def test_the_warning_comes_before_what_it_warns_of_as_the_page_says(manoeuvre, without):
    assert without.warned < without.inner_wheels_off < without.two_wheel_lift < without.rollover
    assert_shown(warning_line(manoeuvre, without))


def assert_same_without_ros(history, manoeuvre: str, controller: str) -> None:
    """The law in a case gives the states, loads and commands of the nodes to the last bit."""
    law = LAWS[controller]()
    alone = outcome_of(Case(**WITHOUT_ROS[manoeuvre], controller=law), history=True).history
    for name in (*STATE_COLUMNS, *(f"normal_force_{wheel}" for wheel in WHEELS)):
        assert np.array_equal(alone[name], history[name]), name
    assert np.array_equal(alone.commands, history.commands)


@pytest.mark.parametrize("controller", CONTROLLERS)
def test_it_prevents_the_rollover_as_the_page_says_and_also_without_ros(
    manoeuvre, without, controller
):
    found = drive(SCENARIOS[manoeuvre], CONTROLLERS[controller])
    assert_same_without_ros(found.history, manoeuvre, controller)
    assert not found.rollover > 0.0
    assert not found.two_wheel_lift > 0.0
    assert_shown("| " + " | ".join(row(controller, manoeuvre, without, found)) + " |")


def test_yaw_control_prevents_the_rollover_in_the_sine_with_dwell_with_less_sideslip(in_domain):
    """At 80 km/h, as docs/controllers.md says."""
    vehicle = preset()
    manoeuvre = manoeuvre_named("sine_with_dwell").for_vehicle(vehicle, Options())
    simulation = Simulation(vehicle)
    simulation.reset(manoeuvre.speed)
    alone = run(simulation, manoeuvre.driver(), manoeuvre.duration, command_period=0.01)
    assert simulation.condition is Condition.ROLLED_OVER
    commands = ("steering_cmd", "wheel_torque_cmd")
    found = drive(
        Scenario(("sine_with_dwell",), commands),
        Chain(("brake_torque_cmd",), (program("yaw_control"),)),
    )
    assert not found.rollover > 0.0
    assert found.end == manoeuvre.duration
    largest = [
        np.nanmax(np.abs(SIDESLIP.of(history)[history["time"] < ON_ITS_WHEELS]))
        for history in (alone, found.history)
    ]
    assert largest[1] < 0.9 * largest[0]
    assert np.count_nonzero(found.history.command("brake_torque"), axis=1).max() == 1


def test_each_gives_one_answer_for_every_set(start, peer):
    topics = ", ".join(("steering_cmd", *sorted(ANSWERS)))
    lockstep = ("-p", "mode:=lockstep", "-p", f"lockstep_topics:=[{topics}]")
    start("simulator", "--ros-args", *lockstep)
    for name in sorted(PROGRAMS):
        start("", program=str(EXAMPLES / f"{name}.py"), fresh=name not in STARTED_ELSEWHERE)
    answers = {name: [] for name in ANSWERS}
    kinds = {topic.name: message_class(topic.type) for topic in COMMANDS}
    for name, kept in answers.items():
        peer.node.create_subscription(kinds[name], name, kept.append, PERIODS)
    peer.listen("state")
    peer.wait(lambda: all(map(peer.node.count_publishers, ANSWERS)), "all controllers")
    peer.publisher("steering_cmd")  # and lockstep begins
    for period in range(PERIODS):
        peer.wait(lambda period=period: len(peer.received["state"]) > period, "the next set")
        for name, kept in answers.items():
            peer.wait(lambda period=period, kept=kept: len(kept) > period, f"an answer: {name}")
        peer.publish("steering_cmd", 0.02)
    peer.wait(lambda: len(peer.received["state"]) > PERIODS, "the last set")
    for name, kept in answers.items():
        peer.wait(lambda kept=kept: len(kept) > PERIODS, f"the last answer: {name}")
    assert {len(kept) for kept in answers.values()} == {PERIODS + 1}
    times = [message.data[0] for _, message in peer.received["state"]]
    assert times == [round(0.01 * k, 2) for k in range(PERIODS + 1)]
