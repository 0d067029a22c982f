"""`vehicle_roll_sim vehicles`: the vehicles that come with the package, and their figures."""

import math
from collections.abc import Iterator

from vehicle_roll_sim.arguments import OneLineParser
from vehicle_roll_sim.command_line import signals
from vehicle_roll_sim.command_line.commands import COMMANDS
from vehicle_roll_sim.command_line.compiling import compile_model
from vehicle_roll_sim.runs.summary import line
from vehicle_roll_sim.simulation.limits import DEFAULT_SPEED
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.derived_values import GRAVITY
from vehicle_roll_sim.vehicle.figures import figures_of
from vehicle_roll_sim.vehicle.shipped import SHIPPED, lift_speeds
from vehicle_roll_sim.vehicle.vehicle_file import preset

MODEL = "2"
"""With which the gradients and the speeds of two-wheel lift are computed."""
KMH = 3.6
COLUMNS = {
    "mass": "kg",
    "c.g. height": "m",
    "SSF": "",
    "understeer": "deg/g",
    "roll": "deg/g",
    "front ride": "Hz",
    "rear ride": "Hz",
    "roll mode": "Hz",
    "two-wheel lift": "km/h",
}
"""Columns behind the name, and their units."""


def vehicles_command(words: list[str], program: str) -> int:
    """Run the command with the arguments after its name; return the exit status."""
    parser = OneLineParser(
        prog=program,
        description=COMMANDS["vehicles"],
        epilog="c.g. height: of the whole vehicle. SSF: static stability factor. understeer, roll: "
        f"gradients in model {MODEL} at {DEFAULT_SPEED:.4g} m/s. ride, roll mode: natural "
        "frequencies of the sprung mass on its springs and tires. two-wheel lift: lowest entry "
        f"speed of nhtsa_fishhook in model {MODEL}; - if there is none up to 144 km/h, or if the "
        "vehicle cannot be driven in it.",
    )
    parser.parse_args(words)
    with signals.exit_on_signal():
        compile_model()
    signals.import_interruptibly("analysis.handling")
    print("\n".join([*_rows(), "", *(line(name, about) for name, about in SHIPPED.items())]))
    return 0


def _rows() -> Iterator[str]:
    from vehicle_roll_sim.analysis.handling import gradients_of

    widths = [max(len(label), 8) + 2 for label in COLUMNS]
    cells = zip(COLUMNS.items(), widths, strict=True)
    head, units = zip(*((f"{a:>{w}}", f"{u:>{w}}") for (a, u), w in cells), strict=True)
    yield f"{'name':16}{''.join(head)}"
    yield f"{'':16}{''.join(units)}"
    lifts = lift_speeds()
    for name in SHIPPED:
        vehicle = preset(name)
        figures = figures_of(vehicle)
        gradients = gradients_of(vehicle, Options(model=MODEL), speed=DEFAULT_SPEED)
        values = (
            f"{figures.mass:.5g}",
            f"{figures.cg_height:.3g}",
            f"{figures.static_stability_factor:.3g}",
            *(f"{math.degrees(slope) * GRAVITY:.2f}" for slope in gradients),
            *(f"{axle.ride_frequency:.2f}" for axle in figures.axles.values()),
            f"{figures.roll_frequency:.2f}",
            "-" if math.isnan(lifts[name]) else f"{lifts[name] * KMH:.1f}",
        )
        yield f"{name:16}" + "".join(f"{v:>{w}}" for v, w in zip(values, widths, strict=True))
