"""The node takes the same models as the command line."""

import numpy as np
import pytest
from std_srvs.srv import Trigger

from vehicle_roll_sim import LR, Options, Simulation, preset
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.messages.topics import set_of

pytestmark = pytest.mark.unmeasured


@pytest.mark.parametrize(
    ("model", "given"),
    [
        ("1", {}),
        ("1", {"steady_state_slip": True}),
        ("1c-iii", {"steady_state_slip": True}),
        ("2", {"body_contact": True}),
        ("8dof", {}),
    ],
)
def test_the_chosen_model_publishes_every_topic_and_its_own_states(start, peer, model, given):
    options = Options(model=model, **given)
    words = (f"model:={model}", "command_timeout:=0.0", *(f"{name}:=true" for name in given))
    start("simulator", "--ros-args", *(word for each in words for word in ("-p", each)))
    names = [topic.name for topic in set_of(options, stamped=False)]
    peer.listen(*names)
    for name in names:
        peer.newest(name)
    peer.call(Trigger, "simulator/reset")
    rest = Simulation(preset(), options)
    states = peer.received["state"]
    peer.wait(
        lambda: any(list(m.data) == [0.0, *rest.model_state] for _, m in states),
        "the initial state",
    )
    labels = [dimension.label for dimension in states[-1][1].layout.dim]
    assert labels == ["time", *rest.state_names]


def test_a_model_without_heave_and_pitch_says_nan_and_leaves_the_suspension_out(start, peer):
    start("simulator", "--ros-args", "-p", "model:=8dof")
    peer.listen("odom", "imu", "joint_states", "tire_normal_forces")
    odom, imu, joints = (peer.newest(name) for name in ("odom", "imu", "joint_states"))
    absent = (odom.pose.pose.position.z, odom.twist.twist.linear.z, odom.twist.twist.angular.y)
    assert np.isnan([*absent, imu.angular_velocity.y]).all()
    turned = imu.orientation
    assert np.isfinite([turned.x, turned.y, turned.z, turned.w]).all()
    assert imu.linear_acceleration.z == pytest.approx(9.81)  # m/s^2, at rest
    kinds = {name.split("_")[1] for name in joints.name}
    assert kinds == {"steering", "wheel"}
    assert len(joints.position) == len(joints.velocity) == len(joints.name)
    assert np.isfinite([*joints.position, *joints.velocity]).all()


def test_a_manoeuvre_finds_the_lift_off_of_a_model_without_tire_compressions(start):
    start("simulator", "--ros-args", "-p", "model:=8dof", "-p", "mode:=lockstep")
    status, out, err = start("manoeuvre", "j_turn", "--duration", "2.0").finish()
    assert (status, err) == (0, "")
    found = {row.split(":")[0]: row.split(":")[1].split()[0] for row in out.splitlines()}
    offline = Simulation(preset(), Options(model="8dof"))
    offline.step(STANDARD["j_turn"], 2.0)
    expected = offline.events.lift_off_time[LR]
    assert float(found["lift-off lr"]) == pytest.approx(expected, abs=0.02)  # s: samples
    assert found["lift-off lf"] == found["rollover"] == "none"


def test_a_combination_that_is_not_defined_ends_it_with_one_line(start):
    words = ("-p", "model:=1a", "-p", "euler_terms:=true")
    status, _, err = start("simulator", "--ros-args", *words).finish()
    assert status == 2
    assert len(err.splitlines()) == 1
    assert "euler_terms" in err
