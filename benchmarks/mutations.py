"""`python -m benchmarks.mutations`: check that each deliberate fault is caught by its test.

The package and its tests are copied to a temporary folder, in which one fault at a time is
inserted and then removed again.
"""

import dataclasses
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from benchmarks.faults import FAULTS, Fault
from vehicle_roll_sim.arguments import OneLineParser, exit_status
from vehicle_roll_sim.declaration import InputError

PROGRAM = "mutations"
ROOT = Path(__file__).resolve().parent.parent
PACKAGE = "vehicle_roll_sim"
COPIED = (PACKAGE, "test", "benchmarks", "msg_examples", "setup.cfg", "setup.py", "package.xml")
CAUGHT, SURVIVED, UNCLEAR = "caught", "survived", "unclear"
OF_PYTEST = {0: SURVIVED, 1: CAUGHT}
"""Verdict by exit status of pytest; any other status is an error of pytest itself."""
TIMEOUT = 600.0
"""s per test, so that a hang is noticed as well."""


@dataclasses.dataclass(frozen=True)
class Result:
    """What became of a fault. test: the first test that failed."""

    verdict: str
    test: str
    seconds: float
    text: str


def faulty_text(fault: Fault, text: str) -> str:
    """The text with the fault; raises InputError unless the original occurs exactly once."""
    found = text.count(fault.original)
    if found != 1:
        raise InputError(
            fault.file, fault.original, f"text that occurs exactly once, not {found} times"
        )
    return text.replace(fault.original, fault.faulty)


def verdict_on(fault: Fault, folder: Path) -> Result:
    """Insert a fault into the copy in `folder`, run its test, and remove the fault."""
    file = folder / PACKAGE / fault.file
    text = file.read_text(encoding="utf-8")
    file.write_text(faulty_text(fault, text), encoding="utf-8")
    try:
        return run_test(fault.test, folder)
    finally:
        file.write_text(text, encoding="utf-8")


def run_test(test: str, folder: Path) -> Result:
    """Run a test on the package in `folder`."""
    environment = os.environ | {
        "PYTHONPATH": str(folder),
        "PYTHONDONTWRITEBYTECODE": "1",
        "NUMBA_CACHE_DIR": str(folder / "compiled"),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    }
    command = [sys.executable, "-m", "pytest", "--quiet", "--exitfirst", "--tb=line", test]
    begun = time.monotonic()
    try:
        done = subprocess.run(
            command, cwd=folder, env=environment, capture_output=True, text=True, timeout=TIMEOUT
        )
    except subprocess.TimeoutExpired:
        return Result(CAUGHT, f"{test} (timed out)", time.monotonic() - begun, "")
    failed = re.search(r"^(?:FAILED|ERROR) (\S+)", done.stdout, re.MULTILINE)
    verdict = OF_PYTEST.get(done.returncode, UNCLEAR)
    text = done.stdout + done.stderr
    return Result(verdict, failed[1] if failed else test, time.monotonic() - begun, text)


def copy_to(folder: Path) -> None:
    """Copy the package and everything that its tests need."""
    for name in COPIED:
        source = ROOT / name
        if source.is_dir():
            shutil.copytree(source, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy2(source, folder / name)


def check_sound(faults: list[Fault], folder: Path) -> None:
    """Raise InputError unless the tests pass without a fault; otherwise they prove nothing."""
    for test in dict.fromkeys(fault.test for fault in faults):
        result = run_test(test, folder)
        if result.verdict != SURVIVED:
            print(result.text, file=sys.stderr)
            raise InputError("test", test, "a test that passes without a fault")


def row(fault: Fault, result: Result) -> str:
    """A row of the table."""
    test = result.test.rpartition("/")[2].partition("[")[0]
    return f"| {fault.what} | `{fault.file}` | {result.verdict} | `{test}` |"


def main(words: list[str] | None = None) -> int:
    about = "Insert deliberate faults into a copy of the package; check that tests catch them."
    parser = OneLineParser(prog=PROGRAM, description=about)
    parser.add_argument(
        "--only", metavar="TEXT", default="", help="only faults in files whose path contains this"
    )

    def command() -> int:
        only = parser.parse_args(words).only
        faults = [fault for fault in FAULTS if only in fault.file]
        if not faults:
            raise InputError("--only", only, "part of the file of a fault")
        with tempfile.TemporaryDirectory(prefix="mutations-") as name:
            folder = Path(name)
            copy_to(folder)
            check_sound(faults, folder)
            print("| fault | file | verdict | test |\n| --- | --- | --- | --- |", flush=True)
            verdicts = []
            for fault in faults:
                result = verdict_on(fault, folder)
                verdicts.append(result.verdict)
                print(row(fault, result), flush=True)
        print(f"\n{verdicts.count(CAUGHT)} of {len(verdicts)} caught")
        return 0 if verdicts.count(CAUGHT) == len(verdicts) else 1

    return exit_status(command, PROGRAM)


if __name__ == "__main__":
    sys.exit(main())
