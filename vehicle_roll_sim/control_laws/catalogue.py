"""The control laws of the example controllers, by the names of their nodes."""

from vehicle_roll_sim.control_laws.active_roll_bar import ActiveRollBar
from vehicle_roll_sim.control_laws.lqr_roll_bar import LqrRollBar
from vehicle_roll_sim.control_laws.rear_steering import RearSteering
from vehicle_roll_sim.control_laws.roll_braking import RollBraking
from vehicle_roll_sim.control_laws.rollover_mpc import RolloverMpc
from vehicle_roll_sim.control_laws.stability_control import StabilityControl
from vehicle_roll_sim.control_laws.yaw_control import YawControl
from vehicle_roll_sim.runs.control_law import ControlLaw

LAWS: dict[str, type[ControlLaw]] = {
    "active_roll_bar": ActiveRollBar,
    "lqr_roll_bar": LqrRollBar,
    "rear_steering": RearSteering,
    "roll_braking": RollBraking,
    "rollover_mpc": RolloverMpc,
    "stability_control": StabilityControl,
    "yaw_control": YawControl,
}
