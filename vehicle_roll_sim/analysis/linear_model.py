"""Linearization about a steady state: dx/dt = A x + B u, y = C x + D u, by central differences.

x, u and y are deviations from the trim, in SI units and radians. The states are those on which the
motion depends. x, y, yaw and the wheel angles are omitted, since nothing depends on them. In the
14 DOF models the tire compressions are omitted too: on a flat road they follow from height,
attitude and suspension compression. If they were kept, four combinations of states would have no
dynamics: the unevenness of the road under each wheel.
"""

import dataclasses
from pathlib import Path

import numpy as np

from vehicle_roll_sim.analysis.level_road_model import LevelRoadModel, typical
from vehicle_roll_sim.analysis.trim import Trim
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.files.output_file import replaced_file
from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.records import STATE_NAMES, WHEELS, element_names
from vehicle_roll_sim.runs.metrics import load_transfer_ratio

OUTPUT_NAMES = (
    *("roll", "roll_rate", "yaw_rate", "lateral_acceleration", "sideslip_angle"),
    *(f"normal_force_{wheel}" for wheel in WHEELS),
    "load_transfer_ratio",
)
"""Roll angle, body rates, acceleration of the sprung c.g. (frame 2), atan(v / u), normal loads and
load transfer ratio."""
STEP = 1e-3
"""Finite-difference step, in typical changes.

Rounding (2e-16 of the rates over the step, and 1e-12 from the iteration of the 8 DOF model) forbids
a much smaller one. Differences over twice the step serve to eliminate the quadratic error
(Richardson extrapolation); the remaining error is of fourth order.
"""
KINK = 0.02
"""Change of a slope within a step, relative to the largest in its row, that counts as a kink.

Curvature of the models gives less than 0.005 while all wheels carry load.
"""
SMALLEST = 1e-3
"""Rate (SI units per second) per typical change below which a row counts as zero."""
HEIGHT_FIELDS = ("z", "roll", "pitch", "suspension_compression")
"""The states that determine the tire compressions."""
TIRE_NAMES = element_names(("tire_compression",))


@dataclasses.dataclass(frozen=True)
class LinearModel:
    """A linear model about a trim, in SI units and radians.

    a: A (n, n). b: B (n, m). c: C (10, n). d: D (10, m). m: 10, or 12 with wind. state_names,
    input_names, output_names: names of the elements of x, u and y. step_error: the largest
    difference between the slopes over one step and over two, relative to the largest in the row,
    with all states and inputs scaled by their typical changes.
    """

    a: np.ndarray
    b: np.ndarray
    c: np.ndarray
    d: np.ndarray
    state_names: tuple[str, ...]
    input_names: tuple[str, ...]
    output_names: tuple[str, ...]
    trim: Trim
    step_error: float

    @property
    def trim_state(self) -> np.ndarray:
        """The states at the trim, shape (n,) (SI units, rad)."""
        return self.trim.state[self.trim.plant.places]

    @property
    def trim_output(self) -> np.ndarray:
        """The outputs at the trim, shape (10,) (SI units, rad)."""
        return outputs_of(self.trim.state, self.trim.outputs)

    def write_npz(self, path: str | Path) -> None:
        """Write matrices, names and trim as .npz, which numpy.load reads without pickle."""
        arrays = {
            "A": self.a,
            "B": self.b,
            "C": self.c,
            "D": self.d,
            "state_names": np.array(self.state_names),
            "input_names": np.array(self.input_names),
            "output_names": np.array(self.output_names),
            "trim_state": self.trim_state,
            "trim_input": self.trim.inputs,
            "trim_output": self.trim_output,
        }
        with replaced_file(path) as partial, partial.open("wb") as file:
            np.savez(file, **arrays)


def linearize(trim: Trim) -> LinearModel:
    """Linearize the model about a steady state.

    Raises InputError at a kink, such as a wheel about to lift off.
    """
    model = trim.plant
    names = (*model.state_names, *(() if model.options.has_eight_dof else TIRE_NAMES))
    places = np.array([STATE_NAMES.index(name) for name in names])
    scale = typical((*names, *model.input_names), model.typical_roll)
    count = len(names)

    def response(change: np.ndarray) -> np.ndarray:
        """Rates and outputs after a change of states and inputs (scaled by typical changes)."""
        state = trim.state.copy()
        state[places] += (scale * change)[:count]
        rates = model.rates(state, trim.inputs + (scale * change)[count:])
        return np.append(rates[places], outputs_of(state, model.outputs))

    slopes, error, kink = _slopes(response, len(scale))
    row, column = np.unravel_index(kink.argmax(), kink.shape)
    if kink[row, column] > KINK:
        one, other = (*names, *OUTPUT_NAMES)[row], (*names, *model.input_names)[column]
        allowed = f"a value further from a kink, such as lift-off: {one} has one over {other}"
        raise InputError("lateral_acceleration", float(trim.outputs.acceleration[1]), allowed)
    slopes = slopes / scale
    a, b = slopes[:count, :count], slopes[:count, count:]
    c, d = slopes[count:, :count], slopes[count:, count:]
    if not model.options.has_eight_dof:
        a, b, c = _on_flat_road(a, b, c, model)
    return LinearModel(
        a, b, c, d, model.state_names, model.input_names, OUTPUT_NAMES, trim, float(error.max())
    )


def outputs_of(state: np.ndarray, outputs: np.record) -> np.ndarray:
    """The outputs OUTPUT_NAMES, shape (10,), at a flat state vector with its OUTPUTS record."""
    loads = outputs.normal_force
    return np.array(
        [
            *(state[at.ROLL], state[at.ROLL_RATE], state[at.YAW_RATE]),
            *(outputs.acceleration[1], np.arctan2(state[at.V], state[at.U])),
            *(*loads, load_transfer_ratio(loads)),
        ]
    )


def _slopes(response, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Jacobian (rows, count) of a vector function of `count` values at 0, with two measures.

    These are the difference between slopes over one step and over two, and the change of slope
    within a step; both (rows, count), relative to the largest slope in the row.
    """
    middle = response(np.zeros(count))
    columns = [
        [response(size * direction) for size in (-2 * STEP, -STEP, STEP, 2 * STEP)]
        for direction in np.eye(count)
    ]
    two_back, back, ahead, two_ahead = np.moveaxis(columns, 0, 2)
    near, far = (ahead - back) / (2 * STEP), (two_ahead - two_back) / (4 * STEP)
    slopes = (4 * near - far) / 3
    largest = np.maximum(np.abs(slopes).max(axis=1, keepdims=True), SMALLEST)
    bend = (ahead + back - 2 * middle[:, np.newaxis]) / STEP
    return slopes, np.abs(near - far) / largest, np.abs(bend) / largest


def _on_flat_road(a, b, c, model: LevelRoadModel) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A, B and C with the tire compressions, the last four states, eliminated.

    Their rates are G times those of height, attitude and suspension compression, so they are G
    times these states. G is determined from the rates and therefore valid for any model.
    """
    count = len(model.state_names)
    given = [model.state_names.index(name) for name in element_names(HEIGHT_FIELDS)]
    follow, *_ = np.linalg.lstsq(a[given].T, a[count:].T, rcond=None)
    a, c = a.copy(), c.copy()
    a[:, given] += a[:, count:] @ follow.T
    c[:, given] += c[:, count:] @ follow.T
    return a[:count, :count], b[:count], c[:, :count]


def as_control_system(model: LinearModel):
    """The model as a `control.StateSpace` with named signals; requires the package `control`."""
    import control

    return control.StateSpace(
        *(model.a, model.b, model.c, model.d),
        states=list(model.state_names),
        inputs=list(model.input_names),
        outputs=list(model.output_names),
    )
