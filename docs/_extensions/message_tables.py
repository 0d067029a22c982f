"""Tables of topics: commands, ways in, messages of a set, and the names of their numbers."""

from collections.abc import Iterable

from markdown_table import table, with_names

from vehicle_roll_sim.live.channels import channels
from vehicle_roll_sim.messages import command_topics
from vehicle_roll_sim.messages.sets import (
    ACTUATOR_LABELS,
    COMMAND_LABELS,
    DEMAND_LABELS,
    MOTION_LABELS,
    ROAD_LABELS,
)
from vehicle_roll_sim.messages.stamped import SIGNAL_UNITS
from vehicle_roll_sim.messages.topic import Topic
from vehicle_roll_sim.model.layout import CORNERS
from vehicle_roll_sim.model.records import WHEELS, element_names
from vehicle_roll_sim.runs.columns import ROLL_CENTRES, WIND
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.sensor_parameters import QUANTITIES as MEASURED
from vehicle_roll_sim.vehicle.sensor_parameters import labels_of


def command_table() -> str:
    """The commands, each with the parameter that limits it."""
    limits = {name: channel.limit for name, channel in channels().items()}
    return table(
        ("topic", "type", "unit", "limit", "meaning"),
        *(
            (
                f"`{each.name}`",
                type_of(each),
                each.unit,
                f"`{limits[each.name]}`",
                with_names(each.meaning),
            )
            for each in command_topics.COMMANDS
        ),
    )


def topic_table(shown: Iterable[Topic]) -> str:
    return table(
        ("topic", "type", "depth", "unit", "meaning"),
        *(
            (f"`{each.name}`", type_of(each), _depth(each), each.unit, with_names(each.meaning))
            for each in shown
        ),
    )


def type_of(topic: Topic) -> str:
    """As it is written in sentences: std_msgs/Float64."""
    return topic.type.replace("/msg/", "/")


def _depth(topic: Topic) -> str:
    return f"{topic.depth}, latched" if topic.latched else str(topic.depth)


def label_table() -> str:
    """What the labels of the multi-arrays say."""
    states = {
        "`state`": Options(),
        "`state` with `steady_state_slip`": Options(steady_state_slip=True),
        "`state` with the models `8dof…`": Options(model="8dof"),
    }
    labels = {name: ("time", *element_names(each.states)) for name, each in states.items()}
    labels |= {
        "`applied_command`": COMMAND_LABELS,
        "`applied_command` of vehicles with air forces": (*COMMAND_LABELS, *WIND),
        "`applied_command` on a commanded road": (*COMMAND_LABELS, *ROAD_LABELS),
        "`applied_command` of vehicles with actuators, after these": DEMAND_LABELS,
        "`motion`": MOTION_LABELS,
    }
    labels["`tire_normal_forces`, `lift_off`"] = WHEELS
    labels["`roll_centre`"] = ROLL_CENTRES
    labels["`body_loads`"] = CORNERS
    labels["`measurements`, of the devices that there are"] = ("time", *labels_of(MEASURED))
    labels["`signals_stamped`"] = tuple(SIGNAL_UNITS)
    labels["`actuators`"] = ACTUATOR_LABELS
    return table(
        ("topic", "values", "names"),
        *((name, str(len(each)), ", ".join(abridged(each))) for name, each in labels.items()),
    )


def signal_table() -> str:
    """The values of `signals_stamped`, with their units."""
    return table(
        ("position", "name", "unit"),
        *((f"[{k}]", f"`{name}`", unit) for k, (name, unit) in enumerate(SIGNAL_UNITS.items())),
    )


def abridged(names: Iterable[str]) -> list[str]:
    """The names; four that end in the names of the wheels are one."""
    first, last = f"_{WHEELS[0]}", {f"_{wheel}" for wheel in WHEELS[1:]}
    shown = (name for name in names if name[-3:] not in last)
    return [f"`{name}` … `{WHEELS[-1]}`" if name.endswith(first) else f"`{name}`" for name in shown]
