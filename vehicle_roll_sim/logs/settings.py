"""What a user chooses about a log."""

import dataclasses

from vehicle_roll_sim.declaration import keep_validated, parameter
from vehicle_roll_sim.input_errors import InputError


@dataclasses.dataclass(frozen=True)
class Conditioning:
    """Which part of a log is used, and how it is filtered."""

    begin: float = parameter(
        "use the log from this time after its first row on", "s", 0.0, 1e6, default=0.0
    )
    end: float | None = parameter(
        "use the log up to this time after its first row",
        "s",
        0.0,
        1e6,
        none="its last row",
        default=None,
    )
    cutoff: float | None = parameter(
        "cutoff of the low-pass filter of measured and simulated signals; 0: no filter",
        "Hz",
        0.0,
        1e3,
        none="10 Hz, or 0.4 times the sampling rate of a slow log",
        default=None,
    )

    def __post_init__(self):
        keep_validated(self)
        if self.end is not None and not self.begin < self.end:
            raise InputError("end", self.end, f"more than begin, {self.begin:g}")
