"""A vehicle whose commands all pass through actuators of different kinds."""

from vehicle_roll_sim import Vehicle, preset

ACTUATORS = {
    "steering_actuator_frequency": 6.0,
    "steering_actuator_damping": 0.6,
    "steering_actuator_rate_limit": 0.5,
    "rear_steering_actuator_dead_time": 0.013,
    "wheel_torque_actuator_time_constant": 0.1,
    "brake_torque_actuator_time_constant": 0.05,
    "brake_torque_actuator_dead_time": 0.03,
    "normal_force_actuator_resolution": 2.0,
}


def actuated(name: str = "reference", **values: float) -> Vehicle:
    """A vehicle of the presets with these actuators, and further values."""
    return preset(name).with_values(ACTUATORS | values)
