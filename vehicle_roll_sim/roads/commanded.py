"""A road whose heights and frictions come with the commands."""

import dataclasses

NOT_COMMANDED = "no value, since the road has no feature `commanded`"
"""The allowed value on other roads."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class Commanded:
    """Heights and friction under the wheels are commands, as on a four-post test rig.

    The heights are added to those of the other features, the friction factors are multiplied. The
    road is level under each wheel.
    """
