"""The example controllers in lockstep: their effects, as stated in docs/controllers.md."""

import dataclasses
import itertools
import re
from pathlib import Path

import numpy as np
import pytest
from forked import fork_nodes

from benchmarks.controllers import CONTROLLERS, SCENARIOS, WITHOUT, program, row, warning_line
from vehicle_roll_sim import Options, Simulation, preset
from vehicle_roll_sim.analysis.panels import SIDESLIP
from vehicle_roll_sim.batch.case import Case
from vehicle_roll_sim.batch.evaluate import outcome_of
from vehicle_roll_sim.control_laws.catalogue import LAWS
from vehicle_roll_sim.control_laws.roll_braking import RollBraking
from vehicle_roll_sim.control_laws.yaw_control import YawControl
from vehicle_roll_sim.manoeuvres.catalogue import manoeuvre_named
from vehicle_roll_sim.messages.command_topics import COMMANDS
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.model.records import MODEL_STATE_SIZE, WHEELS
from vehicle_roll_sim.ros.orchestration.comparison import Chain, Outcome, Scenario, drive
from vehicle_roll_sim.ros.topics import message_class
from vehicle_roll_sim.runs.columns import COLUMNS
from vehicle_roll_sim.runs.control_law import ControlLaw, Controlled
from vehicle_roll_sim.runs.history import History
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
IN_HISTORY = {"normal_force": "active_force"}
"""Names of commands that differ in a history."""
PERIODS = 50
ON_ITS_WHEELS = 2.5
"""s until which the vehicle without control is, in the sine with dwell."""
CHAINS = CONTROLLERS | {"yaw_control": Chain(("brake_torque_cmd",), (program("yaw_control"),))}
"""The nodes of each law."""
TOGETHER = (
    ("active_roll_bar", "roll_braking", "rear_steering"),
    ("lqr_roll_bar", "rollover_mpc"),
    ("stability_control",),
    ("yaw_control",),
)
"""All laws, of which none commands what another of its row does."""
WHILE_IT_ACTS = 2.0
"""s of the fishhook at 35 mph: the first turn, in which every controller intervenes."""
WARNED_WITHIN = {"J-turn": 1.5, "fishhook": 2.6}
"""s, after which the run without control is continued without nodes."""
ANSWERS = {command for name in TOGETHER[0] for command in CHAINS[name].commands}
PROGRAMS = {Path(script).stem for name in TOGETHER[0] for script, *_ in CHAINS[name].programs}


@pytest.fixture
def in_domain(domain, monkeypatch):
    """What is driven has a domain of its own, and its nodes are forked: `compare` has its tests."""
    monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
    fork_nodes(monkeypatch)


def assert_shown(text: str) -> None:
    """The page has a line with that text, and numbers that are the same but for rounding."""
    pattern = f"({NUMBER.pattern})".join(map(re.escape, NUMBER.split(text)))
    shown = re.search(f"^{pattern}$", PAGE, re.MULTILINE)
    assert shown, f"not on the page: {text}"
    for one, other in zip(shown.groups(), NUMBER.findall(text), strict=True):
        digit = 10.0 ** -len(other.partition(".")[2])
        assert float(one) == pytest.approx(float(other), abs=LAST_DIGIT * digit), text


def alone(manoeuvre: str, law: ControlLaw) -> History:
    """The run of a scenario without nodes."""
    return outcome_of(Case(**WITHOUT_ROS[manoeuvre], controller=law), history=True).history


def assert_same(found: History, expected: History) -> None:
    """States, loads and commands are the same to the last bit, as long as the first lasts."""
    rows = slice(len(found.rows))
    for name in (*STATE_COLUMNS, *(f"normal_force_{wheel}" for wheel in WHEELS)):
        assert np.array_equal(found[name], expected[name][rows]), name
    assert np.array_equal(found.commands, expected.commands[rows])


@pytest.mark.parametrize("manoeuvre", SCENARIOS)
def test_each_prevents_the_rollover_that_is_warned_of_as_the_page_says(in_domain, manoeuvre):
    """By laws without nodes: the next test shows that nodes do the same."""
    words = (*SCENARIOS[manoeuvre].manoeuvre, "--duration", str(WARNED_WITHIN[manoeuvre]))
    warned = drive(dataclasses.replace(SCENARIOS[manoeuvre], manoeuvre=words), WITHOUT)
    history = alone(manoeuvre, RollBraking(largest_torque=0.0))
    assert_same(warned.history, history)
    without = Outcome(history, warned.warnings)
    assert without.warned < without.inner_wheels_off < without.two_wheel_lift < without.rollover
    assert_shown(warning_line(manoeuvre, without))
    for controller in CONTROLLERS:
        found = Outcome(alone(manoeuvre, LAWS[controller]()))
        assert not found.rollover > 0.0, controller
        assert not found.two_wheel_lift > 0.0, controller
        assert_shown("| " + " | ".join(row(controller, manoeuvre, without, found)) + " |")


def test_every_law_is_driven_in_lockstep():
    assert sorted(itertools.chain(*TOGETHER)) == sorted(LAWS)


@pytest.mark.parametrize("names", TOGETHER, ids="+".join)
def test_laws_without_ros_do_the_same_as_their_nodes_to_the_bit(in_domain, names):
    chains = [CHAINS[name] for name in names]
    commands = tuple(itertools.chain(*(chain.commands for chain in chains)))
    programs = tuple(itertools.chain(*(chain.programs for chain in chains)))
    words = ("nhtsa_fishhook", "--duration", str(WHILE_IT_ACTS))
    scenario = Scenario(words, ("steering_cmd", "wheel_torque_cmd"))
    found = drive(scenario, Chain(commands, programs)).history
    vehicle, laws = preset(), [LAWS[name]() for name in names]
    fishhook = manoeuvre_named("nhtsa_fishhook").for_vehicle(vehicle, Options())
    simulation = Simulation(vehicle)
    simulation.reset(fishhook.speed)
    driver = Controlled(simulation, fishhook.driver(), *laws)
    assert_same(found, run(simulation, driver, WHILE_IT_ACTS))
    for name in itertools.chain(*(law.commands for law in laws)):
        assert found.command(IN_HISTORY.get(name, name)).any(), name


def test_yaw_control_prevents_the_rollover_in_the_sine_with_dwell_with_less_sideslip():
    """At 80 km/h, as docs/controllers.md says."""
    case = {"vehicle": preset(), "manoeuvre": manoeuvre_named("sine_with_dwell")}
    idle, law = YawControl(gain=0.0), YawControl()
    alone, found = (outcome_of(Case(**case, controller=each), history=True) for each in (idle, law))
    assert alone.condition is Condition.ROLLED_OVER
    assert found.condition is Condition.RUNNING
    largest = [
        np.nanmax(np.abs(SIDESLIP.of(each.history)[each.history["time"] < ON_ITS_WHEELS]))
        for each in (alone, found)
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
