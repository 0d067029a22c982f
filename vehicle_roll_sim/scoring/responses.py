"""The responses to steering that the step steer and the swept sine are driven for."""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.manoeuvres.iso_step_steer import IsoStepSteer
from vehicle_roll_sim.manoeuvres.swept_steer import SweptSteer, frequency_response
from vehicle_roll_sim.scoring.driven import Outcome


@dataclasses.dataclass(frozen=True)
class Response:
    """The response of a run.

    delay: response time of the yaw rate to a step (s). overshoot: of the roll angle after it, as a
    fraction of its steady value. gain, frequency: largest roll angle per steering angle of a sine,
    and where (Hz). nan where a run does not have it.
    """

    delay: float = math.nan
    overshoot: float = math.nan
    gain: float = math.nan
    frequency: float = math.nan


def response_of(outcome: Outcome) -> Response:
    """The response of a run; nothing of other tests, and of runs that were not completed."""
    manoeuvre, history = outcome.manoeuvre, outcome.history
    if not outcome.is_complete:
        return Response()
    if isinstance(manoeuvre, IsoStepSteer):
        delay, _ = manoeuvre.response(history, "yaw_rate")
        _, overshoot = manoeuvre.response(history, "roll")
        return Response(delay=delay, overshoot=overshoot)
    if isinstance(manoeuvre, SweptSteer):
        frequencies, answer = frequency_response(history, "roll")
        within = (frequencies >= manoeuvre.lowest_frequency) & (
            frequencies <= manoeuvre.highest_frequency
        )
        gains = np.nan_to_num(np.abs(answer[within]))
        largest = int(np.argmax(gains))
        return Response(gain=float(gains[largest]), frequency=float(frequencies[within][largest]))
    return Response()
