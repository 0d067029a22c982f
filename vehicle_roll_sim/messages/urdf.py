"""The robot description (URDF) of a vehicle, built from its parameters, for RViz and Foxglove."""

from xml.etree import ElementTree

from vehicle_roll_sim.messages.joints import GUIDED, STEERING, SUSPENSION, WHEEL, Y, Z
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.simulation.drawn_vehicle import (
    BODY_CLEARANCE,
    WHEEL_WIDTH,
    wheel_centres_at_rest,
)
from vehicle_roll_sim.simulation.options import Options, options_for
from vehicle_roll_sim.simulation.sensing import place_of_imu
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.sensor_parameters import IMU, has_device

SPOKE_WIDTH = 0.2
"""Width of the bar that makes wheel spin visible, as a fraction of the tire radius."""
PROUD = 0.01
"""How far markings stand proud of a surface (m)."""
LIMITS = {"prismatic": 0.5, "revolute": 1.6}
"""Limits of the joints of a suspension (m) and of steering and wheel carrier (rad)."""
HERE = (0.0, 0.0, 0.0)
LYING = (1.5707963267948966, 0.0, 0.0)
"""Roll, pitch and yaw (rad) of a cylinder whose axis is the axle."""
COLOURS = {
    "paint": (0.15, 0.35, 0.7, 1.0),
    "glass": (0.08, 0.1, 0.12, 1.0),
    "rubber": (0.13, 0.13, 0.13, 1.0),
    "spoke": (0.95, 0.75, 0.1, 1.0),
}
"""Red, green, blue and opacity of the materials."""


def robot_description(simulation: Simulation) -> str:
    """URDF of a simulated vehicle, with the joints of its model (`urdf`)."""
    return urdf(simulation.vehicle, simulation.options)


def urdf(vehicle: Vehicle, options: Options | None = None) -> str:
    """URDF as text; base_link is at the sprung c.g., the joints of a wheel are those of `joints`.

    options: of the model; by default that of the vehicle. Suspension joints are prismatic along the
    body's z axis, 0 at rest, or fixed in a model without suspension; the wheel is the last link.
    Wheels have the unloaded radius: in model 1 the height of a wheel centre is that radius less the
    tire compression, which is negative after lift-off.
    """
    options = options or options_for(vehicle)
    robot = ElementTree.Element("robot", name="vehicle")
    for name, colour in COLOURS.items():
        material = ElementTree.SubElement(robot, "material", name=name)
        ElementTree.SubElement(material, "color", rgba=_numbers(colour))
    record = vehicle.record()[0]
    _body(robot, vehicle, record, options)
    if has_device(vehicle, IMU):
        place, turn = place_of_imu(vehicle)
        _joint(robot, IMU, "fixed", "base_link", Z, place, turn)
    centres = wheel_centres_at_rest(record, options)
    strut = "fixed" if options.has_eight_dof else "prismatic"
    for i, wheel in enumerate(WHEELS):
        link = _joint(robot, f"{wheel}_{SUSPENSION}", strut, "base_link", Z, centres[i])
        for kind, (motion, axis) in GUIDED.items() if options.is_kinematic else ():
            link = _joint(robot, f"{wheel}_{kind}", motion, link, axis)
        link = _joint(robot, f"{wheel}_{STEERING}", "revolute", link, Z)
        _joint(robot, f"{wheel}_{WHEEL}", "continuous", link, Y)
        _wheel(robot[-1], record.tire_radius[i])
    ElementTree.indent(robot)
    return ElementTree.tostring(robot, encoding="unicode", xml_declaration=True)


def _body(robot: ElementTree.Element, vehicle: Vehicle, record, options: Options) -> None:
    """A box as long as the wheelbase and as wide as the track, centred vertically on the c.g.

    With `body_contact` it is the box that touches the ground. A windscreen marks the front.
    """
    link = ElementTree.SubElement(robot, "link", name="base_link")
    if options.body_contact:
        _touching_body(link, record.body)
        return
    front, rear = vehicle.cg_to_front_axle, vehicle.cg_to_rear_axle
    length = front + rear
    width = max(vehicle.front_track, vehicle.rear_track) - WHEEL_WIDTH
    height = 2 * max(vehicle.cg_height - BODY_CLEARANCE, BODY_CLEARANCE)
    middle = 0.0 - (vehicle.cg_offset or 0.0)
    _box(link, "paint", (length, width, height), ((front - rear) / 2, middle, 0.0))
    _box(link, "glass", (PROUD, 0.9 * width, 0.4 * height), (front, middle, 0.25 * height))


def _touching_body(link: ElementTree.Element, body) -> None:
    """The box of a BODY record, with windscreen."""
    size = (body.ahead + body.behind, body.left + body.right, body.top + body.bottom)
    middle, up = (body.left - body.right) / 2, (body.top - body.bottom) / 2
    _box(link, "paint", size, ((body.ahead - body.behind) / 2, middle, up))
    height = 0.35 * size[2]
    _box(link, "glass", (PROUD, 0.9 * size[1], height), (body.ahead, middle, body.top - height))


def _wheel(link: ElementTree.Element, radius: float) -> None:
    """A tire, and a spoke from axle to rim that makes its spin visible."""
    geometry = _visual(link, "rubber", HERE, LYING)
    ElementTree.SubElement(geometry, "cylinder", radius=f"{radius:.10g}", length=str(WHEEL_WIDTH))
    size = (SPOKE_WIDTH * radius, WHEEL_WIDTH + PROUD, 0.9 * radius)
    _box(link, "spoke", size, (0.0, 0.0, size[2] / 2))


def _joint(robot, name: str, motion: str, parent: str, axis: str, origin=HERE, turn=HERE) -> str:
    """Add a joint and then its child link; returns the link's name."""
    joint = ElementTree.SubElement(robot, "joint", name=f"{name}_joint", type=motion)
    child = f"{name}_link"
    ElementTree.SubElement(joint, "origin", xyz=_numbers(origin), rpy=_numbers(turn))
    ElementTree.SubElement(joint, "parent", link=parent)
    ElementTree.SubElement(joint, "child", link=child)
    if motion != "fixed":
        ElementTree.SubElement(joint, "axis", xyz=axis)
    if limit := LIMITS.get(motion):
        ElementTree.SubElement(
            joint, "limit", lower=str(-limit), upper=str(limit), effort="1e9", velocity="1e9"
        )
    ElementTree.SubElement(robot, "link", name=child)
    return child


def _box(link: ElementTree.Element, material: str, size, centre) -> None:
    ElementTree.SubElement(_visual(link, material, centre, HERE), "box", size=_numbers(size))


def _visual(link: ElementTree.Element, material: str, xyz, rpy) -> ElementTree.Element:
    """Add a visual to a link; returns its geometry element."""
    visual = ElementTree.SubElement(link, "visual")
    ElementTree.SubElement(visual, "origin", xyz=_numbers(xyz), rpy=_numbers(rpy))
    geometry = ElementTree.SubElement(visual, "geometry")
    ElementTree.SubElement(visual, "material", name=material)
    return geometry


def _numbers(values) -> str:
    return " ".join(f"{value:.10g}" for value in values)
