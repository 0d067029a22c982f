"""Manoeuvres and controllers of the user's own: a class in a Python file, or an object in Python.

Results depend on this code, so its text, its values and the declarations of its parameters are part
of the definition of a study.
"""

import contextlib
import dataclasses
import hashlib
import inspect
import json
import sys
import types
from collections.abc import Callable, Mapping
from pathlib import Path

from vehicle_roll_sim.declaration import Curve, InputError, Parameter, Table, parameters_of
from vehicle_roll_sim.files.text_file import read_text

PACKAGE = __name__.partition(".")[0]
SUFFIX = ".py"
HERE = Path()
"""The current folder, for names that do not come from a file."""
LARGEST = 1_000_000
"""Bytes of a file."""
MODULE = "vehicle_roll_sim_study_"
"""Begins the names of the modules that files become."""
KINDS = {kind.__name__: kind for kind in (float, bool, str, tuple, Curve, Table)}
Refuse = Callable[[object, str, str], InputError]
"""The error for a value, with what is allowed and what is wrong."""


def is_file(name) -> bool:
    """Whether a name is one of Python code: FILE.py:NAME."""
    return isinstance(name, str) and name.partition(":")[0].endswith(SUFFIX)


def from_file(name: str, folder: Path, kind: type, refuse: Refuse):
    """An instance of `kind` from a class or an object in a file, named as FILE.py:NAME.

    A relative FILE is in `folder`. The file is executed. Raises InputError by `refuse`.
    """
    file, _, attribute = name.partition(":")
    path = folder / file
    try:
        text = read_text(path, LARGEST)
    except InputError as error:
        raise refuse(name, error.allowed, f"{error.field}: {error.problem}") from None
    try:
        module = _module(text, path)
    except (Exception, SystemExit) as error:
        problem = f"{path}: {type(error).__name__}: {error}"
        raise refuse(name, "a Python file that can be executed", problem) from None
    if attribute not in vars(module):
        allowed = f"FILE.py:NAME, a {kind.__name__} in this file"
        raise refuse(name, allowed, f"{path} has no {attribute or 'NAME given'}")
    return instance_of(vars(module)[attribute], kind, name, refuse)


def instance_of(given, kind: type, name: str, refuse: Refuse):
    """A usable instance of `kind`: as given, or of a class without arguments.

    Raises InputError by `refuse`.
    """
    owner = given if isinstance(given, type) else type(given)
    if not issubclass(owner, kind):
        raise refuse(name, f"a {kind.__module__}.{kind.__name__}, or a class of it", "it is none")
    if any(isinstance(each, dataclasses.Field) for each in vars(owner).values()):
        raise refuse(name, "a class with @dataclasses.dataclass above it", "it has none")
    if any(isinstance(each.type, str) for each in dataclasses.fields(owner)):
        problem = "the types of its fields are texts"
        raise refuse(name, "a file without `from __future__ import annotations`", problem)
    if not isinstance(given, type):
        return given
    try:
        return given()
    except (TypeError, InputError) as error:
        raise refuse(name, "a class whose parameters all have defaults", str(error)) from None


def _module(text: str, path: Path) -> types.ModuleType:
    """The module of a file with this text, executed once."""
    name = MODULE + hashlib.sha256(f"{path.absolute()}\n{text}".encode()).hexdigest()[:16]
    if name not in sys.modules:
        module = types.ModuleType(name)
        module.__file__ = str(path.absolute())
        sys.modules[name] = module  # dataclasses look here, and pickle
        try:
            exec(compile(text, str(path), "exec"), vars(module))
        except BaseException:
            del sys.modules[name]
            raise
    return sys.modules[name]


def code_of(instance, refuse: Refuse) -> dict:
    """What the results depend on of a manoeuvre or a controller: class, values, text, parameters.

    As JSON has it, without the text if the class is one of this program. Raises InputError by
    `refuse`.
    """
    kind = type(instance)
    try:
        values = json.loads(json.dumps(vars(instance), sort_keys=True))
    except (TypeError, ValueError):
        raise refuse(kind.__name__, "attributes that are numbers, texts or lists", "") from None
    found = {"class": kind.__name__, "values": values}
    if is_own(kind):
        found["text"] = _text(kind, refuse)
    parameters = parameters_of(kind)
    return found | {"parameters": {name: _said(each) for name, each in parameters.items()}}


def is_own(kind: type) -> bool:
    """Whether a class is not one of this program."""
    return kind.__module__.partition(".")[0] != PACKAGE


def _text(kind: type, refuse: Refuse) -> str:
    """The text of the file that defines a class."""
    with contextlib.suppress(OSError, TypeError, InputError):
        return read_text(Path(inspect.getfile(kind)), LARGEST)
    raise refuse(kind.__name__, "a class that is defined in a file", "its text cannot be read")


def _said(declared: Parameter) -> dict:
    default = declared.default if declared.default is not dataclasses.MISSING else None
    shown = {each.name: getattr(declared, each.name) for each in dataclasses.fields(declared)}
    del shown["name"]
    return shown | {"kind": declared.kind.__name__, "default": default}


def declaring(code: Mapping) -> type:
    """A class with the parameters that a study's definition has: the code itself is not executed.

    Raises ValueError, TypeError or LookupError if the definition was changed.
    """
    fields = []
    for name, said in code["parameters"].items():
        about = {key: value for key, value in said.items() if key not in ("kind", "default")}
        about |= {key: tuple(about[key]) for key in ("choices", "over")}
        field = dataclasses.field(default=None, metadata=about, kw_only=True)
        fields.append((name, KINDS[said["kind"]], field))
    kind = dataclasses.make_dataclass(str(code["class"]), fields)
    parameters_of(kind)  # which is cached, and raises what is wrong
    return kind


def pickled(given, owners: tuple) -> bytes:
    """`given` as bytes that `pickle.loads` reads where the classes of `owners` are not installed.

    Their code travels with it. Needs cloudpickle, which comes with Dask.
    """
    import cloudpickle

    modules = {type(each).__module__ for each in owners if is_own(type(each))} - {"__main__"}
    registered = [sys.modules[name] for name in modules]
    for module in registered:
        cloudpickle.register_pickle_by_value(module)
    try:
        return cloudpickle.dumps(given)
    finally:
        for module in registered:
            cloudpickle.unregister_pickle_by_value(module)
