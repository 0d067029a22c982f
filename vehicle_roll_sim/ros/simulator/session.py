"""The session of a simulator, made from its parameters."""

from vehicle_roll_sim.live.command_inbox import CommandInbox
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.ros.simulator.parameters import Declared
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.simulation.speed_controller import SpeedController
from vehicle_roll_sim.vehicle.parameters import Vehicle


def session_of(
    declared: Declared, vehicle: Vehicle, speed: float, road: Road | None = None
) -> Session:
    """The session that the parameters describe, with a vehicle that begins at a speed (m/s).

    road: by default that of the parameters.
    """
    settings = declared.settings
    simulation = Simulation(
        vehicle,
        declared.options,
        step=settings.step,
        rollover_angle=settings.rollover_angle,
        road=road or declared.road,
    )
    inbox = CommandInbox(
        settings.command_timeout, settings.steering_timeout_policy, declared.limits
    )
    controller = SpeedController(vehicle, settings.speed_drive_limit, settings.speed_brake_limit)
    period_ns = settings.steps_in_a_period(simulation.step_ns) * simulation.step_ns
    return Session(simulation, inbox, period_ns, speed, controller)
