"""`plot`: the figure of a written run, and clear refusals of other files."""

import importlib
import importlib.util
import math

import numpy as np
import pytest

from vehicle_roll_sim.analysis import drawing
from vehicle_roll_sim.runs.columns import COLUMNS
from vehicle_roll_sim.runs.history import History

BEGINNINGS = {".png": b"\x89PNG\r\n\x1a\n", ".svg": b"<?xml", ".pdf": b"%PDF-"}
SAMPLES = 31


def recorded(steepest: float = 1.6) -> History:
    """3 s in which the roll angle rises to `steepest` (rad), on four wheels."""
    rows = np.zeros((SAMPLES, len(COLUMNS)))
    rows[:, 0] = np.arange(SAMPLES) / 10
    rows[:, COLUMNS.index("x")] = 10 * rows[:, 0]
    rows[:, COLUMNS.index("roll")] = np.linspace(0.0, steepest, SAMPLES)
    history = History(rows)
    history.wheels("normal_force")[:] = history.wheels("tire_compression")[:] = 4000.0
    return history


@pytest.fixture
def history(folder) -> History:
    """What `run.csv` has."""
    history = recorded()
    history.write_csv(folder / "run.csv")
    return history


@pytest.fixture
def figure(command, monkeypatch):
    """Runs `plot` with the given words; the figure and the path that it was to be written to."""

    importlib.import_module("vehicle_roll_sim.analysis.plots")  # which would keep the patch

    def call(*words):
        kept = []
        monkeypatch.setattr(drawing, "save_figure", lambda *saved: kept.append(saved))
        result = command("plot", *words)
        assert (result.status, result.err) == (0, "")
        ((drawn, path),) = kept
        assert result.value == {"plot": str(path)}
        return drawn, str(path)

    return call


def roll_of(drawn) -> list:
    """The curves of the roll angle."""
    return [line for line in drawn.axes[1].lines if line.get_label().startswith("_")]


def title_of(drawn) -> str:
    return drawn._suptitle.get_text()


def legend_of(drawn) -> list[str]:
    return [text.get_text() for legend in drawn.legends for text in legend.get_texts()]


def test_a_figure_is_drawn_of_what_the_file_has_and_named_after_it(figure, history):
    drawn, path = figure("run.csv")
    (curve,) = roll_of(drawn)
    np.testing.assert_array_equal(curve.get_xdata(), history["time"])
    np.testing.assert_array_equal(curve.get_ydata(), np.degrees(1) * history["roll"])
    assert (path, title_of(drawn)) == ("run.png", "run")
    assert "run" not in legend_of(drawn)


@pytest.mark.usefixtures("unplaced")
def test_what_run_writes_can_be_drawn_with_the_events_that_it_prints(command, folder):
    printed = command("run", "j_turn", "--csv", "j.csv")
    assert command("plot", "j.csv", "--output", "j.svg").status == 0
    text = (folder / "j.svg").read_text()
    for wheel in ("lf", "rf", "lr", "rr"):
        assert f"<!-- {wheel}, lifts at {printed.number(f'lift-off {wheel}'):.2f} s" in text
    assert "<!-- rollover" in text


@pytest.mark.usefixtures("unplaced")
def test_the_runs_of_every_kind_of_model_can_be_drawn(command, folder):
    """The one with the fewest signals alone, and with all others in one figure."""
    models = ("8dof", "1a", "1c-iii")
    for model in models:
        words = ("run", "step_steer", "--model", model, "--duration", "1.5")
        assert command(*words, "--csv", f"{model}.csv").status == 0
    files = [f"{model}.csv" for model in models]
    for words in (files[:1], (*files, "--output", "all.png")):
        assert command("plot", *words).status == 0
    assert (folder / "8dof.png").stat().st_size > 0
    assert (folder / "all.png").stat().st_size > 0


def test_a_run_that_diverged_can_be_drawn_too(command, folder):
    words = ("step_steer", "--step", "0.01", "--amplitude", "60", "--speed", "100")
    assert command("run", *words, "--csv", "run.csv").status == 1
    assert command("plot", "run.csv").status == 0


@pytest.mark.usefixtures("unplaced")
@pytest.mark.parametrize(("suffix", "times"), [(".png", 1), (".svg", 2), (".pdf", 1)])
def test_the_format_is_that_of_the_name_and_the_bytes_are_the_same_twice(
    command, folder, history, monkeypatch, suffix, times
):
    """In one format, as the tests of `run` draw each twice, which is the same function."""
    contents = []
    for now in ("0", "1000000000")[:times]:  # of 1970 and of 2001, for what writes the date
        monkeypatch.setenv("SOURCE_DATE_EPOCH", now)
        assert command("plot", "run.csv", "--output", f"figure{suffix}").status == 0
        contents.append((folder / f"figure{suffix}").read_bytes())
    assert contents[0] == contents[-1]
    assert contents[0].startswith(BEGINNINGS[suffix])


def test_commands_that_run_was_told_to_write_are_drawn(command, figure):
    words = ("run", "step_steer", "--duration", "1.5", "--csv", "run.csv")
    for option, shown in (((), False), (("--with-commands",), True)):
        assert command(*words, *option).status == 0
        labels = [axis.get_ylabel() for axis in figure("run.csv")[0].axes]
        assert ("wheel torque\n(N m)" in labels) == shown


def test_the_size_is_that_which_was_asked_for(figure, history):
    drawn, _ = figure("run.csv", "--size", "170x200")
    assert [25.4 * side for side in drawn.get_size_inches()] == pytest.approx([170.0, 200.0])


def test_only_the_part_that_was_asked_for_is_drawn_with_the_events_of_all(figure, history):
    drawn, _ = figure("run.csv", "--begin", "1", "--end", "2")
    (curve,) = roll_of(drawn)
    assert (curve.get_xdata()[0], curve.get_xdata()[-1]) == (1.0, 2.0)
    assert "rollover" not in legend_of(drawn)


def test_rollover_is_at_the_angle_that_was_asked_for(figure, history):
    assert "rollover" in legend_of(figure("run.csv", "--end", "2", "--stop-roll", "45")[0])


def test_several_runs_are_compared_under_their_names(figure, folder, history):
    recorded(0.1).write_csv(folder / "calm.csv")
    drawn, path = figure("run.csv", "calm.csv", "--output", "both.pdf")
    highest = [max(curve.get_ydata()) for curve in roll_of(drawn)]
    assert highest == pytest.approx([math.degrees(1.6), math.degrees(0.1)])
    assert legend_of(drawn)[:2] == ["run", "calm"]
    assert (path, title_of(drawn)) == ("both.pdf", "")


def test_files_of_one_name_are_told_apart_by_their_folders(figure, folder, history):
    (folder / "other").mkdir()
    history.write_csv(folder / "other" / "run.csv")
    drawn, _ = figure("run.csv", "other/run.csv", "--output", "both.png")
    assert legend_of(drawn)[:2] == ["run.csv", "other/run.csv"]


def test_runs_and_figure_are_called_what_was_said(figure, history):
    labels = ("--label", "with", "--label", "without $")
    words = ("run.csv", "run.csv", "--output", "both.png", "--title", "roll control")
    drawn, _ = figure(*words, *labels)
    assert legend_of(drawn)[:2] == ["with", "without $"]
    assert title_of(drawn) == "roll control"
    assert title_of(figure("run.csv", "--title", "")[0]) == ""


def test_columns_may_come_in_any_order_and_beside_others(figure, folder, history):
    order = list(reversed(COLUMNS))
    lines = [", ".join([*order, "remark"])]
    lines += [",".join([*map(repr, row[::-1]), "good"]) for row in history.rows.tolist()]
    (folder / "mine.csv").write_text("\r\n".join(lines))
    (curve,) = roll_of(figure("mine.csv")[0])
    np.testing.assert_array_equal(curve.get_ydata(), np.degrees(1) * history["roll"])


def changed(folder, line: int, column: str, text: str) -> None:
    """Write another text into a line of `run.csv`, lines counted from 1."""
    lines = (folder / "run.csv").read_text().splitlines()
    cells = lines[line - 1].split(",")
    cells[COLUMNS.index(column)] = text
    lines[line - 1] = ",".join(cells)
    (folder / "run.csv").write_text("\n".join(lines) + "\n")


@pytest.mark.parametrize(
    ("line", "column", "text", "words"),
    [
        (1, "roll", "bank", ("run.csv: line 1", "roll missing", "`run --csv`")),
        (1, "x", "roll", ("run.csv: line 1", "x missing")),
        (5, "roll", "flat", ("run.csv: line 5: roll", "'flat'", "a number")),
        (5, "roll", "", ("run.csv: line 5: roll", "''", "a number")),
        (5, "time", "0.1", ("run.csv: line 5: time", "0.1", "at least 0.2")),
        (5, "time", "nan", ("run.csv: line 5: time", "nan", "at least 0.2")),
        (2, "time", "-inf", ("run.csv: line 2: time", "-inf", "a finite number")),
        (5, "yaw", "1,2", ("run.csv: line 5", "53 values", "52 values")),
    ],
)
def test_what_is_wrong_in_a_file_is_named_with_its_line(
    refused, folder, history, line, column, text, words
):
    changed(folder, line, column, text)
    refused(("plot", "run.csv"), *words)


def test_a_column_that_comes_twice_is_refused(refused, folder, history):
    lines = (folder / "run.csv").read_text().splitlines()
    (folder / "run.csv").write_text("\n".join(f"{line},{line.split(',')[4]}" for line in lines))
    refused(("plot", "run.csv"), "run.csv: line 1: column", "'roll'", "once")


def test_a_file_that_was_cut_off_is_refused_at_its_last_line(refused, folder, history):
    content = (folder / "run.csv").read_bytes()
    (folder / "run.csv").write_bytes(content[:-300])
    refused(("plot", "run.csv"), "run.csv: line ", "values", "52 values")


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", ("time, x, y and 49 more missing",)),
        (b"time,steering\n0,0\n", ("x, y, z and 47 more missing",)),
        (b"time;x;y\n0;0;0\n", ("line 1: separated by semicolons", "separated by commas")),
        (",".join(COLUMNS).encode(), ("no rows", "at least one row")),
        (b"\x89PNG\r\n\xff\x00", ("binary data", "text file")),
    ],
    ids=["empty", "commands", "semicolons", "header", "binary"],
)
def test_what_is_no_csv_file_of_a_run_is_refused(refused, folder, content, words):
    (folder / "other.csv").write_bytes(content)
    refused(("plot", "other.csv"), "other.csv", *words)


def test_neither_is_what_is_not_there_or_a_folder(refused, folder):
    refused(("plot", "none.csv"), "none.csv", "No such file")
    (folder / "results").mkdir()
    has_library = importlib.util.find_spec("rosbags") is not None
    refused(("plot", "results"), "a complete bag of a simulator" if has_library else "rosbags")
    refused(("plot", ""), "FILE", "''")
    refused(("plot",), "FILE")


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (("--begin", "3.1"), ("--begin", "3.1", "0 to 3 s", "run.csv")),
        (("--begin", "1.01", "--end", "1.02"), ("--begin", "1.01", "0 to 3 s")),
        (("--begin", "2", "--end", "1"), ("--end", "1.0", "more than --begin, 2")),
        (("--begin", "soon"), ("--begin", "'soon'", "a number")),
        (("--stop-roll", "0"), ("--stop-roll", "0", "1 to 90 deg")),
        (("--label", "a", "--label", "b"), ("--label", "2 labels", "1 file")),
        (("--size", "170"), ("--size", "'170'", "WIDTHxHEIGHT in mm")),
        (("--output", "figure.jpg"), ("--output", "figure.jpg", ".png, .svg, .pdf")),
        (("--output", "none/figure.png"), ("--output", "none does not")),
        (("--output", ""), ("--output", "''")),
        (("run.csv",), ("--output", "missing", "several runs")),
        (("run.csv",) * 6, ("FILE", "7 files", "at most 6")),
    ],
)
def test_options_that_make_no_sense_are_refused(refused, history, words, expected):
    refused(("plot", "run.csv", *words), *expected)


def test_no_run_is_replaced_by_its_figure(refused, folder, history):
    (folder / "run.csv").rename(folder / "run.png")
    before = (folder / "run.png").read_bytes()
    refused(("plot", "run.png"), "--output", "run.png", "another file")
    (folder / "link.svg").symlink_to("run.png")
    refused(("plot", "run.png", "--output", "link.svg"), "--output", "link.svg", "another file")
    assert (folder / "run.png").read_bytes() == before
