"""Implausible values: a warning on stderr, or status 2 with --strict; results stay the same."""

import pytest

ODD = ("--set", "front_damping=2.5", "--set", "cg_height=0.7")
TOLD = "front_damping: 2.5 N s/m gives a damping ratio of 0.00032"
SHORT = ("run", "step_steer", "--duration", "0.1")
COMMANDS = {
    "run": SHORT,
    "linearize": ("linearize",),
    "parameters": ("parameters",),
    "series": ("series", "sine_with_dwell"),
}


@pytest.mark.parametrize("name", ["run", "linearize", "parameters"])
def test_it_is_one_line_of_warning_and_the_results_are_there(command, name):
    result = command(*COMMANDS[name], *ODD)
    assert result.status == 0
    assert result.out
    assert "warning" not in result.out
    (line,) = result.err.splitlines()
    assert line.startswith(f"vehicle_roll_sim: warning: {TOLD}")


@pytest.mark.parametrize("name", COMMANDS)
def test_strict_refuses_all_of_it_in_one_line(refused, name):
    words = (*COMMANDS[name], *ODD, "--set", "rear_damping=0", "--strict")
    refused(words, "--strict: not plausible: ", TOLD, "; rear_damping: 0 N s/m")


@pytest.mark.parametrize("name", ["run", "linearize", "parameters"])
def test_strict_has_nothing_to_say_of_the_reference_vehicle(command, name):
    result = command(*COMMANDS[name], "--strict")
    assert (result.status, result.err) == (0, "")


def test_a_command_file_in_degrees_is_warned_of_once_and_refused_with_strict(
    command, refused, folder
):
    (folder / "in.csv").write_text("time,steering\n0,0\n0.1,3\n")
    told = "in.csv: steering at 0.1 s: 3 rad is 171.9 deg"
    result = command("run", "--commands", "in.csv")
    assert result.status == 0
    assert result.err.startswith(f"vehicle_roll_sim: warning: {told}")
    assert len(result.err.splitlines()) == 1
    refused(("run", "--commands", "in.csv", "--strict"), "--strict", told)


def test_strict_of_replay_keeps_its_meaning(command):
    assert command(*SHORT, *ODD, "--bag", "bag").status == 0
    result = command("replay", "bag", "--strict")
    assert (result.status, result.err) == (0, "")
    told = command("replay", "bag", "--strict", *ODD)
    assert told.status == 0
    assert TOLD in told.err


def test_a_bag_of_heights_is_replayed_to_the_bit_with_and_without_them(command):
    heights = ("--set", "cg_height=0.63", "--set", "front_roll_centre_height=0.1")
    heights = (*heights, "--set", "rear_roll_centre_height=0.13")
    assert command(*SHORT, *heights, "--bag", "bag").status == 0
    for words in ((), heights):
        result = command("replay", "bag", "--strict", *words)
        assert (result.status, result.err) == (0, "")
        assert "every state reproduced bit for bit" in result.value["run 1"]
