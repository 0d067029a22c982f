"""Reading a YAML file of plain names and values; errors name the line."""

import re
from collections.abc import Iterator
from pathlib import Path

import yaml

from vehicle_roll_sim.files.text_file import LARGEST_FILE, read_text
from vehicle_roll_sim.input_errors import LONGEST_SHOWN, InputError

LONGEST_VALUE = 4096
"""Characters: the longest possible file name.

Longer values are refused because the time to parse a sexagesimal number (1:30) grows with the
square of its length.
"""
LONGEST_PROBLEM = 200
"""Maximum number of characters of a YAML error shown in an error message."""
NUMBERS = ("tag:yaml.org,2002:int", "tag:yaml.org,2002:float")
DECIMAL = re.compile(
    r"[-+]?((0|[1-9]\d*)(\.\d*)?|\.\d+)([eE][-+]?\d+)?|[-+]?\.inf|\.nan", re.ASCII | re.IGNORECASE
)
"""Decimal numbers only: YAML 1.1 would read 01440 as 800, 1:30 as 90 and 1_0 as 10."""
MERGE = "tag:yaml.org,2002:merge"
ODD_VALUE = (ValueError, LookupError, TypeError, ArithmeticError, AttributeError)
"""Exceptions that PyYAML raises, apart from its own, for values with wrong or unusual tags."""
Place = tuple[str | int, ...]
"""Where a value is in a file: the names and indices that lead to it."""


class _Loader(yaml.SafeLoader):
    """PyYAML's safe loader, restricted to plain names and values.

    It refuses duplicate keys, keys that are not scalars, values longer than LONGEST_VALUE, and
    numbers that are not decimal. It also refuses aliases and merge keys, by which a small file
    could expand to any number of values.
    """

    def compose_node(self, parent, index):
        if self.check_event(yaml.AliasEvent):
            alias = self.peek_event()
            raise _refused(f"alias {alias.anchor[:20]!r} is not allowed", alias.start_mark)
        node = super().compose_node(parent, index)
        if isinstance(node, yaml.ScalarNode) and len(node.value) > LONGEST_VALUE:
            problem = f"a value of {len(node.value)} characters is too long"
            raise _refused(problem, node.start_mark)
        if node.tag in NUMBERS and not DECIMAL.fullmatch(node.value):
            problem = f"{node.value[:LONGEST_SHOWN]} is not a decimal number"
            raise _refused(problem, node.start_mark)
        return node

    def construct_object(self, node, deep=False):
        try:
            return super().construct_object(node, deep)
        except ODD_VALUE as error:
            raise _refused(f"{type(error).__name__}: {error}", node.start_mark) from None

    def construct_mapping(self, node, deep=False):
        seen = set()
        for key, _ in node.value if isinstance(node, yaml.MappingNode) else ():
            if not isinstance(key, yaml.ScalarNode) or key.tag == MERGE:
                raise _refused("a key is not a name", key.start_mark)
            if key.value in seen:
                raise _refused(f"duplicate key {key.value[:LONGEST_SHOWN]!r}", key.start_mark)
            seen.add(key.value)
        return super().construct_mapping(node, deep)


def _refused(problem: str, mark: yaml.Mark) -> yaml.MarkedYAMLError:
    return yaml.MarkedYAMLError(problem=problem, problem_mark=mark)


_Loader.add_implicit_resolver(  # YAML 1.1 would read 35e3 and 3.5e4 as text
    NUMBERS[1], re.compile(r"[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+$"), list("-+.0123456789")
)


def read_mapping(
    path: Path, kind: str, wanted: str, largest: int = LARGEST_FILE
) -> tuple[dict, dict[Place, int]]:
    """The values of a file by name, and the line of each, also within mappings and lists.

    kind: of the file, such as `vehicle file`. wanted: what is expected of it. largest: maximum size
    of the file (bytes). Raises InputError naming file and line.
    """
    text = read_text(path, largest)

    def refused(problem: str) -> InputError:
        return InputError(f"{kind} {path}", "", wanted, problem)

    try:
        loader = _Loader(text)
        node = loader.get_single_node()
        values = loader.construct_document(node) if node else None
        lines = dict(_lines(node)) if node else {}
    except yaml.reader.ReaderError as error:
        line = text.count("\n", 0, error.position) + 1
        raise refused(f"{error.reason} in line {line}") from None
    except yaml.YAMLError as error:
        raise refused(_where(error)) from None
    except RecursionError:
        raise refused(f"nested too deep in line {loader.get_mark().line + 1}") from None
    except ODD_VALUE as error:  # an escape sequence for a character that does not exist
        raise refused(f"{error} in line {loader.get_mark().line + 1}") from None
    if not isinstance(values, dict) or not all(isinstance(name, str) for name in values):
        raise refused("it has no NAME: VALUE lines")
    return values, lines


def _lines(node: yaml.Node, place: Place = ()) -> Iterator[tuple[Place, int]]:
    """The places of all values in a node, and their lines."""
    if isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            yield (*place, key.value), key.start_mark.line + 1
            yield from _lines(value, (*place, key.value))
    elif isinstance(node, yaml.SequenceNode):
        for index, value in enumerate(node.value):
            yield (*place, index), value.start_mark.line + 1
            yield from _lines(value, (*place, index))


def _where(error: yaml.YAMLError) -> str:
    """A YAML error as one line, with the line number in the file."""
    mark = getattr(error, "problem_mark", None)
    problem = getattr(error, "problem", None) or str(error)
    line = f" in line {mark.line + 1}" if mark else ""
    return " ".join(problem.split())[:LONGEST_PROBLEM] + line
