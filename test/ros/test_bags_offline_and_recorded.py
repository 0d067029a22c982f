"""The bags of an offline run and a recorded lockstep run of one manoeuvre are equal."""

import os
import signal

import pytest
from measured import SENSORS
from recordings import heard_so_far

pytest.importorskip("rosbags", reason="bags need the library rosbags")

from rosbags.rosbag2 import Reader

from vehicle_roll_sim import preset
from vehicle_roll_sim.bags.encoding import TYPES, decode
from vehicle_roll_sim.bags.reading import recorded_runs
from vehicle_roll_sim.bags.replay import replay
from vehicle_roll_sim.command_line.main import main as offline
from vehicle_roll_sim.messages.topics import (
    ACTUATORS,
    DIAGNOSTICS,
    MEASUREMENTS,
    ROLL_CENTRE,
    ROLLOVER,
    set_of,
)
from vehicle_roll_sim.simulation.description import described
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.actuator_parameters import has_actuators
from vehicle_roll_sim.vehicle.sensor_parameters import devices_of

pytestmark = pytest.mark.unmeasured

MANOEUVRES = {
    "nhtsa_fishhook": ("--set", "cg_height=0.55", "--duration", "3"),
    "step_steer": ("--model", "2", "--set", "cg_height=0.55", "--duration", "1.5"),
}
"""Steered by the state; and with the speed held, with model 2."""
MODELS = {"nhtsa_fishhook": "1", "step_steer": "2"}
ACTUATED = {"steering_actuator_time_constant": 0.05}
VEHICLES = {"nhtsa_fishhook": SENSORS, "step_steer": ACTUATED}
"""What the reference vehicle does not have: sensors; and an actuator."""
PERIOD = 0.01
DESCRIBED = {"/simulation_description", "/robot_description"}
"""What comes before the first set."""


def time_of(peer) -> float:
    """Simulated time of the newest state that a peer has heard (s)."""
    return peer.received["state"][-1][1].data[0]


def sets(name: str) -> list[str]:
    vehicle = preset().with_values(VEHICLES[name])
    parts = (devices_of(vehicle), has_actuators(vehicle))
    return [topic.name for topic in set_of(Options(model=MODELS[name]), True, *parts)]


def messages_of(bag) -> dict[str, list[bytes]]:
    """The messages of a bag by topic, encoded by one library: the middleware leaves gaps as is."""
    found = {}
    with Reader(bag) as reader:
        for connection, _, data in reader.messages():
            kind = connection.msgtype
            encoded = bytes(TYPES.serialize_cdr(decode(data, kind), kind))
            found.setdefault(connection.topic, []).append(encoded)
    return found


@pytest.fixture
def lockstep_bag(start, peer, tmp_path):
    """lockstep_bag(name): the bag of a recorder beside a manoeuvre in lockstep.

    The recorder is suspended for a while: it loses nothing.
    """

    def make(name):
        values = {
            "mode": "lockstep",
            "lockstep_topics": "[steering_cmd, wheel_torque_cmd]",
            "lockstep_wait": f"[{', '.join(sets(name))}]",
            "model": f"'{MODELS[name]}'",
            "publish_stamped": "true",
            "vehicle.cg_height": "0.55",
            **{f"vehicle.{key}": str(value) for key, value in VEHICLES[name].items()},
        }
        words = [word for item in values.items() for word in ("-p", ":=".join(item))]
        start("simulator", "--ros-args", *words)
        bag = tmp_path / "lockstep"
        recorder = start("recorder", "--output", str(bag))
        peer.wait(lambda: heard_so_far(bag).keys() >= DESCRIBED, "the recorder to hear")
        _, duration = MANOEUVRES[name][-2:]
        peer.listen("state")
        manoeuvre = start("manoeuvre", name, "--duration", duration)
        peer.wait(lambda: peer.received["state"] and time_of(peer) > 0.2, "the run to begin")
        os.kill(recorder.process.pid, signal.SIGSTOP)
        peer.wait(lambda: time_of(peer) > 1.0, "the run to go on without the recorder")
        os.kill(recorder.process.pid, signal.SIGCONT)
        status, _, err = manoeuvre.finish()
        assert (status, err) == (0, "")
        count = round(float(duration) / PERIOD) + 1
        names = [f"/{topic}" for topic in sets(name)]

        def has_all() -> bool:
            heard = heard_so_far(bag)
            return all(heard[each] >= count for each in names)

        peer.wait(has_all, "the recorder to have every set")
        status, _, _ = recorder.finish(signal.SIGINT)
        assert status == 0
        return bag

    return make


@pytest.mark.parametrize("name", MANOEUVRES)
def test_both_hold_the_same_sets_and_either_is_replayed_to_the_bit(lockstep_bag, tmp_path, name):
    recorded = lockstep_bag(name)
    bag = ("--stamped", "--bag", str(tmp_path / "offline"))
    given = [w for item in VEHICLES[name].items() for w in ("--set", "{}={}".format(*item))]
    assert offline(["run", name, *MANOEUVRES[name], *given, *bag]) == 0
    ours, theirs = messages_of(tmp_path / "offline"), messages_of(recorded)
    commands = {"/steering_cmd", "/wheel_torque_cmd"}
    assert ours.keys() - theirs.keys() <= {"/tf", *commands}  # a type not installed everywhere
    assert theirs.keys() - ours.keys() <= {DIAGNOSTICS.name}
    assert (f"/{ROLL_CENTRE.name}" in ours) == (MODELS[name] == "2")
    assert (f"/{MEASUREMENTS.name}" in ours) == (VEHICLES[name] == SENSORS)
    assert (f"/{ACTUATORS.name}" in ours) == (VEHICLES[name] == ACTUATED)
    count = len(ours["/state"])
    assert count > 100
    for topic in sets(name):
        assert ours[f"/{topic}"] == theirs[f"/{topic}"][-count:], topic
    for topic in commands & theirs.keys():  # best effort: some may be lost
        in_order = iter(ours[topic])
        assert all(message in in_order for message in theirs[topic])
    for topic in ("/simulation_description", "/robot_description", f"/{ROLLOVER.name}"):
        assert ours[topic][0] == theirs[topic][0]
    for bag in (tmp_path / "offline", recorded):
        run = recorded_runs(bag)[-1]
        assert replay(run, described(run.description).simulation).is_exact
