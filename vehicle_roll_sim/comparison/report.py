"""A comparison in text and as a table of samples."""

import math
from pathlib import Path

import numpy as np

from vehicle_roll_sim.comparison.comparison import Compared, Judged
from vehicle_roll_sim.comparison.driving import SPEED_HELD
from vehicle_roll_sim.comparison.steady import LINEAR
from vehicle_roll_sim.files.table_file import write_rows
from vehicle_roll_sim.logs.quantities import QUANTITIES
from vehicle_roll_sim.runs.summary import line

HEADER = (
    f"{'quantity':22}{'unit':>6}{'peak':>10}{'rms error':>18}{'peak error':>18}{'offset':>9}"
    f"{'shift s':>9}{'corr.':>8}{'gain':>7}{'inside':>8}  verdict"
)
VERDICTS = {True: "accepted", False: "rejected", None: "too small to judge"}
SIDES = ("measured", "simulated", "lower", "upper")


def shown_in(unit: str) -> tuple[str, float]:
    """The unit in which values of an SI unit are printed, and the factor."""
    return (unit.replace("rad", "deg"), math.degrees(1.0)) if "rad" in unit else (unit, 1.0)


def summary(compared: Compared) -> str:
    """The comparison as text: what was done, a line for each quantity, gradients, verdict."""
    lines = [
        line("driven by", _driven_by(compared)),
        line("compared", _span(compared)),
        *(line(*note.split(": ", 1)) for note in compared.log.notes),
        HEADER,
        *(_line_of(name, each) for name, each in compared.judged.items()),
        *_steady_lines(compared),
        line("corridor", _tolerances(compared)),
        line("verdict", _verdict(compared)),
    ]
    return "\n".join(lines)


def _span(compared: Compared) -> str:
    time = compared.time
    return f"{time[0]:g} to {time[-1]:g} s of the log, every {compared.log.interval:g} s"


def _driven_by(compared: Compared) -> str:
    driven = compared.driven
    if compared.driving.drive_by == SPEED_HELD:
        text = f"steering and speed, held within {driven.speed_error:.2g} m/s"
    else:
        text = "steering and torques"
    return f"{text}; not used: {', '.join(driven.unused)}" if driven.unused else text


def _line_of(name: str, judged: Judged) -> str:
    unit, scale = shown_in(QUANTITIES[name].unit)
    found = judged.agreement
    rms, peak_error = (
        f"{_number(scale * error)} {_percent(error, found.peak)}"
        for error in (found.rms, found.peak_error)
    )
    return (
        f"{name:22}{unit:>6}{_number(scale * found.peak):>10}{rms:>18}{peak_error:>18}"
        f"{scale * found.offset:>9.2g}{_or_dash(found.shift, '.3f'):>9}"
        f"{_or_dash(found.correlation, '.4f'):>8}{_or_dash(found.gain, '.3f'):>7}"
        f"{100 * judged.inside:>6.1f} %  {VERDICTS[judged.accepted]}"
    )


def _steady_lines(compared: Compared) -> list[str]:
    part = compared.steady
    if part is None:
        return []
    unit, scale = shown_in("rad/(m/s^2)")
    seconds = part.chosen.sum() * compared.log.interval
    lines = [line("quasi-steady part", f"{seconds:.2f} s, gradients up to {LINEAR:g} m/s^2")]
    for name in ("understeer", "roll"):
        sides = (("measured", part.measured), ("simulated", part.simulated))
        values = {side: scale * getattr(of, name) for side, of in sides}
        if not math.isnan(values["measured"]):
            text = ", ".join(f"{side} {value:.4f}" for side, value in values.items())
            lines.append(line(f"{name} gradient", f"{text} {unit}"))
    if part.inside:
        lines.append(line("over lateral acceleration", _over_acceleration(compared)))
    return lines


def _over_acceleration(compared: Compared) -> str:
    """How many cross plots are inside their corridors, and which are not."""
    shares, accepts = compared.steady.inside, compared.tolerances.accepts
    outside = [f"{name} {100 * each:.1f} %" for name, each in shares.items() if not accepts(each)]
    text = f"{len(shares) - len(outside)} of {len(shares)} cross plots inside"
    return f"{text}, not {', '.join(outside)}" if outside else text


def _tolerances(compared: Compared) -> str:
    given = compared.tolerances
    return (
        f"±{given.time_tolerance:g} s, ±({given.gain_tolerance:g} % of the value + "
        f"{given.offset_tolerance:g} % of the peak), for {given.inside:g} % of the samples; "
        "not those of a standard"
    )


def _verdict(compared: Compared) -> str:
    if compared.stopped_early:
        how = compared.driven.condition.name.lower().replace("_", " ")
        return f"rejected: the model stopped at {compared.time[-1]:.2f} s of the log: {how}"
    if compared.accepted is None:
        return "none: no quantity is large enough to judge"
    known = [each for each in compared.judged.values() if each.accepted is not None]
    good = sum(each.accepted for each in known)
    text = f"{VERDICTS[compared.accepted]}: {good} of {len(known)} quantities inside over time"
    is_outside = compared.steady is not None and compared.steady.accepted is False
    return f"{text}, not all over lateral acceleration" if is_outside else text


def _number(value: float) -> str:
    return f"{value:.4g}"


def _percent(error: float, peak: float) -> str:
    return f"{100 * error / peak:5.1f} %" if peak > 0.0 else "–"


def _or_dash(value: float, form: str) -> str:
    return "–" if math.isnan(value) else format(value, form)


def columns_of(compared: Compared) -> dict[str, np.ndarray]:
    """Time and, of each quantity, measured, simulated, lower and upper boundary, in SI units."""
    columns = {"time": compared.time}
    for name, judged in compared.judged.items():
        columns |= {f"{name}_{side}": getattr(judged, side) for side in SIDES}
    return columns


def write_csv(compared: Compared, path: Path) -> None:
    """Write the columns in full precision; an unknown value is empty."""
    columns = columns_of(compared)
    rows = np.column_stack(list(columns.values())).tolist()
    texts = [["" if math.isnan(value) else value for value in row] for row in rows]
    write_rows(path, list(columns), texts)
