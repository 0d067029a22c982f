"""`python -m benchmarks.mutations`: is each deliberate fault noticed by the test that it names?

The package and its tests are copied to a temporary folder, in which one fault after the other is
put in and taken out again.
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
"""By its exit status; another one is of pytest itself."""
TIMEOUT = 600.0
"""s for a test: a hang is noticed, too."""


@dataclasses.dataclass(frozen=True)
class Result:
    """What became of a fault. test: the first that failed."""

    verdict: str
    test: str
    seconds: float
    text: str


def faulty_text(fault: Fault, text: str) -> str:
    """A file with the fault; raises InputError where the original is not there exactly once."""
    found = text.count(fault.original)
    if found != 1:
        raise InputError(
            fault.file, fault.original, f"a text that is there once, not {found} times"
        )
    return text.replace(fault.original, fault.faulty)


def verdict_on(fault: Fault, folder: Path) -> Result:
    """Put a fault into the copy in `folder`, run its test, and take it out."""
    file = folder / PACKAGE / fault.file
    text = file.read_text(encoding="utf-8")
    file.write_text(faulty_text(fault, text), encoding="utf-8")
    try:
        return run_test(fault.test, folder)
    finally:
        file.write_text(text, encoding="utf-8")


def run_test(test: str, folder: Path) -> Result:
    """A test, on the package in `folder`."""
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
        return Result(CAUGHT, f"{test} (does not end)", time.monotonic() - begun, "")
    failed = re.search(r"^(?:FAILED|ERROR) (\S+)", done.stdout, re.MULTILINE)
    verdict = OF_PYTEST.get(done.returncode, UNCLEAR)
    text = done.stdout + done.stderr
    return Result(verdict, failed[1] if failed else test, time.monotonic() - begun, text)


def copy_to(folder: Path) -> None:
    for name in COPIED:
        source = ROOT / name
        if source.is_dir():
            shutil.copytree(source, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy2(source, folder / name)


def check_sound(faults: list[Fault], folder: Path) -> None:
    """Raise InputError unless the tests pass without any fault: else they prove nothing."""
    for test in dict.fromkeys(fault.test for fault in faults):
        result = run_test(test, folder)
        if result.verdict != SURVIVED:
            print(result.text, file=sys.stderr)
            raise InputError("test", test, "a test that passes without a fault")


def row(fault: Fault, result: Result) -> str:
    """Of the table."""
    test = result.test.rpartition("/")[2].partition("[")[0]
    return f"| {fault.what} | `{fault.file}` | {result.verdict} | `{test}` |"


def main(words: list[str] | None = None) -> int:
    parser = OneLineParser(prog=PROGRAM, description=__doc__.partition(": ")[2])
    parser.add_argument("--only", metavar="TEXT", default="", help="faults whose file has this")

    def command() -> int:
        only = parser.parse_args(words).only
        faults = [fault for fault in FAULTS if only in fault.file]
        if not faults:
            raise InputError("--only", only, "part of the file of a fault")
        with tempfile.TemporaryDirectory(prefix="mutations-") as name:
            folder = Path(name)
            copy_to(folder)
            check_sound(faults, folder)
            print("| fault | file | | by |\n| --- | --- | --- | --- |", flush=True)
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
