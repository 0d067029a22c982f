"""Tables of the documentation that are made from declarations: `python docs/_extensions/tables.py`.

On a page, the line `<!-- table: NAME -->` stands above the table of that name; what follows, up to
the next empty line, is replaced. `make tables` writes them, and
test/package/test_generated_tables.py tells whether they are up to date.
"""

import dataclasses
import re
from collections.abc import Callable, Mapping
from pathlib import Path

from definitions import definitions, usual_combinations, usual_values
from markdown_table import table, with_names
from message_tables import abridged, command_table, label_table, signal_table, topic_table

from vehicle_roll_sim import preset
from vehicle_roll_sim.command_line.parameters import parameter_table
from vehicle_roll_sim.control_laws.catalogue import LAWS
from vehicle_roll_sim.control_laws.roll_bar_design import RollBarCriteria
from vehicle_roll_sim.declaration import Parameter, parameters_of
from vehicle_roll_sim.learning.actions import ACTIONS, ENDING
from vehicle_roll_sim.learning.observations import OBSERVATIONS
from vehicle_roll_sim.live.command_limits import CommandLimits
from vehicle_roll_sim.logs.quantities import QUANTITIES
from vehicle_roll_sim.messages import command_topics, topics
from vehicle_roll_sim.messages.covariances import ImuCovariances, OdomCovariances
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.roads.feature import Feature
from vehicle_roll_sim.roads.kinds import KINDS
from vehicle_roll_sim.ros.launching.arguments import ARGUMENTS, Argument
from vehicle_roll_sim.ros.services import SERVICES
from vehicle_roll_sim.ros.simulator.parameters import IMU_PREFIX, ODOM_PREFIX
from vehicle_roll_sim.ros.simulator.settings import Settings
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.signals import as_markdown
from vehicle_roll_sim.vehicle.sensor_parameters import QUANTITIES as MEASURED
from vehicle_roll_sim.vehicle.sensor_parameters import Quantity, parameters_of_quantity

DOCS = Path(__file__).parents[1]
MARKED = re.compile(r"(?P<mark><!-- table: (?P<name>[\w ]+) -->\n)(?P<table>(?:[^\n]+\n)*)")


def service_table() -> str:
    return table(
        ("service", "type", "effect"),
        *(
            (f"`~/{each.name}`", each.type.replace("/srv/", "/"), with_names(each.effect))
            for each in SERVICES
        ),
    )


def node_parameter_table(declaring: Mapping[str, type]) -> str:
    """Parameters of the simulator. declaring: their classes by the prefix of the names."""
    return table(
        ("name", "default", "allowed", "tunable", "meaning"),
        *(
            (
                f"`{prefix}{name}`",
                default(declared),
                allowed(declared),
                "yes" if declared.tunable else "",
                with_names(declared.description),
            )
            for prefix, each in declaring.items()
            for name, declared in parameters_of(each).items()
        ),
    )


def setting_table(declaring: type) -> str:
    """Parameters of a control law, or of its design."""
    return table(
        ("name", "default", "allowed", "meaning"),
        *(
            (f"`{name}`", default(declared), allowed(declared), with_names(declared.description))
            for name, declared in parameters_of(declaring).items()
        ),
    )


def default(declared: Parameter) -> str:
    value = declared.default
    if isinstance(value, bool):
        return f"`{value}`".lower()
    if isinstance(value, tuple):
        return "`[" + ", ".join(map(str, value)) + "]`"
    if isinstance(value, float):
        return f"{value:.6g} {declared.unit}".strip()
    return f"`{value}`" if value else "empty"


def allowed(declared: Parameter) -> str:
    """Like `declared.allowed`, in fewer words, since a cell is narrow."""
    if declared.kind is tuple and not declared.size:
        return "one or more"
    if declared.kind is bool:
        return "`true`, `false`"
    if declared.choices:
        return ", ".join(f"`{each}`" for each in declared.choices)
    if declared.kind is str:
        return "any text"
    number = f"{declared.minimum:g} … {declared.maximum:g} {declared.unit}".strip()
    return f"{declared.size} numbers, {number}" if declared.size else number


def argument_table() -> str:
    """The arguments of the launch files, and which of these have each."""
    of: dict[Argument, list[str]] = {}
    for name, arguments in ARGUMENTS.items():
        for each in arguments:
            of.setdefault(each, []).append(name)
    everywhere = len(ARGUMENTS)
    rows = (
        (
            f"`{each.name}`",
            "all" if len(names) == everywhere else ", ".join(f"`{name}`" for name in names),
            each.default or "empty",
            with_names(each.description),
        )
        for each, names in sorted(of.items(), key=lambda item: len(item[1]) == everywhere)
    )
    return table(("argument", "launch file", "default", "meaning"), *rows)


def manoeuvre_table() -> str:
    rows = ((f"`{name}`", text) for name, text in definitions().items())
    return table(("name", "definition"), *rows)


def action_table() -> str:
    """What an agent of VehicleRoll-v0 may command."""
    rows = (
        (
            f"`{name}`",
            str(channel.size),
            "0 … 1" if channel.smallest == 0.0 else "-1 … 1",
            f"`{channel.limit}`",
            with_names(command_topics.COMMAND_MEANINGS[name + ENDING].partition(";")[0]),
        )
        for name, channel in ACTIONS.items()
    )
    return table(("action", "numbers", "range", "1 stands for", "meaning"), *rows)


def observation_table() -> str:
    """What an agent of VehicleRoll-v0 may observe."""
    rows = (
        (
            f"`{name}`",
            str(each.size),
            each.signal.unit or "–",
            f"{each.bound:g}",
            each.signal.meaning,
        )
        for name, each in OBSERVATIONS.items()
    )
    return table(("observation", "numbers", "unit", "bound", "meaning"), *rows)


def sensor_table() -> str:
    """What sensors measure, and the parameters of its errors."""
    rows = (
        (
            f"`{name}`",
            each.device,
            each.what,
            each.unit,
            ", ".join(f"`{value}`" for value in each.values),
            f"`{each.prefix}_` and " + ", ".join(f"`{ending}`" for ending in _endings(each)),
        )
        for name, each in MEASURED.items()
    )
    return table(("quantity", "device", "what it is", "unit", "values", "parameters"), *rows)


def _endings(quantity: Quantity) -> list[str]:
    names = parameters_of_quantity(quantity)
    return [name.removeprefix(f"{quantity.prefix}_") for name in names]


def quantity_table() -> str:
    """What a log may have; those of the four wheels in one row."""
    rows = (
        (name, each.unit, each.meaning)
        for name, each in zip(abridged(QUANTITIES), _of_one_wheel(), strict=True)
    )
    return table(("quantity", "SI unit", "meaning"), *rows)


def _of_one_wheel() -> list:
    """The quantities; of those of the wheels the first."""
    others = tuple(f"_{wheel}" for wheel in WHEELS[1:])
    return [each for name, each in QUANTITIES.items() if not name.endswith(others)]


def feature_table() -> str:
    """The kinds of features of a road, and their values; those of all kinds first."""
    common = parameters_of(Feature)
    rows = [("all with a place", each) for each in common.values()]
    for name, kind in KINDS.items():
        own = [each for key, each in parameters_of(kind).items() if key not in common]
        rows += [(f"`{name}`", each) for each in own]
    return table(
        ("kind", "value", "default", "allowed", "meaning"),
        *(
            (kind, f"`{each.name}`", _default_of(each), allowed_in_file(each), each.description)
            for kind, each in rows
        ),
    )


def _default_of(declared: Parameter) -> str:
    if declared.default is dataclasses.MISSING:
        return "required"
    return declared.none if declared.default is None else default(declared)


def allowed_in_file(declared: Parameter) -> str:
    return declared.allowed if declared.is_curve else allowed(declared)


SET = (*topics.STATE_SET, *topics.OF_SOME_SETS)
TABLES: dict[str, Callable[[], str]] = {
    "commands": command_table,
    "ways in": lambda: topic_table(command_topics.WAYS_IN),
    "set": lambda: topic_table(SET),
    "stamped": lambda: topic_table(topics.STAMPED),
    "others": lambda: topic_table(t for t in topics.PUBLISHED if t not in SET),
    "labels": label_table,
    "signals": signal_table,
    "services": service_table,
    "simulator": lambda: node_parameter_table({"": Settings}),
    "limits": lambda: node_parameter_table({"": CommandLimits}),
    "model": lambda: node_parameter_table({"": Options}),
    "road features": feature_table,
    "road": lambda: node_parameter_table({"": Road}),
    "covariances": lambda: node_parameter_table(
        {IMU_PREFIX: ImuCovariances, ODOM_PREFIX: OdomCovariances}
    ),
    "roll bar criteria": lambda: setting_table(RollBarCriteria),
    "lqr_roll_bar": lambda: setting_table(LAWS["lqr_roll_bar"]),
    "rollover_mpc": lambda: setting_table(LAWS["rollover_mpc"]),
    "stability_control": lambda: setting_table(LAWS["stability_control"]),
    "launch arguments": argument_table,
    "manoeuvres": manoeuvre_table,
    "actions": action_table,
    "observations": observation_table,
    "quantities": quantity_table,
    "sensors": sensor_table,
    "plausibility": lambda: table(("quantity", "usual"), *usual_values()),
    "combinations": lambda: table(("quantity", "usual"), *usual_combinations()),
    "vehicle": lambda: parameter_table(preset()),
    "fields of state": lambda: as_markdown("state"),
    "fields of outputs": lambda: as_markdown("outputs"),
}


def up_to_date(text: str) -> str:
    """The text of a page with every marked table as the declarations have it."""
    return MARKED.sub(lambda found: f"{found['mark']}{TABLES[found['name']]()}\n", text)


def main() -> None:
    for page in sorted(DOCS.glob("**/*.md")):
        text = page.read_text(encoding="utf-8")
        if (new := up_to_date(text)) != text:
            page.write_text(new, encoding="utf-8")
            print(page.relative_to(DOCS.parent))


if __name__ == "__main__":
    main()
