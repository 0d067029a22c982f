"""A vehicle with all sensors, each with its own errors."""

from vehicle_roll_sim import Vehicle, preset

SENSORS = {
    "imu_x": 0.4,
    "imu_y": -0.3,
    "imu_z": 0.2,
    "imu_yaw": 1.5,
    "imu_misalignment_pitch": 0.02,
    "imu_delay": 0.03,
    "imu_dropout": 0.2,
    "accelerometer_noise_density": 0.002,
    "gyro_bias_walk": 0.001,
    "gyro_bias_z": 0.01,
    "imu_orientation_noise_density": 1e-4,
    "wheel_speed_sensor_period": 0.003,
    "wheel_speed_sensor_noise_density": 0.01,
    "wheel_speed_sensor_scale_error": 0.01,
    "steering_sensor_resolution": 0.002,
    "odom_period": 0.05,
    "odom_delay": 0.05,
    "odom_position_noise_density": 0.1,
    "odom_orientation_bias_walk": 0.001,
    "sensor_seed": 17.0,
}


def measured(name: str = "reference", **values: float) -> Vehicle:
    """A vehicle of the presets with these sensors, and further values."""
    return preset(name).with_values(SENSORS | values)
