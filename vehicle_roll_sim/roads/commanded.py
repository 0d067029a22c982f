"""A road whose heights and frictions come with the commands."""

import dataclasses

NOT_COMMANDED = "no value, since the road has no feature `commanded`"
"""What is allowed on other roads."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class Commanded:
    """The heights under the wheels and their friction are commands, as on a test rig with posts.

    They are added to those of the other features, and multiplied with them. The road is level under
    each wheel.
    """
