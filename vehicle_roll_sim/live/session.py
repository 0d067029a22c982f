"""A simulation driven by external commands, one publish period at a time; no ROS, no clock."""

import dataclasses

from vehicle_roll_sim.input_errors import InputError, given
from vehicle_roll_sim.live.command_inbox import CommandInbox
from vehicle_roll_sim.live.session_snapshot import SessionSnapshot
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.simulation.command import NO_FORCE, OWN_FRICTION, STILL_AIR, Command
from vehicle_roll_sim.simulation.memory import WithMemory
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.simulation.speed_controller import SpeedController

LEVEL_ROAD = NO_FORCE, OWN_FRICTION


class Session:
    """A simulation, its incoming commands, and whether it is paused.

    period_ns: publish period (ns), a multiple of the step. initial_speed: m/s. controller: speed
    controller; by default one with the default torque limits. `applied`: the command applied in
    the last period; that of a vehicle with actuators passes through them. `parts`: what else has a
    memory, by name; snapshots contain all of it, so add to it what is driven beside the simulation,
    such as sensors or a driver.
    """

    def __init__(
        self,
        simulation: Simulation,
        inbox: CommandInbox,
        period_ns: int,
        initial_speed: float,
        controller: SpeedController | None = None,
    ):
        self.simulation, self.inbox, self.period_ns = simulation, inbox, period_ns
        self.controller = controller or SpeedController(simulation.vehicle)
        self.parts: dict[str, WithMemory] = {
            "commands": inbox,
            "speed_controller": self.controller,
        }
        self.paused = False
        self.reset(initial_speed)

    def reset(self, speed: float) -> None:
        """Reset to static equilibrium at `speed` (m/s), time 0, no commands; a pause persists."""
        self.simulation.reset(speed)
        self.inbox.clear()
        self.controller.reset()
        self.applied = Command()

    def set_going(self, speed: float) -> None:
        """Bring the vehicle to static equilibrium at `speed` (m/s) where it is, as it heads.

        Time goes on, and so do the commands. Raises InputError like `reset`.
        """
        self.simulation.roll_freely(speed)
        self.applied = Command()
        self.controller.reset()

    def snapshot(self) -> SessionSnapshot:
        """The present state of everything, but for the pause and the counts of messages."""
        return SessionSnapshot.of(
            self._settings, self.simulation.snapshot(), self.applied, self.parts
        )

    def restore(self, snapshot: SessionSnapshot) -> None:
        """Restore a snapshot of this session or of one constructed with the same arguments.

        Raises InputError, without any change, if it was taken from a different session.
        """
        kept = given("snapshot", snapshot, SessionSnapshot).content
        for name, value in self._settings.items():
            if kept["settings"][name] != value:
                problem = f"taken with another {name}, {kept['settings'][name]}"
                raise InputError("snapshot", "", f"one taken with {value}", problem)
        if kept["parts"].keys() != self.parts.keys():
            problem = f"it contains {', '.join(kept['parts'])}"
            raise InputError("snapshot", "", f"one with {', '.join(self.parts)}", problem)
        self.simulation.restore(snapshot.simulation)
        self.applied = Command(**kept["applied"])
        for name, part in self.parts.items():
            part.remember(kept["parts"][name])

    @property
    def _settings(self) -> dict[str, float]:
        """What a session is constructed with and does not change."""
        return {
            "period (s)": self.period_ns / NANOSECONDS,
            "speed_drive_limit (N m)": self.controller.drive_limit,
            "speed_brake_limit (N m)": self.controller.brake_limit,
        }

    def run_period(self) -> None:
        """Advance by one publish period with the present commands, unless the model has stopped."""
        now, period = self.simulation.time_ns, self.period_ns / NANOSECONDS
        command = self._with_totals(self._felt(self.inbox.command(now)), now)
        if self.stopped:
            return
        self.applied = self.inbox.limits.steered(self.applied, command, period)
        target = self.inbox.total("speed_cmd", now)
        if target is None:
            self.controller.reset()
        else:
            speed = float(self.simulation.state["u"])
            slope = float(self.simulation.outputs["slope_gravity"][0])
            self.applied = self.controller.drive(self.applied, target, speed, period, slope)
        self.simulation.step(self.applied, period)

    def _felt(self, command: Command) -> Command:
        """The command, without a wind that the vehicle does not feel, and without heights and
        frictions that its road does not take."""
        feels_wind, takes_road = self.simulation.takes
        fields = {}
        if not feels_wind and command.wind != STILL_AIR:
            fields["wind"] = STILL_AIR
        if not takes_road and (command.road_height, command.road_friction) != LEVEL_ROAD:
            fields["road_height"], fields["road_friction"] = LEVEL_ROAD
        return dataclasses.replace(command, **fields) if fields else command

    def _with_totals(self, command: Command, now_ns: int) -> Command:
        """The command with the total torques, if any, distributed to the wheels."""
        drive = self.inbox.total("drive_torque_cmd", now_ns)
        brake = self.inbox.total("brake_cmd", now_ns)
        vehicle, fields = self.simulation.vehicle, {}
        if drive is not None:
            fields["wheel_torque"] = tuple((drive * vehicle.drive_shares).tolist())
        if brake is not None:
            fields["brake_torque"] = tuple((brake * vehicle.brake_shares).tolist())
        return dataclasses.replace(command, **fields) if fields else command

    @property
    def stopped(self) -> bool:
        return self.simulation.condition is not Condition.RUNNING

    @property
    def rolled_over(self) -> bool:
        return self.simulation.has_rolled_over
