"""Where the energy of a stop goes: nothing is gained or lost but to dampers, slip, brakes, torques.

In the model that is exact mechanics: no roll centre, Euler terms. Powers are integrated over the
run by the trapezoidal rule.
"""

import numpy as np
import pytest
from programmes import Run, record_run
from random_states import attitude, strut_lengths, wheel_centres, wheel_positions

from vehicle_roll_sim import Options, Simulation
from vehicle_roll_sim.model.records import COMMAND
from vehicle_roll_sim.simulation.road import Road

G = 9.81
EXACT = Options(no_roll_centre=True, euler_terms=True)
STEP, END = 1e-3, 6.0
"""s"""
SHARE = 1e-6
"""Of the kinetic energy at the start; seen 3e-8."""
SECOND_ORDER = 4.0
"""Error of the rule with one step over that with half of it."""


def stop(times: np.ndarray) -> np.ndarray:
    """Some drive, then brakes, on a bend; the vehicle stands after some 5 s."""
    commands = np.zeros(len(times), COMMAND)
    commands["steering"] = 0.03 * np.sin(times)
    commands["wheel_torque"] = np.interp(times, [0.2, 0.4, 0.8, 1.0], [0, 100, 100, 0])[:, None]
    brakes = np.interp(times, [1.0, 1.2], [0.0, 700.0])[:, None]
    commands["brake_torque"] = brakes * [1.0, 1.0, 0.6, 0.6]
    return commands


def unsprung(vehicle, state) -> np.ndarray:
    """Velocities of the wheel centres along the body's axes (m/s), a row each."""
    x, y = wheel_positions(vehicle).T
    lengths = strut_lengths(vehicle, state["suspension_compression"])
    wx, wy, wz = (state[name] for name in ("roll_rate", "pitch_rate", "yaw_rate"))
    along = state["u"] - y * wz - lengths * wy
    across = state["v"] + x * wz + lengths * wx
    return np.column_stack([along, across, state["unsprung_velocity"]])


def energy(vehicle, road: Road, state) -> float:
    """Kinetic, potential and elastic energy (J)."""
    down, along, across = road.gravity(G)
    gravity = np.array([along, across, -down])
    masses = vehicle.per_wheel("unsprung_mass")
    body = np.array([state["x"], state["y"], state["z"]])
    velocity = np.array([state["u"], state["v"], state["w"]])
    rates = np.array([state["roll_rate"], state["pitch_rate"], state["yaw_rate"]])
    inertia = np.array([vehicle.roll_inertia, vehicle.pitch_inertia, vehicle.yaw_inertia])
    total = vehicle.sprung_mass * velocity @ velocity / 2 + inertia @ rates**2 / 2
    total += masses @ (unsprung(vehicle, state) ** 2).sum(axis=1) / 2
    total += vehicle.wheel_inertia * (state["wheel_speed"] ** 2).sum() / 2
    total -= vehicle.sprung_mass * gravity @ body
    total -= masses @ (wheel_centres(vehicle, state) @ gravity)
    springs = vehicle.per_wheel("spring_stiffness")
    tires = vehicle.per_wheel("tire_stiffness")
    total += springs @ state["suspension_compression"] ** 2 / 2
    return total + tires @ np.maximum(state["tire_compression"], 0.0) ** 2 / 2


def powers(vehicle, state, outputs, command) -> dict[str, float]:
    """What dampers, tires, brakes and drive torques bring in (W), all but the last by losing it.

    The tire's share is that of its force at the contact point, less what goes into its spin and
    into the compression of its spring.
    """
    rotation = attitude(state["roll"], state["pitch"], state["yaw"])
    yawed = attitude(0.0, 0.0, state["yaw"])
    radius, spin = outputs["loaded_radius"], state["wheel_speed"]
    centres = unsprung(vehicle, state)
    turning = np.column_stack(
        [-state["pitch_rate"] * radius, state["roll_rate"] * radius, 0 * radius]
    )
    contact = (centres + turning) @ rotation.T @ yawed  # along the axes of frame 2
    names = ("longitudinal_force", "lateral_force", "normal_force")
    forces = np.column_stack([outputs[name] for name in names])
    rise = (centres @ rotation.T)[:, 2]
    tires = (forces * contact).sum() - outputs["normal_force"] @ rise
    drive = command["wheel_torque"] @ spin
    return {
        "dampers": -vehicle.per_wheel("damping") @ outputs["suspension_rate"] ** 2,
        "slip": tires - (radius * outputs["tire_longitudinal"]) @ spin,
        "brakes": -command["brake_torque"] @ np.abs(spin),
        "torques": drive,
    }


def audit(vehicle, road: Road, step: float) -> tuple[Run, float, dict[str, float]]:
    """A stop; the energy that is unaccounted for (J), and the work of everything (J)."""
    simulation = Simulation(vehicle, EXACT, step=step, road=road)
    run = record_run(simulation, stop, END)
    samples = [
        powers(vehicle, state, outputs, command)
        for state, outputs, command in zip(run.state, run.outputs, stop(run.time), strict=True)
    ]
    work = {name: float(np.trapezoid([s[name] for s in samples], run.time)) for name in samples[0]}
    gained = energy(vehicle, road, run.state[-1]) - energy(vehicle, road, run.state[0])
    return run, gained - sum(work.values()), work


@pytest.mark.parametrize("road", [Road(), Road(grade=0.05, bank=-0.03)], ids=["flat", "slope"])
def test_energy_changes_by_the_work_of_dampers_slip_brakes_and_torques(vehicle, road):
    run, missing, work = audit(vehicle, road, STEP)
    kinetic = vehicle.sprung_mass * run.state["u"][0] ** 2 / 2
    assert (run.state["wheel_speed"][-1] == 0.0).all()  # it has stopped
    assert all(work[name] < 0.0 for name in ("dampers", "slip", "brakes"))
    assert work["torques"] > 0.0
    assert -work["brakes"] > 0.5 * kinetic
    assert abs(missing) < SHARE * kinetic


def test_what_is_unaccounted_for_is_the_error_of_the_rule(reference):
    coarse, fine = (abs(audit(reference, Road(), step)[1]) for step in (2 * STEP, STEP))
    assert coarse / fine == pytest.approx(SECOND_ORDER, rel=0.1)
