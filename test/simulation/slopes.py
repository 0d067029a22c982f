"""Vehicles on slopes with a commanded speed, and the required accuracy."""

import numpy as np

from vehicle_roll_sim import Command, Options, Simulation, preset
from vehicle_roll_sim.live.command_inbox import CommandInbox
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.speed_controller import SpeedController
from vehicle_roll_sim.vehicle.parameters import Vehicle

PERIOD_NS = 10_000_000
SLOPES = (0.0, 0.2, -0.2)
CLOSE = 0.02
"""Relative: the integral part settles in some seconds; seen 0.5 %."""
OVERSHOOT = 0.15
"""Of a step of the target: 1/e^2 = 13.5 % with the double pole and the zero of the control."""


def on_slope(
    grade: float,
    vehicle: Vehicle | None = None,
    options: Options | None = None,
    initial_speed: float = 0.0,
    period_ns: int = PERIOD_NS,
    **limits: float,
) -> Session:
    """A vehicle on a slope, for ever listening; limits: of its speed controller."""
    vehicle = vehicle or preset()
    simulation = Simulation(vehicle, options, road=Road(grade=grade))
    controller = SpeedController(vehicle, **limits)
    return Session(simulation, CommandInbox(timeout=0.0), period_ns, initial_speed, controller)


def drive(session: Session, speed: float, seconds: float) -> list[Command]:
    """Command a speed (m/s) for some time; the commands that were applied."""
    session.inbox.receive("speed_cmd", [speed], session.simulation.time_ns)
    applied = []
    for _ in range(round(seconds * 1e9 / session.period_ns)):
        session.run_period()
        applied.append(session.applied)
    return applied


def watch(session: Session, speed: float, seconds: float) -> tuple[np.ndarray, np.ndarray]:
    """Command a speed (m/s) for some time; position (m) and speed after every period."""
    rows = []
    for _ in range(round(seconds * 1e9 / session.period_ns)):
        drive(session, speed, session.period_ns / 1e9)
        rows.append((session.simulation.state.x, session.simulation.state.u))
    return np.array(rows).T
