"""QoS overrides take effect or are refused; none is ignored."""

from pathlib import Path

import pytest
import rclpy
from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy

from vehicle_roll_sim import InputError
from vehicle_roll_sim.manoeuvres.catalogue import manoeuvre_named
from vehicle_roll_sim.ros.clients.manoeuvre_player import ManoeuvrePlayer
from vehicle_roll_sim.ros.clients.recorder import Recorder
from vehicle_roll_sim.ros.simulator.node import Simulator
from vehicle_roll_sim.ros.topics import COMMANDING, EVERY_ANSWER, NEWEST_ONLY

EXAMPLES = Path(__file__).parents[2] / "msg_examples"
LOCKSTEP = ("-p", "mode:=lockstep")
WRONG = {
    "/imuu.publisher.depth:=3": "'/imuu' is unknown: did you mean /imu?",
    "imu.publisher.depth:=3": "'imu' is unknown: did you mean /imu?",
    "/rosout.publisher.depth:=3": "'/rosout' is unknown: one of /applied_command, /brake_cmd",
    "/clock.publisher.depth:=3": "'/clock' is unknown",  # nor is it published
    "/imu.subscription.depth:=3": "'subscription' is unknown: one of publisher",
    "/imu.publisher_a.depth:=3": "'publisher_a' is unknown: did you mean publisher?",
    "/imu.publisher.deph:=3": "'deph' is unknown: did you mean depth?",
    "/imu.publisher.avoid_ros_namespace_conventions:=true": "is unknown: one of history, reliab",
    "/speed_cmd.subscription.lifespan:=1": "'lifespan' is unknown: one of history, reliability",
    "/imu:=3": "incomplete name: a name such as qos_overrides./TOPIC.publisher.depth",
    "/imu.publisher.depth:=0": "0 is not allowed: a whole number from 1",
    "/imu.publisher.depth:=true": "True is not allowed: a whole number from 1",
    "/imu.publisher.deadline:=-1": "-1 is not allowed: a whole number from 0 ns, 0 for no limit",
    "/imu.publisher.lifespan:=0.5": "0.5 is not allowed: a whole number from 0 ns",
    "/imu.publisher.reliability:=best": "'best' is not allowed: one of reliable, best_effort",
    "/imu.publisher.history:=[1]": "[1] is not allowed: one of keep_last, keep_all",
}
LOSING = {
    "/steering_cmd.subscription.reliability:=best_effort": "reliable",
    "/state.publisher.reliability:=best_available": "reliable",
    "/state.publisher.lifespan:=1000": "0",
}


@pytest.fixture
def make_simulator(context):
    """make_simulator(assignments, *words): one with these overrides."""
    made = []

    def make(assignments, *words):
        given = [word for each in assignments for word in ("-p", f"qos_overrides.{each}")]
        made.append(Simulator(context=context, cli_args=["--ros-args", *words, *given]))
        return made[-1]

    yield make
    for simulator in made:
        simulator.destroy_node()


@pytest.fixture
def made_with(domain):
    """made_with(kind, assignment): makes a node by kind() with an override."""
    made = []

    def make(kind, assignment):
        rclpy.init(args=["--ros-args", "-p", f"qos_overrides.{assignment}"], domain_id=domain)
        made.append(kind())
        return made[-1]

    yield make
    for node in made:
        node.destroy_node()
    rclpy.try_shutdown()


@pytest.mark.parametrize("assignment", WRONG)
def test_one_that_is_not_supported_is_refused_with_what_is(make_simulator, assignment):
    with pytest.raises(InputError) as refusal:
        make_simulator([assignment])
    name, text = assignment.partition(":=")[0], str(refusal.value)
    assert text.startswith(f"qos_overrides.{name}: ")
    assert WRONG[assignment] in text
    assert len(text.splitlines()) == 1


@pytest.mark.parametrize("assignment", LOSING)
def test_one_that_could_lose_messages_is_refused_in_lockstep_alone(make_simulator, assignment):
    with pytest.raises(InputError, match=f"allowed: {LOSING[assignment]}, because lockstep"):
        make_simulator([assignment], *LOCKSTEP)
    make_simulator([assignment])


def offered(node, topic):
    """The quality of service of the one publisher of a topic."""
    (found,) = node.get_publishers_info_by_topic(topic)
    return found.qos_profile


def test_those_of_publishers_and_subscriptions_count_and_no_others_change(make_simulator, peer):
    overrides = [
        "/car/imu.publisher.reliability:=best_effort",
        "/car/imu.publisher.deadline:=50000000",
        "/car/imu.publisher.depth:=3",
        "/car/rollover.publisher.durability:=volatile",
        "/car/pose.publisher.reliability:=best_effort",
        "/car/steering_cmd.subscription.reliability:=reliable",
    ]
    simulator = make_simulator(overrides, "-r", "__ns:=/car", "-r", "odom:=pose")
    peer.wait(lambda: peer.node.count_publishers("/car/simulation_description"), "the simulator")
    imu = offered(peer.node, "/car/imu")
    assert imu.reliability is ReliabilityPolicy.BEST_EFFORT
    assert imu.deadline == Duration(nanoseconds=50_000_000)
    assert offered(peer.node, "/car/pose").reliability is ReliabilityPolicy.BEST_EFFORT
    assert offered(peer.node, "/car/rollover").durability is DurabilityPolicy.VOLATILE
    assert offered(peer.node, "/car/state").reliability is ReliabilityPolicy.RELIABLE
    latched = offered(peer.node, "/car/robot_description")
    assert latched.durability is DurabilityPolicy.TRANSIENT_LOCAL
    assert simulator.get_parameter("qos_overrides./car/imu.publisher.depth").value == 3
    listening = {
        topic: peer.node.get_subscriptions_info_by_topic(topic)[0].qos_profile.reliability
        for topic in ("/car/steering_cmd", "/car/speed_cmd")
    }
    assert listening == {
        "/car/steering_cmd": ReliabilityPolicy.RELIABLE,
        "/car/speed_cmd": ReliabilityPolicy.BEST_EFFORT,
    }


def test_an_override_is_of_its_node_alone(make_simulator):
    """The profiles that all nodes begin with stay as they are."""
    before = [copy_of(profile) for profile in (NEWEST_ONLY, EVERY_ANSWER, COMMANDING)]
    make_simulator(["/steering_cmd.subscription.depth:=7"])
    make_simulator(["/steering_cmd.subscription.depth:=7"], *LOCKSTEP)
    assert [copy_of(profile) for profile in (NEWEST_ONLY, EVERY_ANSWER, COMMANDING)] == before


def copy_of(profile) -> tuple:
    return profile.depth, profile.reliability, profile.durability, profile.history


def a_driver() -> ManoeuvrePlayer:
    return ManoeuvrePlayer(manoeuvre_named("j_turn"))


def a_recorder() -> Recorder:
    return Recorder()


@pytest.mark.parametrize(
    ("kind", "assignment", "said"),
    [
        (a_driver, "/odom.subscription.depth:=3", "'/odom' is unknown"),
        (a_driver, "/steering_cmd.publisher.depth:=0", "0 is not allowed"),
        (a_recorder, "/odom.publisher.depth:=3", "one of subscription"),
        (a_recorder, "/odom.subscription.depth:=many", "'many' is not allowed"),
    ],
)
def test_other_nodes_refuse_them_before_they_begin(made_with, kind, assignment, said):
    with pytest.raises(InputError, match=said):
        made_with(kind, assignment)


def test_a_manoeuvre_hears_and_commands_as_it_is_told(made_with):
    node = made_with(a_driver, "/imu.subscription.reliability:=best_effort")
    (imu,) = (each for each in node.subscriptions if each.topic_name == "/imu")
    assert imu.qos_profile.reliability is ReliabilityPolicy.BEST_EFFORT


def test_a_manoeuvre_in_lockstep_may_lose_nothing_either(start):
    start("simulator", "--ros-args", *LOCKSTEP)
    override = "qos_overrides./state.subscription.reliability:=best_effort"
    status, _, err = start("manoeuvre", "j_turn", "--ros-args", "-p", override).finish()
    assert status == 2
    assert "reliable, because lockstep must not lose messages" in err
    assert len(err.splitlines()) == 1


def test_a_controller_refuses_one_of_a_topic_that_it_does_not_have(start):
    program = str(EXAMPLES / "rollover_warning.py")
    override = "qos_overrides./rollover_warnin.publisher.depth:=3"
    status, _, err = start("", "--ros-args", "-p", override, program=program).finish()
    assert status == 2
    assert "'/rollover_warnin' is unknown: did you mean /rollover_warning?" in err
