"""`vehicle_roll_sim compare`: the shipped log, results, and what is refused."""

import shutil
from pathlib import Path

import pytest

from vehicle_roll_sim import PlausibilityWarning, compare

pytest.importorskip("pint", reason="the units of the log need pint")
EXAMPLES = Path(__file__).parents[2] / "examples"
WORDS = ("compare", "log.csv", "--map", "log_map.yaml")


@pytest.fixture
def log(folder):
    """The shipped log and its map in the working folder."""
    for name in WORDS[1::2]:
        shutil.copy(EXAMPLES / name, folder)
    return folder


def row_of(result, name: str) -> list[str]:
    """The words of the row of a quantity in the table."""
    return next(line.split() for line in result.out.splitlines() if line.startswith(f"{name}  "))


@pytest.mark.usefixtures("unplaced")
def test_the_shipped_log_is_accepted_and_its_known_delay_is_told(command, log):
    result = command(*WORDS, "--csv", "out.csv", "--plot", "out.svg")
    assert (result.status, result.err) == (0, "")
    assert result.value["verdict"].startswith("accepted: 5 of 5 quantities")
    assert result.value["read"] == "columns separated by semicolons, decimal commas"
    shifts = {name: float(row_of(result, name)[-6]) for name in ("yaw_rate", "roll")}
    assert shifts["yaw_rate"] == pytest.approx(0.02, abs=2e-3)  # noise of 1 % of the peak
    assert shifts["roll"] == pytest.approx(0.0, abs=2e-3)
    again = compare("log.csv", "log_map.yaml")
    again.write_csv("again.csv")
    assert (log / "again.csv").read_bytes() == (log / "out.csv").read_bytes()
    again.plot("again.svg", title="log.csv")
    assert (log / "again.svg").read_bytes() == (log / "out.svg").read_bytes()


def test_another_vehicle_is_rejected(command, log):
    result = command(*WORDS, "--no-roll-centre")
    assert (result.status, result.err) == (0, "")
    assert result.value["verdict"].startswith("rejected: 3 of 5")
    assert row_of(result, "roll")[-1] == "rejected"


def test_a_swapped_sign_is_a_warning_and_refused_if_strict(command, log):
    text = (log / "log_map.yaml").read_text().replace(", sign: -1", "")
    (log / "log_map.yaml").write_text(text)
    warning = "roll has the opposite sign of lateral_acceleration (correlation -0.99)"
    result = command(*WORDS)
    assert result.status == 0
    assert len([line for line in result.err.splitlines() if warning in line]) == 1
    refused = command(*WORDS, "--strict")
    assert refused.status == 2
    assert f"--strict: not plausible: {warning}" in refused.err
    with pytest.warns(PlausibilityWarning, match="roll has the opposite sign"):
        compare("log.csv", "log_map.yaml")


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        (("compare",), "arguments"),
        (WORDS[:2], "--map: missing: a map file"),
        ((*WORDS[:2], "--map", "no.yaml"), "file no.yaml: No such file"),
        (("compare", "no.csv", *WORDS[2:]), "file no.csv: No such file"),
        (
            ("compare", "log.xls", *WORDS[2:]),
            "error: LOG: 'log.xls' is not allowed: a bag, or a file",
        ),
        ((*WORDS, "--cutoff", "30"), "--cutoff: 30.0 is not allowed: at most 20 Hz"),
        ((*WORDS, "--drive-by", "torques"), "--drive-by: 'torques' is not allowed: drive_torque"),
        ((*WORDS, "--begin", "20"), "--begin: 0 rows of speed from 20 s"),
        ((*WORDS, "--inside", "0"), "--inside: 0.0 is not allowed: a number from 1 to 100 %"),
        ((*WORDS, "--plot", "out.xyz"), "--plot"),
        ((*WORDS, "--size", "100x200"), "--size: '100x200' is not allowed: together with --plot"),
        ((*WORDS, "--csv", "a.svg", "--plot", "a.svg"), "a path different from that of"),
    ],
)
def test_what_cannot_be_compared_is_refused_in_one_line(log, refused, words, problem):
    refused(words, problem)


@pytest.mark.parametrize(
    ("damage", "problem"),
    [
        (
            lambda rows: [rows[0].replace("Gyro Z", "Gyro z"), *rows[1:]],
            "columns: yaw_rate: column: 'Gyro Z [deg/s]' is unknown: did you mean Gyro z [deg/s]?",
        ),
        (lambda rows: rows[:101] + rows[151:], "a gap of 1.02 s after 1.98 s"),
        (lambda rows: rows[:101] + later(rows[101:], 5.0), "a gap of 5.02 s after 1.98 s"),
        (lambda rows: rows[:101] + later(rows[101:], -1.0), "clock steps back by 0.98 s after"),
        (lambda rows: [rows[0], *(row.replace(";79", ";7999", 1) for row in rows[1:])], "100 m/s"),
    ],
    ids=["a misspelt column", "missing rows", "a jump ahead", "a jump back", "a wrong unit"],
)
def test_a_damaged_log_is_refused_in_one_line(log, refused, damage, problem):
    rows = (log / "log.csv").read_text(encoding="utf-8").splitlines()
    (log / "log.csv").write_text("\n".join(damage(rows)) + "\n", encoding="utf-8")
    refused(WORDS, problem)


def later(rows: list[str], seconds: float) -> list[str]:
    """Rows of the log whose clock was set forward."""
    split = (row.split(";", 1) for row in rows)
    times = ((float(time.replace(",", ".")) + seconds, rest) for time, rest in split)
    return [f"{time:.2f};{rest}".replace(".", ",") for time, rest in times]


def test_a_setting_that_is_unknown_is_named(log):
    with pytest.raises(ValueError, match="name: 'cutof' is unknown"):
        compare("log.csv", "log_map.yaml", cutof=3.0)
    with pytest.raises(ValueError, match="map: 3 is not allowed: the name of a file"):
        compare("log.csv", 3)


def test_help_says_that_the_executable_of_ros_is_another_one(capsys):
    from vehicle_roll_sim.command_line.main import main

    with pytest.raises(SystemExit):
        main(["compare", "--help"])
    text = " ".join(capsys.readouterr().out.split())
    assert "`ros2 run vehicle_roll_sim compare`, which compares controllers" in text
    assert "the tolerances are not theirs" in text
