"""Every topic that the package publishes; those of commands are in `command_topics`.

Nodes, bags and the documentation take them from here.
"""

from collections.abc import Collection

from vehicle_roll_sim.messages.topic import ARRAY, FLAGS, FLOAT, JOINTS, TEXT, WRENCH, Topic
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.sensor_parameters import IMU, ODOMETRY, STEERING, WHEEL_SPEEDS


def _latched(name: str, kind: str, meaning: str) -> Topic:
    return Topic(name, kind, latched=True, depth=1, meaning=meaning)


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
