"""Vertical force and radii of a tire file: checks, and what the simulation does with them.

A file of 6.1 or 6.2 has

    Fz = F0 (1 + PFZ1 dp) (q1 r / R0 + Q_FZ2 (r / R0)^2),  q1^2 = (Cz R0 / F0)^2 - 4 Q_FZ2,

at standstill and without other forces, with r: compression, Cz: VERTICAL_STIFFNESS, which is the
slope at the nominal load F0 and nominal pressure. The simulation has the force k r (1 + p r), the
same with p = Q_FZ2 / (q1 R0). With Q_FZ2 below 0 it is linear, since the force would decrease again
at large compression.
"""

import math

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.vehicle.tire.curves import pressure_change
from vehicle_roll_sim.vehicle.tire.text import Entry

NOT_SIMULATED = (
    *("Q_FZ1", "Q_FZ3", "Q_V2", "Q_FCX", "Q_FCY", "Q_CAM", "Q_CAM1", "Q_CAM2", "Q_CAM3"),
    *("QV2", "QFZ1", "QFZ2", "QFZ3", "QFCX1", "QFCY1", "QFCG1", "QPFZ1", "LCZ"),
    *("VERTICAL_DAMPING", "BOTTOM_STIFF"),
)
"""Terms of the vertical force in which the simulation differs from the file."""
NEUTRAL = {"LCZ": 1.0}
"""Values with which these terms vanish, other than 0."""
TABLES = ("DEFLECTION_LOAD_CURVE", "BOTTOMING_CURVE")
"""Sections in which Adams files have tables of the vertical force over compression."""
SAME = 0.01
"""Relative: Q_FZ1 is rounded in many files."""
LEAST_RADIUS, MOST_RADIUS = 0.5, 1.5
"""Of the unloaded radius: range of the effective rolling radius."""


def check_vertical(c: dict[str, float], entries: dict[str, Entry]) -> None:
    """Raise InputError for a vertical force or rolling radius that no tire has."""
    size = c["UNLOADED_RADIUS"] * c["VERTICAL_STIFFNESS"]
    most = (size / c["FNOMIN"]) ** 2 / 4
    if "Q_FZ2" in entries and size > 0.0 and c["Q_FZ2"] > most:
        allowed = f"at most {most:g}, at which the linear part of the vertical force vanishes"
        raise InputError(entries["Q_FZ2"].where, c["Q_FZ2"], allowed)
    factor = 1.0 + c["PFZ1"] * pressure_change(c)
    if factor <= 0.0:
        allowed = f"a stiffness above 0 at INFLPRES, at which it is {factor:.3g} of the nominal one"
        raise InputError(entries["PFZ1"].where, c["PFZ1"], allowed)
    if size > 0.0:
        _check_radius(c, entries, c["VERTICAL_STIFFNESS"] * factor)


def _check_radius(c: dict[str, float], entries: dict[str, Entry], stiffness: float) -> None:
    """The effective rolling radius at nominal load must be near the unloaded one."""
    depth = c["DREFF"] * math.atan(c["BREFF"]) + c["FREFF"]
    depth *= c["FNOMIN"] / stiffness / c["UNLOADED_RADIUS"]
    least, most = LEAST_RADIUS, MOST_RADIUS
    for name, speed, radius in (
        ("Q_RE0", "", c["Q_RE0"]),
        ("FREFF" if abs(c["FREFF"]) > abs(c["DREFF"]) else "DREFF", "", c["Q_RE0"] - depth),
        ("Q_V1", " at LONGVL", c["Q_RE0"] + c["Q_V1"] - depth),
    ):
        if name in entries and not least <= radius <= (math.inf if speed else most):
            problem = f"{entries[name].text} makes the rolling radius{speed} {radius:.3g} times "
            problem += "the unloaded radius"
            allowed = f"a value with which it is {least} to {most} times that radius"
            raise InputError(entries[name].where, c[name], allowed, problem)


def compression(c: dict[str, float], load: float, change: float) -> float:
    """Compression of the tire (m) at a load (N) by the terms of the file, at standstill.

    change: relative change of pressure. Without VERTICAL_STIFFNESS or radius, nan.
    """
    nominal, radius = c["FNOMIN"], c["UNLOADED_RADIUS"]
    slope = c["VERTICAL_STIFFNESS"] * radius / nominal
    if not slope > 0.0:
        return math.nan
    relative = load / nominal / (1.0 + c["PFZ1"] * change)
    linear = math.sqrt(slope * slope - 4.0 * c["Q_FZ2"])
    root = math.sqrt(max(linear * linear + 4.0 * c["Q_FZ2"] * relative, 0.0))
    return 2.0 * relative / (linear + root) * radius


def progression(c: dict[str, float]) -> float:
    """p of a tire file (1/m); 0 without radius or VERTICAL_STIFFNESS, or with Q_FZ2 below 0."""
    size = c["VERTICAL_STIFFNESS"] * c["UNLOADED_RADIUS"] / c["FNOMIN"]
    if not (size > 0.0 and c["Q_FZ2"] > 0.0):
        return 0.0
    linear = math.sqrt(max(size * size - 4.0 * c["Q_FZ2"], 0.0))
    return c["Q_FZ2"] / (linear * c["UNLOADED_RADIUS"]) if linear > 0.0 else math.inf


def initial_share(stiffness: float, progression: float, load: float) -> float:
    """Ratio of the stiffness at zero compression to that at a load (N); progression: 1/m.

    stiffness: at the load (N/m).
    """
    ratio = 2.0 * progression * load / stiffness
    return 1.0 / (math.sqrt(1.0 + ratio * ratio) + ratio)


def vertical_notes(
    c: dict[str, float], entries: dict[str, Entry], sections: list[str]
) -> list[str]:
    """A note on the terms and tables of the vertical force that are not simulated."""
    given = [name for name in NOT_SIMULATED if name in entries and _acts(entries[name])]
    if "Q_FZ2" in entries and _acts(entries["Q_FZ2"]) and not progression(c):
        given.insert(0, "Q_FZ2")
    if "Q_FZ1" in given and _follows(c, entries["Q_FZ1"]):
        given.remove("Q_FZ1")
    given += [f"[{name}]" for name in TABLES if name in sections]
    if not given:
        return []
    return [f"vertical force: not simulated: {', '.join(given)}"]


def _follows(c: dict[str, float], entry: Entry) -> bool:
    """Whether Q_FZ1 is the q1 that follows from VERTICAL_STIFFNESS and Q_FZ2."""
    size = c["VERTICAL_STIFFNESS"] * c["UNLOADED_RADIUS"] / c["FNOMIN"]
    linear = math.sqrt(max(size * size - 4.0 * c["Q_FZ2"], 0.0))
    return abs(_number(entry) - linear) <= SAME * linear


def _acts(entry: Entry) -> bool:
    return _number(entry) != NEUTRAL.get(entry.key, 0.0)


def _number(entry: Entry) -> float:
    """The value; nan if it is not a number, which does not matter for a key without effect."""
    try:
        return entry.number()
    except InputError:
        return math.nan
