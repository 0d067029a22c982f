"""Every option of `run` has its effect on the rows of the run."""

import re

import numpy as np
import pytest

from vehicle_roll_sim import Options, Simulation, preset
from vehicle_roll_sim.manoeuvres.catalogue import manoeuvre_named
from vehicle_roll_sim.runs.run import run
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.vehicle.vehicle_file import PRESETS

SHORT = ("step_steer", "--duration", "2")
GRAVITY = 9.81
"""m/s^2"""
UNSPRUNG = 4 * 80.0
"""kg: the wheels of the reference vehicle."""
ROUNDING = 1e-12
"""Relative: some hundred operations in double precision."""


def at(rows: dict, time: float, name: str) -> float:
    """A column at a time (s)."""
    return float(np.interp(time, rows["time"], rows[name]))


def weight(rows: dict) -> float:
    """Sum of the tire loads at the start (N)."""
    return sum(rows[f"normal_force_{wheel}"][0] for wheel in ("lf", "rf", "lr", "rr"))


def step_steer():
    return manoeuvre_named("step_steer").for_vehicle(preset(), Options())


@pytest.fixture
def vehicle_file(folder):
    """A vehicle of 1600 kg sprung mass, its tire beside it."""
    (folder / "reference.tir").write_text((PRESETS / "reference.tir").read_text())
    text = (PRESETS / "reference.yaml").read_text()
    text, replaced = re.subn(r"(?m)^sprung_mass:.*$", "sprung_mass: 1600", text)
    assert replaced == 1
    (folder / "heavy.yaml").write_text(text)
    return "heavy.yaml"


@pytest.mark.parametrize("amplitude", [2.0, -6.5])
def test_amplitude_is_the_angle_that_is_held(rows, amplitude):
    assert at(rows(*SHORT, f"--amplitude={amplitude}"), 2.0, "steering") == pytest.approx(
        np.radians(amplitude), rel=ROUNDING
    )


def test_rate_is_the_speed_of_the_steering(rows):
    turning = rows(*SHORT, "--rate", "8")
    assert at(turning, 1.25, "steering") == pytest.approx(np.radians(2.0), rel=ROUNDING)


def test_start_is_when_the_steering_begins(rows):
    turning = rows(*SHORT, "--start", "0.5")
    assert at(turning, 0.5, "steering") == 0.0
    assert at(turning, 0.55, "steering") == pytest.approx(np.radians(2.0), rel=ROUNDING)


def test_speed_is_the_speed_at_entry(rows):
    assert rows(*SHORT, "--speed", "20")["u"][0] == 20.0


def test_duration_is_how_long_is_simulated(rows):
    assert rows("step_steer", "--duration", "0.5")["time"][-1] == 0.5


def test_speed_hold_keeps_the_speed_that_is_lost_without(rows):
    free, held = rows(*SHORT, "--speed-hold", "0"), rows(*SHORT, "--speed-hold", "2000")
    assert held["u"][0] == free["u"][0]
    lost, kept = (run["u"][0] - run["u"][-1] for run in (free, held))
    assert lost > 0.1  # m/s: the drag of the front tires in a second of cornering
    assert abs(kept) < lost / 4


def test_without_a_roll_centre_it_leans_at_least_a_sixth_further(rows):
    steady = [rows("step_steer", *option)["roll"][-50:].mean() for option in ((), NO_CENTRE)]
    assert steady[1] / steady[0] > 1.15  # the source's claim


NO_CENTRE = ("--no-roll-centre",)


@pytest.mark.parametrize(
    ("words", "options"),
    [
        ((), Options()),
        (("--euler-terms",), Options(euler_terms=True)),
        (("--steady-state-slip",), Options(steady_state_slip=True)),
        (("--model", "8dof"), Options(model="8dof")),
        (NO_CENTRE, Options(no_roll_centre=True)),
        (("--euler-terms", *NO_CENTRE), Options(no_roll_centre=True, euler_terms=True)),
    ],
)
def test_options_of_the_model_are_those_of_the_library(rows, words, options):
    history = run(Simulation(preset(), options), manoeuvre_named("j_turn"), 2.0)
    assert rows("j_turn", "--duration", "2", *words)["roll"].tolist() == history["roll"].tolist()


def test_grade_and_bank_are_those_of_the_road_of_the_library(rows):
    simulation = Simulation(preset(), road=Road(grade=0.1, bank=-0.04))
    history = run(simulation, step_steer(), 2.0)
    sloping = rows(*SHORT, "--grade", "0.1", "--bank", "-0.04")
    level = rows(*SHORT)
    for name in ("u", "v", "roll"):
        assert sloping[name].tolist() == history[name].tolist()
        assert sloping[name][-1] != level[name][-1]


def test_road_is_the_file_whose_road_is_driven_and_its_slopes_can_be_overridden(rows, folder):
    crest = {"kind": "wave", "start": 3.0, "length": 4.0, "height": 0.1}
    text = f"grade: 0.05\nbank: 0.02\nfeatures: [{crest}]\n".replace("'", "")
    (folder / "road.yaml").write_text(text)
    road = Road.from_values({"grade": 0.05, "bank": -0.04, "features": [crest]})
    history = run(Simulation(preset(), road=road), step_steer(), 2.0)
    found = rows(*SHORT, "--road", "road.yaml", "--bank", "-0.04")
    for name in ("u", "z", "roll"):
        assert found[name].tolist() == history[name].tolist()


def test_euler_terms_make_a_difference(rows):
    plain, full = rows("j_turn"), rows("j_turn", "--euler-terms")
    assert plain["roll"][250] != full["roll"][250]


def test_vehicle_is_the_file_whose_vehicle_runs(rows, vehicle_file):
    heavy = rows(*SHORT, "--vehicle", vehicle_file)
    assert weight(heavy) == pytest.approx((1600.0 + UNSPRUNG) * GRAVITY, rel=ROUNDING)
    assert weight(rows(*SHORT)) == pytest.approx((1440.0 + UNSPRUNG) * GRAVITY, rel=ROUNDING)


def test_tire_is_the_file_whose_tire_the_vehicle_runs_on(rows, folder):
    text = (PRESETS / "reference.tir").read_text()
    (folder / "ice.tir").write_text(re.sub(r"(?m)^PDY1\s*=.*$", "PDY1 = 0.1", text))
    slippery, reference = rows(*SHORT, "--tire", "ice.tir"), rows(*SHORT)
    assert at(reference, 2.0, "lateral_acceleration") > 4.0
    assert at(slippery, 2.0, "lateral_acceleration") < 0.15 * GRAVITY


def test_set_replaces_values_one_by_one_also_those_of_a_file(rows, vehicle_file):
    changed = rows(*SHORT, "--vehicle", vehicle_file, "--set", "sprung_mass=1500")
    assert weight(changed) == pytest.approx((1500.0 + UNSPRUNG) * GRAVITY, rel=ROUNDING)
    twice = rows(*SHORT, "--set", "cg_height=0.7", "--set", "tire_radius=0.3")
    assert twice["z"][0] == 0.7
    assert twice["wheel_speed_lf"][0] < rows(*SHORT)["wheel_speed_lf"][0]


def test_step_is_the_step_of_the_integration(rows):
    fine, coarse = (rows(*SHORT, "--step", step)["roll"] for step in ("0.0005", "0.002"))
    difference = np.abs(fine - coarse).max()
    assert 0.0 < difference < 1e-6  # rad: fourth order, but for corners of the steering
    history = run(Simulation(preset(), step=0.002), step_steer(), 2.0)
    assert coarse.tolist() == history["roll"].tolist()


def test_sample_is_the_interval_of_the_rows(rows):
    expected = np.append(np.arange(0, 2.0, 0.3), 2.0)
    np.testing.assert_allclose(rows(*SHORT, "--sample", "0.3")["time"], expected, rtol=1e-15)
    assert len(rows(*SHORT)["time"]) == 201  # 10 ms unless told otherwise


def test_command_period_samples_the_steering_and_holds_it(rows):
    held = rows(*SHORT, "--command-period", "0.4", "--rate", "5", "--start", "0")
    for time in np.arange(0.05, 0.8, 0.1):
        expected = np.radians(0.0 if time < 0.4 else 2.0)
        assert at(held, round(time, 2), "steering") == pytest.approx(expected, rel=ROUNDING)


def test_stop_roll_is_the_roll_angle_at_which_it_ends(rows):
    roll = np.degrees(rows("j_turn", "--stop-roll", "30")["roll"])
    assert abs(roll[-1]) >= 30.0 > np.abs(roll[:-1]).max()


def test_commands_are_those_of_the_file_for_as_long_as_it_lasts(rows, folder):
    (folder / "in.csv").write_text("time,steering,wheel_torque_lf\n0,0,0\n0.5,0.05,0\n0.8,0.05,300")
    driven = rows("--commands", "in.csv")
    assert driven["time"][-1] == pytest.approx(0.8, rel=1e-15)
    assert at(driven, 0.25, "steering") == pytest.approx(0.025, rel=ROUNDING)
    assert driven["longitudinal_force_lf"][-1] > driven["longitudinal_force_rf"][-1] + 100.0  # N


def test_brakes_of_a_command_file_stop_the_vehicle_for_good(rows, folder):
    brakes = [f"brake_torque_{wheel}" for wheel in ("lf", "rf", "lr", "rr")]
    (folder / "in.csv").write_text(f"time,{','.join(brakes)}\n0,800,800,500,500\n8,800,800,500,500")
    stopped = rows("--commands", "in.csv", "--speed", "10")
    assert stopped["u"][0] == 10.0
    assert np.abs(stopped["u"][-100:]).max() < 1e-3  # m/s, for a second
    assert (stopped["wheel_speed_lf"][-100:] == 0.0).all()


def test_a_command_file_runs_to_the_end_of_a_step_and_takes_speed_and_duration(rows, folder):
    (folder / "in.csv").write_text("time,steering\n0,0\n0.1234567,0.01")
    assert rows("--commands", "in.csv")["time"][-1] == pytest.approx(0.124, rel=1e-15)
    longer = rows("--commands", "in.csv", "--duration", "1", "--speed", "30")
    assert (longer["u"][0], longer["time"][-1], longer["steering"][-1]) == (30.0, 1.0, 0.01)


@pytest.fixture
def other_tire(folder):
    """A tire file that differs from the reference tire."""
    text = (PRESETS / "reference.tir").read_text()
    (folder / "other.tir").write_text(text.replace("= -14.95", "= -12.0"))
    return "other.tir"


def test_each_axle_may_be_on_a_tire_of_its_own(rows, other_tire):
    plain, both = rows(*SHORT), rows(*SHORT, "--tire", other_tire)
    front, rear = (rows(*SHORT, f"--{axle}-tire", other_tire) for axle in ("front", "rear"))
    named = rows(*SHORT, "--front-tire", other_tire, "--rear-tire", other_tire)
    rates = [at(each, 2.0, "yaw_rate") for each in (front, plain, rear)]
    assert rates == sorted(rates)  # a softer front tire understeers, a softer rear tire oversteers
    assert rates[0] < rates[1] < rates[2]
    assert named["yaw_rate"].tolist() == both["yaw_rate"].tolist()


def test_moments_and_shift_are_printed_and_recorded_and_replayed(command, folder):
    words = ("run", *SHORT, "--contact-patch-shift", "on", "--set", "front_camber=-0.01")
    result = command(*words, "--bag", "bag")
    assert result.value["tire moments"] == "off"
    assert result.value["contact patch shift"].startswith("on, front lateral stiffness")
    replayed = command("replay", "bag", "--strict")
    assert (replayed.status, replayed.err) == (0, "")
    other = command("replay", "bag", "--contact-patch-shift", "off", "--set", "front_camber=-0.01")
    assert other.status == 2
    assert "contact_patch_shift" in other.err
    assert "contact patch shift" not in command("run", *SHORT).value
