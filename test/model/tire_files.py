"""Tire files to be changed at will, and what the oracle and the package make of them."""

import functools
import re
from pathlib import Path

import magic_formula
import numpy as np

from vehicle_roll_sim.vehicle.tire_evaluation import TireForces, evaluate
from vehicle_roll_sim.vehicle.tire_file import Tire, load_tire

DATA = Path(__file__).parent / "tire" / "data"
NAMES = ("mf52_full", "mf61", "mf62")
"""Files of 5.2, 6.1 and 6.2 in which every coefficient counts."""
TOLERANCE = 1e-9
"""Relative to the largest value of a force, a moment or a radius over all points."""
ENTRY = re.compile(r"(\w+)( *= *)(\S+)$")
TEXTS = ("FILE_TYPE", "FILE_VERSION", "FILE_FORMAT", "FITTYP", "TYRESIDE")


@functools.cache
def text_of(name: str) -> str:
    return (DATA / f"{name}.tir").read_text(encoding="utf-8")


def numbers_of(name: str) -> dict[str, float]:
    """The numbers of a file by key, as they are written, without those that say what it is."""
    found = (ENTRY.match(line) for line in text_of(name).splitlines())
    pairs = [(each[1], each[3]) for each in found if each]
    return {
        k: float(v) for k, v in pairs if k not in (*TEXTS, "MASS") and magic_formula.is_number(v)
    }


def changed(text: str, values: dict) -> str:
    """The text with other values behind some keys."""
    for key, value in values.items():
        text, count = re.subn(rf"(?m)^({key} *= *)\S+$", rf"\g<1>{value}", text)
        assert count == 1, key
    return text


def points_for(p, seed: int, count: int = 48) -> dict[str, np.ndarray]:
    """Loads, slips and all else a tire may meet, within and a little beyond what it is made for."""
    rng = np.random.default_rng(seed)
    points = {
        "normal_force": rng.uniform(0.1, 2.2, count) * p["FNOMIN"],
        "slip_ratio": rng.uniform(-0.85, 1.5, count),
        "slip_angle": rng.uniform(-1.2, 1.2, count),
        "inclination": rng.uniform(-0.2, 0.2, count),
        "speed": rng.uniform(10.0, 50.0, count),
        "side": rng.choice(["left", "right"], count),
    }
    for name, share in (("slip_ratio", 0.1), ("slip_angle", 0.1)):  # half of them at little slip
        points[name][: count // 2] *= share
    if p.version != "5.2":
        points["pressure"] = rng.choice([0.85, 1.0, 1.2], count) * p["NOMPRES"]
    return points


def of_the_oracle(path: Path, points: dict[str, np.ndarray]) -> magic_formula.Forces:
    """What a file says if it is taken at its word."""
    p, made_for = magic_formula.read(path)
    others = dict(points)
    mirrored = others.pop("side") != made_for
    load, kappa, alpha, camber = (
        others.pop(k) for k in ("normal_force", "slip_ratio", "slip_angle", "inclination")
    )
    with np.errstate(all="ignore"):  # what a file lacks may be divided by
        return magic_formula.evaluate(p, load, kappa, alpha, camber, mirrored=mirrored, **others)


def of_the_package(path: Path, points: dict[str, np.ndarray]) -> TireForces:
    """What this package makes of a file; raises InputError if it is refused."""
    return evaluated(load_tire(path), points)


def evaluated(tire: Tire, points: dict[str, np.ndarray]) -> TireForces:
    """What a tire does at points whose pressures and sides differ."""
    columns = dict(points)
    count = len(columns["side"])
    found = np.empty((len(TireForces._fields), count))
    sides, pressures = columns.pop("side"), columns.pop("pressure", np.full(count, None))
    for side, pressure in set(zip(sides.tolist(), pressures.tolist(), strict=True)):
        chosen = (sides == side) & (pressures == pressure)
        at = {name: values[chosen] for name, values in columns.items()}
        found[:, chosen] = evaluate(tire, **at, side=side, pressure=pressure)
    return TireForces(*found)


def worst(mine: TireForces, expected: magic_formula.Forces) -> dict[str, float]:
    """The largest difference of each quantity, relative to its largest value.

    inf where only one of the two has a number.
    """
    differences = {}
    for name, values in expected._asdict().items():
        own, is_known = getattr(mine, name), np.isfinite(values)
        if (np.isfinite(own) != is_known).any():
            differences[name] = np.inf
            continue
        off = np.abs(own - values)[is_known].max(initial=0.0)
        differences[name] = float(off / (np.abs(values[is_known]).max(initial=0.0) or 1.0))
    return differences
