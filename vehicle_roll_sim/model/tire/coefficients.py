"""The coefficients of a tire, by their names in the .tir file, as the equations take them."""

from collections import namedtuple

import numpy as np

from vehicle_roll_sim.model.compiled.jit import constants
from vehicle_roll_sim.model.layout import record_dtype
from vehicle_roll_sim.model.records import per_wheel
from vehicle_roll_sim.model.tire.factors import FACTORS


def numbered(prefix: str, *numbers: int) -> tuple[str, ...]:
    """Coefficients that differ in their number."""
    return tuple(f"{prefix}{number}" for number in numbers)


SCALING = (
    *("LFZO", "LCX", "LMUX", "LEX", "LKX", "LHX", "LVX", "LXAL"),
    *("LCY", "LMUY", "LEY", "LKY", "LHY", "LVY", "LYKA", "LVYKA"),
    *("LSGKP", "LSGAL"),
)
REQUIRED = (
    *("FNOMIN", "PCX1", "PDX1", "PKX1", "RBX1", "RCX1"),
    *("PCY1", "PDY1", "PKY1", "PKY2", "RBY1", "RCY1"),
)
OPTIONAL = (
    *("PDX2", "PEX1", "PEX2", "PEX3", "PEX4", "PKX2", "PKX3", "PHX1", "PHX2", "PVX1", "PVX2"),
    *("RBX2", "REX1", "REX2", "RHX1"),
    *("PDY2", "PEY1", "PEY2", "PEY3", "PHY1", "PHY2", "PVY1", "PVY2"),
    *("RBY2", "RBY3", "REY1", "REY2", "RHY1", "RHY2"),
    *("RVY1", "RVY2", "RVY4", "RVY5", "RVY6"),
    *("PTX1", "PTX2", "PTX3", "PTY1", "PTY2"),
)
"""These suffice for the forces and lag of an upright tire at nominal pressure."""
INCLINED = (
    *("LGAX", "LGAY", "LKYC", "PDX3", "RBX3", "PDY3", "PEY4", "PEY5"),
    *numbered("PKY", 3, 4, 5, 6, 7),
    *("PHY3", "PVY3", "PVY4", "RBY4", "RVY3"),
)
"""Terms of the forces that depend on inclination, and PKY4."""
PRESSURE = (*numbered("PPX", 1, 2, 3, 4), *numbered("PPY", 1, 2, 3, 4, 5))
OVERTURNING = ("LMX", "LVMX", *numbered("QSX", *range(1, 15)), "PPMX1")
ROLLING = ("LMY", *numbered("QSY", *range(1, 9)))
ALIGNING = (
    *("LGAZ", "LKZC", "LTR", "LRES", "LS"),
    *numbered("QBZ", 1, 2, 3, 4, 5, 9, 10),
    "QCZ1",
    *numbered("QDZ", 1, 2, 3, 4, 6, 7, 8, 9, 10, 11),
    *numbered("QEZ", 1, 2, 3, 4, 5),
    *numbered("QHZ", 1, 2, 3, 4),
    *("PPZ1", "PPZ2"),
    *numbered("SSZ", 1, 2, 3, 4),
)
RADII = (
    *("UNLOADED_RADIUS", "LONGVL", "VERTICAL_STIFFNESS", "BREFF", "DREFF", "FREFF"),
    *("Q_RE0", "Q_V1", "Q_V2", "Q_FZ2", "Q_FCX", "Q_FCY", "PFZ1"),
    *("Q_FCY2", "Q_CAM1", "Q_CAM2", "Q_CAM3", "Q_FYS1", "Q_FYS2", "Q_FYS3"),
    *("WIDTH", "ASPECT_RATIO"),
)
CARCASS = (
    *("LONGITUDINAL_STIFFNESS", *numbered("PCFX", 1, 2, 3)),
    *("LATERAL_STIFFNESS", *numbered("PCFY", 1, 2, 3)),
)
RANGES = ("KPUMIN", "KPUMAX", "ALPMIN", "ALPMAX", "FZMIN", "FZMAX")
CAMBER_RANGE = ("CAMMIN", "CAMMAX")
STATE_OF_TIRE = (
    *("version", "pressure_change", "pressure_effect", "lowest_weight"),
    *("combined", "moments", "plain", "rolls_on_own_radius", "shared", "from_6_1"),
)
COEFFICIENTS = (
    *(*SCALING, *REQUIRED, *OPTIONAL, *INCLINED, *PRESSURE, *OVERTURNING, *ROLLING, *ALIGNING),
    *(*RADII, *CARCASS, *RANGES, *CAMBER_RANGE),
)

TIRE = record_dtype(*COEFFICIENTS, *STATE_OF_TIRE, *FACTORS, *per_wheel("side"))
"""Coefficients of a tire, by their names in the .tir file, and:

version: of the Magic Formula, 5.2, 6.1 or 6.2. pressure_change: dp. pressure_effect:
(p / p0)^QSY8. lowest_weight: of the forces at combined slip, 0. The others are 1 or 0.
combined: whether slip in one direction reduces the force in the other.
moments: whether moments are computed. plain: whether no term depends on inclination or
pressure and no moment is computed, so that the plain forms suffice. rolls_on_own_radius:
whether the file gives the effective rolling radius. shared: whether both axles have this tire.
from_6_1: whether it is of version 6.1 or 6.2.
FACTORS: see `factors`.
side: -1 at the wheels where the tire is mirrored, else +1.
"""
TIRES = record_dtype(("front", TIRE), ("rear", TIRE))
"""The tires of both axles in one record: compiled code passes records on at less cost than arrays,
whose references it counts."""
NEUTRAL = (
    dict.fromkeys(COEFFICIENTS, 0.0)
    | {name: 1.0 for name in COEFFICIENTS if name.startswith("L") and len(name) < len("LONGVL")}
    | {"PKY4": 2.0, "QSY7": 1.0, "Q_RE0": 1.0}
    | {name: -np.inf if name.endswith("MIN") else np.inf for name in (*RANGES, *CAMBER_RANGE)}
)
"""The value of each coefficient that a version does not have, with which the terms that it lacks
vanish: scaling factors are 1."""

TireConstants = namedtuple("TireConstants", (*SCALING, *REQUIRED, *OPTIONAL))
tire_constants = constants(TireConstants)
"""Copies the coefficients of a TIRE record that the plain forms need."""
AllTireConstants = namedtuple("AllTireConstants", [n for n in TIRE.names if not TIRE[n].shape])
all_tire_constants = constants(AllTireConstants)
"""Copies all scalar fields of a TIRE record."""


def on_axles(front: np.ndarray, rear: np.ndarray) -> np.ndarray:
    """The TIRE records of both axles, shape (2,), from one each, shape (1,)."""
    both = front.tobytes(), rear.tobytes()
    tires = np.frombuffer(bytearray().join(both), TIRE)  # quicker than field by field
    tires["shared"] = both[0] == both[1]
    return tires


def as_one(tires: np.ndarray) -> np.ndarray:
    """TIRE records of both axles, shape (2,), as one TIRES record, shape (1,); not a copy."""
    return tires.view(TIRES)
