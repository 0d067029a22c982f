"""Results of the benchmarks: percentiles, and tables in Markdown."""

import math
import textwrap
from collections.abc import Mapping, Sequence

import numpy as np

NONE = "–"
"""Shown where there is no number."""
WIDTH = 105
"""Characters in a line of text."""
MILLI, MICRO, NANO = 1e3, 1e6, 1e9
"""Their number in one unit."""


def median(values: Sequence[float]) -> float:
    return percentile(values, 50)


def percentile(values: Sequence[float], share: float) -> float:
    """The percentile `share` (0 to 100) of some values; nan if there are none."""
    return float(np.percentile(values, share)) if len(values) else math.nan


def as_lines(about: Mapping[str, str]) -> str:
    return "\n".join(f"- {name}: {value}" for name, value in about.items())


def as_section(benchmark, rows: Sequence[Mapping]) -> str:
    """Heading, explanation and table of a benchmark; COLUMNS maps keys of a row to headings."""
    columns = benchmark.COLUMNS
    lines = [list(columns.values()), ["---"] * len(columns)]
    lines += [[_shown(row[key]) for key in columns] for row in rows]
    table = "\n".join("| " + " | ".join(line) + " |" for line in lines)
    about = textwrap.fill(benchmark.ABOUT, WIDTH, break_on_hyphens=False)
    return f"### {benchmark.TITLE}\n\n{about}\n\n{table}"


def _shown(value) -> str:
    """A number with three significant digits, but no digit before the point dropped."""
    if not isinstance(value, float):
        return str(value)
    if math.isnan(value):
        return NONE
    return f"{value:.0f}" if abs(value) >= 100.0 else f"{value:.3g}"


def without_nan(value):
    """The same lists and dictionaries with None for numbers that are not finite, for JSON."""
    if isinstance(value, Mapping):
        return {key: without_nan(each) for key, each in value.items()}
    if isinstance(value, list):
        return [without_nan(each) for each in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
