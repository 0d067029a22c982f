"""All keys of tire files of the Magic Formula 5.0 to 6.2, including those of MF-Swift and Adams."""

from vehicle_roll_sim.vehicle.tire.force_keys import FORCES
from vehicle_roll_sim.vehicle.tire.general_keys import GENERAL, HIGHEST, LOWEST
from vehicle_roll_sim.vehicle.tire.idle_keys import IDLE
from vehicle_roll_sim.vehicle.tire.key import ALL, Key
from vehicle_roll_sim.vehicle.tire.moment_keys import MOMENTS

KEYS: dict[str, Key] = GENERAL | FORCES | MOMENTS | IDLE
COEFFICIENTS = {v: tuple(n for n, key in KEYS.items() if v in key.acts) for v in ALL}
"""Names of the coefficients of each version that are simulated."""
SIMULATED = tuple(name for name, key in KEYS.items() if key.acts)
NUMERIC = tuple(name for name, key in KEYS.items() if key.acts or not key.idle)
"""Keys whose value is read as a number."""
MATTERING = (
    *NUMERIC,
    *("PROPERTY_FILE_FORMAT", "FITTYP", "TYRESIDE", "USE_MODE", "FE_METHOD", "SIGN_CONVENTION"),
)
"""Keys that change what is simulated."""
LONGITUDINAL = ("PCX1", "PDX1", "PKX1")
COMBINED = ("RBX1", "RCX1", "RBY1", "RCY1")
LATERAL = ("PCY1", "PDY1", "PKY1", "PKY2")
REQUIRED = ("FNOMIN", *LONGITUDINAL, *LATERAL, *COMBINED)
"""Required coefficients; COMBINED only for combined slip."""
RANGES = tuple(end for pair in zip(LOWEST, HIGHEST, strict=True) for end in pair)
"""Lowest and highest value of each range, alternating."""
OTHER_NEUTRAL = {"QSY7": (0.0,)}
"""Further values with which a term vanishes: in Adams the load is a separate factor."""


def defaults() -> dict[str, float]:
    """Values of coefficients missing from a file, with which their terms vanish."""
    return {name: KEYS[name].default for name in SIMULATED}


def is_neutral(name: str, value: float) -> bool:
    """Whether the term of a coefficient vanishes with this value."""
    return value == KEYS[name].default or value in OTHER_NEUTRAL.get(name, ())
