"""The 8 DOF model: its equations written out as residuals, and its general properties."""

import functools
from types import SimpleNamespace

import magic_formula
import numpy as np
import pytest
from programmes import Evaluation, j_turn, record_run
from random_states import random_command, random_state
from test_mirror import FORCE, OTHER_SIDE, REVERSED_STATES, SHARE_OF_PEAK, TORQUE, share_of_peak
from tire_springs import tire_compressions, tire_slopes

from vehicle_roll_sim import LF, LR, Command, Condition, Options, Simulation
from vehicle_roll_sim.model.records import EIGHT_DOF_STATES, MODEL_STATE, SLIP_STATES

MODELS = ("8dof", "8dof-rigid-tires")
G = 9.81
STATES = 100
RELATIVE = 1e-9
"""Of the largest term: the accelerations agree to 1e-12, which the tires' longitudinal stiffness of
some 1e5 N per unit of slip carries into the forces; seen 3e-11."""
MIRRORED = {
    **dict.fromkeys((*EIGHT_DOF_STATES, *SLIP_STATES), False),
    **dict.fromkeys(REVERSED_STATES, True),
}
FOURTH_ORDER, ORDER_TOLERANCE = 16, 4
"""Ratio of the errors with a step and half the step, and its tolerance."""


def symbols(vehicle, model: str) -> SimpleNamespace:
    """The parameters of equations 77-87 under the names in the paper."""
    v = vehicle
    p = SimpleNamespace(m=v.sprung_mass, Jx=v.roll_inertia, h=v.cg_height)
    p.a, p.b = v.cg_to_front_axle, v.cg_to_rear_axle
    p.cf, p.cr = v.front_track, v.rear_track
    p.Muf, p.Mur = 2 * v.front_unsprung_mass, 2 * v.rear_unsprung_mass
    p.mt = p.m + p.Muf + p.Mur
    p.hrcf, p.hrcr = v.front_roll_centre_depth, v.rear_roll_centre_depth
    p.hrc = (p.hrcf * p.b + p.hrcr * p.a) / (p.a + p.b)  # (81)
    p.Jz = v.yaw_inertia + p.Muf * (p.a**2 + p.cf**2 / 4) + p.Mur * (p.b**2 + p.cr**2 / 4)
    p.sf = p.m * G * p.b / (2 * (p.a + p.b)) + p.Muf * G / 2
    p.sr = p.m * G * p.a / (2 * (p.a + p.b)) + p.Mur * G / 2
    p.r0, p.compressed = v.tire_radius, functools.partial(tire_compressions, v)
    xti = p.compressed(np.array([p.sf, p.sf, p.sr, p.sr]))
    p.huf, p.hur = p.r0 - xti[[LF, LR]]
    ktf, ktr = tire_slopes(v, xti)[[LF, LR]]
    share_f = ktf / (v.front_spring_stiffness + ktf)
    share_r = ktr / (v.rear_spring_stiffness + ktr)
    p.share = (1.0, 1.0) if model == "8dof-rigid-tires" else (share_f, share_r)
    p.kf = 0.5 * p.cf**2 * v.front_spring_stiffness * p.share[0]
    p.kr = 0.5 * p.cr**2 * v.rear_spring_stiffness * p.share[1]
    p.bf = 0.5 * p.cf**2 * v.front_damping * p.share[0] ** 2
    p.br = 0.5 * p.cr**2 * v.rear_damping * p.share[1] ** 2
    return p


def loads(p, state, ax, ay, moments) -> np.ndarray:
    """Equations 84-87; moments: the active roll moment of each axle."""
    lx = (p.m * p.h + p.Muf * p.huf + p.Mur * p.hur) * ax / (2 * (p.a + p.b))
    roll, rate = state["roll"], state["roll_rate"]
    front = (p.Muf * p.huf / p.cf + p.m * p.b * (p.h - p.hrcf) / (p.cf * (p.a + p.b))) * ay
    front += (p.kf * roll + p.bf * rate - moments[0]) / p.cf
    rear = (p.Mur * p.hur / p.cr + p.m * p.a * (p.h - p.hrcr) / (p.cr * (p.a + p.b))) * ay
    rear += (p.kr * roll + p.br * rate - moments[1]) / p.cr
    return np.maximum([p.sf - front - lx, p.sf + front - lx, p.sr - rear + lx, p.sr + rear + lx], 0)


def forces(p, tire, state, command, fz) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Fxt, Fxg and Fyg of every wheel (3-6, 82, 83)."""
    x, y = np.array([p.a, p.a, -p.b, -p.b]), np.array([p.cf, -p.cf, p.cr, -p.cr]) / 2
    ug, vg = state["u"] - y * state["yaw_rate"], state["v"] + x * state["yaw_rate"]
    delta = np.repeat([command["steering"], command["rear_steering"]], 2)
    s, c = np.sin(delta), np.cos(delta)
    rolling = ug * c + vg * s
    radius = p.r0 - p.compressed(fz)
    kappa = (radius * state["wheel_speed"] - rolling) / np.abs(rolling)
    alpha = np.arctan2(vg * c - ug * s, np.abs(rolling))
    fxt, fyt = np.where(fz > 0, magic_formula.combined(tire, kappa, alpha, fz), 0.0)
    return radius * fxt, fxt * c - fyt * s, fyt * c + fxt * s


def residuals(p, tire, state, command, rates) -> dict[str, tuple]:
    """Both sides of 77-80 and of the wheels' spin at the rates of the model."""
    u, v, wx, wz = (state[name] for name in ("u", "v", "roll_rate", "yaw_rate"))
    ax, ay = rates["u"] - wz * v, rates["v"] + wz * u
    active = np.repeat(p.share, 2) * command["normal_force"]
    moments = (active[0] - active[1]) * p.cf / 2, (active[2] - active[3]) * p.cr / 2
    braking, fx, fy = forces(p, tire, state, command, loads(p, state, ax, ay, moments))
    moment = (fy[0] + fy[1]) * p.a - (fy[2] + fy[3]) * p.b
    moment += (fx[1] - fx[0]) * p.cf / 2 + (fx[3] - fx[2]) * p.cr / 2
    offset = p.Mur * p.b - p.Muf * p.a
    rolling = p.m * G * p.hrc * state["roll"] - (p.kf + p.kr) * state["roll"]
    rolling += -(p.bf + p.br) * wx + p.hrc * p.m * ay + sum(moments)
    return {
        "77": (p.mt * ax, fx.sum() - offset * wz**2 - 2 * p.hrc * p.m * wz * wx),
        "78": (p.mt * ay, fy.sum() + offset * rates["yaw_rate"] + p.hrc * p.m * rates["roll_rate"]),
        "79": (p.Jz * rates["yaw_rate"], moment + offset * ay),
        "80": ((p.Jx + p.m * p.hrc**2) * rates["roll_rate"], rolling),
        "spin": (rates["wheel_speed"], command["wheel_torque"] - braking),
    }


@pytest.mark.parametrize("model", MODELS)
def test_its_rates_solve_the_equations_written_out(vehicle, model):
    p, tire = symbols(vehicle, model), vehicle.tire.coefficients
    evaluation = Evaluation(vehicle, Options(model=model, steady_state_slip=True))
    rng = np.random.default_rng(8)
    for _ in range(STATES):
        state, command = random_state(vehicle, rng), random_command(rng)
        state["roll"] *= 0.3  # 20 degrees
        rates = evaluation.rates(state, command)
        sides = residuals(p, tire, state, command, rates)
        sides["spin"] = (vehicle.wheel_inertia * sides["spin"][0], sides["spin"][1])
        for number, (left, right) in sides.items():
            largest = np.abs([left, right]).max() + p.mt
            assert np.abs(left - right).max() < RELATIVE * largest, number
        assert rates["roll"] == state["roll_rate"]
        assert rates["yaw"] == state["yaw_rate"]
        across = state["u"] * np.sin(state["yaw"]) + state["v"] * np.cos(state["yaw"])
        assert rates["y"] == pytest.approx(across)


@pytest.mark.parametrize("steady", [False, True])
@pytest.mark.parametrize("model", MODELS)
def test_what_it_has_no_state_for_is_nan_from_the_start_to_the_end(reference, model, steady):
    simulation = Simulation(reference, Options(model=model, steady_state_slip=steady))
    run = record_run(simulation, j_turn(), 1.5)
    has = EIGHT_DOF_STATES if steady else (*EIGHT_DOF_STATES, *SLIP_STATES)
    for name in (*MODEL_STATE.names, *SLIP_STATES):
        values = run.state[name]
        assert np.isfinite(values).all() if name in has else np.isnan(values).all()
    for name in ("strut_length", "suspension_rate", "tire_tilt", "link_load_transfer"):
        assert np.isnan(run.outputs[name]).all(), name
    assert simulation.condition is Condition.RUNNING


def test_its_states_come_in_the_order_of_its_equations(reference):
    simulation = Simulation(reference, Options(model="8dof"))
    wheels = ("wheel_speed", "longitudinal_slip", "lateral_slip")
    of_wheels = [f"{name}_{wheel}" for name in wheels for wheel in ("lf", "rf", "lr", "rr")]
    names = ("x", "y", "yaw", "roll", "u", "v", "yaw_rate", "roll_rate", *of_wheels)
    assert simulation.state_names == names
    steady = Simulation(reference, Options(model="8dof", steady_state_slip=True))
    assert steady.state_names == names[:12]
    simulation.step(Command(steering=0.05), 0.5)
    values = dict(zip(names, simulation.model_state, strict=True))
    assert values["roll"] == simulation.state.roll > 0.0
    assert values["wheel_speed_rr"] == simulation.state.wheel_speed[3]


def test_at_rest_it_carries_what_model_1_carries_and_stays_so(vehicle):
    rolling, full = Simulation(vehicle, Options(model="8dof")), Simulation(vehicle)
    start = rolling.model_state
    np.testing.assert_allclose(rolling.outputs.normal_force, full.outputs.normal_force, rtol=1e-12)
    rolling.step(Command(), 10.0)
    drift = np.abs(rolling.model_state - start)[1:]  # all but x
    assert drift.max() < 1e-9  # rounding of 10,000 steps, a hundred times over


def test_a_pair_of_active_forces_rolls_it_as_it_rolls_model_1(reference):
    """Steady state: moment / (roll stiffness - m g hrc), and equal loads in both models."""
    pair = Command(normal_force=(500.0, -500.0, 300.0, -300.0))
    both = [Simulation(reference, Options(model=model)) for model in ("8dof", "1")]
    for simulation in both:
        simulation.step(pair, 4.0)  # the roll has settled to 1e-6 of it
    p = symbols(reference, "8dof")
    moment = p.share[0] * 500.0 * p.cf + p.share[1] * 300.0 * p.cr
    expected = moment / (p.kf + p.kr - p.m * G * p.hrc)
    rolls = [simulation.state.roll for simulation in both]
    assert rolls[0] == pytest.approx(expected, rel=1e-3)  # unequal loads steer a little
    assert rolls[0] == pytest.approx(rolls[1], rel=0.08)  # model 1 has no weight moment on tires
    loads_of_both = [simulation.outputs.normal_force for simulation in both]
    np.testing.assert_allclose(*loads_of_both, rtol=0.02)


def test_active_forces_that_only_lift_do_nothing(reference):
    lifted = Simulation(reference, Options(model="8dof"))
    left_alone = Simulation(reference, Options(model="8dof"))
    for simulation, force in ((lifted, 400.0), (left_alone, 0.0)):
        simulation.step(Command(steering=0.05, normal_force=(force,) * 4), 1.0)
    np.testing.assert_allclose(lifted.model_state, left_alone.model_state, rtol=1e-12)


def test_mirrored_commands_give_mirrored_motion(vehicle):
    runs = []
    for side in (1.0, -1.0):
        wheels = slice(None) if side > 0 else OTHER_SIDE

        def turn(times, side=side, wheels=wheels):
            commands = j_turn(wheel_torque=TORQUE[wheels], normal_force=FORCE[wheels])(times)
            commands["steering"] *= side
            return commands

        runs.append(record_run(Simulation(vehicle, Options(model="8dof")), turn, 2.0))
    left, right = runs
    assert left.outputs["normal_force"].min() == 0.0
    for name in MIRRORED:
        share = share_of_peak(left.state[name], right.state[name], MIRRORED[name])
        assert share < SHARE_OF_PEAK, name


def test_halving_the_step_divides_the_error_by_sixteen(vehicle):
    def slalom(times):
        commands = j_turn()(times)
        commands["steering"] = np.radians(2.0) * np.sin(2 * np.pi * 2.0 * times)
        return commands

    ends = []
    for step in (1e-3, 0.5e-3, 0.25e-3):  # s
        simulation = Simulation(vehicle, Options(model="8dof"), step=step)
        simulation.step(slalom, 1.0)
        ends.append(simulation.model_state[3:])
    ratio = np.abs(ends[0] - ends[1]).max() / np.abs(ends[1] - ends[2]).max()
    assert abs(ratio - FOURTH_ORDER) < ORDER_TOLERANCE


def test_where_loads_and_accelerations_find_no_agreement_it_says_diverged(reference):
    """With a steering angle of nan, no loads satisfy the equations."""
    simulation = Simulation(reference, Options(model="8dof"))
    before = simulation.model_state
    nowhere = Command(steering=0.1).records()
    nowhere["steering"] = np.nan
    assert simulation.step(lambda times: nowhere, 0.001) is Condition.DIVERGED
    assert np.isfinite(simulation.model_state).all()
    assert simulation.model_state[4:] == pytest.approx(before[4:])
