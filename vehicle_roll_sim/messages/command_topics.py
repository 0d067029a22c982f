"""The topics that the simulator subscribes to: one for each command, and other ways in."""

from vehicle_roll_sim.live.channels import BRAKE, DRIVE, OF_ROAD, WIND, channels
from vehicle_roll_sim.live.command_limits import UNITS
from vehicle_roll_sim.messages.topic import ARRAY, FLOAT, JOINTS, Topic

COMMAND_MEANINGS = {
    "steering_cmd": "road-wheel angle of both front wheels, left positive",
    "rear_steering_cmd": "road-wheel angle of both rear wheels, left positive",
    "wheel_torque_cmd": "external torque at each wheel, signed",
    "brake_torque_cmd": "largest torque that the brake of each wheel can exert, not below 0; it "
    "opposes the spin and holds a wheel that does not turn",
    "normal_force_cmd": "active force at each suspension corner; positive pushes the body up and "
    "the wheel down",
    "speed_cmd": "forward speed for the speed controller; ignored while wheel torques or a drive "
    "torque are commanded",
    "drive_torque_cmd": "total drive torque at the wheels, signed, distributed by the vehicle's "
    "`front_drive_share`; ignored while wheel torques are commanded",
    "brake_cmd": "total brake torque, not below 0, distributed by the vehicle's "
    "`front_brake_share`; ignored while brake torques of wheels are commanded",
    "wind_cmd": "velocity of the air over the ground, along x and y of `odom`; ignored if the "
    "vehicle has no air forces",
    "road_height_cmd": "height of the road under each wheel; ignored unless the road has the "
    "feature commanded",
    "road_friction_cmd": "friction factor of each tire, not below 0; likewise",
}
COMMANDS = tuple(
    Topic(
        name,
        FLOAT if channel.size == 1 else ARRAY,
        depth=1,
        unit=UNITS[channel.limit],
        meaning=COMMAND_MEANINGS[name],
    )
    for name, channel in channels().items()
)
"""What the simulator subscribes to; the depth is that of publishers in this package."""
WAYS_IN = (
    Topic(
        "ackermann_cmd",
        "ackermann_msgs/msg/AckermannDriveStamped",
        depth=1,
        meaning="angle of the front wheels and speed, as `steering_cmd` and `speed_cmd`; where "
        "ackermann_msgs is installed",
    ),
    Topic(
        "cmd_vel",
        "geometry_msgs/msg/TwistStamped",
        depth=1,
        meaning="forward speed and yaw rate, as `speed_cmd` and the `steering_cmd` of a kinematic "
        "bicycle",
    ),
    Topic(
        "joint_commands",
        JOINTS,
        depth=1,
        meaning="positions of steering joints, efforts of wheel joints and of suspension joints, "
        "as commands for these",
    ),
)
"""Other ways in: topics of standard types, each for several of the commands."""
TOTAL_TORQUES = tuple(topic for topic in COMMANDS if channels()[topic.name].field in (DRIVE, BRAKE))
"""Commands that the vehicle distributes to the wheels."""
OF_WIND = tuple(topic for topic in COMMANDS if channels()[topic.name].field == WIND)
"""Commands for vehicles with air forces."""
COMMANDS_OF_ROAD = tuple(t for t in COMMANDS if channels()[t.name].field in OF_ROAD)
"""Commands for roads that take them."""
