"""The model about a steady state: dx/dt = A x + B u, y = C x + D u, by central differences.

x, u and y are changes from the trim, in SI units and radians. The states are those of the model on
which its motion depends: x, y and yaw are left out, since nothing depends on them, the angles of
the wheels too, and in the models with 14 degrees of freedom the compressions of the tires, which on
a flat road follow from height, attitude and suspension: with them, as the model has its states,
four combinations would have no dynamics, the unevenness of the road under each wheel.
"""

import dataclasses
from pathlib import Path

import numpy as np

from vehicle_roll_sim.analysis.trim import INPUT_NAMES, LevelRoadModel, Trim, typical
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
"""Angle, body rates, acceleration of the sprung c.g. (frame 2), atan(v / u) and tire loads."""
STEP = 1e-3
"""Step of the differences, in typical changes. Rounding (2e-16 of the rates over the step, and in
the 8 DOF model the 1e-12 to which its loop agrees) asks for no smaller one; with the differences
over twice the step, the error that grows with its square is eliminated, and what is left, with the
fourth power, is smaller still."""
KINK = 0.02
"""Change of a slope within a step, relative to the largest of its row, that is no curvature: that
of the models is below 0.005 where all wheels carry load."""
SMALLEST = 1e-3
"""Rate (SI units per second) for a typical change, below which a row is as good as none."""
HEIGHT_FIELDS = ("z", "roll", "pitch", "suspension_compression")
"""What gives the compression of the tires."""
TIRE_NAMES = element_names(("tire_compression",))


@dataclasses.dataclass(frozen=True)
class LinearModel:
    """A (n, n), B (n, 10), C (10, n) and D (10, 10) about a trim, with the names of the elements.

    step_error: the largest difference between the slopes over one step and over two, relative to
    the largest of the row, every state and input in its typical changes.
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
        """The states of the trim, shape (n,)."""
        return self.trim.state[self.trim.model.places]

    @property
    def trim_output(self) -> np.ndarray:
        """The outputs in the trim, shape (10,)."""
        return outputs_of(self.trim.state, self.trim.outputs)

    def write_npz(self, path: str | Path) -> None:
        """Write matrices, names and trim; numpy.load reads them without pickle."""
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
    """The model about a steady state.

    Raises InputError where it has no slope there, as with a wheel that is about to lift.
    """
    model = trim.model
    names = (*model.state_names, *(() if model.options.has_eight_dof else TIRE_NAMES))
    places = np.array([STATE_NAMES.index(name) for name in names])
    scale = typical((*names, *INPUT_NAMES))
    count = len(names)

    def response(change: np.ndarray) -> np.ndarray:
        """Rates and outputs after a change of states and inputs (in typical changes)."""
        state = trim.state.copy()
        state[places] += (scale * change)[:count]
        rates = model.rates(state, trim.inputs + (scale * change)[count:])
        return np.append(rates[places], outputs_of(state, model.outputs))

    slopes, error, kink = _slopes(response, len(scale))
    row, column = np.unravel_index(kink.argmax(), kink.shape)
    if kink[row, column] > KINK:
        one, other = (*names, *OUTPUT_NAMES)[row], (*names, *INPUT_NAMES)[column]
        allowed = f"one further from a kink, such as lift-off: {one} has one over {other}"
        raise InputError("lateral_acceleration", float(trim.outputs.acceleration[1]), allowed)
    slopes = slopes / scale
    a, b = slopes[:count, :count], slopes[:count, count:]
    c, d = slopes[count:, :count], slopes[count:, count:]
    if not model.options.has_eight_dof:
        a, b, c = _on_flat_road(a, b, c, model)
    return LinearModel(
        a, b, c, d, model.state_names, INPUT_NAMES, OUTPUT_NAMES, trim, float(error.max())
    )


def outputs_of(state: np.ndarray, outputs: np.record) -> np.ndarray:
    """OUTPUT_NAMES at a flat state vector and the OUTPUTS record that belongs to it."""
    loads = outputs.normal_force
    return np.array(
        [
            *(state[at.ROLL], state[at.ROLL_RATE], state[at.YAW_RATE]),
            *(outputs.acceleration[1], np.arctan2(state[at.V], state[at.U])),
            *(*loads, load_transfer_ratio(loads)),
        ]
    )


def _slopes(response, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Slopes (rows, count) of a vector function of `count` values at 0.

    With how much those over one step and over two differ, and how much the slope changes within a
    step, both relative to the largest of the row.
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
    """A, B and C without the compressions of the tires, the last four states.

    Their rates are some G times those of height, attitude and suspension, which makes them G times
    these. G comes from the rates, so that it is that of any of the models.
    """
    count = len(model.state_names)
    given = [model.state_names.index(name) for name in element_names(HEIGHT_FIELDS)]
    follow, *_ = np.linalg.lstsq(a[given].T, a[count:].T, rcond=None)
    a, c = a.copy(), c.copy()
    a[:, given] += a[:, count:] @ follow.T
    c[:, given] += c[:, count:] @ follow.T
    return a[:count, :count], b[:count], c[:, :count]


def as_control_system(model: LinearModel):
    """The model as a `control.StateSpace` with its names; needs the package `control`."""
    import control

    return control.StateSpace(
        *(model.a, model.b, model.c, model.d),
        states=list(model.state_names),
        inputs=list(model.input_names),
        outputs=list(model.output_names),
    )
