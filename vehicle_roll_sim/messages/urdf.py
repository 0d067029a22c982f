"""A minimal robot description (URDF) from the parameters of a vehicle."""

from xml.etree import ElementTree

from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.parameters import Vehicle

WHEEL_WIDTH = 0.2
"""m, for the picture only."""
BODY_CLEARANCE = 0.25
"""Height of the body's underside above ground (m), for the picture only."""
TRAVEL = 0.5
"""Limit of the suspension joints (m)."""
LOCK = 1.6
"""Limit of the steering joints (rad)."""
AXES = {"prismatic": "0 0 1", "revolute": "0 0 1", "continuous": "0 1 0"}
HERE = (0.0, 0.0, 0.0)


def robot_description(simulation: Simulation) -> str:
    """URDF of the simulated vehicle as its model has it (`urdf`)."""
    return urdf(simulation.vehicle, not simulation.options.has_eight_dof)


def urdf(vehicle: Vehicle, has_suspension: bool = True) -> str:
    """URDF: base_link is the sprung c.g.; per wheel a suspension, a steering and a wheel joint.

    Suspension joints are prismatic along the body's z axis, 0 at rest, or fixed; the wheel is the
    last link.
    """
    travel = ("prismatic", TRAVEL) if has_suspension else ("fixed", 0.0)
    robot = ElementTree.Element("robot", name="vehicle")
    _body(robot, vehicle)
    record = vehicle.record()[0]
    for i, wheel in enumerate(WHEELS):
        at_rest = (record.x[i], record.y[i], -record.static_strut_length[i])
        motion, limit = travel
        strut = _joint(robot, f"{wheel}_suspension", motion, "base_link", at_rest, limit)
        knuckle = _joint(robot, f"{wheel}_steering", "revolute", strut, HERE, LOCK)
        _joint(robot, f"{wheel}_wheel", "continuous", knuckle, HERE)
        geometry = _visual(robot[-1], "0 0 0", "1.5707963267948966 0 0")
        radius = f"{vehicle.tire_radius:.10g}"
        ElementTree.SubElement(geometry, "cylinder", radius=radius, length=str(WHEEL_WIDTH))
    ElementTree.indent(robot)
    return ElementTree.tostring(robot, encoding="unicode", xml_declaration=True)


def _body(robot: ElementTree.Element, vehicle: Vehicle) -> None:
    """A box from the underside to as far above the c.g., over the wheelbase and the track."""
    link = ElementTree.SubElement(robot, "link", name="base_link")
    middle = (vehicle.cg_to_front_axle - vehicle.cg_to_rear_axle) / 2
    geometry = _visual(link, f"{middle:.10g} 0 0", "0 0 0")
    length = vehicle.cg_to_front_axle + vehicle.cg_to_rear_axle
    width = max(vehicle.front_track, vehicle.rear_track) - WHEEL_WIDTH
    height = 2 * max(vehicle.cg_height - BODY_CLEARANCE, BODY_CLEARANCE)
    ElementTree.SubElement(geometry, "box", size=f"{length:.10g} {width:.10g} {height:.10g}")


def _joint(robot, name: str, motion: str, parent: str, origin, limit: float = 0.0) -> str:
    """Add a joint and the link behind it, the link last; returns the link's name."""
    joint = ElementTree.SubElement(robot, "joint", name=f"{name}_joint", type=motion)
    child = f"{name}_link"
    ElementTree.SubElement(joint, "origin", xyz=" ".join(f"{x:.10g}" for x in origin))
    ElementTree.SubElement(joint, "parent", link=parent)
    ElementTree.SubElement(joint, "child", link=child)
    if motion in AXES:
        ElementTree.SubElement(joint, "axis", xyz=AXES[motion])
    if limit:
        ElementTree.SubElement(
            joint, "limit", lower=str(-limit), upper=str(limit), effort="1e9", velocity="1e9"
        )
    ElementTree.SubElement(robot, "link", name=child)
    return child


def _visual(link: ElementTree.Element, xyz: str, rpy: str) -> ElementTree.Element:
    """Add a visual to a link; returns its geometry element."""
    visual = ElementTree.SubElement(link, "visual")
    ElementTree.SubElement(visual, "origin", xyz=xyz, rpy=rpy)
    return ElementTree.SubElement(visual, "geometry")
