"""The gains of roll bars in a file: a ROS parameter file for the node `lqr_roll_bar`."""

import dataclasses
from pathlib import Path

import numpy as np

from vehicle_roll_sim.control_laws.lqr_roll_bar import NODE, PARAMETERS, LqrRollBar
from vehicle_roll_sim.control_laws.roll_bar_design import RollBarCriteria, RollBarDesign
from vehicle_roll_sim.declaration import InputError, parameters_of
from vehicle_roll_sim.files.yaml_file import read_mapping

DIGITS = 5
"""Significant digits of a gain: fewer than those in which machines differ."""
SLOW = 30.0
"""1/s: poles that a comment names are slower."""


def read_gains(path: str | Path) -> LqrRollBar:
    """The law with the gains in a file; raises InputError."""
    wanted = f"{NODE}: {PARAMETERS}: with {', '.join(parameters_of(LqrRollBar))}"
    values, _ = read_mapping(Path(path), "gains file", wanted)
    try:
        gains = values[NODE][PARAMETERS]
        missing = parameters_of(LqrRollBar).keys() ^ gains.keys()
    except (KeyError, TypeError, AttributeError):
        raise InputError(f"gains file {path}", "", wanted, "no parameters of the node") from None
    if missing:
        problem = f"{', '.join(sorted(missing))} missing or unknown"
        raise InputError(f"gains file {path}", "", wanted, problem)
    return LqrRollBar(**gains)


def as_parameter_file(design: RollBarDesign, criteria: RollBarCriteria, vehicle: str) -> str:
    """The text of the file; comments tell where the gains come from.

    vehicle: what it is, in words.
    """
    model = design.model
    trim = dict(zip(model.output_names, model.trim_output, strict=True))
    speed = model.trim_state[model.state_names.index("u")]
    given = dataclasses.asdict(criteria)
    weighed = (f"{name} {given[name]:g}" for name in given if name.endswith("_scale"))
    lines = (
        f"# Gains of {NODE}, computed by examples/design_lqr_roll_bar.py, which writes this file.",
        f"# vehicle: {vehicle}, model {model.trim.plant.options.model}",
        f"# trim: straight ahead at {speed:g} m/s, torque at each rear wheel "
        f"{_tenths(model.trim.drive_torque)} N m,",
        f"#   roll angle {_tenths(trim['roll'])} rad, lateral acceleration "
        f"{_tenths(trim['lateral_acceleration'])} m/s^2",
        f"# weights: {', '.join(weighed)}",
        "# slow poles of the lateral motion (1/s):",
        f"#   without the bars: {_slow(design.poles_without)}",
        f"#   with them: {_slow(design.poles)}",
        f"{NODE}:",
        f"  {PARAMETERS}:",
    )
    values = dataclasses.asdict(design.law).items()
    return "\n".join((*lines, *(f"    {name}: {_rounded(value)}" for name, value in values), ""))


def _slow(poles: np.ndarray) -> str:
    """The slow poles, slowest first, conjugate ones once."""
    named = sorted((p for p in poles if p.imag >= 0.0 and abs(p) < SLOW), key=abs)
    return ", ".join(f"{p.real:.3g}" + (f"±{p.imag:.3g}i" if p.imag else "") for p in named)


def _tenths(value: float) -> float:
    """Rounded; never -0.0, which rounding errors would make of nought on some machines."""
    return round(float(value), 1) + 0.0


def _rounded(value: float) -> float:
    return float(f"{value:.{DIGITS}g}")
