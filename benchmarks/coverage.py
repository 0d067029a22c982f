"""How many of the intervals of 95 % contain the hidden value, and how the fits ended, as text.

The result of a vehicle has `rows`: by name, hidden and identified value, and half width of the
interval and of that for white residuals; and `doubt`: whether the fit may have ended beside the
best values.
"""

from collections.abc import Container, Sequence

import numpy as np

FAR = 5.0
"""Standard errors by which a value that is off is no longer one of the 5 % outside."""
NORMAL = 1.96
"""Standard errors of a half width of 95 %."""


def table(results: Sequence[dict | None], relative: Container[str]) -> str:
    """The table of coverage in Markdown.

    results: those of vehicles; one that failed (None) covers nothing. relative: names of the values
    whose half widths are shown over the value.
    """
    known = [each["rows"] for each in results if each is not None]
    white_head = "share if residuals counted as white"
    lines = [
        f"| value | covered | of | share | {white_head} | over white | usual half width |",
        "| --- | --- | --- | --- | --- | --- | --- |",
    ]
    total, white = [], []
    for name in known[0]:
        truth, value, half, narrow = np.array([each[name] for each in known]).T
        is_covered, is_white = abs(value - truth) <= half, abs(value - truth) <= narrow
        total += is_covered.tolist()
        white += is_white.tolist()
        is_relative = name in relative
        usual = np.median(100 * half / abs(truth) if is_relative else half)
        over = np.median(half / narrow)
        lines.append(
            f"| `{name}` | {is_covered.sum()} | {len(results)} | {_share(is_covered, results)} | "
            f"{_share(is_white, results)} | {over:.2f} | {usual:.2g}{' %' if is_relative else ''} |"
        )
    count = len(results) * len(known[0])
    lines.append(
        f"| all | {sum(total)} | {count} | {100 * sum(total) / count:.1f} % | "
        f"{100 * sum(white) / count:.1f} % | | |"
    )
    return "\n".join(lines)


def text_on_fits(results: Sequence[dict | None]) -> str:
    """How many fits are off by far, and how many the report puts in doubt."""
    failed = sum(each is None for each in results)
    off = {number: _off(each) for number, each in enumerate(results) if each is not None}
    far = [number for number, errors in off.items() if errors > FAR]
    doubtful = [number for number in off if results[number]["doubt"]]
    of_far = "".join(f"; vehicle {number} by {off[number]:.1f}" for number in far)
    return (
        f"Fits that failed: {failed}. Fits in which a value is off by more than {FAR:g} standard "
        f"errors: {len(far)}{of_far}. Fits of which the report says that they may have ended "
        f"beside the best values: {len(doubtful)}; of the former, {len({*far} & {*doubtful})}."
    )


def _off(result: dict) -> float:
    """The largest error of a result, in standard errors."""
    return max(
        abs(value - truth) / (half / NORMAL) for truth, value, half, _ in result["rows"].values()
    )


def _share(is_covered: np.ndarray, results: Sequence[dict | None]) -> str:
    return f"{100 * is_covered.sum() / len(results):.1f} %"
