"""The values of a study and where each was given, for messages."""

import dataclasses
from collections.abc import Iterable, Mapping
from pathlib import Path

from vehicle_roll_sim.declaration import InputError, parameters_of, unknown_name
from vehicle_roll_sim.files.yaml_file import Place, read_mapping

WANTED = "a YAML mapping with manoeuvre, factors and so on, see docs/studies.md"


@dataclasses.dataclass(frozen=True)
class Source:
    """The values of a study as they were given.

    values: by name. lines: line of each place in the file. path: the study file, or None for values
    that come from Python.
    """

    values: Mapping
    lines: Mapping[Place, int] = dataclasses.field(default_factory=dict)
    path: Path | None = None

    @classmethod
    def of_file(cls, path: str | Path) -> "Source":
        """Read a study file; raises InputError naming file and line."""
        path = Path(path)
        return cls(*read_mapping(path, "study file", WANTED), path)

    def where(self, *place: str | int) -> str:
        """A place as messages name it: `study.yaml: line 3: factors: road.bank`."""
        names = ": ".join(str(part + 1) if isinstance(part, int) else part for part in place)
        if self.path is None:
            return f"study: {names}"
        line = self.lines.get(place) or self.lines.get(place[:-1])
        return f"{self.path}: line {line}: {names}" if line else f"{self.path}: {names}"

    def refused(self, place: Place, value, allowed: str, problem: str = "") -> InputError:
        """The error for a value at a place."""
        return InputError(self.where(*place), value, allowed, problem)

    def mapping(self, place: Place, values, known: Iterable[str] = ()) -> Mapping:
        """`values` if they are a mapping of names, these among the `known` ones if there are any.

        Raises InputError.
        """
        if not isinstance(values, Mapping) or not all(isinstance(name, str) for name in values):
            allowed = "NAME: VALUE lines" + (f" of {', '.join(known)}" if known else "")
            raise self.refused(place, values, allowed)
        for name in values:
            if known and name not in known:
                raise unknown_name(name, known, self.where(*place, name))
        return values

    def declared(self, kind: type, place: Place, values):
        """An instance of a declaring class from a mapping of its parameters; raises InputError."""
        known = parameters_of(kind)
        values = self.mapping(place, values, known)
        for name, each in known.items():
            if each.default is dataclasses.MISSING and name not in values:
                raise self.refused((*place, name), None, each.description)
        try:
            return kind(**values)
        except InputError as error:
            named = self.where(*place, error.field)
            raise InputError(named, error.value, error.allowed, error.problem) from None


def whole(value: float, field: str, allowed: str) -> int:
    """A float as an integer; raises InputError naming `field`."""
    if value != int(value):
        raise InputError(field, value, allowed)
    return int(value)
