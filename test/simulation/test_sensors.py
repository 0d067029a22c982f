"""Sensors against closed forms: noise, walks, delays, dropouts, resolution, place and attitude."""

import math

import numpy as np
import pytest
from measured import SENSORS, measured
from scipy.spatial.transform import Rotation

from vehicle_roll_sim import Command, InputError, Options, Simulation, preset
from vehicle_roll_sim.model.records import OUTPUTS, STATE
from vehicle_roll_sim.simulation.sensors import Sensors
from vehicle_roll_sim.vehicle.derived_values import GRAVITY
from vehicle_roll_sim.vehicle.sensor_parameters import DEVICES, OF_DEVICE, QUANTITIES

STEP_NS = 1_000_000
PERIOD_NS = 10_000_000
INTERVAL = 0.01
"""s: default period."""
ROUNDING = 1e-12
"""Of a few operations on numbers of about 10."""
TURN = Command(steering=0.04)
DEVIATIONS = 4.5
"""Standard deviations that a statistic may be off: chance exceeds it once in 150 000 times. The
seeds are fixed, so that a test passes always or never."""


def body(**fields) -> tuple[np.record, np.record]:
    """STATE and OUTPUTS records, 0 but for these fields."""
    state, outputs = np.zeros(1, STATE), np.zeros(1, OUTPUTS)
    for name, value in fields.items():
        record = state if name in STATE.names else outputs
        record[name] = value
    return state[0], outputs[0]


def sensors(**values: float) -> Sensors:
    found = Sensors(preset().with_values(values), STEP_NS, None)
    found.rest()
    return found


def readings(given: Sensors, quantity: str, count: int, truth=None) -> np.ndarray:
    """Readings in the first periods, of a body at rest or of `truth(number of the sample)`."""
    found = []
    for number in range(count):
        parts = body() if truth is None else truth(number)
        given.sample(number * PERIOD_NS, *parts)
        found.append(given[quantity])
    return np.array(found)


def allan_variance(values: np.ndarray, size: int) -> np.ndarray:
    """Of each column: half the mean square of the differences of means of `size` values."""
    count = len(values) // size
    means = values[: count * size].reshape(count, size, -1).mean(axis=1)
    return (np.diff(means, axis=0) ** 2).mean(axis=0) / 2


SAMPLES = 8192
"""82 s."""


@pytest.mark.parametrize("size", [1, 4, 16, 64])
@pytest.mark.parametrize("kind", ["noise", "walk"])
def test_noise_and_walk_have_their_allan_variances(kind, size, at_rest):
    """Noise of density N: N^2 / t. A walk of K: K^2 T (2 m^2 + 1) / (6 m) with m samples of period
    T in a mean of duration t, which tends to K^2 t / 3.

    The estimate from n means has a relative deviation of sqrt(3 / n) for noise, less for fewer
    dependent differences; a walk's differences are correlated, by a quarter with their neighbours:
    sqrt(2.25 / n). There are three axes.
    """
    density, walk = 0.02, 0.05
    found = allan_variance(at_rest[kind], size).mean()
    if kind == "noise":
        expected = density**2 / (size * INTERVAL)
    else:
        expected = walk**2 * INTERVAL * (2 * size**2 + 1) / (6 * size)
    apart = DEVIATIONS * math.sqrt(3 / (3 * SAMPLES / size))
    assert found == pytest.approx(expected, rel=apart)


@pytest.fixture(scope="module")
def at_rest():
    """Noise of an accelerometer and the walk of a gyro, of a body at rest."""
    given = sensors(accelerometer_noise_density=0.02, gyro_bias_walk=0.05, sensor_seed=3)
    found = []
    parts = body()
    for number in range(SAMPLES):
        given.sample(number * PERIOD_NS, *parts)
        found.append(given.readings())
    found = np.array(found)
    return {"noise": found[:, :3], "walk": found[:, 3:6]}


def test_noise_is_gaussian_and_independent(at_rest):
    """Moments of n standard normal numbers deviate by sqrt(1 / n), sqrt(2 / n), sqrt(96 / n)."""
    values = at_rest["noise"].ravel() / (0.02 / math.sqrt(INTERVAL))
    count = len(values)
    assert abs(values.mean()) < DEVIATIONS * math.sqrt(1 / count)
    assert abs(values.var() - 1) < DEVIATIONS * math.sqrt(2 / count)
    assert abs((values**4).mean() - 3) < DEVIATIONS * math.sqrt(96 / count)
    steps = np.diff(at_rest["walk"], axis=0)
    axes = np.corrcoef(np.hstack((at_rest["noise"][1:], steps)).T)
    assert np.abs(axes - np.eye(6)).max() < DEVIATIONS / math.sqrt(SAMPLES)
    later = np.corrcoef(values[3:], values[:-3])[0, 1]
    assert abs(later) < DEVIATIONS / math.sqrt(count)


def test_a_walk_begins_at_zero(at_rest):
    assert at_rest["walk"][0].tolist() == [0.0, 0.0, 0.0]


@pytest.mark.parametrize("number", [0, 1, 63, 64, 200])
def test_the_random_numbers_are_those_of_the_seed_the_device_and_the_sample(number):
    """Box and Muller's of numpy's own Philox, whichever samples were taken before."""
    given = sensors(wheel_speed_sensor_noise_density=0.1, imu_period=0.01, sensor_seed=2**53)
    given.sample(number * PERIOD_NS, *body())
    steps = 3  # of four words: for 4 pairs and a dropout
    key = np.array([2**53, list(DEVICES).index("wheel_speed_sensor")], np.uint64)
    counter = np.array([number * steps, 0, 0, 0], np.uint64)
    words = np.random.Philox(key=key, counter=counter).random_raw(8)
    a, b = (((words >> np.uint64(12)) + 0.5) / 2.0**52).reshape(4, 2).T
    expected = np.sqrt(-2 * np.log(a)) * np.cos(2 * np.pi * b)
    np.testing.assert_allclose(given["wheel_speed"], expected, rtol=0, atol=1e-13)


def test_another_seed_gives_other_noise_and_another_sensor_changes_none():
    noise = {"gyro_noise_density": 0.01}
    one, other = (readings(sensors(**noise, sensor_seed=s), "gyro", 5) for s in (1, 2))
    assert (one != other).all()
    more = sensors(**noise, sensor_seed=1, accelerometer_noise_density=1.0, odom_period=0.01)
    assert (readings(more, "gyro", 5) == one).all()
    unsaid = readings(sensors(**noise), "gyro", 5)
    assert (unsaid == readings(sensors(**noise, sensor_seed=0), "gyro", 5)).all()


def ramp(number: int):
    """A wheel that turns faster with every sample."""
    return body(wheel_speed=np.array([1.0, 2.0, 3.0, 4.0]) + number)


def test_a_delay_shifts_readings_by_whole_samples():
    noise = {"wheel_speed_sensor_noise_density": 0.1, "wheel_speed_sensor_resolution": 0.01}
    direct = readings(sensors(**noise), "wheel_speed", 40, ramp)
    late = sensors(**noise, wheel_speed_sensor_delay=0.17)
    found = readings(late, "wheel_speed", 40, ramp)
    assert (found[17:] == direct[:-17]).all()
    assert (found[:17] == direct[0]).all()
    assert late.devices["wheel_speed_sensor"].arrived_ns == 39 * PERIOD_NS


@pytest.mark.parametrize("share", [0.0, 0.25, 1.0])
def test_that_share_of_the_samples_does_not_arrive_and_the_last_reading_stays(share):
    count = 2000
    given = sensors(wheel_speed_sensor_dropout=share, sensor_seed=5)
    found = readings(given, "wheel_speed", count, ramp)[:, 0] - 1.0
    arrived = found == np.arange(count)
    assert (found == np.maximum.accumulate(np.where(arrived, np.arange(count), 0))).all()
    deviation = math.sqrt(count * share * (1 - share))  # binomial; the first sample arrives
    assert abs(np.sum(~arrived[1:]) - share * (count - 1)) <= DEVIATIONS * deviation


def test_readings_are_multiples_of_the_resolution():
    resolution = 0.003
    given = sensors(steering_sensor_resolution=resolution)
    angles = np.random.default_rng(1).uniform(-0.5, 0.5, (500, 4))
    found = readings(given, "steering", 500, lambda number: body(steering=angles[number]))
    assert np.abs(found / resolution - np.round(found / resolution)).max() < ROUNDING / resolution
    assert np.abs(found - angles).max() <= resolution / 2 + ROUNDING
    variance = np.var(found - angles)  # of a uniform error, and its deviation from 2000 values
    assert given.variance("steering") == pytest.approx(resolution**2 / 12)
    assert variance == pytest.approx(resolution**2 / 12, rel=DEVIATIONS * math.sqrt(0.8 / 2000))


def test_the_variance_is_that_of_the_noise_of_a_sample():
    given = sensors(odom_velocity_noise_density=0.2, odom_rate_resolution=0.06, odom_period=0.04)
    assert given.variance("odom_velocity") == pytest.approx(0.2**2 / 0.04)
    assert given.variance("odom_rate") == pytest.approx(0.06**2 / 12)
    assert given.variance("odom_orientation") == 0.0


def test_scale_and_bias_are_those_of_the_axis():
    errors = {"gyro_scale_error": 0.1, "gyro_bias_y": 0.25, "accelerometer_bias_x": -0.5}
    given = sensors(**errors, wheel_speed_sensor_bias=2.0, wheel_speed_sensor_scale_error=-0.5)
    state = {"roll_rate": 1.0, "pitch_rate": 2.0, "yaw_rate": 3.0, "wheel_speed": [4.0] * 4}
    given.sample(0, *body(**state, specific_force=[0.0, 0.0, 9.8]))
    np.testing.assert_allclose(given["gyro"], [1.1, 2.45, 3.3], rtol=0, atol=ROUNDING)
    assert given["accelerometer"].tolist() == [-0.5, 0.0, 9.8]
    assert given["wheel_speed"].tolist() == [4.0] * 4


def test_the_imu_reads_along_its_own_axes():
    """By another library: the attitude that is said, then the misalignment about its axes."""
    said, apart = [0.3, -0.2, 2.0], [0.01, 0.02, -0.03]
    values = dict(zip(("imu_roll", "imu_pitch", "imu_yaw"), said, strict=True))
    values |= {
        f"imu_misalignment_{n}": a for n, a in zip(("roll", "pitch", "yaw"), apart, strict=True)
    }
    given = sensors(**values)
    rates, force, attitude = [0.4, -0.5, 0.6], [1.0, 2.0, 9.0], [0.1, 0.2, -0.7]
    named = zip(("roll_rate", "pitch_rate", "yaw_rate"), rates, strict=True)
    angles = zip(("roll", "pitch", "yaw"), attitude, strict=True)
    given.sample(0, *body(**dict(named), **dict(angles), specific_force=force))
    mounting = Rotation.from_euler("ZYX", said[::-1]) * Rotation.from_euler("ZYX", apart[::-1])
    near(given["gyro"], mounting.inv().apply(rates))
    near(given["accelerometer"], mounting.inv().apply(force))
    orientation = Rotation.from_euler("ZYX", attitude[::-1]) * mounting
    turn = Rotation.from_quat(given["imu_orientation"]).inv() * orientation
    assert turn.magnitude() < 1e-7  # rad: the angle of a product of unit quaternions


def near(found: np.ndarray, expected: np.ndarray, tolerance: float = ROUNDING) -> None:
    np.testing.assert_allclose(found, expected, rtol=0, atol=tolerance)


def test_a_turning_body_pulls_at_a_place_off_its_centre():
    """Closed form: r w^2 towards the axis, and the angular acceleration times r across it."""
    given = sensors(imu_x=2.0, imu_z=0.5)
    fields = {"yaw_rate": 3.0, "body_acceleration": [0.0, 0.0, 0.0, 0.0, 0.0, 4.0]}
    given.sample(0, *body(**fields, specific_force=[0.0, 0.0, 9.81]))
    near(given["accelerometer"], [-2.0 * 9.0, 2.0 * 4.0, 9.81])


@pytest.mark.parametrize("model", ["1", "2"])
def test_the_specific_force_is_the_acceleration_of_the_place_less_gravity(model):
    """From the path of the place by second differences, in a turn with roll and pitch."""
    place = np.array([1.2, 0.7, -0.4])
    values = dict(zip(("imu_x", "imu_y", "imu_z"), place, strict=True))
    step = 0.001
    car = preset("reference").with_values(values | {"imu_period": step})
    simulation = Simulation(car, Options(model=model, euler_terms=model == "1"), step=step)
    simulation.reset(20.0)
    paths, felt, turns = [], [], []
    for number in range(300):
        state = simulation.state
        turn = Rotation.from_euler("ZYX", [state.yaw, state.pitch, state.roll])
        paths.append(np.array([state.x, state.y, state.z]) + turn.apply(place))
        felt.append(simulation.sensors["accelerometer"])
        turns.append(turn)
        smooth = 0.08 * math.sin(0.01 * number) ** 2
        simulation.step(Command(steering=smooth, wheel_torque=(0.0, 0.0, 100.0, 100.0)), step)
    paths = np.array(paths)
    accelerations = (paths[2:] - 2 * paths[1:-1] + paths[:-2]) / step**2
    upward = np.array([0.0, 0.0, GRAVITY])
    expected = [turn.inv().apply(a + upward) for turn, a in zip(turns[1:-1], accelerations)]  # noqa: B905
    # A second difference of 1e-16 times 20 m errs by 1e-9; that of a jerk's slope by some 1e-3.
    found = np.array(felt[1:-1])
    near(found[150:], np.array(expected)[150:], 0.02)
    at_cg = simulation.outputs.specific_force
    assert np.abs(found[-1] - at_cg).max() > 0.2  # m/s^2: the place matters


def test_in_the_8_dof_model_the_imu_does_not_pitch_and_reads_numbers():
    simulation = Simulation(measured(), Options(model="8dof"))
    simulation.step(TURN, 0.5)
    for quantity in ("accelerometer", "gyro", "imu_orientation", "wheel_speed", "steering"):
        assert np.isfinite(simulation.sensors[quantity]).all()
    exact = Simulation(preset().with_values({"imu_period": 0.01}), Options(model="8dof"))
    exact.step(TURN, 0.5)
    assert exact.sensors["gyro"][1] == 0.0
    assert (exact.sensors["accelerometer"] == exact.outputs.specific_force).all()


WRONG = {
    "imu_period": (0.0015, "imu_period: 0.0015 .* a multiple of the step, 0.001 s"),
    "odom_delay": (0.013, "odom_delay: 0.013 .* a multiple of odom_period, 0.01 s"),
    "wheel_speed_sensor_dropout": (1.1, "from 0 to 1"),
    "gyro_noise_density": (-0.1, "from 0 to 100"),
    "accelerometer_bias_walk": (math.nan, "a number from 0"),
    "sensor_seed": (0.5, "a whole number"),
    "steering_sensor_scale_error": (math.inf, "from -1 to 1"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_makes_no_sense_is_refused_in_one_line(name):
    value, message = WRONG[name]
    others = {"imu_period": 0.01} if name == "sensor_seed" else {}
    with pytest.raises(InputError, match=message) as refusal:
        Simulation(preset().with_values(others | {name: value}))
    assert "\n" not in str(refusal.value)


def test_a_seed_without_sensors_is_refused():
    with pytest.raises(InputError, match="no value without a sensor"):
        preset().with_values({"sensor_seed": 1})


def test_every_parameter_belongs_to_a_device_and_every_quantity_is_measured():
    assert {name for names in OF_DEVICE.values() for name in names} >= SENSORS.keys() - {
        "sensor_seed"
    }
    assert all(quantity in Simulation(measured()).sensors for quantity in QUANTITIES)
