"""The manoeuvre and the controller of a study: named, in a file of the user's, or an object."""

from collections.abc import Mapping

from vehicle_roll_sim.control_laws.catalogue import LAWS
from vehicle_roll_sim.declaration import unknown_name
from vehicle_roll_sim.manoeuvres.base import Manoeuvre
from vehicle_roll_sim.manoeuvres.catalogue import MANOEUVRES
from vehicle_roll_sim.runs.control_law import COMMANDED, ControlLaw
from vehicle_roll_sim.studies import own_code
from vehicle_roll_sim.studies.source import Source

KINDS = {"manoeuvre": Manoeuvre, "controller": ControlLaw}
NAMED = {"manoeuvre": MANOEUVRES, "controller": LAWS}
FILE = "FILE.py:NAME"
Driving = tuple[dict[str, Manoeuvre | ControlLaw | None], dict[str, dict]]
"""The manoeuvre and the controller by section, and the user's own code of each."""


def driving_of(source: Source, kept: Mapping[str, dict] | None = None) -> Driving:
    """What drives the vehicle of a study; raises InputError.

    kept: the user's own code in the definition of a study that is only shown: it is not executed,
    and an object with its parameters stands in.
    """
    found, code = {}, {}
    for section in KINDS:
        given = source.values.get(section)
        if given is None and section == "controller":
            found[section] = None
        elif kept and section in kept:
            found[section] = _stand_in(source, section, kept[section])
        elif isinstance(given, str) and given in NAMED[section]:
            found[section] = NAMED[section][given]
        else:
            found[section] = _own(source, section, given)
            code[section] = own_code.code_of(found[section], _refusal(source, section))
        if isinstance(found[section], type):
            found[section] = found[section]()
    _check_commands(source, found["controller"])
    return found, code


def _stand_in(source: Source, section: str, kept: dict):
    """An object with the parameters of code that is not executed; raises InputError."""
    try:
        return own_code.declaring(kept)()
    except (LookupError, TypeError, ValueError, AttributeError):
        allowed = f"{source.path} as it was written"
        raise source.refused((section,), "", allowed, "its code was changed there") from None


def _refusal(source: Source, section: str) -> own_code.Refuse:
    return lambda value, allowed, problem: source.refused((section,), value, allowed, problem)


def _own(source: Source, section: str, given):
    """What is not in the catalogue: in a file, or given as an object."""
    kind, refuse = KINDS[section], _refusal(source, section)
    if own_code.is_file(given):
        folder = source.path.parent if source.path else own_code.HERE
        return own_code.from_file(given, folder, kind, refuse)
    if isinstance(given, kind | type):
        return own_code.instance_of(given, kind, getattr(given, "__name__", "object"), refuse)
    names = (*NAMED[section], FILE)
    if isinstance(given, str):
        raise unknown_name(given, names, source.where(section))
    raise refuse(given, "one of " + ", ".join(names), "")


def _check_commands(source: Source, law: ControlLaw | None) -> None:
    """Raise InputError for a control law that does not say which commands it sets."""
    if not isinstance(law, ControlLaw):
        return
    commands = law.commands
    is_listed = isinstance(commands, tuple | list) and len(commands) > 0
    if not is_listed or any(name not in COMMANDED for name in commands):
        allowed = "a class whose `commands` are some of " + ", ".join(COMMANDED)
        problem = f"its commands are {commands!r}"
        raise source.refused(("controller",), type(law).__name__, allowed, problem)
