"""The control laws of the example controllers, by the names of their nodes."""

from vehicle_roll_sim.control.active_roll_bar import ActiveRollBar
from vehicle_roll_sim.control.rear_steering import RearSteering
from vehicle_roll_sim.control.roll_braking import RollBraking
from vehicle_roll_sim.control.yaw_control import YawControl
from vehicle_roll_sim.runs.control_law import ControlLaw

LAWS: dict[str, type[ControlLaw]] = {
    "active_roll_bar": ActiveRollBar,
    "rear_steering": RearSteering,
    "roll_braking": RollBraking,
    "yaw_control": YawControl,
}
