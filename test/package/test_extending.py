"""docs/extending.md: its changes can be applied as printed and work as the page says."""

import os
import re
import shutil
import subprocess
import sys
import textwrap

import pytest

pytestmark = pytest.mark.unmeasured  # what runs is a copy of the package

PACKAGE = "vehicle_roll_sim"
DOES = {
    "A vehicle parameter": """
        from vehicle_roll_sim import Command, Simulation, preset
        forces = []
        for progression in (0.0, 1e9):
            vehicle = preset().with_values({"front_spring_progression": progression})
            simulation = Simulation(vehicle, step=1e-6)
            simulation.state["suspension_compression"][0] += 0.01
            simulation.step(Command(), 1e-6)
            forces.append(simulation.outputs.strut_force[:3].copy())
        added = forces[1] - forces[0]
        assert abs(added[0] - 1000.0) < 0.1  # N: 1e9 * 0.01**3, but for what a step moves
        assert abs(added[1:]).max() < 0.01
    """,
    "A model option": """
        from vehicle_roll_sim import Command, Options, Simulation, preset
        transfers = []
        for off in (False, True):
            simulation = Simulation(preset(), Options(no_link_load_transfer=off))
            simulation.step(Command(steering=0.05), 0.01)
            transfers.append(abs(simulation.outputs.link_load_transfer).max())
        assert transfers[0] > 1.0 and transfers[1] == 0.0
    """,
    "A manoeuvre": """
        import math
        from vehicle_roll_sim.command_line.main import main
        from vehicle_roll_sim.manoeuvres.catalogue import manoeuvre_named
        import numpy as np
        steering = manoeuvre_named("sine_steer")(np.array([0.5, 1.5, 2.5, 4.0]))["steering"]
        peak = math.radians(3.0)
        np.testing.assert_allclose(steering, [0.0, peak, -peak, 0.0], atol=1e-12)
        assert main(["run", "sine_steer", "--frequency", "0.7", "--duration", "0.02"]) == 0
    """,
    "A topic": """
        from rosbags.rosbag2 import Reader
        from vehicle_roll_sim.command_line.main import main
        assert main(["run", "step_steer", "--duration", "0.02", "--bag", "bag"]) == 0
        with Reader("bag") as reader:
            counts = {each.topic: each.msgcount for each in reader.connections}
        assert counts["/sideslip_angle"] == counts["/motion"] == 3
    """,
}
"""By heading: a program to run with the changes of that section."""


@pytest.fixture(scope="module")
def sections(root) -> dict[str, str]:
    """The text of each section, by heading."""
    _, *parts = re.split(r"^## ", (root / "docs" / "extending.md").read_text("utf-8"), flags=re.M)
    return dict(part.split("\n", 1) for part in parts)


def make(change: str, folder) -> None:
    """Apply one change: create a file, or replace lines that occur exactly once in a file."""
    header, *lines = change.splitlines()
    kind, name = header.split()
    old = "\n".join(line[1:] for line in lines if line[0] in " -")
    new = "\n".join(line[1:] for line in lines if line[0] in " +")
    if kind == "+++":
        (folder / name).write_text(new + "\n", encoding="utf-8")
        return
    text = (folder / name).read_text("utf-8")
    assert text.count(old + "\n") == 1, f"{name}: {old!r} stands there {text.count(old)} times"
    (folder / name).write_text(text.replace(old + "\n", new + "\n"), encoding="utf-8")


def test_every_section_is_tried(sections):
    assert sections.keys() == DOES.keys()


@pytest.mark.parametrize("heading", DOES)
def test_the_changes_do_what_the_page_says(root, tmp_path, sections, heading):
    shutil.copytree(
        root / PACKAGE, tmp_path / PACKAGE, ignore=shutil.ignore_patterns("__pycache__")
    )
    changes = re.findall(r"^```diff\n(.*?)\n```$", sections[heading], flags=re.M | re.S)
    assert changes
    for change in changes:
        make(change, tmp_path)
    if heading == "A topic":
        pytest.importorskip("rosbags", reason="the topic is looked for in a bag")
    plain = os.environ | {"NUMBA_DISABLE_JIT": "1", "PYTHONPATH": str(tmp_path)}
    words = [sys.executable, "-c", textwrap.dedent(DOES[heading])]
    result = subprocess.run(
        words, cwd=tmp_path, env=plain, capture_output=True, text=True, timeout=300, check=False
    )
    assert result.returncode == 0, result.stderr
