"""`python -m benchmarks.scores PAGE --out DIR [...]`: scores of the example controllers.

All are scored by the executable `score` into the folder DIR, in the quick size unless `--full` is
given. The tables of its report replace those in PAGE.
"""

import argparse
import re
import subprocess
import sys
from pathlib import Path

from vehicle_roll_sim.scoring.report import TEXT

CONTROLLERS = (
    *("active_roll_bar", "lqr_roll_bar", "rear_steering"),
    *("roll_braking", "yaw_control", "stability_control", "rollover_mpc"),
)
BEGIN, END = "<!-- score -->\n", "<!-- end of score -->"
FIRST, LAST = "## Summary", "## Worst runs"
"""Headings: from the first on, and before the last, the report goes into the page."""


def as_part(report: str) -> str:
    """The tables of a report, one level of headings lower, without figures."""
    text = FIRST + report.partition(FIRST)[2].partition(LAST)[0]
    text = re.sub(r"!\[[^\n]*\n\n", "", text)
    return re.sub(r"^##", "###", text, flags=re.MULTILINE)


def replaced(page: str, report: str) -> str:
    """The page with the tables of the report; exits if it has no place for them."""
    before, begin, rest = page.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not (begin and end):
        raise SystemExit("scores: error: no place for tables")
    return f"{before}{begin}\n{as_part(report)}{end}{after}"


def main(words: list[str]) -> int:
    parser = argparse.ArgumentParser(prog="scores", description=__doc__)
    parser.add_argument("page", metavar="PAGE", type=Path)
    parser.add_argument("--out", metavar="DIR", type=Path, required=True)
    parser.add_argument("--full", action="store_true")
    arguments, others = parser.parse_known_args(words)
    size = [] if arguments.full else ["--quick"]
    module = [sys.executable, "-m", "vehicle_roll_sim.ros.executables", "score"]
    command = [*module, *CONTROLLERS, *size, "--out", str(arguments.out), *others]
    status = subprocess.run(command, check=False).returncode
    if status == 0:
        page = arguments.page.read_text(encoding="utf-8")
        report = (arguments.out / TEXT).read_text(encoding="utf-8")
        arguments.page.write_text(replaced(page, report), encoding="utf-8")
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
