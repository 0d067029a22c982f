"""Tables from declarations: `node-parameters GROUP` and `topics GROUP`.

A group is a section of the page: which parameters of the simulator are in it, or which topics.
"""

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError
from sphinx.util.docutils import SphinxDirective

from vehicle_roll_sim.declaration import Parameter, parameters_of
from vehicle_roll_sim.live.command_limits import CommandLimits
from vehicle_roll_sim.messages import topics
from vehicle_roll_sim.messages.covariances import ImuCovariances, OdomCovariances
from vehicle_roll_sim.ros.simulator.settings import Settings
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.road import Road

PARAMETERS = {
    "simulator": {"": Settings},
    "limits": {"": CommandLimits},
    "model": {"": Options},
    "road": {"": Road},
    "covariances": {"imu.": ImuCovariances, "odom.": OdomCovariances},
}
TOPICS = {
    "commands": topics.COMMANDS,
    "set": topics.STATE_SET,
    "stamped": topics.STAMPED,
    "others": tuple(each for each in topics.PUBLISHED if each not in topics.STATE_SET),
}


def parameter_rows(group: str) -> list[list[str]]:
    """Header and rows of a group of the simulator's parameters."""
    rows = [["name", "default", "allowed", "tunable", "meaning"]]
    for prefix, declaring in PARAMETERS[group].items():
        for name, declared in parameters_of(declaring).items():
            tunable = "yes" if declared.tunable else ""
            meaning = declared.description
            rows.append(
                [f"`{prefix}{name}`", _default(declared), declared.allowed, tunable, meaning]
            )
    return rows


def _default(declared: Parameter) -> str:
    value = declared.default
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, tuple):
        return "[" + ", ".join(map(str, value)) + "]"
    text = f"{value:.6g}" if isinstance(value, float) else value or "empty"
    return f"{text} {declared.unit}".strip()


def topic_rows(group: str) -> list[list[str]]:
    """Header and rows of a group of topics."""
    rows = [["topic", "type", "depth", "durability"]]
    for topic in TOPICS[group]:
        durability = "transient local" if topic.latched else "volatile"
        rows.append([f"`{topic.name}`", f"`{topic.type}`", str(topic.depth), durability])
    return rows


def table(rows: list[list[str]]) -> nodes.table:
    """A table whose first row is its header; a cell in backticks is code."""
    head, *body = ([_cell(text) for text in row] for row in rows)
    columns = len(rows[0])
    group = nodes.tgroup("", *(nodes.colspec(colwidth=1) for _ in range(columns)), cols=columns)
    group += nodes.thead("", nodes.row("", *head))
    group += nodes.tbody("", *(nodes.row("", *cells) for cells in body))
    return nodes.table("", group, classes=["colwidths-auto"])


def _cell(text: str) -> nodes.entry:
    bare = text.strip("`")
    inline = nodes.literal("", bare) if bare != text else nodes.Text(text)
    return nodes.entry("", nodes.paragraph("", "", inline))


class _Table(SphinxDirective):
    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        try:
            return [table(self.rows(self.arguments[0]))]
        except KeyError as group:
            raise ExtensionError(f"{self.name}: no group {group}") from None


class NodeParameters(_Table):
    rows = staticmethod(parameter_rows)


class Topics(_Table):
    rows = staticmethod(topic_rows)


def setup(app: Sphinx) -> dict:
    app.add_directive("node-parameters", NodeParameters)
    app.add_directive("topics", Topics)
    return {"parallel_read_safe": True}
