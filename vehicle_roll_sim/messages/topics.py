"""Every topic of the package: name, type, QoS, unit and meaning.

Nodes, bags and the documentation take them from here.
"""

import dataclasses
from collections.abc import Collection

from vehicle_roll_sim.live.channels import BRAKE, DRIVE, OF_ROAD, WIND, channels
from vehicle_roll_sim.live.command_limits import UNITS
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.sensor_parameters import IMU, ODOMETRY, STEERING, WHEEL_SPEEDS


@dataclasses.dataclass(frozen=True)
class Topic:
    """A topic: reliable, keep last `depth`; transient local if latched, else volatile.

    unit: that of its values, '' if they have none or several. meaning: what it carries, in one
    phrase; a value for each wheel is in the order lf, rf, lr, rr.
    """

    name: str
    type: str
    latched: bool = False
    depth: int = 10
    unit: str = dataclasses.field(default="", compare=False)
    meaning: str = dataclasses.field(default="", compare=False)


FLOAT, ARRAY = "std_msgs/msg/Float64", "std_msgs/msg/Float64MultiArray"
FLAGS, TEXT = "std_msgs/msg/UInt8MultiArray", "std_msgs/msg/String"
JOINTS = "sensor_msgs/msg/JointState"
WRENCH = "geometry_msgs/msg/WrenchStamped"


def _latched(name: str, kind: str, meaning: str) -> Topic:
    return Topic(name, kind, latched=True, depth=1, meaning=meaning)


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
STATE_SET = (
    Topic("state", ARRAY, meaning="time since the reset, then the states of the model"),
    Topic(
        "applied_command",
        ARRAY,
        meaning="the commands that were applied in the period that ends with this set, after "
        "limits and timeouts; with actuators what they let act at its end, and then what was "
        "demanded of them",
    ),
    Topic(
        "odom",
        "nav_msgs/msg/Odometry",
        meaning="pose of base_link, the sprung c.g., in `odom`; twist in base_link",
    ),
    Topic(
        "imu",
        "sensor_msgs/msg/Imu",
        meaning="attitude, body rates and specific force in base_link (REP-145: +g on z at rest)",
    ),
    Topic(
        "joint_states",
        JOINTS,
        meaning="position and velocity of the suspension, steering and wheel joints",
    ),
    Topic("tire_normal_forces", ARRAY, unit="N", meaning="normal load Fz of each tire"),
    *(
        Topic(
            f"tire_forces/{wheel}",
            WRENCH,
            unit="N",
            meaning=f"contact force of tire {wheel} in base_footprint; the torque is 0",
        )
        for wheel in WHEELS
    ),
    Topic("lift_off", FLAGS, meaning="for each tire: 1 if its Fz is 0, else 0"),
    Topic(
        "load_transfer_ratio",
        FLOAT,
        meaning="(right - left) / total normal load, 0 when no tire carries load",
    ),
    Topic("motion", ARRAY, meaning="signals for handling controllers in one message"),
)
"""The topics of every set, published each period in this order, beginning with `state`."""
ROLL_CENTRE = Topic(
    "roll_centre",
    ARRAY,
    unit="m",
    meaning="with model 2: height of each axle's roll centre above the road, and its place to the "
    "left of the c.g.; nan where there is none",
)
"""Also part of the set in models whose roll centres move with the suspension."""
BODY_LOADS = Topic(
    "body_loads",
    ARRAY,
    unit="N",
    meaning="with `body_contact`: normal load on each corner of the body",
)
"""Also part of the set if the body may touch the ground."""
MEASUREMENTS = Topic(
    "measurements",
    ARRAY,
    meaning="with sensors: time since the reset, then their last readings",
)
"""Also part of the set if the vehicle has sensors."""
ACTUATORS = Topic(
    "actuators",
    ARRAY,
    meaning="with actuators: time since the reset, then their states: outputs of the rate "
    "limiters, outputs of the lags, and rates of the latter",
)
"""Also part of the set if the vehicle has actuators."""
MEASURED_BY = {"odom": (ODOMETRY,), "imu": (IMU,), "joint_states": (WHEEL_SPEEDS, STEERING)}
"""The topics that have the readings of devices, if the vehicle has these."""
TRUTH = "ground_truth/"
GROUND_TRUTH = tuple(
    Topic(
        f"{TRUTH}{topic.name}",
        topic.type,
        meaning=f"with sensors, if they measure what `{topic.name}` has: the truth",
    )
    for topic in STATE_SET
    if topic.name in MEASURED_BY
)
"""Also part of the set if devices measure what these topics have."""
OF_SOME_SETS = (ROLL_CENTRE, BODY_LOADS, MEASUREMENTS, ACTUATORS, *GROUND_TRUTH)
"""The topics of a set that depend on model and vehicle, besides the stamped ones."""
STAMPED_ENDING = "_stamped"
SIGNALS = Topic(
    f"signals{STAMPED_ENDING}",
    JOINTS,
    meaning="the most frequently plotted quantities: values in `position`, their names in `name`",
)
STAMPED = (
    *(
        Topic(
            topic.name + STAMPED_ENDING,
            JOINTS,
            unit=topic.unit,
            meaning=f"`{topic.name}` with a header: values in `position`, their names in `name`",
        )
        for topic in (*STATE_SET, ROLL_CENTRE, BODY_LOADS, MEASUREMENTS, ACTUATORS)
        if topic.type in (FLOAT, ARRAY, FLAGS)
    ),
    SIGNALS,
)
"""Also part of the set with `publish_stamped`: topics without a header, with a header and names.

The last one has no version without a header. JointState is the only standard message with a header
and named numbers, and plotting and bag tools show the numbers by these names."""
TRANSFORMS = Topic(
    "/tf",
    "tf2_msgs/msg/TFMessage",
    meaning="transforms from `odom` to base_link and base_footprint",
)
"""Also part of the set, if its type is installed."""
CLOCK = Topic("/clock", "rosgraph_msgs/msg/Clock", meaning="simulated time")
"""Published before each set, if stamps are simulated time."""
ROLLOVER = _latched("rollover", "std_msgs/msg/Bool", "true from a rollover until a reset")
ROBOT_DESCRIPTION = _latched(
    "robot_description", TEXT, "URDF, generated from the vehicle's parameters"
)
SIMULATION_DESCRIPTION = _latched(
    "simulation_description", TEXT, "JSON from which the simulation can be rebuilt"
)
ROAD = _latched(
    "road",
    "visualization_msgs/msg/Marker",
    "surface of a road with features, in `odom`: triangles, coloured by friction",
)
"""Only if the road has such features, and if its type is installed."""
DIAGNOSTICS = Topic(
    "/diagnostics",
    "diagnostic_msgs/msg/DiagnosticArray",
    meaning="status of the simulator, once per second",
)

PUBLISHED = (
    *STATE_SET,
    *OF_SOME_SETS,
    ROLLOVER,
    ROBOT_DESCRIPTION,
    SIMULATION_DESCRIPTION,
    ROAD,
    DIAGNOSTICS,
    CLOCK,
    TRANSFORMS,
)


def set_of(
    options: Options, stamped: bool, devices: Collection[str] = (), actuated: bool = False
) -> tuple[Topic, ...]:
    """The topics of a set of a model, in order.

    stamped: with those of `publish_stamped`. devices: names of those of the vehicle's sensors.
    actuated: whether it has actuators.
    """
    measured = {TRUTH + name for name, by in MEASURED_BY.items() if not {*by}.isdisjoint(devices)}
    topics = (
        *STATE_SET,
        *((ROLL_CENTRE,) if options.is_kinematic else ()),
        *((BODY_LOADS,) if options.body_contact else ()),
        *((MEASUREMENTS,) if devices else ()),
        *((ACTUATORS,) if actuated else ()),
        *(topic for topic in GROUND_TRUTH if topic.name in measured),
    )
    if not stamped:
        return topics
    names = {SIGNALS.name, *(topic.name + STAMPED_ENDING for topic in topics)}
    return (*topics, *(topic for topic in STAMPED if topic.name in names))
