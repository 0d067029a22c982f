"""The coefficients of a tire, by their names in the .tir file, as the equations take them."""

from collections import namedtuple

import numpy as np

from vehicle_roll_sim.model.compiled.jit import constants
from vehicle_roll_sim.model.records import FRONT, REAR, per_wheel, record_dtype

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
RANGES = ("KPUMIN", "KPUMAX", "ALPMIN", "ALPMAX", "FZMIN", "FZMAX")

TIRE = record_dtype(*SCALING, *REQUIRED, *OPTIONAL, *RANGES, "shared", *per_wheel("side"))
"""Coefficients of a tire. shared: 1 if both axles have this tire, else 0. side: -1 at the wheels
where the tire is mirrored, else +1."""

TireConstants = namedtuple("TireConstants", (*SCALING, *REQUIRED, *OPTIONAL))
tire_constants = constants(TireConstants)
"""Copies the coefficients of a TIRE record."""


def on_axles(front: np.ndarray, rear: np.ndarray) -> np.ndarray:
    """The TIRE records of both axles, shape (2,), from one each, shape (1,)."""
    tires = np.concatenate((front, rear))
    tires["shared"] = tires[FRONT].tobytes() == tires[REAR].tobytes()
    return tires
