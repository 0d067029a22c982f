"""The environment of one vehicle is a run of the simulator with an agent's commands added."""

import copy
import pickle
import warnings

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium", reason="gymnasium is not installed")

from gymnasium.error import ResetNeeded  # noqa: E402
from gymnasium.utils.env_checker import check_env  # noqa: E402
from measured import measured  # noqa: E402

import vehicle_roll_sim.learning  # noqa: E402, F401
from vehicle_roll_sim import Command, Simulation, preset, run  # noqa: E402
from vehicle_roll_sim.learning.actions import ACTIONS  # noqa: E402
from vehicle_roll_sim.learning.observations import OBSERVATIONS  # noqa: E402
from vehicle_roll_sim.live.command_limits import CommandLimits  # noqa: E402

PERIOD, STEP = 0.01, 0.0025
FISHHOOK = {"manoeuvre.duration": 4.0, "manoeuvre.steering_at_03g": 30.0}
AGENT_STEERS = {"manoeuvre": None, "actions": ("steering", "drive_torque", "brake")}


def environment(**given):
    return gymnasium.make("VehicleRoll-v0", **given).unwrapped


def played(env, action=0.0, seed: int = 0, **options):
    """Observation, info, reward, terminated and truncated of the reset and of each step.

    The action stays the same.
    """
    actions = np.full(env.action_space.shape, action, np.float32)
    found = [(*env.reset(seed=seed, options=options), 0.0, False, False)]
    while not any(found[-1][3:]):
        observation, reward, *ended, info = env.step(actions)
        found.append((observation, info, reward, *ended))
    return found


SENSING = {
    "vehicle": measured(wheel_speed_sensor_period=0.005),
    "observations": tuple(OBSERVATIONS),
}


@pytest.mark.parametrize("given", [{}, AGENT_STEERS, SENSING])
def test_gymnasium_finds_nothing_to_say(given):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(environment(fixed={"manoeuvre.duration": 1.0}, **given))


@pytest.mark.parametrize(
    ("manoeuvre", "fixed"),
    [
        ("nhtsa_fishhook", FISHHOOK),  # reversed by the roll rate, ends in a rollover
        ("step_steer", {"manoeuvre.duration": 1.205}),  # holds its speed; half a period remains
        ("iso_double_lane_change", {"manoeuvre.duration": 1.0}),  # answers the state
    ],
)
def test_without_actions_an_episode_is_the_run_of_its_manoeuvre(manoeuvre, fixed):
    names = ("roll", "wheel_speed", "normal_force", "lateral_acceleration", "steering")
    factors = {"manoeuvre.speed": [18.0]}
    env = environment(manoeuvre=manoeuvre, fixed=fixed, factors=factors, observations=names)
    found = played(env)
    values = {name.removeprefix("manoeuvre."): value for name, value in fixed.items()}
    single = run(manoeuvre, speed=18.0, step=STEP, command_period=PERIOD, **values)
    columns = [single[name] for name in env.observation_names]
    assert np.array([each[0] for each in found]).tobytes() == np.array(columns).T.tobytes()
    assert [each[1]["time"] for each in found] == single["time"].tolist()
    last = found[-1][1]
    assert repr(last["metrics"]) == repr(single.metrics)
    assert last["condition"] == single.condition.name


def test_actions_are_shares_of_the_limits_of_the_node():
    """Compared with a simulation to which the same command is given by hand."""
    vehicle = preset("suv")
    given = {"manoeuvre": None, "actions": tuple(ACTIONS), "factors": {"manoeuvre.speed": [20.0]}}
    env = environment(vehicle="suv", limits={"normal_force_limit": 800.0}, **given)
    (low, high), limits = (env.action_space.low, env.action_space.high), CommandLimits()
    action = np.linspace(-0.125, 0.5, len(low), dtype=np.float32).clip(low, high)
    by_name = dict(zip(env.action_names, action.astype(float).tolist(), strict=True))
    wheels = {
        name: np.array([by_name[f"{name}_{wheel}"] for wheel in ("lf", "rf", "lr", "rr")])
        for name in ("wheel_torque", "brake_torque", "normal_force")
    }
    drive, brake = by_name["drive_torque"], by_name["brake"]
    command = Command(
        steering=by_name["steering"] * limits.steering_limit,
        rear_steering=by_name["rear_steering"] * limits.steering_limit,
        wheel_torque=wheels["wheel_torque"] * limits.wheel_torque_limit
        + drive * limits.drive_torque_limit * vehicle.drive_shares,
        brake_torque=wheels["brake_torque"] * limits.brake_torque_limit
        + brake * limits.brake_limit * vehicle.brake_shares,
        normal_force=wheels["normal_force"] * 800.0,
    )
    simulation = Simulation(vehicle, step=STEP)
    simulation.reset(20.0)
    env.reset(seed=0)
    for _ in range(5):
        observation, *_ = env.step(action)
        simulation.step(command, PERIOD)
    seen = dict(zip(env.observation_names, observation, strict=True))
    now = simulation.state
    assert [seen["roll"], seen["yaw_rate"], seen["u"]] == [now.roll, now.yaw_rate, now.u]
    assert np.all((low == -1.0) | (low == 0.0))
    assert np.all(high == 1.0)
    assert {name for name, least in zip(env.action_names, low, strict=True) if least == 0.0} == {
        *(f"brake_torque_{wheel}" for wheel in ("lf", "rf", "lr", "rr")),
        "brake",
    }


def test_the_steering_rate_is_limited():
    limits = {"steering_rate_limit": 0.5, "steering_limit": 0.1}
    env = environment(**AGENT_STEERS, limits=limits, observations=("steering",))
    env.reset(seed=0)
    steering = [float(env.step(np.array([-1.0, 0.0, 0.0]))[0][0]) for _ in range(25)]
    assert steering == pytest.approx([-min(0.005 * (k + 1), 0.1) for k in range(25)], abs=1e-12)


def test_a_rollover_terminates_and_the_end_of_the_manoeuvre_truncates():
    env = environment(fixed=FISHHOOK, factors={"manoeuvre.speed": [20.0, 5.0]})
    found = played(env, **{"manoeuvre.speed": 20.0})
    assert [each[3:] for each in found[1:-1]] == [(False, False)] * (len(found) - 2)
    assert found[-1][3:] == (True, False)
    assert found[-1][1]["condition"] == "ROLLED_OVER"
    assert -102.0 < found[-1][2] < -98.0
    with pytest.raises(ResetNeeded):
        env.step(env.action_space.sample())
    fixed = {**FISHHOOK, "options.steady_state_slip": True}
    *_, last = played(environment(actions=("brake",), fixed=fixed), 0.1)
    assert (last[1]["condition"], *last[3:]) == ("TOO_SLOW", False, True)
    slow = played(env, **{"manoeuvre.speed": 5.0})
    assert len(slow) == 401
    assert slow[-1][3:] == (False, True)
    assert slow[0][1] == {"time": 0.0, "drawn": {"manoeuvre.speed": 5.0}}


def test_the_same_seed_gives_the_same_bytes_and_another_one_another_episode():
    factors = {
        "manoeuvre.speed": {"distribution": "normal", "mean": 15.0, "sd": 1.0},
        "vehicle.cg_height": [0.6, 0.7, 0.8],
        "tire.LMUY": {"distribution": "uniform", "lowest": 0.8, "highest": 1.0},
    }
    given = {"manoeuvre": ["j_turn", "step_steer"], "factors": factors}
    found = []
    for seed in (4, 4, 5):
        env = environment(**given, fixed={"manoeuvre.duration": 0.1})
        found.append(played(env, 0.3, seed) + played(env, 0.3, None))
    texts = [[(each[0].tobytes(), repr(each[1:])) for each in episode] for episode in found]
    assert texts[0] == texts[1]
    assert texts[0][0] != texts[0][11]
    assert texts[0][0] != texts[2][0]


def test_the_reward_may_be_a_function_of_ones_own():
    def reward(signals, actions, rolled_over):
        return signals["lift_off"].sum(axis=1) + signals["time"] + actions.mean(axis=1)

    env = environment(reward=reward, fixed=FISHHOOK, observations=("lift_off",))
    found = played(env, 0.25)[1:]
    expected = [each[0].sum() + each[1]["time"] + 0.25 for each in found]
    assert [each[2] for each in found] == pytest.approx(expected, rel=1e-15)
    assert len({each[2] for each in found}) > 100


def test_a_brake_keeps_a_vehicle_on_its_wheels_that_tips_without():
    env = environment(actions=("brake",), fixed=FISHHOOK, factors={"manoeuvre.speed": [17.0]})
    without, braked = played(env), played(env, 0.3)
    assert (without[-1][3], braked[-1][3]) == (True, False)
    returns = [sum(each[2] for each in found[1:]) for found in (without, braked)]
    assert returns[1] > returns[0] + 90.0


@pytest.mark.parametrize("copied", [copy.deepcopy, lambda env: pickle.loads(pickle.dumps(env))])
def test_a_copy_in_the_middle_of_an_episode_goes_on_to_the_same_bits(copied):
    env, action = environment(fixed=FISHHOOK), np.full(4, 0.1, np.float32)
    env.reset(seed=3)
    for _ in range(40):
        env.step(action)
    other = copied(env)
    for _ in range(40):
        mine, its = env.step(action), other.step(action)
        assert (mine[0].tobytes(), *mine[1:]) == (its[0].tobytes(), *its[1:])
    assert env.reset()[1] == other.reset()[1]


def test_observations_are_what_the_sensors_of_the_vehicle_measure():
    """With the noise of a seed that is drawn for the episode, and that its info names."""
    names = tuple(name for name in OBSERVATIONS if name.startswith("measured_"))
    about = {"observations": names, "fixed": {"manoeuvre.duration": 0.5}}
    env = environment(vehicle=SENSING["vehicle"], **about)
    assert env.observation_names[:4] == tuple(
        f"measured_{name}"
        for name in ("accelerometer_x", "accelerometer_y", "accelerometer_z", "gyro_x")
    )
    found, again, other = (played(env, seed=seed) for seed in (5, 5, 6))
    assert [step[0].tolist() for step in found] == [step[0].tolist() for step in again]
    seeds = [each[0][1]["drawn"]["vehicle.sensor_seed"] for each in (found, again, other)]
    assert seeds[0] == seeds[1] != seeds[2]
    speed = found[0][1]["drawn"]["manoeuvre.speed"]
    seeded = SENSING["vehicle"].with_values({"sensor_seed": seeds[0]})
    single = run("j_turn", seeded, amplitude=0.0, speed=speed, duration=0.5, step=STEP)
    assert env.observation_names == single.history.measured_names
    measurements = np.array([step[0] for step in found])
    expected = single.history.measured.astype(measurements.dtype)
    np.testing.assert_array_equal(measurements, expected)
    fixed = environment(
        vehicle=SENSING["vehicle"],
        observations=names,
        fixed={"manoeuvre.duration": 0.5, "vehicle.sensor_seed": 3},
    )
    one, other = (played(fixed, seed=0) for _ in range(2))
    assert "vehicle.sensor_seed" not in one[0][1]["drawn"]
    assert [step[0].tolist() for step in one] == [step[0].tolist() for step in other]
