"""The vehicle as an entity: its motion along the ground frame, and moving it."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from signals import everything

from vehicle_roll_sim import Command, InputError, Options, Simulation, preset
from vehicle_roll_sim.live.command_inbox import CommandInbox
from vehicle_roll_sim.live.entity_state import entity_state, put, set_going
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.simulation.road import Road

TURN = Command(steering=0.08)
LEVEL = (0.0, 0.0, 0.0, 1.0)
ROUNDING = 1e-9
"""Relative: rotations of a few hundred operations in double precision."""


def session_of(model: str = "1", road: Road | None = None) -> Session:
    session = Session(
        Simulation(preset(), Options(model=model), road=road), CommandInbox(0.0), 10_000_000, 15.0
    )
    session.inbox.receive("steering_cmd", [TURN.steering], 0)
    for _ in range(60):
        session.run_period()
    return session


def turned(yaw: float) -> tuple[float, ...]:
    return tuple(Rotation.from_euler("z", yaw).as_quat())


def test_velocities_and_accelerations_are_those_of_the_body_turned_by_its_attitude():
    session = session_of()
    state, outputs = session.simulation.state, session.simulation.outputs
    found = entity_state(session.simulation)
    attitude = Rotation.from_euler("ZYX", [state.yaw, state.pitch, state.roll])
    assert found.position == (state.x, state.y, state.z)
    assert np.allclose(Rotation.from_quat(found.orientation).as_matrix(), attitude.as_matrix())
    assert np.allclose(found.velocity, attitude.apply([state.u, state.v, state.w]))
    rates = [state.roll_rate, state.pitch_rate, state.yaw_rate]
    assert np.allclose(found.turning, attitude.apply(rates))
    heading = Rotation.from_euler("z", state.yaw)
    assert np.allclose(found.acceleration, heading.apply(outputs["acceleration"]))


@pytest.mark.parametrize("model", ["1", "8dof"])
def test_the_velocity_is_the_derivative_of_the_position(model):
    """Central differences over 1 ms: their error is that of the third derivative, some 1e-5."""
    session = session_of(model)
    places = []
    for _ in range(3):
        places.append(entity_state(session.simulation))
        session.simulation.step(TURN, 0.001)
    slope = (np.array(places[2].position) - places[0].position) / 0.002
    assert np.allclose(slope[:2], places[1].velocity[:2], atol=1e-4)
    assert all(map(math.isfinite, (*places[1].position, *places[1].acceleration)))


@pytest.mark.parametrize("model", ["1", "2", "8dof"])
def test_a_vehicle_that_was_moved_drives_the_same_path_elsewhere(model):
    """On a level road, place and heading are without effect on anything else."""
    straight, moved = session_of(model), session_of(model)
    place, yaw = (30.0, -20.0), 1.2
    before = entity_state(moved.simulation)
    put(moved, (*place, 0.0), turned(yaw))
    found = entity_state(moved.simulation)
    assert found.position[:2] == pytest.approx(place, abs=ROUNDING)
    assert found.position[2] == before.position[2]
    assert float(moved.simulation.state["yaw"]) == pytest.approx(yaw, abs=ROUNDING)
    turn = yaw - float(straight.simulation.state["yaw"])
    for _ in range(20):
        straight.run_period()
        moved.run_period()
    c, s = math.cos(turn), math.sin(turn)
    ways = np.array(entity_state(straight.simulation).position[:2]) - before.position[:2]
    expected = place + np.array([[c, -s], [s, c]]) @ ways
    assert entity_state(moved.simulation).position[:2] == pytest.approx(expected, abs=1e-7)
    for name in ("roll", "u", "v", "yaw_rate"):
        left, right = moved.simulation.state[name], straight.simulation.state[name]
        assert left == pytest.approx(right, abs=1e-8)
    assert moved.simulation.time_ns == straight.simulation.time_ns


@pytest.mark.parametrize("model", ["1", "2"])
def test_on_an_uneven_road_the_height_over_it_stays(model):
    """On a wide plateau a vehicle drives as on the level below it, but for its height."""
    plateau = {"kind": "ramp", "start": 500.0, "length": 5.0, "height": 0.4, "top": 100.0}
    road = Road.from_values({"features": [plateau]})
    moved, straight = session_of(model, road), session_of(model, road)
    put(moved, (550.0, 0.0, 0.0), turned(float(straight.simulation.state["yaw"])))
    straight.simulation.place(0.0, 0.0, float(straight.simulation.state["yaw"]))
    for _ in range(20):
        moved.run_period()
        straight.run_period()
    left, right = entity_state(moved.simulation), entity_state(straight.simulation)
    assert np.subtract(left.position, right.position) == pytest.approx((550.0, 0.0, 0.4), abs=1e-8)
    loads = moved.simulation.outputs["normal_force"]
    assert loads == pytest.approx(straight.simulation.outputs["normal_force"], rel=1e-7)


def test_outputs_are_those_of_the_new_heading():
    """On a slope, gravity acts along the vehicle as soon as it heads uphill."""
    session = session_of(road=Road(grade=0.1))
    put(session, (0.0, 0.0, 0.0), turned(math.pi / 2))
    slope = session.simulation.outputs["slope_gravity"]
    assert slope[0] == pytest.approx(0.0, abs=1e-6)
    assert abs(slope[1]) > 0.5
    assert session.simulation.outputs["steering"][0] == TURN.steering


def test_a_vehicle_is_set_going_in_equilibrium_where_it_is():
    session = session_of()
    time_ns = session.simulation.time_ns
    put(session, (5.0, 6.0, 0.0), turned(0.5))
    set_going(session, (20.0 * math.cos(0.5), 20.0 * math.sin(0.5), 0.0), (0.0, 0.0, 0.0))
    fresh = Simulation(preset())
    fresh.reset(20.0)
    fresh.place(5.0, 6.0, float(session.simulation.state["yaw"]))
    state, expected = session.simulation.state, fresh.state
    for name in state.dtype.names:
        assert np.allclose(state[name], expected[name], rtol=1e-12, atol=1e-12), name
    assert session.simulation.time_ns == time_ns
    assert session.applied == Command()


def test_what_was_put_where_it_is_moves_nothing():
    session = session_of()
    before = entity_state(session.simulation)
    straight = session.snapshot()
    put(session, before.position, before.orientation)
    assert float(session.simulation.state["roll"]) == float(
        Simulation.from_snapshot(straight.simulation, preset()).state["roll"]
    )
    assert entity_state(session.simulation).position == pytest.approx(before.position, abs=1e-12)


@pytest.mark.parametrize(
    ("position", "orientation", "words"),
    [
        ((0.0, 0.0, 3.0), LEVEL, "z: 3.0"),
        ((0.0, 0.0, 0.0), tuple(Rotation.from_euler("x", 0.3).as_quat()), "roll: 0.3"),
        ((0.0, 0.0, 0.0), tuple(Rotation.from_euler("y", 0.2).as_quat()), "pitch: 0.2"),
        ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0), "norm 1"),
        ((math.nan, 0.0, 0.0), LEVEL, "finite"),
        ((1e13, 0.0, 0.0), LEVEL, "x: "),
    ],
)
def test_a_pose_that_the_suspension_does_not_have_is_refused(position, orientation, words):
    session = session_of()
    before = everything(session.simulation)
    with pytest.raises(InputError) as refusal:
        put(session, position, orientation)
    assert words in str(refusal.value)
    assert everything(session.simulation) == before


@pytest.mark.parametrize(
    ("velocity", "turning", "words"),
    [
        ((20.0, 5.0, 0.0), (0.0, 0.0, 0.0), "along the heading"),
        ((20.0, 0.0, 1.0), (0.0, 0.0, 0.0), "along the heading"),
        ((20.0, 0.0, 0.0), (0.0, 0.0, 0.2), "along the heading"),
        ((math.inf, 0.0, 0.0), (0.0, 0.0, 0.0), "finite"),
        ((-3.0, 0.0, 0.0), (0.0, 0.0, 0.0), "speed: -3.0"),
    ],
)
def test_a_twist_that_is_no_speed_is_refused(velocity, turning, words):
    session = session_of()
    put(session, (0.0, 0.0, 0.0), LEVEL)
    before = everything(session.simulation)
    with pytest.raises(InputError) as refusal:
        set_going(session, velocity, turning)
    assert words in str(refusal.value)
    assert everything(session.simulation) == before


def test_a_stopped_simulation_stays_stopped_when_it_is_placed_and_not_when_set_going():
    simulation = Simulation(preset(), rollover_angle=0.05)
    simulation.step(Command(steering=0.2), 3.0)
    assert simulation.condition.name == "ROLLED_OVER"
    simulation.place(1.0, 2.0, 0.3)
    assert simulation.condition.name == "ROLLED_OVER"
    simulation.roll_freely(10.0)
    assert simulation.condition.name == "RUNNING"
    assert (simulation.state["x"], simulation.state["y"]) == pytest.approx((1.0, 2.0))
