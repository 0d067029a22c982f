"""The summary of a study as Markdown: failures, probabilities, quantiles, thresholds, indices."""

import itertools
from collections.abc import Iterator

import numpy as np

from vehicle_roll_sim.runs.run_metrics import METRIC_UNITS
from vehicle_roll_sim.studies.quantities import quantity
from vehicle_roll_sim.studies.results import Results
from vehicle_roll_sim.studies.statistics import Interval, probability, quantiles, sobol_indices
from vehicle_roll_sim.studies.study import SALTELLI, Study
from vehicle_roll_sim.studies.tables import cell

QUANTILES = (0.05, 0.5, 0.95)
MOST_ROWS = 50
"""Of a table of grid points or thresholds; the files have all."""
MOST_REASONS = 5


def summary_of(results: Results) -> str:
    """The whole summary. Metrics are in SI units and radians."""
    blocks = [_head(results), *_failures(results)]
    if results.estimate:
        blocks += _rare(results)
    elif results.study.search:
        blocks += _thresholds(results)
    else:
        blocks += [*_probabilities(results), *_quantiles(results)]
        if results.study.design == SALTELLI and results.is_complete:
            blocks += _indices(results)
    return "\n\n".join(blocks) + "\n"


def _head(results: Results) -> str:
    study = results.study
    said = study.said
    controller = f", controller: {said['controller']}" if study.controller else ""
    lines = [
        "# Study",
        "",
        f"- manoeuvre: {said['manoeuvre']}{controller}, "
        f"vehicle: {said.get('vehicle', 'reference')}",
        *(f"- fixed: {name} = {_fixed(name, value, study)}" for name, value in study.fixed.items()),
        f"- design: {study.design}, factors: {', '.join(study.factors) or 'none'}",
        f"- runs: {len(results.runs)}{'' if results.is_complete else ', more to come'}",
    ]
    return "\n".join(lines)


def _fixed(name: str, value, study: Study) -> str:
    """A fixed value in words, also one that is None."""
    return str(value) if value is not None else quantity(name, study.driving, name).none


def _failures(results: Results) -> Iterator[str]:
    reasons = results.columns.reasons
    if reasons:
        rows = [(count, reason) for reason, count in reasons.most_common(MOST_REASONS)]
        yield f"## Runs that failed: {reasons.total()}"
        yield table(("runs", "reason"), rows)
        yield "They are left out of probabilities and quantiles."


def _probabilities(results: Results) -> Iterator[str]:
    """The probability of each event, or whether it happened, at each point of the grid."""
    study, happened = results.study, results.columns.happened
    rows = [
        (*levels.values(), len(own), *(_share(each[own], study) for each in happened.values()))
        for levels, own in _grid_points(results)
    ]
    yield "## Probabilities" if study.drawn else "## Events"
    yield "\n".join(f"- {name}: {event}" for name, event in study.events.items())
    yield from _shortened((*study.gridded, "runs", *study.events), rows)
    if study.drawn:
        yield (
            "95 % Wilson intervals in brackets. They assume independent draws; estimates from "
            "Latin hypercubes and Sobol sequences usually scatter less."
        )


def _share(happened: np.ndarray, study: Study) -> str:
    """The share of runs in which an event happened, of those that did not fail."""
    known = happened[~np.isnan(happened)]
    if not len(known):
        return "unknown"
    if not study.drawn:
        return "yes" if known.all() else "no"
    return _with_interval(probability(int(known.sum()), len(known)))


def _grid_points(results: Results) -> Iterator[tuple[dict, np.ndarray]]:
    """The values of the gridded factors, and the indices of the runs with them.

    For Sobol indices, only runs of the first two blocks: the others mix the values of both.
    """
    study = results.study
    positions, draws = np.divmod(results.columns.numbers, study.samples)
    independent = 2 * study.settings.runs if study.design == SALTELLI else study.samples
    for position, values in enumerate(itertools.product(*study.gridded.values())):
        begin, end = np.searchsorted(positions, (position, position + 1))
        own = np.arange(begin, end)[draws[begin:end] < independent]
        if len(own):
            yield dict(zip(study.gridded, values, strict=True)), own


def _quantiles(results: Results) -> Iterator[str]:
    """Quantiles of the outputs at each point of the grid."""
    if not results.study.drawn:
        return
    rows = []
    for levels, own in _grid_points(results):
        for name, magnitudes in results.columns.magnitudes.items():
            values = magnitudes[own]
            values = values[~np.isnan(values)]
            if len(values):
                found = map(_with_interval, quantiles(values, QUANTILES))
                rows.append((*levels.values(), name, METRIC_UNITS[name], len(values), *found))
    if rows:
        yield "## Quantiles"
        names = (f"{100 * share:g} %" for share in QUANTILES)
        yield from _shortened((*results.study.gridded, "metric", "unit", "runs", *names), rows)
        yield "Magnitudes, with 95 % bootstrap intervals in brackets."


def _with_interval(found: Interval) -> str:
    return f"{cell(found.value)} ({cell(found.low)} to {cell(found.high)})"


def _indices(results: Results) -> Iterator[str]:
    """Sobol indices of the outputs, for grids with a single point."""
    yield "## Sobol indices"
    rows = []
    for name, values in results.columns.magnitudes.items():
        if results.study.gridded or np.isnan(values).any():
            why = "the design has a grid" if results.study.gridded else "not all runs have a value"
            yield f"No indices of {name}: {why}."
            continue
        factors = list(results.study.drawn)
        for factor, found in zip(factors, sobol_indices(values, len(factors)), strict=True):
            rows.append((name, factor, _with_interval(found.first), _with_interval(found.total)))
    if rows:
        yield table(("metric", "factor", "first order", "total"), rows)


def _thresholds(results: Results) -> Iterator[str]:
    search = results.study.search
    if results.brackets is None:
        return
    yield f"## Lowest {search.factor} with {search.event}"
    event = results.study.events[search.event]
    yield f"{event}; searched from {search.lowest:g} to {search.highest:g}."
    rows = [
        (*each.point.values(), cell(each.threshold), cell(each.below), len(each.happened))
        for each in results.brackets
    ]
    columns = (*results.study.factors, "threshold", "no event at", "runs")
    yield from _shortened(columns, rows)


def _rare(results: Results) -> Iterator[str]:
    estimate, name = results.estimate, results.study.rare.event
    low, high = estimate.interval
    yield f"## Probability of {name} by subset simulation"
    yield f"{results.study.events[name]}"
    if not estimate.is_reached:
        yield (
            f"Not reached in {len(estimate.levels)} levels: it is less likely than the last of "
            f"them, whose probability is {estimate.probability:.2g} (95 % interval {low:.2g} to "
            f"{high:.2g})."
        )
        return
    rows = [
        ("probability", f"{estimate.probability:.3g}"),
        ("95 % interval", f"{low:.2g} to {high:.2g}"),
        ("coefficient of variation", f"{estimate.variation:.2f}"),
        ("runs", estimate.runs),
        ("independent runs for the same accuracy", f"{estimate.brute_force_runs:.2g}"),
        ("failed runs, counted as non-events", estimate.unknown),
    ]
    yield table(("", ""), rows)


def _shortened(columns: tuple, rows: list[tuple]) -> Iterator[str]:
    yield table(columns, rows[:MOST_ROWS])
    if len(rows) > MOST_ROWS:
        yield f"The first {MOST_ROWS} of {len(rows)} rows."


def table(columns: tuple, rows: list[tuple]) -> str:
    """A table in Markdown."""
    lines = (columns, ("---",) * len(columns), *rows)
    return "\n".join("| " + " | ".join(map(_text, line)) + " |" for line in lines)


def _text(value) -> str:
    text = f"{value:g}" if isinstance(value, float) else str(value)
    return text.replace("|", "\\|").replace("\n", " ")
