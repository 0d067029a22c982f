"""The robot description, moved by the messages, agrees with the motion of the model."""

from xml.etree import ElementTree

import numpy as np
import pytest
from nav_msgs.msg import Odometry
from rclpy.serialization import deserialize_message
from scipy.spatial.transform import Rotation
from sensor_msgs.msg import JointState

from vehicle_roll_sim import WHEELS, Command, Options, Simulation, Vehicle, preset
from vehicle_roll_sim.live.command_inbox import CommandInbox
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.messages.sets import Messages
from vehicle_roll_sim.messages.urdf import COLOURS, urdf
from vehicle_roll_sim.ros.encoding import encode

ROUNDING = 1e-9
"""Tolerance (m): numbers are written with ten digits."""
STEP = 1e-4
"""s"""
TURNS = {"front": (0.2, 0.0), "rear": (0.0, -0.2)}
"""Steering in front and at the rear (rad) in a turn to the left in which the inner wheels lift."""


class Picture:
    """A robot description with joints and base positioned by messages."""

    def __init__(self, session: Session, description: str):
        messages = Messages(session.simulation, "", encode)
        joints = deserialize_message(messages.joint_states(), JointState)
        pose = deserialize_message(messages.odom(), Odometry).pose.pose
        self.robot = ElementTree.fromstring(description.encode())
        self._joints = {j.find("child").get("link"): j for j in self.robot.findall("joint")}
        self._moved = dict(zip(joints.name, joints.position, strict=True))
        q = pose.orientation
        self._base = np.eye(4)
        self._base[:3, :3] = Rotation.from_quat([q.x, q.y, q.z, q.w]).as_matrix()
        self._base[:3, 3] = pose.position.x, pose.position.y, pose.position.z

    def link(self, name: str) -> np.ndarray:
        """Pose of a link in `odom`, a 4 x 4 matrix."""
        if name == "base_link":
            return self._base
        joint = self._joints[name]
        moved = np.eye(4)
        moved[:3, 3] = numbers(joint.find("origin"), "xyz")
        position = self._moved.get(joint.get("name"), 0.0)
        motion = np.eye(4)
        if joint.get("type") == "prismatic":
            motion[:3, 3] = position * numbers(joint.find("axis"), "xyz")
        elif joint.get("type") != "fixed":
            turn = position * numbers(joint.find("axis"), "xyz")
            motion[:3, :3] = Rotation.from_rotvec(turn).as_matrix()
        return self.link(joint.find("parent").get("link")) @ moved @ motion

    def clearance(self, wheel: str) -> float:
        """Height of the wheel centre above the ground minus the wheel radius (m)."""
        cylinder = self.robot.find(f"link[@name='{wheel}_wheel_link']//cylinder")
        return float(self.link(f"{wheel}_wheel_link")[2, 3]) - float(cylinder.get("radius"))


def numbers(element: ElementTree.Element, attribute: str) -> np.ndarray:
    return np.array([float(number) for number in element.get(attribute).split()])


def session_of(options: Options | None = None, vehicle: Vehicle | None = None) -> Session:
    simulation = Simulation(vehicle or preset(), options, step=STEP)
    return Session(simulation, CommandInbox(), 10_000_000, 13.9)


def test_at_rest_every_wheel_stands_on_the_ground_by_its_tires_compression():
    session = session_of()
    picture = Picture(session, urdf(preset()))
    expected = (1440 * 9.81 / 4 + 80 * 9.81) / 200_000  # m: a quarter of the body, were it even
    found = [-picture.clearance(wheel) for wheel in WHEELS]
    assert np.mean(found) == pytest.approx(expected, abs=ROUNDING)
    assert found == pytest.approx(preset().static_tire_compression, abs=ROUNDING)


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("steered", TURNS)
def test_in_a_roll_a_wheel_leaves_the_ground_exactly_when_it_has_lifted(steered, side):
    """Steered at either axle, to either side, until rollover."""
    session, description = session_of(), urdf(preset())
    front, rear = TURNS[steered]
    command = Command(steering=side * front, rear_steering=side * rear)
    lifted = np.zeros(4, dtype=bool)
    for _ in range(100):
        session.simulation.step(command, 0.03)
        picture = Picture(session, description)
        compression = session.simulation.state.tire_compression
        clearance = np.array([picture.clearance(wheel) for wheel in WHEELS])
        assert clearance == pytest.approx(-compression, abs=ROUNDING)
        off = session.simulation.outputs.normal_force == 0.0
        certain = abs(compression) > ROUNDING
        assert ((clearance > 0.0) == off)[certain].all()
        lifted |= off
    assert lifted[[0, 2] if side > 0.0 else [1, 3]].all()
    assert abs(session.simulation.state.roll) > 1.0


GUIDED_WHEELS = {
    "front_camber": 0.02,
    "front_camber_change": ((-0.2, 0.15), (0.0, 0.0), (0.2, -0.1)),
    "front_longitudinal_change": 0.2,
    "front_toe_change": -0.3,
    "front_carrier_pitch_change": 0.8,
    "rear_camber_change": 2.0,
    "rear_toe_change": 0.4,
    "rear_half_track_change": 0.5,
}
MODEL_2 = Options(model="2")


def test_in_model_2_wheels_follow_their_paths_and_lean():
    """The lowest point of each disc is above the road by minus its tire's compression."""
    session = session_of(MODEL_2, preset().with_values(GUIDED_WHEELS))
    description = urdf(session.simulation.vehicle, MODEL_2)
    radius, leans = 0.285, []
    for _ in range(100):
        session.simulation.step(Command(steering=0.2, rear_steering=-0.05), 0.02)
        picture, state = Picture(session, description), session.simulation.state
        poses = [picture.link(f"{wheel}_wheel_link") for wheel in WHEELS]
        lowest = [pose[2, 3] - radius * np.sqrt(1 - pose[2, 1] ** 2) for pose in poses]
        assert lowest == pytest.approx(-state.tire_compression, abs=ROUNDING)
        leans.append([np.arcsin(pose[2, 1]) for pose in poses])
        expected = np.tan(session.simulation.outputs.inclination)
        assert np.tan(leans[-1]) == pytest.approx(expected, abs=ROUNDING)
    assert abs(np.ptp(leans, axis=0)).min() > 0.2  # rad


def test_in_model_2_the_velocities_of_the_joints_are_the_rates_of_their_positions():
    simulation = session_of(MODEL_2, preset().with_values(GUIDED_WHEELS)).simulation
    simulation.step(Command(steering=0.2), 0.4)
    before, middle, after = joints_of(simulation, 3)
    rate = (np.array(after.position) - before.position) / 2e-4  # two steps of 0.1 ms
    steered = ["steering" in name for name in middle.name]
    assert np.abs(middle.velocity).max() > 1.0
    moved = np.where(steered, 0.0, middle.velocity)
    assert moved == pytest.approx(np.where(steered, 0.0, rate), abs=1e-4)


def joints_of(simulation: Simulation, count: int) -> list[JointState]:
    """The joints now and after further steps, with the steering held."""
    found = []
    for _ in range(count):
        messages = Messages(simulation, "", encode)
        found.append(deserialize_message(messages.joint_states(), JointState))
        simulation.step(Command(steering=0.2), 1e-4)
    return found


def test_wheels_steer_and_spin():
    session = session_of()
    session.simulation.step(Command(steering=0.1, rear_steering=-0.05), 0.05)
    picture, state = Picture(session, urdf(preset())), session.simulation.state
    for i, (wheel, steered) in enumerate(zip(WHEELS, (0.1, 0.1, -0.05, -0.05), strict=True)):
        knuckle = picture.link(f"{wheel}_steering_link")[:3, :3]
        in_body = picture.link("base_link")[:3, :3].T @ knuckle
        assert Rotation.from_matrix(in_body).as_rotvec() == pytest.approx([0, 0, steered])
        spun = knuckle.T @ picture.link(f"{wheel}_wheel_link")[:3, :3]
        turns = Rotation.from_matrix(spun).as_rotvec()
        ahead = Rotation.from_rotvec([0.0, state.wheel_angle[i], 0.0]).as_rotvec()
        assert turns == pytest.approx(ahead)
        assert spun[0, 2] > 0.0  # the spoke, which began upwards, leans ahead: it rolls forwards


def test_every_part_has_a_colour_and_every_wheel_a_mark_that_is_not_round():
    robot = ElementTree.fromstring(urdf(preset()).encode())
    assert {m.get("name") for m in robot.findall("material")} == set(COLOURS)
    used = {visual.find("material").get("name") for visual in robot.iter("visual")}
    assert used == set(COLOURS)
    for wheel in WHEELS:
        visuals = robot.findall(f"link[@name='{wheel}_wheel_link']/visual")
        materials = {visual.find("material").get("name") for visual in visuals}
        assert materials == {"rubber", "spoke"}
        assert visuals[1].find("geometry/box") is not None
        assert numbers(visuals[1].find("origin"), "xyz")[2] > 0.0


def test_without_suspension_the_wheels_are_where_they_stand_at_rest():
    robot = ElementTree.fromstring(urdf(preset(), Options(model="8dof")).encode())
    rest = ElementTree.fromstring(urdf(preset()).encode())
    for wheel in WHEELS:
        path = f"joint[@name='{wheel}_suspension_joint']/origin"
        assert robot.find(path).attrib == rest.find(path).attrib
