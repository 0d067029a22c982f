"""An identification in text: values with intervals, combinations, correlations, fits."""

import numpy as np

from vehicle_roll_sim.comparison.comparison import Compared
from vehicle_roll_sim.comparison.report import VERDICTS, shown_in
from vehicle_roll_sim.identification.estimate import Estimate
from vehicle_roll_sim.identification.uncertainty import Combination
from vehicle_roll_sim.identification.vehicle_text import interval_text
from vehicle_roll_sim.logs.quantities import QUANTITIES
from vehicle_roll_sim.runs.summary import line

SMALL_WEIGHT = 0.2
"""Of a value in a combination: smaller ones are not shown."""
SHOWN_CORRELATION = 0.9
WIDTH = 34


def summary(estimate: Estimate, names: list[str]) -> str:
    """The identification as text. names: of the logs."""
    uncertainty = estimate.uncertainty
    rows = sum(len(log.time) * len(log.compared) for log in estimate.problem.logs)
    windows = ", ".join(f"{width:.2g}" for width in uncertainty.window)
    lines = [
        line("identified from", ", ".join(names)),
        line("runs", f"{estimate.problem.runs}{_ended(estimate)}"),
        line("samples", f"{rows}, as good as {uncertainty.effective:.0f} independent ones"),
        line("correlated over", f"{windows} s"),
        f"{'value':{WIDTH}}{'unit':>10}{'start':>12}{'identified':>12}  95 % interval",
        *(_row(estimate, each) for each in estimate.free),
        *_correlation_lines(estimate),
        *_combination_lines(estimate),
        *_fit_lines(estimate, names),
    ]
    return "\n".join(lines)


def _ended(estimate: Estimate) -> str:
    at_bounds = [each.name for each in estimate.free if _is_at_bound(estimate, each)]
    text = "" if estimate.is_converged else ", and still not converged"
    if estimate.is_beside:
        text += f"; the best values may be {estimate.beside:.1f} standard errors away"
    return f"{text}; at a bound: {', '.join(at_bounds)}" if at_bounds else text


def _is_at_bound(estimate: Estimate, free) -> bool:
    value = estimate.values[free.name]
    return min(value - free.lower, free.upper - value) <= 1e-6 * free.scale


def _row(estimate: Estimate, free) -> str:
    value = estimate.values[free.name]
    return (
        f"{free.name:{WIDTH}}{free.unit or '-':>10}{free.start:>12.6g}{value:>12.6g}"
        f"  {interval_text(estimate, free.name)}"
    )


def _correlation_lines(estimate: Estimate) -> list[str]:
    """Pairs that are hard to tell apart."""
    found, names = estimate.uncertainty.correlations, [each.name for each in estimate.free]
    pairs = [
        f"{names[i]} and {names[j]} {found[i, j]:+.3f}"
        for i, j in zip(*np.triu_indices(len(names), 1), strict=True)
        if abs(found[i, j]) >= SHOWN_CORRELATION
    ]
    return [line("strongly correlated", "; ".join(pairs))] if pairs else []


def in_words(combination: Combination, names: list[str]) -> str:
    """A combination as a sum of its values over their scales, the largest first."""
    weights = combination.weights * np.sign(
        combination.weights[np.argmax(abs(combination.weights))]
    )
    order = np.argsort(-abs(weights), kind="stable")
    parts = [f"{weights[j]:+.2f} {names[j]}" for j in order if abs(weights[j]) >= SMALL_WEIGHT]
    return " ".join(parts)


def _combination_lines(estimate: Estimate) -> list[str]:
    """The least certain combination, and all that are not identifiable."""
    names, found = [each.name for each in estimate.free], estimate.uncertainty.combinations
    worst = max(found, key=lambda each: each.error)
    lines = [
        line("least certain", f"{in_words(worst, names)}: ± {_percent(worst)} of their scales")
    ]
    lines += [
        line("not identifiable", f"{in_words(each, names)}: ± {_percent(each)} of their scales")
        for each in found
        if not each.is_identifiable
    ]
    return lines


def _percent(combination: Combination) -> str:
    return f"{100 * combination.error:.2g} %" if combination.error < 1e3 else "more than 100000 %"


def _fit_lines(estimate: Estimate, names: list[str]) -> list[str]:
    """Root mean square of what the fit leaves, by log and quantity."""
    return [
        line(f"left of {name}", ", ".join(_left(quantity, rms) for quantity, rms in spread.items()))
        for name, spread in zip(names, estimate.spreads, strict=True)
    ]


def _left(quantity: str, rms: float) -> str:
    unit, scale = shown_in(QUANTITIES[quantity].unit)
    return f"{quantity} {scale * rms:.3g} {unit}"


def verdict_line(name: str, compared: Compared) -> str:
    """One line on a log that is driven by the identified vehicle."""
    errors = [
        f"{quantity} {100 * each.agreement.rms / each.agreement.peak:.1f} %"
        for quantity, each in compared.judged.items()
        if each.agreement.peak > 0.0
    ]
    verdict = "nothing to judge" if compared.accepted is None else VERDICTS[compared.accepted]
    if compared.stopped_early:
        verdict += ": the model stopped early"
    return line(name, f"{verdict}; rms error {', '.join(errors)} of the peak")
