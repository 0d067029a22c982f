"""The checkout, and a workspace in which it was built."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from patience import PATIENCE

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = "vehicle_roll_sim"


@pytest.fixture(scope="session")
def root() -> Path:
    """The root of the checkout."""
    return ROOT


@pytest.fixture(scope="session")
def sources() -> dict[str, str]:
    """Every module of the package: dotted name, and its text. Launch files are none."""
    modules = {}
    for path in sorted((ROOT / PACKAGE).rglob("*.py")):
        if path.name.endswith(".launch.py"):
            continue
        parts = path.relative_to(ROOT).with_suffix("").parts
        name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
        modules[name] = path.read_text(encoding="utf-8")
    return modules


@pytest.fixture(scope="session")
def environment() -> dict[str, str]:
    """That of a fresh login, with the tools of this Python in front."""
    tools = Path(sys.executable).parent
    kept = {
        name: os.environ[name] for name in ("HOME", "LANG", "XDG_CACHE_HOME") if name in os.environ
    }
    return kept | {"PATH": f"{tools}:/usr/local/bin:/usr/bin:/bin"}


@pytest.fixture(scope="session")
def installed(tmp_path_factory, environment) -> Path:
    """The install space of the package after `colcon build` of a copy of the checkout."""
    colcon = Path(sys.executable).parent / "colcon"
    if not colcon.exists():
        pytest.skip("colcon is not installed beside this Python")
    workspace = tmp_path_factory.mktemp("workspace")
    for name in checked_in_files():
        target = workspace / "src" / PACKAGE / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, target)
    built = run([colcon, "build"], workspace, environment)
    assert built.returncode == 0, built.stdout + built.stderr
    assert "1 package finished" in built.stdout
    return workspace / "install" / PACKAGE


def checked_in_files() -> list[str]:
    """What git has or would take, relative to the root."""
    listed = run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], ROOT, None)
    if listed.returncode != 0:
        pytest.skip("not a git checkout")
    return [name for name in listed.stdout.splitlines() if (ROOT / name).is_file()]


def run(words: list, folder: Path, environment: dict | None) -> subprocess.CompletedProcess:
    return subprocess.run(
        words,
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
