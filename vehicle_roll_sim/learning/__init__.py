"""Reinforcement learning: the gymnasium environment VehicleRoll-v0, which this import registers."""

from vehicle_roll_sim.input_errors import InputError

try:
    import gymnasium
except ModuleNotFoundError as error:
    if error.name != "gymnasium":
        raise
    INSTALL = "pip install gymnasium, the extra `gym` of vehicle_roll_sim"
    raise InputError("VehicleRoll-v0", "", INSTALL, "no Python package gymnasium") from None

ENVIRONMENT = "VehicleRoll-v0"

if ENVIRONMENT not in gymnasium.registry:
    gymnasium.register(
        ENVIRONMENT,
        entry_point=f"{__name__}.environment:VehicleRollEnv",
        vector_entry_point=f"{__name__}.vector_environment:VehicleRollVectorEnv",
    )
