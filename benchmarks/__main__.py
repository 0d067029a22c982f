"""`python -m benchmarks`: measure speed and accuracy on this machine; see docs/performance.md."""

import importlib
import json
import os
import signal
import sys
import tempfile
from pathlib import Path

from benchmarks import machine, report
from vehicle_roll_sim.arguments import OneLineParser, exit_status, named_file
from vehicle_roll_sim.declaration import InputError, unknown_name

BENCHMARKS = (
    *("kernel", "work_precision", "batch", "learning"),
    *("node_load", "latency", "lockstep", "startup"),
)
"""Modules, each with TITLE, ABOUT, COLUMNS and measure(quick), in the order of their tables."""
PROGRAM = "benchmarks"


def main(words: list[str] | None = None) -> int:
    """Run the benchmarks chosen in `words` (default: `sys.argv[1:]`); return the exit status."""
    parser = OneLineParser(
        prog=PROGRAM,
        description="Measure the simulator on this machine; print tables and write JSON.",
    )
    parser.add_argument(
        "--json", metavar="FILE", default="bench.json", help="file for the numbers (%(default)s)"
    )
    parser.add_argument(
        "--only",
        metavar="NAME",
        nargs="+",
        default=BENCHMARKS,
        help="benchmarks to run: " + ", ".join(BENCHMARKS),
    )
    parser.add_argument("--quick", action="store_true", help="shorter runs, rougher numbers")
    signal.signal(signal.SIGTERM, signal.default_int_handler)

    def command() -> int:
        arguments = parser.parse_args(words)
        for name in arguments.only:
            if name not in BENCHMARKS:
                raise unknown_name(name, BENCHMARKS, "--only")
        file = named_file(arguments.json, "--json")
        if file.is_dir() or not file.parent.is_dir():
            raise InputError("--json", str(file), "a file in a folder that exists")
        chosen = [name for name in BENCHMARKS if name in arguments.only]
        with tempfile.TemporaryDirectory(prefix="benchmarks-") as folder:
            os.environ["ROS_LOG_DIR"] = folder
            measure(chosen, arguments.quick, file)
        return 0

    return exit_status(command, PROGRAM)


def measure(names: list[str], quick: bool, file: Path) -> None:
    """Print the table of each benchmark when it is done, and write the rows of all to `file`."""
    here = machine.describe()
    print(report.as_lines(here), end="\n\n", flush=True)
    results = {}
    for name in names:
        benchmark = importlib.import_module(f"benchmarks.{name}")
        results[name] = benchmark.measure(quick)
        print(report.as_section(benchmark, results[name]), end="\n\n", flush=True)
    written = {"machine": here, "quick": quick, "results": report.without_nan(results)}
    file.write_text(json.dumps(written, indent=1, allow_nan=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
