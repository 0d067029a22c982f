"""A stand-in for the package simulation_interfaces, which is not among the wheels.

Its classes have the fields, defaults and constants of version 2.1.0. These stand as data, written
for these tests, in the folder `standard_2_1_0` beside this module. The classes carry no type
support: they can be filled and read, but not sent.
"""

import importlib
import types
from pathlib import Path

FOLDER = Path(__file__).with_name("standard_2_1_0")
SIMPLE = {"bool": False, "string": ""}
ENDINGS = {"msg": ("",), "srv": ("Request", "Response"), "action": ("Goal", "Result", "Feedback")}


def modules() -> dict[str, types.ModuleType]:
    """The modules of the package by name."""
    root = types.ModuleType("simulation_interfaces")
    found = {root.__name__: root}
    for part, endings in ENDINGS.items():
        module = types.ModuleType(f"{root.__name__}.{part}")
        for path in (FOLDER / part).iterdir():
            setattr(module, path.stem, _defined(path, endings, found))
        setattr(root, part, module)
        found[module.__name__] = module
    return found


def _defined(path: Path, endings: tuple[str, ...], known: dict) -> type:
    """The class of a message, or one that has the classes of a service or an action."""
    texts = path.read_text(encoding="utf-8").split("---")
    parts = [_message(path.stem, text, known) for text in texts]
    if endings == ("",):
        return parts[0]
    return type(path.stem, (), dict(zip(endings, parts, strict=True)))


def _message(name: str, text: str, known: dict) -> type:
    """A class whose objects have the fields of a definition."""
    constants, fields = {}, {}
    for line in filter(None, text.splitlines()):
        kind, field, *value = line.split()
        if value[:1] == ["="]:
            constants[field] = int(value[1])
        else:
            fields[field] = kind, value

    def fill(self):
        for field, (kind, value) in fields.items():
            setattr(self, field, int(value[0]) if value else _initial(kind, known))

    return type(name, (), constants | {"__init__": fill, "__slots__": tuple(fields)})


def _initial(kind: str, known: dict):
    if kind.endswith("[]"):
        return []
    if kind in SIMPLE or kind.startswith("uint"):
        return SIMPLE.get(kind, 0)
    package, _, name = kind.rpartition("/")
    module = importlib.import_module(f"{package}.msg") if package else None
    return getattr(module or known["simulation_interfaces.msg"], name)()
