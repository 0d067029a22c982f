"""Events of a run of which only samples are known."""

import numpy as np

from vehicle_roll_sim.model.compiled.jit import kernel_argument
from vehicle_roll_sim.model.integration.events import no_events, note_lift_offs
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.metrics import peak, rollover_time


def events_of(history: History, rollover_angle: float) -> np.record:
    """Lift-offs, rollover and peaks from samples, as an EVENTS record.

    Lift-off times of a wheel are interpolated if its tire compression is positive where it carries
    load and only there. Otherwise they are those of the first sample without load: in models
    without compressions, and on roads with heights, which the compressions against z = 0 lack.
    rollover_angle: rad.
    """
    events = no_events()
    seen, time = kernel_argument(events)[0], history["time"]
    compression, loads = history.wheels("tire_compression"), history.wheels("normal_force")
    differs = ((loads > 0.0) & (compression <= 0.0)) | ((loads <= 0.0) & (compression > 0.0))
    by_load = differs.any(axis=0) | np.isnan(compression).all()
    support = np.ascontiguousarray(np.where(by_load, loads, compression))  # as it is compiled
    note_lift_offs(time[0], 0.0, support[0], seen)
    for k in range(1, len(time)):
        note_lift_offs(time[k - 1], time[k] - time[k - 1], support[k], seen)
    events["rollover_time"] = rollover_time(time, history["roll"], rollover_angle)
    events["peak_roll"] = peak(time, history["roll"])
    acceleration = history["lateral_acceleration"]
    events["peak_lateral_acceleration"] = peak(time, acceleration)
    return events[0]
