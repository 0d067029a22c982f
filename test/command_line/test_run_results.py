"""Output of `run`: the reference numbers, and the same bytes for the same input."""

import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest
from matplotlib.image import imread
from patience import PATIENCE

from vehicle_roll_sim.command_line.main import main

pytestmark = pytest.mark.unmeasured

SHORT = ("run", "step_steer", "--duration", "1.5")
PRINTED = 0.0015
"""s: the references are certain to 1 ms, and the lines are rounded to 1 ms."""
J_TURN = {"lf": 1.572, "rf": 3.001, "lr": 1.395, "rr": 3.119}
RAMP_STEER = {"lf": 3.732, "rf": 5.078, "lr": 3.020, "rr": 5.207}
"""s: when the wheels lift off, in two implementations made apart."""
ANGLE = 0.0015
"""deg: likewise."""


@pytest.mark.parametrize(
    ("manoeuvre", "lift_off", "rollover"),
    [("j_turn", J_TURN, 3.130), ("ramp_steer", RAMP_STEER, 5.217)],
)
def test_a_rollover_is_a_result_with_the_reference_numbers(command, manoeuvre, lift_off, rollover):
    result = command("run", manoeuvre, "--steady-state-slip")
    assert (result.status, result.err) == (0, "")
    for wheel, time in lift_off.items():
        assert result.number(f"lift-off {wheel}") == pytest.approx(time, abs=PRINTED)
    assert result.number("rollover") == pytest.approx(rollover, abs=PRINTED)
    assert "rolled over" in result.value["end"]


def test_the_step_steer_gives_the_reference_numbers(command):
    result = command("run", "step_steer", "--steady-state-slip")
    assert (result.status, result.err) == (0, "")
    assert result.number("peak roll angle") == pytest.approx(5.619, abs=ANGLE)
    assert "at 1.664 s" in result.value["peak roll angle"]
    for label in ("lift-off lf", "lift-off rf", "lift-off lr", "lift-off rr", "rollover"):
        assert result.value[label] == "none"
    assert result.value["end"] == "4.000 s, complete"


def test_a_turn_to_the_right_is_the_mirrored_one_to_the_left(command):
    left, right = command("run", "j_turn"), command("run", "j_turn", "--amplitude", "-10")
    assert right.number("peak roll angle") == -left.number("peak roll angle")
    for here, there in (("lf", "rf"), ("lr", "rr")):
        assert left.value[f"lift-off {here}"] == right.value[f"lift-off {there}"]


SLOWER = ("step_steer", "--speed", "4", "--speed-hold", "0", "--amplitude", "30")


def test_with_steady_state_slip_a_run_that_becomes_too_slow_is_a_result_too(command):
    result = command("run", *SLOWER, "--steady-state-slip")
    assert result.status == 0
    assert "too slow" in result.value["end"]


@pytest.mark.parametrize("speed", ["4", "0"])
def test_with_transient_slip_no_run_is_too_slow(command, speed):
    result = command("run", *SLOWER, "--speed", speed)
    assert (result.status, result.value["end"]) == (0, "4.000 s, complete")


def test_a_run_that_diverges_says_when_and_which_state_did_and_fails(command, folder):
    """Ten billion N m at a wheel, given by a command file."""
    (folder / "drive.csv").write_text("time,wheel_torque_lr\n0,0\n0.05,0\n0.0501,1e10\n1,1e10\n")
    result = command("run", "--commands", "drive.csv")
    assert result.status == 1
    assert result.value["end"].startswith("0.050 s, diverged: wheel_speed_lr is not plausible")


def test_a_speed_hold_that_drives_a_vehicle_beyond_any_engine_ends_as_diverged(command):
    """Thrown from its course at 100 km/h; a smaller step would change nothing."""
    result = command("run", "iso_step_steer", "--handwheel-angle", "400")
    assert result.status == 1
    assert "diverged: longitudinal_slip" in result.value["end"]
    assert "torques" in result.value["end"]


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """written(name): a result of that name, twice, in 1970 and in 2001; by folders."""
    folders, made = [tmp_path_factory.mktemp(year) for year in ("1970", "2001")], set()

    def write(name: str) -> list[Path]:
        if name not in made:
            option = "--csv" if name.endswith("csv") else "--plot"
            for now, folder in zip(("0", "1000000000"), folders, strict=True):
                with pytest.MonkeyPatch.context() as patched:
                    patched.setenv("SOURCE_DATE_EPOCH", now)  # for what writes the date
                    assert main([*SHORT, option, str(folder / name)]) == 0
            made.add(name)
        return [folder / name for folder in folders]

    return write


@pytest.mark.parametrize("name", ["rows.csv", "figure.png", "figure.svg", "figure.pdf"])
def test_the_same_input_gives_the_same_bytes(written, name):
    one, other = written(name)
    assert one.read_bytes() == other.read_bytes()


def test_a_process_of_its_own_prints_and_writes_the_same(command, folder):
    result = command(*SHORT, "--csv", "rows.csv")
    here = (folder / "rows.csv").read_bytes()
    words = [sys.executable, "-m", "vehicle_roll_sim", *SHORT, "--csv", "rows.csv"]
    there = subprocess.run(words, capture_output=True, text=True, timeout=PATIENCE, check=False)
    assert (there.returncode, there.stdout, there.stderr) == (0, result.out, "")
    assert (folder / "rows.csv").read_bytes() == here


def test_a_process_of_its_own_exits_with_the_status_of_a_refusal(folder):
    words = [sys.executable, "-m", "vehicle_roll_sim", "run", "step_steer", "--speed", "-1"]
    there = subprocess.run(words, capture_output=True, text=True, timeout=PATIENCE, check=False)
    assert (there.returncode, there.stdout, there.stderr.count("\n")) == (2, "", 1)


def test_a_png_figure_shows_something(written):
    figure, _ = written("figure.png")
    pixels = imread(figure, format="png")
    assert min(pixels.shape[:2]) > 500
    colours = {tuple(pixel) for pixel in pixels[::3, ::3, :3].reshape(-1, 3).round(1).tolist()}
    assert len(colours) > 10


@pytest.mark.usefixtures("unplaced")
def test_an_svg_figure_has_the_title_the_axes_and_the_wheels(command, folder):
    words = ("run", "j_turn", "--steady-state-slip", "--plot", "figure.svg")
    assert command(*words).status == 0
    ElementTree.parse(folder / "figure.svg")
    text = (folder / "figure.svg").read_text()
    for word in ("j_turn", "roll angle", "tire normal force", "lr, lifts at 1.40 s"):
        assert f"<!-- {word}" in text  # text is drawn as paths, and kept as comments


def test_files_are_named_when_they_are_written_and_only_then_capitals_or_not(
    command, folder, written
):
    result = command(*SHORT, "--csv", "rows.csv", "--plot", "figure.PNG")
    assert (result.value["CSV"], result.value["plot"]) == ("rows.csv", "figure.PNG")
    assert sorted(file.name for file in folder.iterdir()) == ["figure.PNG", "rows.csv"]
    figure, _ = written("figure.png")
    assert (folder / "figure.PNG").read_bytes() == figure.read_bytes()
    assert not {"CSV", "plot"} & set(command(*SHORT).value)


def test_a_pdf_figure_is_a_whole_pdf(written):
    figure, _ = written("figure.pdf")
    content = figure.read_bytes()
    assert content.startswith(b"%PDF-")
    assert content.rstrip().endswith(b"%%EOF")


@pytest.mark.usefixtures("unplaced")
def test_the_title_of_a_figure_of_a_command_file_is_its_name(command, folder):
    (folder / "in.csv").write_text("time,steering\n0,0\n1,0.02\n")
    assert command("run", "--commands", "in.csv", "--plot", "figure.svg").status == 0
    assert "<!-- in.csv" in (folder / "figure.svg").read_text()
