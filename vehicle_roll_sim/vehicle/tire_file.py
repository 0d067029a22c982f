"""Tires of the Magic Formula 5.0 to 6.2, as read from tire property files (.tir)."""

import dataclasses
import functools
from pathlib import Path

import numpy as np

from vehicle_roll_sim.declaration import InputError, number_of, unknown_name
from vehicle_roll_sim.vehicle.tire.checks import PRESSURE_RATIO
from vehicle_roll_sim.vehicle.tire.keys import ALL, KEYS, SIMULATED, defaults, is_neutral
from vehicle_roll_sim.vehicle.tire.reading import tire_data
from vehicle_roll_sim.vehicle.tire_record import MIRRORED, tire_record

SIDES = tuple(MIRRORED)
DEFAULTS = defaults()
"""Values of coefficients that a tire does not have, with which their terms vanish."""


@dataclasses.dataclass(frozen=True)
class Tire:
    """A Magic Formula tire.

    coefficients: by their names in the .tir file, in SI units and ISO signs; those not given have
    their neutral values. side: the side of the vehicle on which the tire was measured, left or
    right, or symmetric. file: where it was read from. version: of the Magic Formula, 5.2 (for 5.0
    to 5.2), 6.1 or 6.2. combined: whether slip in one direction reduces the force in the other.
    notes: decisions made when the file was read, and warnings, one line each.

    Raises InputError for a coefficient that is unknown, not a number, or not part of the version,
    and for an invalid side or version.
    """

    coefficients: dict[str, float]
    side: str = "left"
    file: str = ""
    version: str = "5.2"
    combined: bool = True
    notes: tuple[str, ...] = dataclasses.field(default=(), compare=False)

    def __post_init__(self):
        for name in self.coefficients:
            if name not in SIMULATED:
                raise unknown_name(str(name), SIMULATED, "coefficient")
        numbers = {n: number_of(v, n, "a number") for n, v in self.coefficients.items()}
        if self.side not in SIDES:
            raise InputError("side", self.side, " or ".join(SIDES))
        if self.version not in ALL:
            raise InputError("version", self.version, " or ".join(ALL))
        for name, value in numbers.items():
            if self.version not in KEYS[name].acts and not is_neutral(name, value):
                allowed = f"{KEYS[name].default:g} in a tire of version {self.version}"
                raise InputError(name, value, allowed)
        object.__setattr__(self, "coefficients", DEFAULTS | numbers)

    def record(self, pressure: float | None = None, moments: bool = False) -> np.ndarray:
        """The tire as input to the equations: an array of one TIRE record, shape (1,).

        pressure: inflation pressure (Pa); None: that of the file, else the nominal one. moments:
        whether moments are computed.
        """
        return self.shared_record(pressure, moments).copy()

    def shared_record(self, pressure: float | None = None, moments: bool = False) -> np.ndarray:
        """The same array as `record` each time, not to be changed: vehicles share tires."""
        key = pressure, moments
        if key not in self._records:
            given = (self.coefficients, self.version, self.side, pressure)
            self._records[key] = tire_record(*given, combined=self.combined, moments=moments)
            self._records[key].flags.writeable = False
        return self._records[key]

    @functools.cached_property
    def _records(self) -> dict[tuple[float | None, bool], np.ndarray]:
        return {}

    def check_pressure(self, pressure: float, field: str) -> None:
        """Raise InputError naming `field` for a pressure (Pa) beyond what it is made for."""
        if self.version == "5.2":
            allowed = "no pressure for a file of Magic Formula 5.2, which has none"
            raise InputError(field, pressure, allowed)
        nominal = self.coefficients["NOMPRES"]
        if not nominal > 0.0:
            raise InputError(field, pressure, "no pressure, since the tire file has no NOMPRES")
        if not nominal / PRESSURE_RATIO <= pressure <= nominal * PRESSURE_RATIO:
            allowed = f"from 1/{PRESSURE_RATIO} to {PRESSURE_RATIO} times NOMPRES, {nominal:g} Pa"
            raise InputError(field, pressure, allowed)

    def with_coefficients(self, **values: float) -> "Tire":
        """A copy with some coefficients replaced."""
        return dataclasses.replace(self, coefficients=self.coefficients | values)


def load_tire(path: str | Path, longitudinal: str = "") -> Tire:
    """Read a tire property file (.tir); raises InputError naming file, line and key.

    longitudinal: `from_lateral` derives the longitudinal force of a file with lateral force only
    from the lateral force (see vehicle/tire/lateral_only.py).
    """
    path = Path(path)
    data = tire_data(path, longitudinal)
    return Tire(data.coefficients, data.side, str(path), data.version, data.combined, data.notes)
