"""Columns of a history: names, units, and where their values are in a simulation."""

import numpy as np

from vehicle_roll_sim.model.layout import CORNERS
from vehicle_roll_sim.model.records import MODEL_STATE_SIZE, OUTPUTS, STATE_NAMES, WHEELS
from vehicle_roll_sim.simulation.signals import OUTPUT_SIGNALS, STATE_SIGNALS, field_of
from vehicle_roll_sim.simulation.simulation import Simulation

OUTPUT_QUANTITIES = (
    "normal_force",
    "longitudinal_force",
    "lateral_force",
    "slip_ratio",
    "slip_angle",
)
ACCELERATIONS = ("longitudinal_acceleration", "lateral_acceleration")
_ACCELERATIONS = dict.fromkeys(ACCELERATIONS, OUTPUT_SIGNALS["acceleration"])
COLUMNS = (
    "time",
    *STATE_NAMES[:MODEL_STATE_SIZE],
    *(f"{quantity}_{wheel}" for quantity in OUTPUT_QUANTITIES for wheel in WHEELS),
    "steering",
    *ACCELERATIONS,
)
"""Names of the columns: SI units and radians; forces and accelerations in frame 2."""
UNITS = {
    name: "s"
    if name == "time"
    else (STATE_SIGNALS | OUTPUT_SIGNALS | _ACCELERATIONS)[field_of(name)].unit
    for name in COLUMNS
}
"""Unit of each column; '' for a ratio."""
COMMANDS = (
    "rear_steering",
    *(f"{command}_{wheel}" for command in ("wheel_torque", "brake_torque") for wheel in WHEELS),
    *(f"active_force_{wheel}" for wheel in WHEELS),
)
"""Names of the commands other than the steering.

If commands are held over periods, those of the period that ends with the row; else those at the
time of the row. If the vehicle has actuators, what they let act at the time of the row.
"""
ROLL_CENTRES = tuple(
    f"{axle}_roll_centre_{measure}" for measure in ("height", "place") for axle in ("front", "rear")
)
"""Names of further columns of model 2: height above the road, and place to the left of the c.g., of
the roll centre of each axle (m); nan where there is none."""
BODY_LOADS = tuple(f"body_load_{corner}" for corner in CORNERS)
"""Names of further columns with `body_contact`: normal load on each corner of the body (N)."""
WHEEL_LIFTS = tuple(f"wheel_lift_{wheel}" for wheel in WHEELS)
"""Names of further columns on a road with features: distance of each tire from the road (m), 0 in
contact; nan if it is unknown. On a plane without features the tire compressions have it."""
WIND = ("wind_x", "wind_y")
"""Names of further commands of vehicles with air forces (m/s), in the same sense."""
FURTHER = {
    COMMANDS: "commands",
    ROLL_CENTRES: "roll_centres",
    WIND: "wind",
    BODY_LOADS: "body_loads",
    WHEEL_LIFTS: "lifts",
}
"""Groups of columns that a file may lack, and the attributes of a History with their values."""
MEASURED = "measured_"
"""Begins the names of further columns of vehicles with sensors: the last reading of each."""


def _places_of_outputs() -> tuple[np.ndarray, np.ndarray]:
    """Where the outputs among COLUMNS, and ROLL_CENTRES and BODY_LOADS, are in that of OUTPUTS."""
    places = np.arange(OUTPUTS.itemsize // 8).astype(np.float64).view(OUTPUTS)[0]
    quantities = (places[quantity] for quantity in OUTPUT_QUANTITIES)
    steering, accelerations = places["commanded_steering"][:1], places["acceleration"]
    of_rows = np.concatenate((*quantities, steering, accelerations[: len(ACCELERATIONS)]))
    centres = (places["roll_centre_height"], places["roll_centre_place"])
    return of_rows.astype(int), np.concatenate((*centres, places["body_load"])).astype(int)


OUTPUT_PLACES, FURTHER_PLACES = _places_of_outputs()


def row_of(simulation: Simulation) -> np.ndarray:
    """The values of COLUMNS at the present simulated time, shape (len(COLUMNS),)."""
    row = np.empty(len(COLUMNS))
    row[0] = simulation.time
    row[1 : 1 + MODEL_STATE_SIZE] = simulation.state_vector[:MODEL_STATE_SIZE]
    row[1 + MODEL_STATE_SIZE :] = simulation.output_vector[OUTPUT_PLACES]
    return row


def roll_centres_of(simulation: Simulation) -> np.ndarray:
    """The values of ROLL_CENTRES at the present simulated time; nan in models without them."""
    return further_of(simulation)[: len(ROLL_CENTRES)]


def further_of(simulation: Simulation) -> np.ndarray:
    """The values of ROLL_CENTRES and BODY_LOADS at the present simulated time; nan if absent."""
    return simulation.output_vector[FURTHER_PLACES]


def measured_names(simulation: Simulation) -> tuple[str, ...]:
    """Names of the columns of what the sensors of a simulation measure."""
    return tuple(MEASURED + label for label in simulation.sensors.labels)
