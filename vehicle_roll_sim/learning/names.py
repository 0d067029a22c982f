"""Arguments that are names, or values by name."""

from collections.abc import Iterable, Mapping, Sequence

from vehicle_roll_sim.declaration import InputError, unknown_name


def names_of(field: str, names: Sequence[str], known: Iterable[str]) -> tuple[str, ...]:
    """One or more different names of `known` ones; raises InputError naming `field`."""
    if isinstance(names, str) or not isinstance(names, Sequence) or not names:
        raise InputError(field, names, "a list of one or more of " + ", ".join(known))
    for name in names:
        if name not in known:
            raise unknown_name(str(name), known, field)
        if list(names).count(name) > 1:
            raise InputError(field, name, "each name once", f"{name} is given twice")
    return tuple(names)


def mapping_of(field: str, given, example: str) -> dict:
    """A copy of values by name; raises InputError naming `field`. example: such values."""
    if not isinstance(given, Mapping):
        raise InputError(field, given, f"values by name, such as {example}")
    return dict(given)
