"""Vehicle files: YAML with the names of `Vehicle`, and the shipped presets."""

import re
from dataclasses import MISSING
from importlib.resources import as_file, files
from pathlib import Path

import yaml

from vehicle_roll_sim.declaration import InputError, parameters_of, unknown_name, validated
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.text_file import read_text
from vehicle_roll_sim.vehicle.tire_file import load_tire

A_MAPPING = "a YAML mapping of parameter names to values is wanted"
PRESETS = files("vehicle_roll_sim.vehicle") / "presets"


class _UniqueKeyLoader(yaml.SafeLoader):
    """YAML's safe loader, which also refuses a key that stands twice."""

    def construct_mapping(self, node, deep=False):
        seen = set()
        pairs = node.value if isinstance(node, yaml.MappingNode) else ()
        for key_node, _ in pairs:
            if isinstance(key_node, yaml.ScalarNode) and key_node.value in seen:
                raise yaml.constructor.ConstructorError(
                    problem=f"key {key_node.value!r} stands twice",
                    problem_mark=key_node.start_mark,
                )
            seen.add(key_node.value if isinstance(key_node, yaml.ScalarNode) else None)
        return super().construct_mapping(node, deep)


_UniqueKeyLoader.add_implicit_resolver(  # YAML 1.1 takes 35e3 for text
    "tag:yaml.org,2002:float", re.compile(r"[-+]?\d+[eE][-+]?\d+$"), list("-+0123456789")
)


def load_vehicle(path: str | Path) -> Vehicle:
    """Read a vehicle file and the tire file it names; raises InputError naming file and key."""
    path = Path(path)
    values = _mapping(path)
    prefix = f"{path}: "
    expected = (*parameters_of(Vehicle), "tire")
    for name in values:
        if name not in expected:
            raise unknown_name(name, expected, f"{path}: name")
    optional = {n for n, p in parameters_of(Vehicle).items() if p.default is not MISSING}
    missing = [name for name in expected if name not in values and name not in optional]
    if missing:
        raise InputError(prefix + missing[0], None, "every parameter must be given")
    tire = values.pop("tire")
    if not isinstance(tire, str) or not tire:
        raise InputError(prefix + "tire", tire, "the name of a .tir file")
    numbers = validated(Vehicle, values, prefix)
    return Vehicle.checked(numbers, load_tire(path.parent / tire), prefix)


def _mapping(path: Path) -> dict:
    text = read_text(path)
    try:
        values = yaml.load(text, Loader=_UniqueKeyLoader)
    except yaml.YAMLError as error:
        raise InputError(f"vehicle file {path}", "", A_MAPPING, _where(error)) from None
    except RecursionError:
        raise InputError(f"vehicle file {path}", "", A_MAPPING, "nested too deep") from None
    except (ValueError, LookupError, TypeError) as error:  # of a value with a wrong or odd tag
        problem = " ".join(f"{type(error).__name__}: {error}".split())
        raise InputError(f"vehicle file {path}", "", A_MAPPING, problem) from None
    if not isinstance(values, dict) or not all(isinstance(name, str) for name in values):
        raise InputError(f"vehicle file {path}", values, A_MAPPING, "no NAME: VALUE lines")
    return values


def _where(error: yaml.YAMLError) -> str:
    """A YAML error in one line."""
    mark = getattr(error, "problem_mark", None)
    problem = getattr(error, "problem", None) or str(error)
    line = f" in line {mark.line + 1}" if mark else ""
    return " ".join(problem.split()) + line


def preset(name: str = "reference") -> Vehicle:
    """A shipped vehicle; `reference` is the one of Shim and Ghike (2007)."""
    with as_file(PRESETS) as folder:
        return load_vehicle(folder / f"{name}.yaml")
