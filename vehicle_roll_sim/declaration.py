"""Parameters are declared once: a dataclass field carries unit, range, description and symbol.

Validation, vehicle files, ROS parameter descriptors, command-line options and the tables in the
documentation all read these declarations.
"""

import array
import dataclasses
import functools
import itertools
import math
import types
import typing
from collections.abc import Mapping

from vehicle_roll_sim.input_errors import InputError, number_of, plain, shown, unknown_name

AUTO, ON, OFF = SWITCH = ("auto", "on", "off")
"""Choices of a parameter that says whether something counts."""
FEWEST_POINTS, MOST_POINTS = 2, 63
CLOSEST = 1e-5
"""Between two points of a Curve."""
TRAVEL = ("travel", 2.0)
"""What a Curve is over, and the largest magnitude of it (SI units)."""


class Curve:
    """Kind of a parameter that changes with wheel travel.

    Its values are a float, the change per metre of travel, or a tuple of pairs of floats: travel
    (m, increasing) and value.
    """


class Table(Curve):
    """Kind of a parameter that is a tuple of such pairs only, over travel or something else."""


@dataclasses.dataclass(frozen=True)
class Parameter:
    """Declaration of one parameter.

    kind: float, int, bool, str, or tuple for a list of `size` numbers or of some of the `choices`.
    alternative: name of the parameter that specifies the same quantity in another way; exactly one
    of the two is given. tunable: may be changed while a simulation runs. over: what a Curve is
    over, and the largest magnitude of it. none: meaning of the value None, if it is allowed.
    """

    name: str
    kind: type
    default: object
    unit: str
    minimum: float
    maximum: float
    description: str
    symbol: str
    choices: tuple[str, ...]
    tunable: bool
    size: int
    alternative: str
    over: tuple[str, float]
    none: str = ""

    @property
    def is_curve(self) -> bool:
        """Whether the value may be a list of pairs of numbers."""
        return issubclass(self.kind, Curve)

    def validate(self, value, field: str | None = None):
        """Convert `value` to this parameter's type.

        Raises InputError naming `field`, by default the parameter's name.
        """
        field, value = field or self.name, plain(value)
        if value is None and self.none:
            return None
        if self.kind is float:
            return self._validate_number(value, field)
        if self.kind is int:
            return self._validate_whole(value, field)
        if self.kind is tuple:
            check = self._validate_numbers if self.size else self._validate_names
            return check(value, field)
        if self.is_curve:
            return self._validate_curve(value, field)
        if isinstance(value, bool) and ON in self.choices:
            return ON if value else OFF  # YAML reads `on` and `off` as true and false
        if self.choices and str(value) in self.choices:
            return str(value)  # ROS parses `1` as an integer
        if self.choices:
            raise InputError(field, value, "one of " + ", ".join(self.choices))
        if not isinstance(value, self.kind):
            raise InputError(field, value, self.allowed)
        return value

    def _validate_number(self, value, field: str) -> float:
        number = value if type(value) is float else number_of(value, field, self.allowed)
        if not self.minimum <= number <= self.maximum or math.isinf(number):
            raise InputError(field, value, self.allowed)
        return number

    def _validate_whole(self, value, field: str) -> int:
        number = self._validate_number(value, field)
        if not number.is_integer():
            raise InputError(field, value, self.allowed)
        return int(number)

    def _validate_numbers(self, value, field: str) -> tuple[float, ...]:
        if not isinstance(value, (list, tuple, array.array)) or len(value) != self.size:
            raise InputError(field, value, self.allowed)
        try:
            return tuple(self._validate_number(number, field) for number in value)
        except InputError:
            raise InputError(field, value, self.allowed) from None

    def _validate_curve(self, value, field: str) -> float | tuple[tuple[float, float], ...]:
        if not isinstance(value, (list, tuple, array.array)):
            if self.kind is Table:
                raise InputError(field, value, self.allowed)
            return self._validate_number(value, field)
        try:
            points = self._points(value, field)
        except (TypeError, ValueError, IndexError):  # InputError is a ValueError
            raise InputError(field, value, self.allowed) from None
        travels = [travel for travel, _ in points]
        gaps = [after - before for before, after in itertools.pairwise(travels)]
        if not (max(map(abs, travels)) <= self.over[1] and min(gaps) >= CLOSEST):
            raise InputError(field, value, self.allowed)
        return points

    def _points(self, values, field: str) -> tuple[tuple[float, float], ...]:
        """Pairs from a list of pairs, or from their numbers in a row."""
        if not isinstance(values[0], (list, tuple)):
            values = list(zip(values[::2], values[1::2], strict=True))
        points = tuple(
            (number_of(travel, field, ""), self._validate_number(value, field))
            for travel, value in values
        )
        if not FEWEST_POINTS <= len(points) <= MOST_POINTS:
            raise ValueError
        return points

    def _validate_names(self, value, field: str) -> tuple[str, ...]:
        is_list = isinstance(value, (list, tuple)) and len(value) > 0
        if not is_list or any(name not in self.choices for name in value):
            raise InputError(field, value, self.allowed)
        return tuple(value)

    @property
    def allowed(self) -> str:
        """The allowed values, in words."""
        if self.kind is tuple and not self.size:
            return "a list of one or more of " + ", ".join(self.choices)
        if self.kind is bool:
            return "true or false"
        if self.is_curve:
            span = f"from {self.minimum:g} to {self.maximum:g}"
            points = f"{FEWEST_POINTS} to {MOST_POINTS} pairs [{self.over[0]}, value]"
            if self.kind is Table:
                return f"{points}, the first increasing, values {span} {self.unit}"
            return f"a number {span} {self.unit}, or {points}, travels increasing, values {span}"
        if self.choices:
            return " or ".join(self.choices)
        if self.kind is str:
            return "any text"
        unit = f" {self.unit}" if self.unit else ""
        form = "a whole number" if self.kind is int else "a number"
        form = f"a list of {self.size} numbers" if self.size else form
        return f"{form} from {self.minimum:g} to {self.maximum:g}{unit}"


def parameter(
    description: str,
    unit: str = "",
    minimum: float = -math.inf,
    maximum: float = math.inf,
    symbol: str = "",
    choices: tuple[str, ...] = (),
    tunable: bool = False,
    size: int = 0,
    alternative: str = "",
    over: tuple[str, float] = TRAVEL,
    none: str = "",
    default=dataclasses.MISSING,
):
    """Declare a parameter as a dataclass field; it is required if it has no `default`.

    A field with an `alternative` is keyword-only and None if the alternative is given; one whose
    `default` is None is keyword-only, too, and may be absent.
    """
    about = {
        "description": description,
        "unit": unit,
        "minimum": minimum,
        "maximum": maximum,
        "symbol": symbol,
        "choices": choices,
        "tunable": tunable,
        "size": size,
        "alternative": alternative,
        "over": over,
        "none": none,
    }
    if alternative or default is None:
        return dataclasses.field(default=None, metadata=about, kw_only=True)
    return dataclasses.field(default=default, metadata=about)


def parameters_of(declaring) -> Mapping[str, Parameter]:
    """The parameters declared by a dataclass or its instance, by name, in order of declaration."""
    return _declared_by(declaring if isinstance(declaring, type) else type(declaring))


@functools.cache
def _declared_by(declaring_class: type) -> Mapping[str, Parameter]:
    return types.MappingProxyType(
        {
            field.name: Parameter(field.name, _kind(field.type), field.default, **field.metadata)
            for field in dataclasses.fields(declaring_class)
            if field.metadata
        }
    )


def _kind(annotation) -> type:
    """The type of a parameter's values; float for `float | None`."""
    is_optional = isinstance(annotation, types.UnionType)
    return typing.get_args(annotation)[0] if is_optional else annotation


def check_alternatives(declaring_class, given: Mapping) -> None:
    """Raise InputError unless exactly one parameter of each alternative pair is in `given`."""
    for name, declared in parameters_of(declaring_class).items():
        other = declared.alternative
        if not other:
            continue
        if name in given and other in given:
            problem = f"{shown(given[name])} together with {other} {shown(given[other])}"
            raise InputError(name, given[name], "only one of the two may be given", problem)
        if name not in given and other not in given:
            raise InputError(name, None, f"either this or {other} must be given")


def validated(declaring_class, values: Mapping, prefix: str = "") -> dict:
    """Validate each of `values` against its declaration.

    Raises InputError for an unknown name or an invalid value; `prefix` precedes names in messages.
    """
    known = parameters_of(declaring_class)
    for name in values:
        if name not in known:
            raise unknown_name(name, known, f"{prefix}name" if prefix else "name")
    return {name: known[name].validate(value, prefix + name) for name, value in values.items()}


def keep_validated(instance, given: Mapping | None = None) -> None:
    """Validate the parameters of a frozen dataclass instance and store them as declared types.

    For use in `__post_init__`. given: the parameters that have a value; by default all of them.
    Raises InputError.
    """
    if given is None:
        given = {name: getattr(instance, name) for name in parameters_of(instance)}
    for name, value in validated(type(instance), given).items():
        object.__setattr__(instance, name, value)
