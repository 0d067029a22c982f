"""The equations against an independent multibody engine: accelerations, then whole manoeuvres.

Comparable is the variant in which the engine's bodies are the model's, MULTIBODY. Both have the
same tires, which are tested by themselves.
"""

import dataclasses

import numpy as np
import pytest
from programmes import Evaluation, ramp_and_hold, with_moments
from random_states import attitude, random_command, random_state, wheel_positions

from vehicle_roll_sim import LF, LR, Condition, InputError, Simulation, Vehicle, preset
from vehicle_roll_sim.runs.columns import COLUMNS, OUTPUT_QUANTITIES
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.run import run
from vehicle_roll_sim.simulation.limits import DEFAULT_SPEED
from vehicle_roll_sim.simulation.options import MULTIBODY

pytest.importorskip("mujoco", reason="the multibody engine is not installed")
from vehicle_roll_sim.paper.multibody import SPEEDS, SPINS, Multibody

pytestmark = pytest.mark.unmeasured

STATES = 200
SAMPLE = 1e-3
"""s"""
RELATIVE = 1e-10
"""Of the largest one: rounding, and the engine's point masses that are not quite points, 1e-12;
seen 4e-12."""
CLOSE = {
    "roll": 1e-9,
    "yaw_rate": 1e-6,
    "lateral_acceleration": 1e-4,
    "normal_force": 1e-3,
    "wheel_speed": 5e-4,
}
"""rad, rad/s, m/s^2, N, rad/s. Both are integrated to fourth order with 1 ms, but in different
coordinates: what is left is divided by 17 to 19 with half the step. Seen 4e-11, 4e-8, 3e-6, 4e-5
and 2e-5; the last is large because a loaded wheel's spin settles within 1 ms."""
CLOSE_TO_PEAK = 1e-3
"""The other columns, as a share of their peak, for the same reason; seen 4e-5."""
EVENT_TIMES = 5e-9
"""s, for the same reason; seen 2.4e-10."""


def uneven() -> Vehicle:
    """A vehicle near the reference of which no two parameters are alike."""
    vehicle, rng = preset("reference"), np.random.default_rng(5)
    return vehicle.with_values(
        {name: value * rng.uniform(0.9, 1.1) for name, value in vehicle.given.items()}
    )


ASIDE = {
    "cg_offset": 0.1,
    "roll_pitch_product": 60.0,
    "roll_yaw_product": -80.0,
    "pitch_yaw_product": 40.0,
    "front_anti_roll_bar_rate": 9000.0,
}
VEHICLES = {
    "reference": preset("reference"),
    "uneven": uneven(),
    "with contact moments": with_moments(uneven()),
    "progressive tires": uneven().with_values(
        {"front_tire_progression": 4.0, "rear_tire_progression": 9.0}
    ),
    "c.g. below the wheel centres": uneven().with_values({"cg_height": 0.2}),
    "c.g. beside the middle": uneven().with_values(ASIDE),
}


@pytest.fixture(params=VEHICLES)
def vehicle(request) -> Vehicle:
    return VEHICLES[request.param]


def accelerations(vehicle, state, rates) -> np.ndarray:
    """The model's, as the engine has them: c.g. over the ground, body rates, slides."""
    rotation = attitude(state["roll"], state["pitch"], state["yaw"])
    velocity = np.array([state["u"], state["v"], state["w"]])
    turning = np.array([state["roll_rate"], state["pitch_rate"], state["yaw_rate"]])
    in_body = np.array([rates["u"], rates["v"], rates["w"]]) + np.cross(turning, velocity)
    spinning = np.array([rates["roll_rate"], rates["pitch_rate"], rates["yaw_rate"]])
    x, y = wheel_positions(vehicle).T
    at_strut = rates["w"] + y * rates["roll_rate"] - x * rates["pitch_rate"]
    return np.concatenate([rotation @ in_body, spinning, rates["unsprung_velocity"] - at_strut])


def test_accelerations_at_random_states_are_those_of_the_engine(vehicle):
    engine, evaluation = Multibody(vehicle), Evaluation(vehicle, MULTIBODY)
    rng = np.random.default_rng(11)
    for _ in range(STATES):
        state, command = random_state(vehicle, rng), random_command(rng)
        command["speed_hold_gain"], command["speed_hold_target"] = 500.0, 15.0
        rates = evaluation.rates(state, command)
        engine.state_vector[:] = state.reshape(1).view(np.float64)
        theirs = engine.rates(engine.coordinates(), command)
        pairs = [
            (accelerations(vehicle, state, rates), theirs[SPEEDS]),
            (rates["wheel_speed"], theirs[SPINS]),
        ]
        for name in (*OUTPUT_QUANTITIES, "steering", "acceleration"):
            pairs.append((evaluation.outputs[name], engine.outputs[name]))
        for mine, other in pairs:
            assert np.abs(mine - other).max() <= RELATIVE * np.abs(other).max(), state


@dataclasses.dataclass(frozen=True)
class Runs:
    """The same manoeuvre by the model, whose `simulation` it was, and by the engine."""

    simulation: Simulation
    model: History
    engine: History
    events: np.record

    def differences(self, names) -> dict[str, float]:
        """Of each column, or of a quantity of all wheels, the largest one."""
        return {
            name: float(np.abs(of(self.model, name) - of(self.engine, name)).max())
            for name in names
        }


def of(history, name) -> np.ndarray:
    return history[name] if name in COLUMNS else history.wheels(name)


def both(vehicle, programme, duration, speed=DEFAULT_SPEED, **settings) -> Runs:
    """Runs with a row at every millisecond."""
    simulation = Simulation(vehicle, MULTIBODY, **settings)
    simulation.reset(speed)
    model = run(simulation, programme, duration, sample=SAMPLE)
    multibody = Multibody(vehicle, **settings)
    multibody.reset(speed)
    engine = run(multibody, programme, duration, sample=SAMPLE)
    return Runs(simulation, model, engine, multibody.events)


J_TURN = ramp_and_hold(0.1, 40.0, 10.0)
"""The J-turn, which lifts the inner wheels, after a short way straight ahead."""
LONG = {"reference": 5.1, "with contact moments": 1.6}
"""s: beyond the rollover of the first; the second goes on, on two wheels."""


@pytest.fixture(scope="module", params=LONG)
def turn(request) -> Runs:
    """The J-turn."""
    return both(VEHICLES[request.param], J_TURN, LONG[request.param])


@pytest.mark.parametrize("turn", ["reference"], indirect=True)
def test_the_reference_vehicle_leaves_the_ground_and_rolls_over_in_it(turn):
    assert turn.simulation.condition is Condition.ROLLED_OVER
    assert np.isfinite(turn.simulation.events.lift_off_time).all()


def test_the_j_turn_to_rollover_is_that_of_the_engine(turn):
    assert np.isfinite(turn.simulation.events.lift_off_time[[LF, LR]]).all()
    assert turn.engine["time"].tolist() == turn.model["time"].tolist()
    for name, difference in turn.differences(CLOSE).items():
        assert difference < CLOSE[name], name


def test_every_column_of_the_j_turn_is_that_of_the_engine(turn):
    for name, difference in turn.differences(COLUMNS).items():
        assert difference <= CLOSE_TO_PEAK * np.abs(turn.model[name]).max(), name


def test_the_events_of_the_j_turn_are_those_of_the_engine(turn):
    mine, theirs = turn.simulation.events, turn.events
    for name in ("lift_off_time", "rollover_time", "out_of_range_time"):
        np.testing.assert_allclose(theirs[name], mine[name], rtol=0, atol=EVENT_TIMES)
    for name, peak in (
        ("roll", "peak_roll"),
        ("lateral_acceleration", "peak_lateral_acceleration"),
    ):
        value, time = theirs[peak]
        assert abs(value - mine[peak][0]) < CLOSE[name]
        assert time == mine[peak][1]


@pytest.mark.parametrize("turn", ["reference"], indirect=True)
def test_what_is_left_in_the_j_turn_is_of_fourth_order_in_the_step(turn):
    """Until shortly after the first wheel has lifted off."""
    finer = both(VEHICLES["reference"], J_TURN, 0.6, step=turn.simulation.step_ns / 2e9)
    for name in ("normal_force", "wheel_speed", "lateral_acceleration"):
        fine = of(finer.model, name) - of(finer.engine, name)
        coarse = (of(turn.model, name) - of(turn.engine, name))[: len(fine)]
        # 16; the next order adds to it
        assert 12 < np.abs(coarse).max() / np.abs(fine).max() < 24, name


def test_steering_at_both_axles_torques_active_forces_and_speed_hold_act_as_in_the_engine(vehicle):
    everything = ramp_and_hold(
        0.2,
        30.0,
        4.0,
        rear_steering=-0.01,
        wheel_torque=(-150.0, -100.0, 200.0, 300.0),
        normal_force=(500.0, -300.0, 200.0, -400.0),
        speed_hold_gain=800.0,
        speed_hold_target=13.0,
    )
    runs = both(vehicle, everything, 1.0)
    assert runs.simulation.condition is Condition.RUNNING
    for name, difference in runs.differences(CLOSE).items():
        assert difference < CLOSE[name], name
    for name, difference in runs.differences(COLUMNS).items():
        assert difference <= CLOSE_TO_PEAK * np.abs(runs.model[name]).max(), name


@pytest.mark.parametrize(
    ("programme", "settings", "condition"),
    [
        (ramp_and_hold(0.0, 20.0, 2.0, wheel_torque=(-1200.0,) * 4), {"speed": 5.0}, "TOO_SLOW"),
        (J_TURN, {"rollover_angle": 0.1}, "ROLLED_OVER"),
    ],
)
def test_a_run_in_the_engine_stops_where_one_of_the_model_does(programme, settings, condition):
    runs = both(VEHICLES["reference"], programme, 2.0, **settings)
    assert runs.simulation.condition is Condition[condition]
    assert runs.engine["time"].tolist() == runs.model["time"].tolist()


def test_the_engine_refuses_actuators():
    vehicle = preset().with_values({"steering_actuator_range": 0.5})
    with pytest.raises(InputError, match=r"^steering_actuator_range: 0.5 is not allowed: no value"):
        Multibody(vehicle)


@pytest.mark.parametrize(
    ("setting", "value"), [("speed", 1.0), ("step", 1.0), ("rollover_angle", 2.0)]
)
def test_the_engine_refuses_what_the_model_refuses(setting, value):
    settings = {setting: value}
    speed = settings.pop("speed", DEFAULT_SPEED)
    with pytest.raises(InputError) as refused:
        Multibody(VEHICLES["reference"], **settings).reset(speed)
    assert refused.value.field == setting
