"""One value to be identified."""

import dataclasses


@dataclasses.dataclass(frozen=True)
class Free:
    """One value to be identified.

    start, lower, upper: in `unit`. scale: a change that matters, above 0: the start itself, unless
    it is 0. about: what it is. is_reading: whether it only changes how a sensor reads what the
    model does, so that no run is needed for it.
    """

    name: str
    start: float
    lower: float
    upper: float
    scale: float
    unit: str
    about: str
    is_reading: bool = False
