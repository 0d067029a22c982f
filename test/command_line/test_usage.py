"""Arguments of a command: for unknown ones the nearest known one is suggested; help is complete."""

import pytest

MANOEUVRES = ("step_steer", "ramp_steer", "j_turn")
OPTIONS = (
    *("--amplitude", "--rate", "--start", "--speed", "--duration", "--speed-hold"),
    *("--no-roll-centre", "--euler-terms", "--vehicle", "--tire", "--set"),
    *("--step", "--sample", "--command-period", "--stop-roll", "--csv", "--plot", "--commands"),
)


@pytest.mark.parametrize(
    ("given", "nearest"),
    [("rnu", "run"), ("parameter", "parameters"), ("parametres", "parameters")],
)
def test_a_misspelt_command_gives_the_nearest(refused, given, nearest):
    refused((given,), given, f"did you mean {nearest}?")


def test_a_command_like_no_other_gives_all_there_are(refused):
    refused(("fly",), "fly", "run", "parameters")


@pytest.mark.parametrize("option", OPTIONS)
def test_a_misspelt_option_gives_the_nearest(refused, option):
    misspelt = option[:-1] + "x" + option[-1]
    refused(("run", "step_steer", misspelt), misspelt, f"did you mean {option}?")


@pytest.mark.parametrize("option", ["--amp", "--no-roll", "--euler", "--com"])
def test_an_option_is_not_cut_short(refused, option):
    refused(("run", "step_steer", option), option)


@pytest.mark.parametrize(
    "option", [o for o in OPTIONS if o[2:] not in ("no-roll-centre", "euler-terms")]
)
def test_an_option_without_its_value_is_named(refused, option):
    refused(("run", "step_steer", option), option)


@pytest.mark.parametrize("given", ["step_ster", "jturn", "lane_change"])
def test_a_misspelt_manoeuvre_gives_those_there_are(refused, given):
    refused(("run", given), given, *MANOEUVRES)


def test_run_without_anything_to_run_says_what_there_is(refused):
    refused(("run",), *MANOEUVRES, "--commands")
    refused(("run", "--amplitude", "3"), *MANOEUVRES, "--commands")


def test_a_word_too_many_is_named(refused):
    refused(("run", "step_steer", "j_turn"), "j_turn")
    refused(("parameters", "step_steer"), "step_steer")


def test_no_command_at_all_is_refused(refused):
    refused((), "COMMAND")


@pytest.mark.parametrize("value", ["-4", "-0.5", "-1e-3", "-2E0"])
def test_a_negative_number_is_a_value_and_no_option(command, value):
    result = command("run", "step_steer", "--duration", "0.1", "--amplitude", value)
    assert (result.status, result.err) == (0, "")


@pytest.mark.parametrize("before", [True, False])
def test_options_may_stand_before_and_after_the_manoeuvre(command, before):
    options = ("--duration", "0.1")
    words = (*options, "step_steer") if before else ("step_steer", *options)
    assert command("run", *words).value["end"] == "0.100 s, complete"


def help_of(command, capsys, *words) -> str:
    with pytest.raises(SystemExit) as end:
        command(*words)
    printed = capsys.readouterr()
    assert (end.value.code, printed.err) == (0, "")
    return printed.out


def test_help_names_every_command(command, capsys):
    text = help_of(command, capsys, "--help")
    assert "  run " in text
    assert "  parameters " in text


@pytest.mark.parametrize("manoeuvre", ["", *MANOEUVRES])
@pytest.mark.parametrize("word", ["--help", "-h"])
def test_help_of_run_names_every_option_and_manoeuvre(command, capsys, manoeuvre, word):
    text = help_of(command, capsys, *filter(None, ("run", manoeuvre, word)))
    for name in (*OPTIONS, *MANOEUVRES):
        assert name in text


@pytest.mark.parametrize(
    ("manoeuvre", "amplitude"), [("step_steer", 4), ("ramp_steer", 12), ("j_turn", 10)]
)
def test_help_of_a_manoeuvre_has_its_defaults(command, capsys, manoeuvre, amplitude):
    text = " ".join(help_of(command, capsys, "run", manoeuvre, "--help").split())
    assert f"left positive (default {amplitude})" in text


@pytest.mark.parametrize("words", [("run",), ("series",), ("run", "nhtsa_fishhook")])
def test_help_has_each_heading_once(command, capsys, words):
    lines = help_of(command, capsys, *words, "--help").splitlines()
    headings = [line for line in lines if line.endswith(":") and not line.startswith(" ")]
    assert "manoeuvre:" in headings
    assert len(set(headings)) == len(headings)
