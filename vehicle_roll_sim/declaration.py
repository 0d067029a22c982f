"""Parameters declared once: a dataclass field carries its unit, range, meaning and symbol.

Everything that needs to know of a parameter (validation, vehicle files, ROS descriptors, command
line, tables in the documentation) reads it from here.
"""

import array
import dataclasses
import difflib
import math
import numbers
import reprlib
import types
import typing
from collections.abc import Iterable, Mapping

LONGEST_SHOWN = 60
"""Characters of a wrong value that an error message shows."""


class InputError(ValueError):
    """Something that a user gave is not allowed; its text is one line for that user."""

    def __init__(self, field: str, value, allowed: str, problem: str = ""):
        what = problem or ("missing" if value is None else f"{_shown(value)} is not allowed")
        super().__init__(_in_one_line(f"{field}: {what}: {allowed}"))
        self.field, self.value, self.allowed, self.problem = field, value, allowed, problem


class NotWrittenError(InputError):
    """The system did not let a result be written where the user wanted it."""


def _in_one_line(text: str) -> str:
    """Characters that are not printable, such as a new line in a file's name, written out."""
    return "".join(char if char.isprintable() else ascii(char)[1:-1] for char in text)


class _Outline(reprlib.Repr):
    """Values written out, of large ones no more than a message shows."""

    def __init__(self):
        super().__init__()
        self.maxlevel = 3
        self.maxlist = self.maxtuple = self.maxset = self.maxfrozenset = LONGEST_SHOWN // 3
        self.maxdict = self.maxarray = self.maxdeque = LONGEST_SHOWN // 3
        self.maxstring = self.maxother = self.maxlong = 3 * LONGEST_SHOWN  # these are cut inside

    def repr_int(self, x, level):
        return super().repr_int(x, level) if x.bit_length() < 1000 else hex(x)


def _shown(value) -> str:
    """A value in an error message, cut where it would fill the line."""
    text = _Outline().repr(plain(value))
    return text if len(text) <= LONGEST_SHOWN else text[:LONGEST_SHOWN] + "..."


def plain(value):
    """A numpy scalar, or an array without dimensions, as Python's own number; else `value`."""
    return value.item() if getattr(value, "ndim", None) == 0 else value


def number_of(value, field: str, allowed: str) -> float:
    """`value` as a float if it is a real number, of numpy too; raises InputError naming `field`."""
    value = plain(value)
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise InputError(field, value, allowed)
    try:
        return float(value)
    except OverflowError:  # an integer beyond the largest float
        raise InputError(field, value, allowed) from None


@dataclasses.dataclass(frozen=True)
class Parameter:
    """What is known of one parameter. Its kind is float, bool, str or, for a list of some of the
    choices or of `size` numbers, tuple. Its alternative is the parameter that states the same fact
    in another way: one of the two is given."""

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

    def validate(self, value, field: str | None = None):
        """`value` as this parameter's type; raises InputError naming `field`, else the name."""
        field, value = field or self.name, plain(value)
        if self.kind is float:
            return self._validate_number(value, field)
        if self.kind is tuple:
            check = self._validate_numbers if self.size else self._validate_names
            return check(value, field)
        if self.choices and str(value) in self.choices:
            return str(value)  # ROS reads `1` as a number
        if not isinstance(value, self.kind):
            raise InputError(field, value, f"a {self.kind.__name__} is wanted")
        if self.choices:
            raise InputError(field, value, "one of " + ", ".join(self.choices))
        return value

    def _validate_number(self, value, field: str) -> float:
        number = number_of(value, field, self.allowed)
        if not self.minimum <= number <= self.maximum or math.isinf(number):
            raise InputError(field, value, self.allowed)
        return number

    def _validate_numbers(self, value, field: str) -> tuple[float, ...]:
        if not isinstance(value, (list, tuple, array.array)) or len(value) != self.size:
            raise InputError(field, value, self.allowed)
        try:
            return tuple(self._validate_number(number, field) for number in value)
        except InputError:
            raise InputError(field, value, self.allowed) from None

    def _validate_names(self, value, field: str) -> tuple[str, ...]:
        is_list = isinstance(value, (list, tuple)) and len(value) > 0
        if not is_list or any(name not in self.choices for name in value):
            raise InputError(field, value, self.allowed)
        return tuple(value)

    @property
    def allowed(self) -> str:
        """The allowed values in words."""
        if self.kind is tuple and not self.size:
            return "a list of one or more of " + ", ".join(self.choices)
        if self.kind is bool:
            return "true or false"
        if self.choices:
            return " or ".join(self.choices)
        if self.kind is str:
            return "any text"
        unit = f" {self.unit}" if self.unit else ""
        what = f"a list of {self.size} numbers" if self.size else "a number"
        return f"{what} from {self.minimum:g} to {self.maximum:g}{unit}"


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
    default=dataclasses.MISSING,
):
    """A dataclass field that declares a parameter; without `default` it must be given.

    One with an `alternative` is None where the other is given, and is set by keyword.
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
    }
    if alternative:
        return dataclasses.field(default=None, metadata=about, kw_only=True)
    return dataclasses.field(default=default, metadata=about)


def parameters_of(declaring_class) -> dict[str, Parameter]:
    """The parameters that a dataclass declares, by name, in order."""
    return {
        field.name: Parameter(field.name, _kind(field.type), field.default, **field.metadata)
        for field in dataclasses.fields(declaring_class)
        if field.metadata
    }


def given(field: str, value, kind: type):
    """`value`, which has to be of a class of this package; raises InputError naming `field`."""
    if not isinstance(value, kind):
        raise InputError(field, value, f"an object of the class {kind.__name__}")
    return value


def _kind(annotation) -> type:
    """The type of a parameter's values: of `float | None`, float."""
    is_optional = isinstance(annotation, types.UnionType)
    return typing.get_args(annotation)[0] if is_optional else annotation


def check_alternatives(declaring_class, given: Mapping) -> None:
    """Raise InputError unless exactly one of each pair of alternatives is among the `given`."""
    for name, declared in parameters_of(declaring_class).items():
        other = declared.alternative
        if not other:
            continue
        if name in given and other in given:
            problem = f"{_shown(given[name])} beside {other} {_shown(given[other])}"
            raise InputError(name, given[name], "only one of the two may be given", problem)
        if name not in given and other not in given:
            raise InputError(name, None, f"it or {other} must be given")


def number_in(text: str) -> float:
    """The number that a text is; raises ValueError, also for what only Python reads as one.

    It takes 1_0 for 10, and digits of any script.
    """
    if "_" in text or not text.isascii():
        raise ValueError(text)
    return float(text)


def unknown_name(name: str, known: Iterable[str], field: str) -> InputError:
    """The error for a name that is not among the `known` ones, with the nearest of them."""
    known = {each.casefold(): each for each in known}
    nearest = difflib.get_close_matches(name.casefold(), known, n=1)
    every = "one of " + ", ".join(known.values())
    allowed = f"did you mean {known[nearest[0]]}?" if nearest else every
    return InputError(field, name, allowed, f"{_shown(name)} is unknown")


def validated(declaring_class, values: Mapping, prefix: str = "") -> dict:
    """`values` checked one by one against the declarations; names are reported with `prefix`."""
    known = parameters_of(declaring_class)
    for name in values:
        if name not in known:
            raise unknown_name(name, known, f"{prefix}name" if prefix else "name")
    return {name: known[name].validate(value, prefix + name) for name, value in values.items()}


def keep_validated(instance, given: Mapping | None = None) -> None:
    """Check the parameters of a frozen dataclass's instance and keep them as their declared types.

    For its `__post_init__`. given: those that have a value, where not all have. Raises InputError.
    """
    if given is None:
        given = {name: getattr(instance, name) for name in parameters_of(instance)}
    for name, value in validated(type(instance), given).items():
        object.__setattr__(instance, name, value)
