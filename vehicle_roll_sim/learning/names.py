"""Choices by name."""

from collections.abc import Iterable, Sequence

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
