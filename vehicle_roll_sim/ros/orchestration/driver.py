"""The driver on a bench, as a node: what he demands, and the warnings that he gets."""

from collections.abc import Sequence

from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import Bool, Float64, Float64MultiArray

from vehicle_roll_sim.messages.set_synchronizer import KEPT
from vehicle_roll_sim.scoring.options import WARNING

STEERING, TORQUE, BRAKE = "steering_cmd", "wheel_torque_cmd", "brake_torque_cmd"
DEMANDS = {
    STEERING: "driver_steering",
    TORQUE: "driver_wheel_torque",
    BRAKE: "driver_brake_torque",
}
"""Topics of the driver's demand where the controller commands the same quantity."""
EVERY_MESSAGE = QoSProfile(depth=KEPT)


class Driver(Node):
    """Publishes what the driver demands, and hears the warnings of the controller.

    answers: topics of the controller. warnings: those received in this run.
    """

    def __init__(self, answers: Sequence[str]):
        super().__init__("manoeuvre", use_global_arguments=False)
        kinds = {STEERING: Float64, TORQUE: Float64MultiArray, BRAKE: Float64MultiArray}
        names = {each: DEMANDS[each] if each in answers else each for each in kinds}
        self._publishers_of = {
            each: self.create_publisher(kind, names[each], EVERY_MESSAGE)
            for each, kind in kinds.items()
        }
        self.warnings: list[bool] = []
        self.is_heard_for_warnings = WARNING in answers
        if self.is_heard_for_warnings:
            self._heard = self.create_subscription(Bool, WARNING, self._warn, EVERY_MESSAGE)

    def _warn(self, message: Bool) -> None:
        self.warnings.append(message.data)

    def say(self, topic: str, data) -> None:
        """Publish a demand (rad, N m) if somebody hears it."""
        if self.is_heard(topic):
            publisher = self._publishers_of[topic]
            publisher.publish(publisher.msg_type(data=data))

    def is_heard(self, topic: str) -> bool:
        """Whether the demand has a subscriber."""
        return self._publishers_of[topic].get_subscription_count() > 0
