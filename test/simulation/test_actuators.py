"""Actuators against closed forms, alone and together; without effect they change no bit."""

import numpy as np
import pytest
from actuated import ACTUATORS

from vehicle_roll_sim import Command, InputError, Simulation, preset
from vehicle_roll_sim.model.actuators import CHANNELS
from vehicle_roll_sim.model.records import COMMAND
from vehicle_roll_sim.simulation.command import command_at
from vehicle_roll_sim.vehicle.actuator_parameters import QUANTITIES

STEP = 0.001
ROUNDING = 1e-12
"""Of values of about 1, after some hundred steps that round to 1e-16 each."""
AMPLITUDE = 0.01
"""rad, N m or N: small, so that the vehicle hardly moves."""


def with_actuators(**values: float) -> Simulation:
    simulation = Simulation(preset().with_values(values), step=STEP)
    simulation.reset(20.0)
    return simulation


def given(quantity: str, value: float) -> Command:
    per_wheel = COMMAND[quantity].shape
    return Command(**{quantity: (value,) * 4 if per_wheel else value})


def response(simulation: Simulation, inputs, quantity: str = "steering") -> np.ndarray:
    """What acts after each step with these inputs, held step by step."""
    found = []
    for value in inputs:
        command = given(quantity, value)
        simulation.step(command, STEP)
        acting = np.unique(getattr(simulation.acting(command), quantity))
        assert len(acting) == 1
        found.append(acting[0])
    return np.array(found)


def held(steps: int = 300) -> np.ndarray:
    return np.full(steps, AMPLITUDE)


def times(steps: int = 300) -> np.ndarray:
    """The end of each step (s)."""
    return STEP * np.arange(1, steps + 1)


def near(values: np.ndarray, share: np.ndarray) -> None:
    np.testing.assert_allclose(values / AMPLITUDE, share, rtol=0, atol=ROUNDING)


@pytest.mark.parametrize("quantity", QUANTITIES)
def test_a_first_order_lag_has_its_step_response(quantity):
    simulation = with_actuators(**{f"{quantity}_actuator_time_constant": 0.07})
    near(response(simulation, held(), quantity), 1 - np.exp(-times() / 0.07))


def second_order_step(damping: float, w: float) -> np.ndarray:
    """The step response, by the roots of its characteristic equation."""
    t = times()
    if damping == 1.0:
        return 1 - (1 + w * t) * np.exp(-w * t)
    root = np.sqrt(complex(damping**2 - 1))
    first, second = w * (-damping + root), w * (-damping - root)
    return 1 - ((first * np.exp(second * t) - second * np.exp(first * t)) / (first - second)).real


@pytest.mark.parametrize("damping", [0.05, 0.7, 1.0, 1.0 + 1e-9, 1.5, 30.0])
def test_a_second_order_lag_has_its_step_response(damping):
    lag = {"steering_actuator_frequency": 5.0, "steering_actuator_damping": damping}
    found, expected = (
        response(with_actuators(**lag), held()),
        second_order_step(damping, 10 * np.pi),
    )
    tolerance = 1e-7 if damping == 1.0 + 1e-9 else ROUNDING  # of the reference: roots that cancel
    np.testing.assert_allclose(found / AMPLITUDE, expected, rtol=0, atol=tolerance)


def test_without_a_damping_ratio_it_is_critical():
    found = response(with_actuators(rear_steering_actuator_frequency=5.0), held(), "rear_steering")
    near(found, second_order_step(1.0, 10 * np.pi))


def test_a_dead_time_shifts_what_is_given_by_whole_steps():
    inputs = AMPLITUDE * np.random.default_rng(1).uniform(-1, 1, 60)
    simulation = with_actuators(normal_force_actuator_dead_time=0.017)
    found = response(simulation, inputs, "normal_force")
    assert found[:17].tolist() == [0.0] * 17
    np.testing.assert_array_equal(found[17:], inputs[:-17])


def test_a_rate_limited_value_goes_straight_to_where_it_is_to_be():
    rate = AMPLITUDE / 0.1  # reached after 0.1 s
    near(
        response(with_actuators(steering_actuator_rate_limit=rate), held()),
        np.minimum(times() / 0.1, 1),
    )


def test_a_lag_follows_a_rate_limited_value_as_it_follows_a_ramp():
    lag, end = 0.03, 0.1
    actuator = {
        "steering_actuator_time_constant": lag,
        "steering_actuator_rate_limit": AMPLITUDE / end,
    }
    rising, t = lag * (1 - np.exp(-end / lag)) / end, times()
    ramp = (t - lag * (1 - np.exp(-t / lag))) / end
    after = 1 - rising * np.exp(-(t - end) / lag)
    near(response(with_actuators(**actuator), held()), np.where(t < end + STEP / 2, ramp, after))


def test_a_value_is_a_multiple_of_the_resolution_within_the_range():
    resolution, inputs = 0.003, np.linspace(-0.05, 0.05, 201)
    actuator = {"steering_actuator_resolution": resolution, "steering_actuator_range": 0.02}
    found = response(with_actuators(**actuator), inputs)
    inside = np.abs(inputs) < 0.0195  # where the next multiple is not beyond the range
    multiples = found[inside] / resolution
    np.testing.assert_allclose(multiples, np.round(multiples), atol=1e-9)
    assert np.abs(found - inputs)[inside].max() <= resolution / 2 + ROUNDING
    assert (found.min(), found.max()) == (-0.02, 0.02)


def test_an_underdamped_lag_stays_within_the_range_and_a_brake_does_not_push():
    actuator = {
        f"brake_torque_actuator_{name}": value
        for name, value in (("frequency", 10.0), ("damping", 0.1), ("range", 50.0))
    }
    simulation = with_actuators(**actuator)
    found = response(simulation, [100.0] * 150 + [0.0] * 100, "brake_torque")
    assert (found.max(), found[150:].min()) == (50.0, 0.0)


def test_a_lag_follows_with_the_dead_time():
    actuator = {"steering_actuator_dead_time": 0.05, "steering_actuator_time_constant": 0.04}
    found = response(with_actuators(**actuator), held())
    assert found[:50].tolist() == [0.0] * 50
    near(found[50:], 1 - np.exp(-times(250) / 0.04))


def sine(times: np.ndarray) -> np.ndarray:
    """Commands that change with time, brakes and a speed hold."""
    commands = np.zeros(len(times), COMMAND)
    commands["steering"] = 0.05 * np.sin(9.0 * times)
    commands["brake_torque"] = 40.0
    commands["speed_hold_gain"], commands["speed_hold_target"] = 500.0, 20.0
    return commands


def test_a_lag_follows_a_command_that_changes_within_the_step():
    simulation, lag, w = with_actuators(steering_actuator_time_constant=0.05), 0.05, 9.0
    simulation.step(sine, 0.3)
    settled = np.sin(w * 0.3) - w * lag * np.cos(w * 0.3) + w * lag * np.exp(-0.3 / lag)
    found = simulation.acting(Command()).steering
    interpolation = 0.05 * (w * STEP / 2) ** 2 / 8  # of a sine by straight lines: at most
    assert found == pytest.approx(0.05 * settled / (1 + (w * lag) ** 2), abs=interpolation)


WITHOUT_EFFECT = {
    "steering_actuator_time_constant": 0.0,
    "rear_steering_actuator_dead_time": 0.0,
    "brake_torque_actuator_resolution": 0.0,
    "normal_force_actuator_range": 1e6,
}
SWERVE = Command(
    steering=0.04, rear_steering=-0.01, brake_torque=(50.0,) * 4, normal_force=(9.0,) * 4
)


def everything(simulation: Simulation) -> list[bytes]:
    return [each.tobytes() for each in (simulation.state, simulation.outputs, simulation.events)]


def test_actuators_without_effect_change_no_bit():
    plain, other = with_actuators(), with_actuators(**WITHOUT_EFFECT)
    assert (plain.has_actuators, other.has_actuators) == (False, True)
    for command in (SWERVE, sine, Command(), SWERVE):
        for each in (plain, other):
            each.step(command, 0.15)
        assert everything(plain) == everything(other)


def test_without_actuators_a_command_is_what_acts():
    assert with_actuators().acting(SWERVE) is SWERVE


def test_the_torque_of_a_speed_hold_passes_through_as_found_at_each_step():
    hold = Command(steering=0.04, speed_hold_gain=400.0, speed_hold_target=21.0)
    plain, other = with_actuators(), with_actuators(wheel_torque_actuator_time_constant=0.0)
    other.step(hold, 0.2)
    for _ in range(200):
        plain.step(command_at(lambda times: hold.records(), plain.time, plain.state), STEP)
    assert everything(plain) == everything(other)
    assert min(other.acting(hold).wheel_torque[2:]) > 0.0


@pytest.mark.parametrize("command", [SWERVE, sine], ids=["held", "of time"])
def test_it_does_not_matter_how_many_steps_are_made_at_once(command):
    whole, parts = with_actuators(**ACTUATORS), with_actuators(**ACTUATORS)
    whole.step(command, 0.2)
    for steps in (1, 7, 12, 1, 100, 79):
        parts.step(command, steps * STEP)
    assert everything(whole) == everything(parts)


def test_a_snapshot_in_the_middle_of_a_transition_goes_on_to_the_bit():
    simulation = with_actuators(**ACTUATORS)
    simulation.step(SWERVE, 0.02)
    kept = simulation.snapshot()
    simulation.step(Command(), 0.1)
    other = with_actuators(**ACTUATORS)
    other.restore(kept)
    other.step(Command(), 0.1)
    assert everything(other) == everything(simulation)
    unlike = with_actuators(**ACTUATORS | {"wheel_torque_actuator_time_constant": 0.11})
    with pytest.raises(InputError, match="taken from a different simulation"):
        unlike.restore(kept)


def test_a_reset_puts_actuators_at_rest():
    simulation, fresh = with_actuators(**ACTUATORS), with_actuators(**ACTUATORS)
    simulation.step(SWERVE, 0.1)
    simulation.reset(20.0)
    assert simulation.acting(SWERVE) == Command()
    for each in (simulation, fresh):
        each.step(Command(), 0.1)
    assert everything(simulation) == everything(fresh)


@pytest.mark.parametrize(
    ("values", "told"),
    [
        (
            {"steering_actuator_time_constant": 0.1, "steering_actuator_frequency": 3.0},
            "steering_actuator_time_constant: 0.1 together with steering_actuator_frequency 3: "
            "only one of the two may be given",
        ),
        (
            {"brake_torque_actuator_damping": 0.7},
            "brake_torque_actuator_damping: 0.7 is not allowed: no value without a "
            "brake_torque_actuator_frequency",
        ),
        (
            {"rear_steering_actuator_dead_time": 0.0105},
            "rear_steering_actuator_dead_time: 0.0105 is not allowed: a multiple of the step, "
            "0.001 s",
        ),
    ],
)
def test_what_does_not_go_together_is_refused(values, told):
    with pytest.raises(InputError) as refusal:
        with_actuators(**values)
    assert str(refusal.value) == told


def test_every_commanded_value_but_speed_hold_wind_and_road_has_an_actuator():
    sizes = [np.prod(COMMAND[name].shape, dtype=int) for name in QUANTITIES]
    assert sum(sizes) == CHANNELS
    others = {"speed_hold_gain", "speed_hold_target", "wind", "road_height", "road_friction_change"}
    assert {*COMMAND.names} - {*QUANTITIES} == others
