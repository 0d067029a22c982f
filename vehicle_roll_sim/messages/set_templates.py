"""The messages of a set as encoded in advance, with marks where their numbers will be."""

import numpy as np

from vehicle_roll_sim.messages.covariances import ImuCovariances, OdomCovariances
from vehicle_roll_sim.messages.message_template import MARK, STAMP_MARK, Encode, MessageTemplate
from vehicle_roll_sim.messages.topics import (
    ACTUATORS,
    BODY_LOADS,
    CLOCK,
    FLOAT,
    MEASUREMENTS,
    ROLL_CENTRE,
    STATE_SET,
    TRANSFORMS,
    WRENCH,
)

OF_ODOMETRY = 85
POSITION, ATTITUDE, VELOCITY, TURNING = slice(3), slice(3, 7), slice(43, 46), slice(46, 49)
"""Numbers of an Odometry: a pose (7) and a twist (6), each followed by a covariance (36)."""
OF_IMU = 37
IMU_ATTITUDE, IMU_RATES, SPECIFIC_FORCE = slice(4), slice(13, 16), slice(25, 28)
"""Numbers of an Imu: 4, 3 and 3, with a covariance of 9 behind each."""
OF_WRENCH = 6
FORCE = slice(3)
"""Numbers of a Wrench: force and torque."""
OF_TRANSFORM = 7
TRANSLATION, ROTATION = slice(3), slice(3, 7)
"""Numbers of a Transform."""
EMPTY_LIST = 4
"""Bytes of an empty list: its length field."""
OF_SOME = (ROLL_CENTRE, BODY_LOADS, MEASUREMENTS, ACTUATORS)
TYPES = {topic.name: topic.type for topic in (*STATE_SET, *OF_SOME)}


class Templates:
    """Encodes the messages of a set, once for each, with `encode`.

    named: for each topic without a header, the names of its numbers and a view of the numbers.
    """

    def __init__(self, frame_prefix: str, encode: Encode):
        self._frame_prefix, self._encode = frame_prefix, encode
        self.named: dict[str, tuple[tuple[str, ...], np.ndarray]] = {}

    def labelled(self, topic: str, labels, mark=(MARK,), kind: str = "<f8") -> MessageTemplate:
        """A multi-array whose layout labels every element: dim[i].label is the name of data[i]."""
        dimensions = [{"label": name, "size": 1, "stride": 1} for name in labels]
        data = [*mark, *[0.0] * (len(labels) - len(mark))]
        fields = {"layout": {"dim": dimensions}, "data": data}
        message = MessageTemplate(self._encode(TYPES[topic], fields), len(labels), mark, kind)
        self.named[topic] = labels, message.numbers
        return message

    def single_numbers(self) -> dict[str, MessageTemplate]:
        """Those of every set that are one number, by topic."""
        single = {
            topic.name: MessageTemplate(self._encode(topic.type, {"data": MARK}), 1)
            for topic in STATE_SET
            if topic.type == FLOAT
        }
        self.named |= {name: ((name,), each.numbers) for name, each in single.items()}
        return single

    def clock(self) -> MessageTemplate:
        return MessageTemplate(self._encode(CLOCK.type, {"clock": STAMP_MARK}))

    def odometry(self, covariances: OdomCovariances) -> MessageTemplate:
        fields = self._in_frame("odom") | {"pose": {"pose": {"position": {"x": MARK}}}}
        fields |= self._of_frame("base_link")
        message = MessageTemplate(self._encode(TYPES["odom"], fields), OF_ODOMETRY)
        covariances.spread(message.numbers)
        return message

    def inertial(self, frame: str, covariances: ImuCovariances) -> MessageTemplate:
        fields = self._in_frame(frame) | {"orientation": {"x": MARK}}
        message = MessageTemplate(self._encode(TYPES["imu"], fields), OF_IMU)
        covariances.spread(message.numbers)
        return message

    def joint_states(self, names: list[str]) -> MessageTemplate:
        """Positions and velocities are contiguous, except for the length field of the latter."""
        zeros = [0.0] * len(names)
        moving = {"name": names, "position": [MARK, *zeros[1:]], "velocity": zeros}
        fields = {"header": {"stamp": STAMP_MARK}, **moving}
        message = self._encode(TYPES["joint_states"], fields)
        return MessageTemplate(message, len(names) + 1 + len(names), tail=EMPTY_LIST)

    def force(self) -> MessageTemplate:
        force = self._in_frame("base_footprint") | {"wrench": {"force": {"x": MARK}}}
        return MessageTemplate(self._encode(WRENCH, force), OF_WRENCH)

    def transforms(self, frames: tuple[str, ...]) -> MessageTemplate:
        """One from odom to each of the frames."""
        at_mark = {"transform": {"translation": {"x": MARK}}}
        transforms = [self._in_frame("odom") | self._of_frame(frame) | at_mark for frame in frames]
        return MessageTemplate(
            self._encode(TRANSFORMS.type, {"transforms": transforms}), OF_TRANSFORM
        )

    def _in_frame(self, frame: str) -> dict:
        return {"header": {"stamp": STAMP_MARK, "frame_id": self._frame_prefix + frame}}

    def _of_frame(self, frame: str) -> dict:
        return {"child_frame_id": self._frame_prefix + frame}
