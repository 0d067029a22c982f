"""Groups the messages of a simulator into sets again and converts them to a history.

This works on messages decoded by any library, as long as fields have the names of the definitions.
"""

import bisect
import math
from collections.abc import Iterable

import numpy as np

from vehicle_roll_sim.messages.sets import COMMAND_LABELS, DEMAND_LABELS, ROAD_LABELS
from vehicle_roll_sim.messages.topics import (
    BODY_LOADS,
    GROUND_TRUTH,
    MEASUREMENTS,
    ROLL_CENTRE,
    STATE_SET,
    TRUTH,
)
from vehicle_roll_sim.model.frames import body_to_yawed
from vehicle_roll_sim.model.layout import CORNERS, WHEELS
from vehicle_roll_sim.runs.columns import COLUMNS, COMMANDS, ROLL_CENTRES, WIND
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.vehicle.derived_values import GRAVITY

STATE, COMMAND, IMU, LOADS = "state", "applied_command", "imu", "tire_normal_forces"
COLLECTED = tuple(t for t in STATE_SET if t.name in (STATE, COMMAND, IMU, LOADS))
"""The topics from which a history is built."""
(TRUE_IMU,) = (topic for topic in GROUND_TRUTH if topic.name == TRUTH + IMU)
NOT_OF_EVERY_MODEL = (ROLL_CENTRE, BODY_LOADS, TRUE_IMU)
"""Topics from which columns are added to it, if there are any messages on them, or which then take
the place of another."""
TIRE_FORCES = tuple(topic for topic in STATE_SET if topic.name.startswith("tire_forces/"))
"""Topics that fill the columns of horizontal tire forces, lf to rr, where they are kept."""
OF_TIRES = {topic.name for topic in TIRE_FORCES}
HORIZONTAL = ("longitudinal", "lateral")

COMMAND_SIZES = tuple(
    len(COMMAND_LABELS) + wind + road + demand
    for wind in (0, len(WIND))
    for road in (0, len(ROAD_LABELS))
    for demand in (0, len(DEMAND_LABELS))
)
"""Numbers of values of an `applied_command`, with and without wind, road and what was demanded."""
NEEDED = {"x", "y", "yaw", "u", "v", "yaw_rate", "roll", "roll_rate"}
"""States that every model publishes."""


class RunMessages:
    """Messages of one run, each with the time at which it was sent (ns), in that order.

    A set begins with its `state`, and one process sends it in order, so a message sent between two
    states belongs to the first of them. If two messages of one topic lie between two states, the
    times are those of a receiver, where topics overtake one another: each message then belongs to
    the nearest state.
    """

    def __init__(self):
        self.states: list[tuple[int, dict[str, float]]] = []
        self._others = {topic.name: [] for topic in COLLECTED if topic.name != STATE}
        self._added = {topic.name: [] for topic in (*NOT_OF_EVERY_MODEL, *TIRE_FORCES)}

    def keep(self, name: str, sent: int, message) -> None:
        """Add a message of a topic other than `state`. sent: when it was sent (ns)."""
        kept = self._added if name in self._added else self._others
        kept[name].append((sent, _used(name, message)))

    def is_complete(self) -> bool:
        """Whether all messages of the last set are present."""
        sent = self.states[-1][0]
        added = [kept for kept in self._added.values() if kept]
        return all(_has_sent_after(sent, kept) for kept in (*self._others.values(), *added))

    def history(self, road: Road) -> History:
        """One row for each complete set, driven on `road`; nan in columns that no topic carries.

        On a road that is no plane the lift of wheels is unknown.
        """
        sets = self._complete_sets()
        given, end = [command for _, command, *_ in sets.values()], len(COMMAND_LABELS)
        commands = np.array([values[end - len(COMMANDS) : end] for values in given])
        winds = [wind_in(values) for values in given]
        wind = np.array(winds) if all(map(len, winds)) else None
        rows = [_row(road, *parts) for parts in sets.values()]
        self._add_forces(rows, sets)
        centres = self._added_values(ROLL_CENTRE.name, len(ROLL_CENTRES), sets)
        loads = self._added_values(BODY_LOADS.name, len(CORNERS), sets)
        lifts = np.full((len(rows), len(WHEELS)), np.nan) if road.has_heights else None
        return History(rows, commands, centres, wind, body_loads=loads, lifts=lifts)

    def _add_forces(self, rows: list[np.ndarray], places: Iterable[int]) -> None:
        """Fill the horizontal tire forces of the rows, which belong to the states at some places.

        nan where there is no message.
        """
        sent = np.array([sent for sent, _ in self.states])
        for wheel, topic in zip(WHEELS, TIRE_FORCES, strict=True):
            found = _shared_out(self._added[topic.name], sent)
            ahead, left = (COLUMNS.index(f"{name}_force_{wheel}") for name in HORIZONTAL)
            for row, place in zip(rows, places, strict=True):
                if place in found:
                    row[ahead], row[left] = found[place]

    def _added_values(self, topic: str, size: int, places: Iterable[int]) -> np.ndarray | None:
        """The values of a topic for the states at some places, shape (n, size); None if unknown.

        nan where there is no message.
        """
        kept = self._added[topic]
        if not kept:
            return None
        found = _shared_out(kept, np.array([sent for sent, _ in self.states]))
        unknown = np.full(size, np.nan)
        return np.array([found.get(k, unknown) for k in places])

    def _complete_sets(self) -> dict[int, tuple]:
        """State, applied command, accelerometer reading and normal loads of every complete set.

        The keys are the places of their states.
        """
        sent = np.array([sent for sent, _ in self.states])
        topics = self._others | {IMU: self._added[TRUE_IMU.name] or self._others[IMU]}
        columns = [_shared_out(kept, sent) for kept in topics.values()]
        found = {}
        for k, (_, state) in enumerate(self.states):
            parts = [column.get(k) for column in columns]
            if all(part is not None for part in parts) and parts[0][0] == state["time"]:
                found[k] = (state, *parts)
        return found


def _used(name: str, message):
    """The part of a message that is used: an hour of entire messages would take gigabytes."""
    if name in (IMU, TRUE_IMU.name):
        reading = message.linear_acceleration
        return reading.x, reading.y, reading.z
    if name in OF_TIRES:
        return message.wrench.force.x, message.wrench.force.y
    return message.data


def wind_in(values: np.ndarray) -> np.ndarray:
    """The wind among the values of an `applied_command`, shape (2,), or none, shape (0,)."""
    between = _between(values)
    return between[: len(between) % len(ROAD_LABELS)]


def road_in(values: np.ndarray) -> np.ndarray:
    """Heights and frictions of the road among them, shape (8,), or none, shape (0,)."""
    between = _between(values)
    return between[len(between) % len(ROAD_LABELS) :]


def _between(values: np.ndarray) -> np.ndarray:
    """The values of wind and road, between what was applied and what was demanded."""
    further = values[len(COMMAND_LABELS) :]
    return further[: len(further) % len(DEMAND_LABELS)]


def demand_in(values: np.ndarray) -> np.ndarray:
    """The values after the time that were demanded: of actuators, or applied as they were."""
    further = values[len(COMMAND_LABELS) :]
    has_actuators = len(further) >= len(DEMAND_LABELS)
    return (further if has_actuators else values[: len(COMMAND_LABELS)])[-len(DEMAND_LABELS) :]


def _has_sent_after(start: int, kept: list[tuple[int, object]]) -> bool:
    """Whether one of the messages of a topic was sent at a time (ns) or later."""
    return bisect.bisect_left(kept, start, key=lambda entry: entry[0]) < len(kept)


def _shared_out(kept: list[tuple[int, object]], states: np.ndarray) -> dict[int, object]:
    """The messages of one topic, by the index of the state to which they belong.

    states: when the states were sent (ns).
    """
    times = np.array([sent for sent, _ in kept], dtype=states.dtype)
    places = np.searchsorted(states, times, side="right") - 1
    if len(np.unique(places)) < len(places) or (places < 0).any():
        limits = (states[1:] + states[:-1]) / 2
        places = np.searchsorted(limits, times)
    return {int(place): message for place, (_, message) in zip(places, kept, strict=True)}


def by_name(message) -> dict[str, float]:
    """The values of a labelled multi-array (such as `state` or `motion`) as a dict by label."""
    labels = (dimension.label for dimension in message.layout.dim)
    return dict(zip(labels, message.data, strict=True))


def is_ours(name: str, message) -> bool:
    """Whether a message of a collected topic can come from a simulator: others may use its name."""
    if name == STATE:
        labels = [dimension.label for dimension in message.layout.dim]
        is_whole = labels[:1] == ["time"] and len(labels) == len(message.data)
        return is_whole and set(labels) >= NEEDED and math.isfinite(message.data[0])
    if name == COMMAND:
        return len(message.data) in COMMAND_SIZES and math.isfinite(message.data[0])
    if name == MEASUREMENTS.name:
        return len(message.data) > 0 and math.isfinite(message.data[0])
    sizes = {LOADS: len(WHEELS), ROLL_CENTRE.name: len(ROLL_CENTRES)}
    sizes[BODY_LOADS.name] = len(CORNERS)
    return name not in sizes or len(message.data) == sizes[name]


def _row(road: Road, state: dict, command, imu, loads) -> np.ndarray:
    row = np.full(len(COLUMNS), np.nan)
    for name, value in state.items():
        if name in COLUMNS:
            row[COLUMNS.index(name)] = value
    first = COLUMNS.index(f"normal_force_{WHEELS[0]}")
    row[first : first + len(WHEELS)] = loads
    row[COLUMNS.index("steering")] = command[COMMAND_LABELS.index("steering")]
    row[COLUMNS.index("lateral_acceleration")] = _lateral_acceleration(road, state, imu)
    return row


def _lateral_acceleration(road: Road, state: dict, imu) -> float:
    """Acceleration (m/s^2) along the y axis of frame 2: the specific force there plus gravity."""
    roll, pitch = state["roll"], state.get("pitch", 0.0)
    attitude = (np.sin(roll), np.cos(roll), np.sin(pitch), np.cos(pitch))
    _, ahead, across = road.gravity(GRAVITY, state["time"])
    gravity = np.cos(state["yaw"]) * across - np.sin(state["yaw"]) * ahead
    return body_to_yawed(attitude, *imu)[1] + gravity
