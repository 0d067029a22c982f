"""The bag of an offline run: the same as a recording of the node."""

import contextlib
from collections.abc import Iterable, Iterator
from pathlib import Path

from vehicle_roll_sim.bags.encoding import encode
from vehicle_roll_sim.bags.writing import Bag, whole_bag
from vehicle_roll_sim.live.channels import channels
from vehicle_roll_sim.messages.command_topics import (
    COMMANDS,
    COMMANDS_OF_ROAD,
    OF_WIND,
    TOTAL_TORQUES,
)
from vehicle_roll_sim.messages.measured import messages_of
from vehicle_roll_sim.messages.road_marker import road_marker
from vehicle_roll_sim.messages.stamped import builder
from vehicle_roll_sim.messages.topics import (
    CLOCK,
    OF_SOME_SETS,
    PUBLISHED,
    ROAD,
    ROBOT_DESCRIPTION,
    ROLLOVER,
    SIMULATION_DESCRIPTION,
    STAMPED,
    TRANSFORMS,
    set_of,
)
from vehicle_roll_sim.messages.urdf import robot_description
from vehicle_roll_sim.simulation.command import Command
from vehicle_roll_sim.simulation.description import describe
from vehicle_roll_sim.simulation.road_mesh import has_mesh
from vehicle_roll_sim.simulation.simulation import Simulation


@contextlib.contextmanager
def run_bag(
    simulation: Simulation,
    commanded: Iterable[str],
    folder: Path,
    period_ns: int,
    field: str,
    *,
    stamped: bool = False,
) -> Iterator["RunBag"]:
    """An observer of a run that writes a bag, complete when the block ends.

    commanded: names of the commanded fields of a Command. period_ns: for which commands are held.
    stamped: include the topics of `publish_stamped`. Raises InputError naming `field` if the bag
    cannot be written.
    """
    with whole_bag(folder, field) as bag:
        yield RunBag(simulation, commanded, bag, period_ns, stamped)


class RunBag:
    """Observer of a run that writes every set to a bag, stamped and logged in simulated time.

    The bag has the topics of a recording, without those of total torques, since a run commands
    wheels, and without those of a wind or a road that there is not. The topics of the `commanded`
    fields of a Command have the values applied in each period; diagnostics stay empty.
    """

    def __init__(
        self,
        simulation: Simulation,
        commanded: Iterable[str],
        bag: Bag,
        period_ns: int,
        stamped: bool = False,
    ):
        self._simulation, self._bag = simulation, bag
        parts = (simulation.sensors.devices, simulation.has_actuators)
        in_set = set_of(simulation.options, stamped, *parts)
        absent = [
            *TOTAL_TORQUES,
            *(() if simulation.feels_wind else OF_WIND),
            *(() if simulation.road.is_commanded else COMMANDS_OF_ROAD),
            *(topic for topic in OF_SOME_SETS if topic not in in_set),
            *(() if has_mesh(simulation.road) else (ROAD,)),
        ]
        with_header = (topic for topic in in_set if topic in STAMPED)
        present = (topic for topic in (*COMMANDS, *PUBLISHED) if topic not in absent)
        topics = (*present, *with_header)
        self._connections = {
            topic.name: bag.add_topic(topic, "/" + topic.name.lstrip("/")) for topic in topics
        }
        self._types = {topic.name: topic.type for topic in topics}
        messages = self._messages = messages_of(simulation, "", encode)
        self._set = [
            (topic.name, builder(messages, encode, topic)) for topic in (CLOCK, *in_set, TRANSFORMS)
        ]
        fields = set(commanded)
        self._commands = {
            name: channel.field
            for name, channel in channels().items()
            if channel.field in fields and name in self._connections
        }
        self._rolled_over = None
        description = describe(simulation, period_ns)
        bag.describe(description)
        self._write(SIMULATION_DESCRIPTION.name, {"data": description})
        self._write(ROBOT_DESCRIPTION.name, {"data": robot_description(simulation)})
        if marker := road_marker(simulation.road):
            self._write(ROAD.name, marker)

    def on_set(self) -> None:
        """Write the current set, and `rollover` at first and when it changes."""
        self._messages.set_time(self._simulation.time_ns)
        for name, build in self._set:
            self._bag.write(self._connections[name], self._simulation.time_ns, build())
        rolled_over = self._simulation.has_rolled_over
        if rolled_over != self._rolled_over:
            self._rolled_over = rolled_over
            self._write(ROLLOVER.name, {"data": rolled_over})

    def on_command(self, command: Command) -> None:
        """Write the command for the next period."""
        self._messages.applied = command
        for name, field in self._commands.items():
            self._write(name, {"data": getattr(command, field)})

    def _write(self, name: str, fields: dict) -> None:
        data = encode(self._types[name], fields)
        self._bag.write(self._connections[name], self._simulation.time_ns, data)
