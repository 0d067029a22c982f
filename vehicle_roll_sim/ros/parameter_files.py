"""Warnings about parameter files without a section for the node, which ROS ignores silently."""

import itertools
import re
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import yaml
from rclpy.node import Node

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.files.text_file import read_text

BEGIN, END, OPTION = "--ros-args", "--", "--params-file"
"""On a command line, the arguments for ROS stand between the first two."""
PARAMETERS = "ros__parameters"
EVERY_NODE = "/**"


def warn_of_files_for_others(node: Node, words: Sequence[str] | None = None) -> None:
    """Log a warning for each parameter file on the command line that has nothing for `node`.

    words: the command line (default: `sys.argv`).
    """
    name, given = node.get_fully_qualified_name(), node._parameter_overrides
    for file in _files(sys.argv if words is None else words):
        sections = _sections(file)
        if sections and not any(_is_for(name, given, *each) for each in sections.items()):
            node.get_logger().warning(
                f"{file} has no section for this node, {name}, and is ignored; "
                f"it has sections for: {', '.join(sections)}"
            )


def _files(words: Sequence[str]) -> list[Path]:
    """The parameter files on a command line."""
    files, is_for_ros = [], False
    for word, following in itertools.pairwise([*words, END]):
        is_for_ros = word == BEGIN or (is_for_ros and word != END)
        if is_for_ros and word == OPTION and following != END:
            files.append(Path(following))
    return files


def _sections(file: Path) -> dict[str, set[str]]:
    """Parameter names by full node name or pattern; none if the file cannot be read again."""
    if not file.is_file():  # such as a pipe
        return {}
    try:
        root = yaml.compose(read_text(file), Loader=yaml.SafeLoader)
    except (InputError, yaml.YAMLError, RecursionError):  # ROS may still be able to read it
        return {}
    if not isinstance(root, yaml.MappingNode):
        return {}
    sections = {}
    for *names, name, parameters in _paths(root, until=PARAMETERS):
        if name == PARAMETERS:
            full_name = "/" + "/".join(part.strip("/") for part in names)
            known = sections.setdefault(full_name, set())
            known |= {".".join(path) for *path, _ in _paths(parameters)}
    return sections


def _paths(node: yaml.Node, until: str | None = None, above: tuple = ()) -> Iterator[tuple]:
    """(key, key, ..., value) of every leaf of nested mappings; `until` is a key not to go below."""
    if not isinstance(node, yaml.MappingNode):
        yield (*above, node)
        return
    for key, value in node.value:
        path = (*above, str(key.value))
        if key.value == until:
            yield (*path, value)
        else:
            yield from _paths(value, until, path)


def _is_for(name: str, given: dict, section: str, parameters: set[str]) -> bool:
    """Whether ROS applies a section to the node of that full name.

    Not every ROS version supports every pattern, so a pattern also counts only if one of its
    parameters arrived. given: the parameters that the node received.
    """
    if section in (name, EVERY_NODE):
        return True
    pattern = re.escape(section).replace(r"/\*\*", "(/[^/]+)*").replace(r"/\*", "/[^/]+")
    return re.fullmatch(pattern, name) is not None and bool(parameters & given.keys())
