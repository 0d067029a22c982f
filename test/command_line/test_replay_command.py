"""`run --bag`, `replay` and `plot` of bags, as a user calls them."""

import shutil

import pytest

pytest.importorskip("rosbags", reason="bags need the library rosbags")

from vehicle_roll_sim.bags.reading import RecordedRun
from vehicle_roll_sim.bags.replay import Replay
from vehicle_roll_sim.command_line import replay as replay_module

SHORT = ("run", "j_turn", "--duration", "1.2")


@pytest.fixture
def bag(command):
    """The bag of a short run, in the folder of the command."""
    assert command(*SHORT, "--bag", "bag").value["bag"] == "bag"
    return "bag"


def test_a_bag_is_replayed_to_the_bit(command, bag):
    result = command("replay", bag, "--strict")
    assert (result.status, result.err) == (0, "")
    assert result.value["run 1"] == "1.200 s, every state reproduced bit for bit"


def test_the_options_of_the_run_are_in_the_bag(command):
    words = ("--set", "cg_height=0.7", "--model", "1b", "--grade", "0.1", "--step", "0.002")
    command(*SHORT, *words, "--command-period", "0.02", "--bag", "other")
    assert "bit for bit" in command("replay", "other").value["run 1"]
    assert "bit for bit" in command("replay", "other", *words).value["run 1"]


def test_the_road_of_the_run_is_in_the_bag_and_its_file_is_not_needed(command, folder):
    (folder / "road.yaml").write_text("features: [{kind: random_profile, start: 2, roughness: D}]")
    command(*SHORT, "--road", "road.yaml", "--bag", "rough")
    assert "bit for bit" in command("replay", "rough", "--road", "road.yaml").value["run 1"]
    (folder / "road.yaml").unlink()
    assert "bit for bit" in command("replay", "rough", "--strict").value["run 1"]


def test_commands_are_held_for_the_period_of_the_node_with_and_without_rows(rows):
    held = rows("j_turn", "--duration", "1.2", "--command-period", "0.01")
    with_bag = rows("j_turn", "--duration", "1.2", "--bag", "bag")
    assert held.keys() == with_bag.keys()
    for name, column in held.items():
        assert (column == with_bag[name]).all(), name


def test_what_is_not_exact_is_told_and_with_strict_an_error(command, bag, monkeypatch):
    monkeypatch.setattr(replay_module, "VERSION", "9.9.9")
    result = command("replay", bag)
    assert result.value["replayed with"].startswith("version 9.9.9 on ")
    assert result.value["recorded with"].startswith("version 0.1.0 on ")


def test_a_recording_that_begins_under_way_is_left_out(command, bag, monkeypatch):
    monkeypatch.setattr(RecordedRun, "begins_at_a_reset", False)
    result = command("replay", bag)
    assert (result.status, len(result.err.splitlines())) == (2, 1)
    assert "starts in mid-run" in result.err


def test_with_strict_a_gap_is_an_error_too(command, bag, monkeypatch):
    monkeypatch.setattr(Replay, "is_complete", False)
    assert command("replay", bag).status == 0
    assert command("replay", bag, "--strict").status == 1


def test_a_bag_is_drawn_as_the_csv_is(command, folder, bag):
    result = command("plot", bag)
    assert result.status == 0
    assert (folder / "bag.png").read_bytes().startswith(b"\x89PNG")


def test_a_bag_that_is_there_already_is_not_replaced(refused, bag):
    refused([*SHORT, "--bag", bag], "--bag", "does not exist yet")


def test_results_of_one_name_are_refused(refused, folder):
    refused([*SHORT, "--csv", "x.png", "--plot", str(folder / "x.png")], "--plot", "--csv")
    refused([*SHORT, "--csv", "x", "--bag", "x"], "--bag", "--csv")
    refused([*SHORT, "--bag", "none/.."], "--bag", "does not exist yet")


def test_a_bag_of_several_vehicles_wants_a_namespace_in_plot_too(refused, bag):
    refused(["plot", bag, "--namespace", "a"], "--namespace", "one of /")
    refused(["replay", bag, "--namespace", "a"], "--namespace", "one of /")


def test_a_period_that_is_no_multiple_of_the_step_is_refused(refused):
    refused([*SHORT, "--step", "0.003", "--bag", "bag"], "0.003")


def test_a_bag_of_another_vehicle_than_the_options_say_is_refused(refused, bag):
    refused(["replay", bag, "--set", "cg_height=0.7"], "vehicle.cg_height", "0.7", "0.75")
    refused(["replay", bag, "--model", "8dof"], "model.model", "8dof")


@pytest.mark.parametrize("length", [0, 7, 1000, -1])
def test_a_truncated_bag_is_refused(refused, folder, bag, length):
    file = folder / bag / "bag_0.mcap"
    file.write_bytes(file.read_bytes()[:length])
    refused(["replay", bag], "BAG", "a complete bag")
    refused(["plot", bag], "BAG", "a complete bag")


def test_what_is_no_bag_is_refused(refused, folder, bag):
    (folder / bag / "metadata.yaml").unlink()
    refused(["replay", bag], "BAG", "metadata.yaml")
    refused(["replay", "nothing"], "BAG", "nothing")
    refused(["replay"], "BAG")
    shutil.rmtree(folder / bag)
    (folder / bag).mkdir()
    (folder / bag / "metadata.yaml").write_text("rosbag2_bagfile_information: 3\n")
    refused(["replay", bag], "BAG", "a complete bag")
