"""`tire`: what a tire file contains and how the tire behaves, as a table, a figure and answers."""

import csv
import itertools
import math
from pathlib import Path

import magic_formula
import numpy as np
import pytest
from matplotlib.image import imread
from tire_files import DATA, NAMES

from vehicle_roll_sim.analysis import drawing

COLUMNS = {
    "normal_force": "Fz",
    "slip_ratio": "kappa",
    "slip_angle": "alpha",
    "inclination": "gamma",
    "pressure": "pressure",
    "speed": "vx",
    "side": "side",
}
"""Of a file of points, and of the tables of the data."""
ANSWERS = {
    "longitudinal_force": "Fx",
    "lateral_force": "Fy",
    "overturning_moment": "Mx",
    "rolling_resistance_moment": "My",
    "aligning_moment": "Mz",
    "loaded_radius": "Rl",
    "effective_rolling_radius": "Re",
}
TOLERANCE = 1e-9
"""Relative to the largest value of a column."""
WEIGHTS = (
    "vehicle_roll_sim: a weight of combined slip is negative at {} points; the simulation limits "
    "it to 0 (--as-simulated)\n"
)
REVERSED = {
    "mf52_full": WEIGHTS.format("2 of 53"),
    "mf61": WEIGHTS.format("2 of 61"),
    "mf62": "",
}
ONE_POINT = "normal_force,slip_ratio,slip_angle\n4000,0.02,0.05\n"


def file(name: str) -> Path:
    return DATA / f"{name}.tir"


def read(path: Path) -> list[dict[str, str]]:
    with path.open(newline="", encoding="utf-8") as opened:
        return list(csv.DictReader(opened))


def column(rows: list[dict[str, str]], name: str) -> np.ndarray:
    """nan where a field is empty."""
    return np.array([float(row[name] or "nan") for row in rows])


def table_of(printed: str) -> np.ndarray:
    """The numbers of the printed table, a row for each condition; nan for a dash."""
    rows = [line.split() for line in printed.splitlines() if line.startswith("  ")]
    numbers = [row for row in rows if row[0][0].isdigit()]
    return np.array([[float(text.replace("-", "nan", text == "-")) for text in r] for r in numbers])


@pytest.fixture
def asked(command, folder):
    """asked(name, text, words, said): the rows that answer a file of points; said: on stderr."""

    def ask(name: str, text: str, *words, said: str = "") -> list[dict[str, str]]:
        (folder / "points.csv").write_text(text, encoding="utf-8")
        result = command("tire", file(name), "--points", "points.csv", "--csv", "out.csv", *words)
        assert (result.status, result.err) == (0, said)
        assert result.value["CSV"] == "out.csv"
        return read(folder / "out.csv")

    return ask


@pytest.mark.parametrize(("name", "version"), zip(NAMES, ("5.2", "6.1", "6.2"), strict=True))
def test_it_says_what_was_read(command, name, version):
    result = command("tire", file(name))
    assert (result.status, result.err) == (0, "")
    said = result.value
    assert said["version"].startswith(f"Magic Formula {version}")
    assert "FITTYP" in result.out  # why
    assert said["side"] == "left"
    assert said["combined slip"] == "yes"
    assert said["tire load range"] == "150 to 12000 N"
    assert said["slip ratio range"] == "-1.5 to 1.5"
    assert said["slip angle range"] == "-1.5 to 1.5 rad"
    assert said["inclination range"] == "-0.2 to 0.2 rad"
    assert ("inflation pressure" in said) == (version != "5.2")
    p, _ = magic_formula.read(file(name))
    dp = 0.0 if version == "5.2" else p["INFLPRES"] / p["NOMPRES"] - 1.0
    stiffness = p["VERTICAL_STIFFNESS"] * (1 + p["PFZ1"] * dp)
    assert result.number("vertical stiffness") == pytest.approx(stiffness, rel=1e-5)  # 6 digits
    load, linear = p["FNOMIN"], 1e3 * p["FNOMIN"] / stiffness
    if version == "5.2":
        assert "progression" not in said
        assert result.number("tire compression") == pytest.approx(linear, rel=1e-3)
        return
    slope = stiffness / (1 + p["PFZ1"] * dp) * p["UNLOADED_RADIUS"] / load
    growth = p["Q_FZ2"] / math.sqrt(slope**2 - 4 * p["Q_FZ2"]) / p["UNLOADED_RADIUS"]
    assert result.number("progression") == pytest.approx(growth, rel=1e-3)
    without = f"{linear:.4g} mm without progression"
    assert said["tire compression"].endswith(without)
    assert result.number("tire compression") > linear


def test_a_file_with_lateral_force_only_is_shown_on_request(command, folder, refused):
    command("template", "--tire", "mine.tir")
    text = (folder / "mine.tir").read_text()
    lines = text.replace("VERTICAL_ST", "$ VERTICAL_ST").splitlines()
    kept = [line for line in lines if not line.startswith(("PCX1", "PDX1", "PKX1"))]
    (folder / "mine.tir").write_text("\n".join(kept))
    refused(("tire", "mine.tir"), "PCX1, PDX1, PKX1", "--longitudinal from_lateral")
    result = command("tire", "mine.tir", "--longitudinal", "from_lateral")
    assert (result.status, result.err) == (0, "")
    assert "derived from the lateral force" in result.out
    assert result.value["vertical stiffness"].startswith("not given")
    for row in table_of(result.out):
        assert row[5] == pytest.approx(row[7], rel=1e-3)  # as isotropic as it can be


def test_what_a_file_leaves_open_is_said(command, folder):
    command("template", "--tire", "mine.tir")
    text = (folder / "mine.tir").read_text()
    kept = [line for line in text.splitlines() if not line.startswith(("KPU", "TYRESIDE"))]
    (folder / "mine.tir").write_text("\n".join(kept))
    result = command("tire", "mine.tir")
    assert result.value["slip ratio range"] == "not given"
    assert "TYRESIDE is not given" in result.out


def test_converted_units_and_warnings_have_lines_of_their_own(command, folder):
    command("template", "--tire", "mine.tir")
    text = (folder / "mine.tir").read_text().replace("'newton'", "'kN'")
    lines = [line for line in text.splitlines() if not line.startswith(("FNOMIN", "FZM"))]
    (folder / "mine.tir").write_text("\n".join([*lines, "[LOAD]", "FNOMIN = 4"]))
    said = command("tire", "mine.tir").value
    assert said["units"].startswith("SI, converted from FORCE = kN")
    assert said["nominal load"] == "4000 N"
    switched_off = ["[MORE]", "RBX1 = 0", "RCX1 = 0", "RBY1 = 0", "RCY1 = 0"]
    lines = [line for line in lines if not line.startswith(("RBX1", "RCX1", "RBY1", "RCY1"))]
    (folder / "mine.tir").write_text("\n".join([*lines, "[LOAD]", "FNOMIN = 4", *switched_off]))
    assert "combined slip is off" in command("tire", "mine.tir").value["warning"]


@pytest.mark.parametrize("name", NAMES)
def test_the_table_has_stiffness_and_friction_at_four_loads(command, name):
    p, _ = magic_formula.read(file(name))
    dp = 0.0 if p.version == "5.2" else p["INFLPRES"] / p["NOMPRES"] - 1.0
    rows = table_of(command("tire", file(name)).out)
    load = np.array([0.5, 1.0, 1.5, 2.0]) * p["FNOMIN"]
    assert rows[:, 0] == pytest.approx(load)
    slopes = magic_formula.slopes(p, load, dp)
    assert rows[:, 3] == pytest.approx(slopes[0] / 1e3, abs=0.006)  # printed to 0.01 kN
    assert rows[:, 4] == pytest.approx(-slopes[1] / 1e3, abs=0.006)
    fine = np.linspace(-0.349, 0.349, 2001)
    for row, each in zip(rows, load, strict=True):
        fx = magic_formula.pure_longitudinal(p, 2 * fine, each, 0.0, dp) / each
        fy = magic_formula.pure_lateral(p, fine, each, 0.0, dp) / each
        assert row[5:] == pytest.approx([-fx.min(), fx.max(), -fy.min(), fy.max()], abs=1e-3)


def test_conditions_are_chosen_and_every_combination_has_a_row(command):
    words = ("--load", "2000", "5000", "--camber", "-0.05", "0.05", "--pressure", "2e5", "2.2e5")
    rows = table_of(command("tire", file("mf61"), *words).out)
    assert sorted(set(rows[:, 0])) == [2000.0, 5000.0]
    assert sorted(set(rows[:, 1])) == [-0.05, 0.05]
    assert sorted(set(rows[:, 2])) == [200.0, 220.0]
    assert len(rows) == len({tuple(row) for row in rows}) == 8


@pytest.mark.parametrize("name", NAMES)
def test_answers_are_those_of_the_reference(asked, name):
    given = read(DATA / f"{name}_values.csv")
    names = [n for n in COLUMNS if n != "pressure" or given[0]["pressure"]]
    lines = [",".join(row[COLUMNS[n]] for n in names) for row in given]
    rows = asked(name, "\n".join([",".join(names), *lines]) + "\n", said=REVERSED[name])
    assert list(rows[0]) == [*COLUMNS, *ANSWERS]
    for answer, reference in ANSWERS.items():
        mine, theirs = column(rows, answer), column(given, reference)
        known = ~np.isnan(theirs)
        assert np.abs(mine - theirs)[known].max(initial=0.0) <= TOLERANCE * np.nanmax(
            np.abs(theirs), initial=0.0
        )
    assert (column(rows, "loaded_radius") > 0).all() or name == "mf52_full"
    assert all(row["loaded_radius"] == "" for row in rows) == (name == "mf52_full")


def test_answers_can_be_those_of_the_simulation(asked):
    text = "normal_force,slip_ratio,slip_angle\n8200,-1,0\n8200,-0.1,0.02\n"
    said = REVERSED["mf61"].replace("2 of 61", "1 of 2")
    (published, same), simulated = (
        asked("mf61", text, said=said),
        asked("mf61", text, "--as-simulated"),
    )
    assert float(published["lateral_force"]) == pytest.approx(69.589225, abs=1e-6)
    assert float(simulated[0]["lateral_force"]) == pytest.approx(72.450205, abs=1e-6)
    assert simulated[1] == same


def test_columns_that_are_missing_have_stated_values(asked):
    (row,) = asked("mf61", ONE_POINT)
    assert (row["inclination"], row["pressure"], row["speed"]) == ("0.0", "230000.0", "16.5")
    assert row["side"] == "left"
    whole = ONE_POINT.replace("angle\n", "angle,inclination,pressure,speed,side\n")
    whole = whole.replace("0.05\n", "0.05,0,230000,16.5,left\n")
    assert asked("mf61", whole) == [row]


def test_the_curves_of_the_figure_are_points_and_answers(command, folder, asked):
    result = command("tire", file("mf61"), "--csv", "curves.csv", "--load", "3000")
    assert (result.status, result.err) == (0, "")
    rows = read(folder / "curves.csv")
    assert list(rows[0]) == ["curve", *COLUMNS, *ANSWERS]
    assert {row["curve"] for row in rows} == {"longitudinal", "lateral", "outline"}
    lines = [",".join(row[name] for name in COLUMNS) for row in rows]
    answers = asked("mf61", "\n".join([",".join(COLUMNS), *lines]) + "\n", "--as-simulated")
    assert [{k: v for k, v in row.items() if k != "curve"} for row in rows] == answers


def test_the_outline_encloses_the_curves(command, folder):
    command("tire", file("mf62"), "--csv", "curves.csv", "--load", "4000")
    rows = read(folder / "curves.csv")
    x, y = column(rows, "longitudinal_force"), column(rows, "lateral_force")
    is_outline = np.array([row["curve"] == "outline" for row in rows])
    corners = np.column_stack([x, y])[is_outline]
    assert (corners[0] == corners[-1]).all()
    for a, b in itertools.pairwise(corners):
        left = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])
        assert (left >= -1e-9 * np.hypot(*(b - a)) * 4000.0).all()


def test_the_figure_shows_what_the_data_has(command, folder, monkeypatch):
    kept = []
    monkeypatch.setattr(drawing, "save_figure", lambda *saved: kept.append(saved))
    words = ("--load", "3000", "6000", "--camber", "0", "0.1")
    result = command("tire", file("mf61"), *words, "--plot", "f.svg", "--csv", "curves.csv")
    assert (result.status, result.err) == (0, "")
    ((figure, path),) = kept
    assert str(path) == result.value["plot"] == "f.svg"
    rows = read(folder / "curves.csv")
    for axis, curve, answer, scale in (
        (figure.axes[0], "longitudinal", "longitudinal_force", 1e3),
        (figure.axes[1], "lateral", "lateral_force", 1e3),
        (figure.axes[2], "lateral", "aligning_moment", 1.0),
        (figure.axes[3], "outline", "lateral_force", 1e3),
    ):
        drawn = [line.get_ydata() for line in axis.lines if len(line.get_ydata()) > 2]  # no axes
        assert len(drawn) == 4
        data = [row for row in rows if row["curve"] == curve]
        assert np.concatenate(drawn) == pytest.approx(column(data, answer) / scale, rel=1e-12)
    texts = [text.get_text() for legend in figure.legends for text in legend.get_texts()]
    assert texts == ["3000 N", "6000 N", "inclination 0°", "inclination 5.73°"]
    assert figure._suptitle.get_text() == "mf61.tir: Magic Formula 6.1"


def test_the_same_file_gives_the_same_bytes(command, folder):
    """As SVG, whose names of elements depend on every position; a PNG has fewer of its digits."""
    for name in ("one.svg", "two.svg", "one.png"):
        words = ("--plot", name, "--csv", f"{name}.csv", "--load", "3000")
        assert command("tire", file("mf52_full"), *words).status == 0
    assert (folder / "one.svg").read_bytes() == (folder / "two.svg").read_bytes()
    assert (folder / "one.svg.csv").read_bytes() == (folder / "two.svg.csv").read_bytes()
    assert imread(folder / "one.png").shape[:2] == (935, 1210)


def test_points_outside_the_ranges_are_counted(command, folder):
    (folder / "points.csv").write_text(ONE_POINT + "14000,0.02,0.05\n4000,0,1.55\n")
    words = ("--points", "points.csv", "--csv", "out.csv")
    said = command("tire", file("mf61"), *words).value
    assert said["outside tire load range"] == "1 of 3 points"
    assert said["outside slip angle range"] == "1 of 3 points"
    assert not {"outside slip ratio range", "outside inclination range"} & said.keys()


def test_conditions_outside_the_ranges_are_counted(command):
    words = ("--load", "3000", "14000", "--camber", "0", "0.3", "--pressure", "9e4")
    said = command("tire", file("mf61"), *words).value
    assert said["outside tire load range"] == "2 of 4 conditions"
    assert said["outside inclination range"] == "2 of 4 conditions"
    assert said["outside pressure range"] == "4 of 4 conditions"
    assert not [label for label in command("tire", file("mf61")).value if "outside" in label]


REFUSED = {
    "no file": (("none.tir",), "none.tir"),
    "a folder": ((".",), "not of a folder"),
    "nothing": ((), "FILE"),
    "load": (("mf61", "--load", "0"), "--load: 0.0", "from 1 to 1e+06 N"),
    "no number": (("mf61", "--load", "heavy"), "--load: 'heavy'", "from 1 to 1e+06 N"),
    "many loads": (("mf61", "--load", *"1234567"), "--load", "at most 6"),
    "camber": (("mf61", "--camber", "4"), "--camber: 4.0", "from -1 to 1 rad"),
    "many cambers": (("mf61", "--camber", *(f"0.{i}" for i in range(5))), "at most 4"),
    "pressure": (("mf61", "--pressure", "2.2"), "--pressure: 2.2", "Pa"),
    "bar": (("mf61", "--pressure", "2e3"), "--pressure: 2000.0", "20 times NOMPRES, 230000 Pa"),
    "no pressure": (("mf52_full", "--pressure", "2e5"), "--pressure", "5.2"),
    "figure": (("mf61", "--plot", "f.txt"), "--plot", ".png, .svg, .pdf"),
    "no folder": (("mf61", "--csv", "none/f.csv"), "--csv", "none"),
    "itself": (("mf61", "--csv", DATA / "mf61.tir"), "--csv", "different from that of FILE"),
    "points alone": (("mf61", "--points", "p.csv"), "--csv: missing", "--points"),
    "onto points": (("mf61", "--points", "p.csv", "--csv", "p.csv"), "--points"),
    "no points": (("mf61", "--points", "none.csv", "--csv", "f.csv"), "none.csv"),
    "nothing simulated": (("mf61", "--as-simulated"), "--as-simulated", "--points"),
    "misspelt": (("mf61", "--lode", "1"), "did you mean --load?"),
    "longitudinal": (("mf61", "--longitudinal", "yes"), "--longitudinal: 'yes'", "from_lateral"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_wrong_is_one_line(refused, folder, case):
    (folder / "p.csv").write_text(ONE_POINT)
    given, *expected = REFUSED[case]
    words = [file(word) if word in NAMES else word for word in given]
    refused(("tire", *words), *expected)


HEAD = "normal_force,slip_ratio,slip_angle"
WRONG_POINTS = {
    "unknown column": (f"{HEAD},sid\n1,0,0,left\n", "line 1: column: 'sid'", "did you mean side?"),
    "missing column": ("normal_force,slip_ratio\n1,0\n", "line 1", "slip_angle"),
    "column twice": (f"{HEAD},side,side\n1,0,0,left,left\n", "line 1", "each column once"),
    "side": (
        f"{HEAD},side\n1,0,0,left\n1,0,0,middle\n",
        "line 3: side: 'middle'",
        "left, right",
    ),
    "load": (f"{HEAD}\n1,0,0\n-4,0,0\n", "line 3: normal_force: -4.0", "from 0 to 1e+06 N"),
    "nan": (f"{HEAD}\n1,0,nan\n", "line 2: slip_angle: nan", "rad"),
    "degrees": (f"{HEAD}\n1,0,5\n", "line 2: slip_angle: 5.0", "rad"),
    "no number": (f"{HEAD}\n1,,0\n", "line 2: slip_ratio: ''", "a number"),
    "no rows": (f"{HEAD}\n", "no rows"),
    "few values": (f"{HEAD}\n1,0\n", "line 2: 2 values"),
    "semicolons": (f"{HEAD}\n1,0,0\n".replace(",", ";"), "semicolons"),
    "pressure": (f"{HEAD},pressure\n1,0,0,2.3\n", "line 2: pressure: 2.3", "Pa"),
    "far from nominal": (f"{HEAD},pressure\n1,0,0,7e6\n", "line 2: pressure: 7", "20 times"),
}


@pytest.mark.parametrize("case", WRONG_POINTS)
def test_wrong_points_are_refused_with_line_and_column(refused, folder, case):
    text, *expected = WRONG_POINTS[case]
    (folder / "p.csv").write_text(text)
    words = ("--points", "p.csv", "--csv", "out.csv", "--plot", "out.png")
    refused(("tire", file("mf61"), *words), "p.csv", *expected)


def test_a_pressure_column_is_refused_for_5_2(refused, folder):
    (folder / "p.csv").write_text(f"{HEAD},pressure\n1,0,0,230000\n")
    words = ("--points", "p.csv", "--csv", "out.csv")
    refused(("tire", file("mf52_full"), *words), "p.csv: line 1: column", "pressure", "5.2")


def test_a_full_disk_leaves_no_file(command, folder, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.replace", full)
    result = command("tire", file("mf61"), "--csv", "curves.csv", "--load", "3000")
    assert (result.status, result.out) == (1, "")
    assert "No space left on device" in result.err
    assert len(result.err.splitlines()) == 1
    assert not any(folder.iterdir())


def test_help_names_options_and_axes(command, capsys):
    with pytest.raises(SystemExit) as end:
        command("tire", "--help")
    assert end.value.code == 0
    text = capsys.readouterr().out
    for word in (
        "FILE",
        "--load",
        "--camber",
        "--pressure",
        "--plot",
        "--csv",
        "--points",
        "TYDEX",
    ):
        assert word in text


def test_a_file_without_an_aligning_moment_and_a_narrow_range_say_so_in_the_figure(
    command, folder, monkeypatch
):
    kept = []
    monkeypatch.setattr(drawing, "save_figure", lambda *saved: kept.append(saved))
    command("template", "--tire", "mine.tir")
    text = (folder / "mine.tir").read_text()
    lines = [line for line in text.splitlines() if not line.startswith(("ALPM", "KPUM"))]
    narrow = ["[SLIP_ANGLE_RANGE]", "ALPMIN = -0.1", "ALPMAX = 0.1"]
    (folder / "mine.tir").write_text("\n".join([*lines, *narrow]))
    assert command("tire", "mine.tir", "--plot", "f.png", "--load", "3000").err == ""
    ((figure, _),) = kept
    assert [text.get_text() for text in figure.axes[2].texts] == ["no coefficients in the file"]
    ends = [line for line in figure.axes[1].lines if line.get_linestyle() == ":"]
    assert [line.get_xdata()[0] for line in ends] == pytest.approx([-5.73, 5.73], abs=0.01)
    assert "limit of the file's range" in [
        text.get_text() for text in figure.legends[0].get_texts()
    ]
    assert not [line for line in figure.axes[0].lines if line.get_linestyle() == ":"]
