"""An identified vehicle as a vehicle file, with the intervals in comments, and its tire files."""

import dataclasses
import json
import os
from collections.abc import Mapping
from pathlib import Path

from vehicle_roll_sim.declaration import parameters_of
from vehicle_roll_sim.files.output_file import replaced_file
from vehicle_roll_sim.files.text_file import read_text
from vehicle_roll_sim.identification.estimate import Estimate
from vehicle_roll_sim.identification.free import AXLES, applied
from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.model.variants import PAPER
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.tire.text import ENCODINGS, HEADER, KEY
from vehicle_roll_sim.vehicle.tire_file import Tire
from vehicle_roll_sim.vehicle.vehicle_file import (
    LONGITUDINAL,
    MODEL,
    PAYLOAD,
    SHIPPED_TIRE,
    SWITCHES,
    TIRES,
    shipped_tire,
)

SECTION = "SCALING_COEFFICIENTS"
COMMENT_AT = 45
"""Column at which the comment of a line begins."""
HEAD = """\
# Vehicle file for vehicle_roll_sim with values identified from logs. Intervals are those of 95 %.
"""


def write_vehicle(estimate: Estimate, path: Path, logs: list[str]) -> list[Path]:
    """Write the vehicle file, and beside it a tire file for each tire with identified values.

    logs: names, for the comments. Returns the paths that were written. Raises InputError for a tire
    that does not come from a file.
    """
    vehicle, _ = applied(estimate.problem.simulation.vehicle, estimate.values)
    texts = _tire_texts(estimate, vehicle, path)
    lines = [HEAD, *(f"# from: {name}\n" for name in logs), *_sensor_lines(estimate)]
    lines += _value_lines(estimate, vehicle)
    lines += _other_lines(vehicle, path, texts)
    for file, text in texts.items():
        _write(path.parent / file, text)
    _write(path, "".join(lines))
    return [path, *(path.parent / file for file in texts)]


def _write(path: Path, text: str) -> None:
    with replaced_file(path) as partial:
        partial.write_text(text, encoding="utf-8")


def interval_text(estimate: Estimate, name: str, factor: float = 1.0) -> str:
    """The interval of a value in words, with as many digits as it deserves."""
    low, high = (factor * end for end in estimate.intervals[name])
    half = abs(high - low) / 2.0
    digits = 2 if half > 0.0 else 6
    decimals = max(0, digits - 1 - _magnitude(half or 1.0))
    return f"{low:.{decimals}f} to {high:.{decimals}f}"


def _magnitude(value: float) -> int:
    """The power of ten of the first digit."""
    return int(f"{value:e}".partition("e")[2])


def _sensor_lines(estimate: Estimate) -> list[str]:
    """Comments on values that are not those of the vehicle."""
    known = parameters_of(Vehicle)
    lines = []
    for each in estimate.free:
        is_factor = all(f"{axle}_{each.name}" in known for axle in AXLES)
        if each.name not in known and "." not in each.name and not is_factor:
            value = estimate.values[each.name]
            unit = f" {each.unit}" if each.unit else ""
            text = f"{each.name}: {value:.6g}{unit}, {interval_text(estimate, each.name)}"
            lines.append(f"# {text}: {each.about}\n")
    return lines


def _value_lines(estimate: Estimate, vehicle: Vehicle) -> list[str]:
    """A line for each given parameter, with a comment."""
    known, values = parameters_of(Vehicle), estimate.values
    starts = estimate.problem.simulation.vehicle
    lines = []
    for name, value in vehicle.given.items():
        about = f"{known[name].unit or '-'}: {known[name].description}"
        both = name.partition("_")[2]
        if name in values:
            about = f"identified: {interval_text(estimate, name)} {known[name].unit}".rstrip()
        elif both in values and name.partition("_")[0] in AXLES:
            factor = getattr(starts, name)
            about = f"identified: {interval_text(estimate, both, factor)} {known[name].unit}; both "
            about += "axles by one factor"
        shown = f"{name}: {_yaml(value)}"
        lines.append(f"{shown:{COMMENT_AT}}# {about}\n")
    return lines


def _yaml(value) -> str:
    """A number, or a table as a list of lists."""
    return json.dumps(value) if isinstance(value, tuple) else repr(value)


def _other_lines(vehicle: Vehicle, path: Path, texts: Mapping[str, str]) -> list[str]:
    """The lines of what is no number: switches, payload, model, tires."""
    lines = [f"{name}: {str(getattr(vehicle, name)).lower()}\n" for name in SWITCHES]
    if vehicle.longitudinal:
        lines.append(f"{LONGITUDINAL}: {vehicle.longitudinal}\n")
    if vehicle.payload:
        loads = [json.dumps(dataclasses.asdict(load)) for load in vehicle.payload]
        lines += [f"{PAYLOAD}:\n", *(f"  - {load}\n" for load in loads)]
    if vehicle.model != PAPER:
        lines.append(f"{MODEL}: {json.dumps(vehicle.model)}\n")
    for name in TIRES:
        tire = getattr(vehicle, name)
        if tire is not None:
            file = _file_of(name, path)
            lines.append(f"{name}: {file if file in texts else _named(tire, path)}\n")
    return lines


def _file_of(name: str, path: Path) -> str:
    """The name of the tire file that is written for `tire`, `front_tire` or `rear_tire`."""
    return f"{path.stem}_{name}.tir"


def _named(tire: Tire, path: Path) -> str:
    """How the vehicle file names a tire file that stays where it is."""
    shipped = shipped_tire()
    if (tire.coefficients, tire.side) == (shipped.coefficients, shipped.side):
        return SHIPPED_TIRE
    return json.dumps(os.path.relpath(Path(tire.file).resolve(), path.resolve().parent))


def _tire_texts(estimate: Estimate, vehicle: Vehicle, path: Path) -> dict[str, str]:
    """By name of the file: texts of the tires with identified scaling factors."""
    scaled = {}
    for each in estimate.free:
        head, point, key = each.name.partition(".")
        if point:
            for axle in AXLES if head == "tire" else (head.partition("_")[0],):
                scaled.setdefault(axle, {})[key] = each.name
    texts = {}
    for name in TIRES:
        axle = "front" if name == "tire" else name.partition("_")[0]
        tire = getattr(vehicle, name)
        if tire is not None and axle in scaled:
            keys = {key: tire.coefficients[key] for key in scaled[axle]}
            notes = {key: interval_text(estimate, free) for key, free in scaled[axle].items()}
            texts[_file_of(name, path)] = _scaled(tire, keys, notes)
    return texts


def _scaled(tire: Tire, keys: Mapping[str, float], notes: Mapping[str, str]) -> str:
    """The text of a tire's file with some scaling factors replaced or added."""
    if not tire.file:
        raise InputError("vehicle", "", "a tire that was read from a file", "its tire has no file")
    lines, left, section = [], dict(keys), ""
    for line in read_text(Path(tire.file), encodings=ENCODINGS).splitlines():
        header, entry = HEADER.match(line), KEY.match(line)
        if header and section == SECTION:
            lines += [_tire_line(key, left.pop(key), notes[key]) for key in list(left)]
        section = header["name"].upper() if header else section
        key = entry["key"].upper() if entry else ""
        lines.append(_tire_line(key, left.pop(key), notes[key]) if key in left else line)
    if left and section != SECTION:
        lines.append(f"[{SECTION}]")
    lines += [_tire_line(key, value, notes[key]) for key, value in left.items()]
    return "\n".join(lines) + "\n"


def _tire_line(key: str, value: float, note: str) -> str:
    return f"{f'{key:24} = {value!r}':{COMMENT_AT}}$ identified: {note}"
