"""The question that the paper leaves open: how much a moving roll centre changes.

The J-turn and the ramp steer of the paper with models 1 and 2, on the reference vehicle and on
swing axles, whose roll centres move a lot. Model 1 has the same roll centres at rest.
"""

import dataclasses
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np

from vehicle_roll_sim.analysis.drawing import add_legend, new_figure, save_figure
from vehicle_roll_sim.analysis.panels import DEGREES
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.paper.figures import IN_WORDS, write_table
from vehicle_roll_sim.paper.study import J_TURN, RAMP_STEER, Response
from vehicle_roll_sim.runs.columns import ROLL_CENTRES
from vehicle_roll_sim.runs.run import run
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.derived_values import AXLES
from vehicle_roll_sim.vehicle.parameters import Vehicle

LINKS, SWING_AXLES = "straight paths", "swing axles"
MODELS = {"1": Options(euler_terms=True, steady_state_slip=True)} | {
    "2": Options(model="2", steady_state_slip=True)
}
CASES = tuple((name, axles) for name in (J_TURN, RAMP_STEER) for axles in (LINKS, SWING_AXLES))
PIVOT_ASIDE, PIVOT_HEIGHT = 0.15, 0.26
"""m: pivots of the swing axles, from the middle of the vehicle and above the road."""
LARGEST_TURN, POINTS = 0.28, 63
"""rad: largest turn of a swing axle in its tables, and their number of points."""
PANELS = (
    ("roll", "roll angle\n(deg)", DEGREES),
    ("z", "height of the\nsprung c.g. (m)", 1.0),
    ("front_roll_centre_height", "front roll centre\nheight (m)", 1.0),
    ("rear_roll_centre_height", "rear roll centre\nheight (m)", 1.0),
    ("normal_force_lf", "lf load (kN)", 1e-3),
    ("normal_force_rf", "rf load (kN)", 1e-3),
)
DATA = ("time", *(name for name, _, _ in PANELS))
SAMPLE = 0.01
"""s"""
COLOURS = {"1": "black", "2": "tab:orange"}
GOOD_ENOUGH, SMALLEST = 0.05, 0.5
"""Largest difference of the roll angles of both models over that of model 2; smaller differences
than the second (deg) do not count."""
JACKED = 10.0
"""deg: roll angle of model 2 up to which the rise of the c.g. is compared."""


def on_swing_axles(vehicle: Vehicle) -> Vehicle:
    """The vehicle with its wheels on arms that turn about pivots; roll centres at rest to match.

    A wheel moves on a circle about its pivot and leans as its arm turns.
    """
    values = {}
    for axle, wheel in AXLES.items():
        radius = float(vehicle.static_loaded_radius[wheel])
        half_track = getattr(vehicle, f"{axle}_track") / 2
        left = half_track - PIVOT_ASIDE
        up = float(vehicle.static_wheel_height[wheel]) - PIVOT_HEIGHT
        turn = np.linspace(-LARGEST_TURN, LARGEST_TURN, POINTS)
        travel = left * np.sin(turn) + up * np.cos(turn) - up
        outwards = left * np.cos(turn) - up * np.sin(turn) - left + radius * np.sin(turn)
        values |= {
            f"{axle}_half_track_change": tuple(zip(travel, outwards, strict=True)),
            f"{axle}_camber_change": tuple(zip(travel, -turn, strict=True)),
            f"{axle}_roll_centre_height": PIVOT_HEIGHT * half_track / left,
        }
    return vehicle.with_values(values)


@dataclasses.dataclass(frozen=True)
class Pair:
    """A manoeuvre with both models on the same suspension."""

    manoeuvre: str
    axles: str
    responses: dict[str, Response]

    @property
    def name(self) -> str:
        return f"beyond_{self.manoeuvre}_{self.axles.replace(' ', '_')}"

    def signal(self, model: str, name: str) -> np.ndarray:
        """A column of DATA; the fixed roll centres of model 1 move with the body, not shown."""
        history = self.responses[model].history
        if name in ROLL_CENTRES:
            axle, _, measure = name.partition("_roll_centre_")
            return history.roll_centre(measure)[:, list(AXLES).index(axle)]
        return history[name]

    def limit(self) -> float:
        """Roll angle (deg) of model 2 from which on that of model 1 is no longer good enough."""
        count = min(len(response.time) for response in self.responses.values())
        one, two = (self.responses[model].roll[:count] for model in MODELS)
        wrong = np.abs(one - two) > np.maximum(GOOD_ENOUGH * np.abs(two), SMALLEST)
        return float(np.abs(two[np.argmax(wrong)])) if wrong.any() else math.nan

    def jacked(self) -> int:
        """The number of samples up to a roll angle of JACKED of model 2."""
        roll = np.abs(self.responses["2"].roll)
        return int(np.argmax(roll > JACKED)) or len(roll)

    def rise(self, model: str, count: int) -> float:
        """How far the sprung c.g. has risen within the first samples (m)."""
        height = self.signal(model, "z")[:count]
        return float(height.max() - height[0])


def with_roll_centres_of(vehicle: Vehicle, guided: Vehicle) -> Vehicle:
    """The vehicle with the roll centres at rest of another: all that model 1 has of its axles."""
    heights = [f"{axle}_roll_centre_height" for axle in AXLES]
    return vehicle.with_values({name: getattr(guided, name) for name in heights})


def pairs(vehicle: Vehicle, done: Callable[[], None] = lambda: None) -> list[Pair]:
    """Every case of CASES; done: called after each run."""
    swinging = on_swing_axles(vehicle)
    fixed = with_roll_centres_of(vehicle, swinging)
    vehicles = {LINKS: dict.fromkeys(MODELS, vehicle), SWING_AXLES: {"1": fixed, "2": swinging}}
    found = []
    for manoeuvre, axles in CASES:
        responses = {}
        for model, options in MODELS.items():
            responses[model] = _response(vehicles[axles][model], options, manoeuvre)
            done()
        found.append(Pair(manoeuvre, axles, responses))
    return found


def _response(vehicle: Vehicle, options: Options, manoeuvre: str) -> Response:
    simulation, programme = Simulation(vehicle, options), STANDARD[manoeuvre]
    simulation.reset(programme.speed)
    history = run(simulation, programme.driver(), programme.duration, sample=SAMPLE)
    return Response(history, simulation.events.copy(), simulation.condition)


def draw(pair: Pair, folder: Path) -> None:
    """Write the figure of a pair as PNG, and its data as CSV, into `folder`."""
    drawing = new_figure(11.0, 7.6)
    axes = drawing.subplots(len(PANELS) // 2, 2, sharex=True)
    for axis, (name, label, scale) in zip(axes.flatten(), PANELS, strict=True):
        for model, response in pair.responses.items():
            values = pair.signal(model, name) * scale
            axis.plot(response.time, values, color=COLOURS[model], label=f"model {model}")
        axis.set_ylabel(label)
        axis.grid(alpha=0.3)
    for axis in axes[-1]:
        axis.set_xlabel("time (s)")
    add_legend(drawing, list(zip(*axes[0, 0].get_legend_handles_labels(), strict=True)))
    drawing.suptitle(f"{IN_WORDS[pair.manoeuvre]}, {pair.axles}")
    save_figure(drawing, folder / f"{pair.name}.png")
    columns = {model: [pair.signal(model, name) for name in DATA] for model in pair.responses}
    write_table(folder / f"{pair.name}.csv", ("model", *DATA), columns)


def as_text(found: list[Pair]) -> str:
    """Up to which roll angle a fixed roll centre is good enough, a line per pair."""
    lines = [
        f"Model 1, whose roll centres are fixed, is within {SMALLEST:g} deg or {GOOD_ENOUGH:.0%} "
        "of the roll angle of model 2 up to"
    ]
    for pair in found:
        limit, until = pair.limit(), pair.jacked()
        angle = "the end" if math.isnan(limit) else f"{limit:.1f} deg"
        rises = ", ".join(f"{pair.rise(model, until):.3f} m (model {model})" for model in MODELS)
        name = f"{IN_WORDS[pair.manoeuvre]}, {pair.axles}:"
        lines.append(f"  {name:<28}{angle:>9}; rise of the c.g. up to {JACKED:g} deg: {rises}")
    return "\n".join(lines)
