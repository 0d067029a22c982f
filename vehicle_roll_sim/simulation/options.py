"""Options of the model, declared once for Python, the command line and the node."""

import dataclasses

import numpy as np

from vehicle_roll_sim.declaration import parameter, validated
from vehicle_roll_sim.model.records import OPTIONS


@dataclasses.dataclass(frozen=True)
class Options:
    """Variants of the equations. All off: the source's model 1."""

    no_roll_centre: bool = parameter(
        "lateral link forces act at the strut top (eq. 24 for 25), no link load transfer",
        default=False,
    )
    euler_terms: bool = parameter(
        "the gyroscopic terms that the source leaves out of equations 32 to 34", default=False
    )

    def __post_init__(self):
        validated(Options, dataclasses.asdict(self))

    def record(self) -> np.ndarray:
        """The options as the equations take them: one OPTIONS record in an array."""
        options = np.zeros(1, OPTIONS)
        for name, value in dataclasses.asdict(self).items():
            options[name] = value
        return options
