"""~/save and ~/restore: the node goes on to the bit, also after a restart; or it says why not."""

import signal

import pytest
from lockstep_partner import answered, begin
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter
from std_msgs.msg import Float64
from std_srvs.srv import SetBool, Trigger

from vehicle_roll_sim.ros.simulator import snapshot_store
from vehicle_roll_sim.ros.simulator.node import Simulator

ACTUATED = ("vehicle.steering_actuator_frequency", 5.0)


@pytest.fixture
def make(context):
    """make(NAME=VALUE...): a simulator that nothing spins, paused, after its first set."""
    nodes = []

    def make_node(*pairs):
        overrides = [Parameter(name, value=value) for name, value in pairs]
        node = Simulator(context=context, parameter_overrides=overrides)
        nodes.append(node)
        node.begin()
        assert call(node, "pause", True).success
        return node

    yield make_node
    for node in nodes:
        node.destroy_node()


def call(node, name: str, data: bool | None = None):
    """The answer of a service of the node."""
    (found,) = (each for each in node.services if each.srv_name.endswith(f"/{name}"))
    kind = Trigger if data is None else SetBool
    return found.callback(kind.Request(**({} if data is None else {"data": data})), kind.Response())


def receive(node, topic: str, value: float) -> None:
    (found,) = (each for each in node.subscriptions if each.topic_name.endswith(f"/{topic}"))
    found.callback(Float64(data=value))


def drive(node, steering: float, periods: int = 5) -> list:
    """States and applied commands of a few periods; the speed command is given once."""
    seen = []
    for number in range(periods):
        receive(node, "steering_cmd", steering * number)
        assert call(node, "step").success
        seen.append((node.session.simulation.state.tobytes(), node.session.applied))
    return seen


def set_parameter(node, name: str, value) -> None:
    (result,) = node.set_parameters([Parameter(name, value=value)])
    assert result.successful, result.reason


def token(node) -> str:
    answer = call(node, "save")
    assert answer.success
    return answer.message


def refusal(node) -> str:
    """Why ~/restore is refused; nothing moves."""
    before = node.session.snapshot()
    answer = call(node, "restore")
    assert not answer.success
    assert "\n" not in answer.message
    assert node.session.snapshot() == before
    return answer.message


def test_a_simulator_goes_on_from_the_last_state_saved_or_from_that_of_a_token(make):
    node = make(ACTUATED)
    receive(node, "speed_cmd", 20.0)
    drive(node, 0.01)
    first = token(node)
    straight = drive(node, 0.02)
    second = token(node)
    further = drive(node, -0.03)
    answer = call(node, "restore")
    assert answer.success
    assert answer.message == f"{second} at 0.1 s"
    assert drive(node, -0.03) == further
    set_parameter(node, "snapshot", first)
    for _ in range(2):
        assert call(node, "restore").message == f"{first} at 0.05 s"
        assert token(node) == first
        assert drive(node, 0.02) == straight
    assert token(node) == second


def test_parameters_that_change_while_it_runs_are_restored_and_shown(make):
    node = make()
    changed = {
        "initial_speed": (15.0, 25.0),
        "command_timeout": (0.3, 0.0),
        "steering_timeout_policy": ("centre", "hold"),
        "steering_limit": (0.3, 0.2),
        "wind_limit": (30.0, 20.0),
    }
    for name, (saved, _) in changed.items():
        set_parameter(node, name, saved)
    kept = token(node)
    for name, (_, later) in changed.items():
        set_parameter(node, name, later)
    set_parameter(node, "snapshot", kept)
    assert call(node, "restore").success
    for name, (saved, _) in changed.items():
        assert node.get_parameter(name).value == saved
    assert node.session.inbox.limits.steering_limit == 0.3
    assert node.settings.initial_speed == 15.0
    assert node.get_parameter("snapshot").value == kept


def test_what_cannot_be_restored_is_refused_in_one_line(make, tmp_path, monkeypatch):
    folder = tmp_path / "saved" / "here"
    node = make(("snapshot_folder", str(folder)))
    assert "nothing has been saved yet" in refusal(node)
    for wrong in ("../secret", "s0", "S0123456789abcdef", "/etc/passwd"):
        set_parameter(node, "snapshot", wrong)
        assert "a token as ~/save returned it" in refusal(node)
    set_parameter(node, "snapshot", "s0123456789abcdef")
    assert f"no file in {folder}" in refusal(node)
    kept = token(node)
    (file,) = folder.iterdir()
    assert file.name == f"{kept}.snapshot"
    other = make(("snapshot_folder", str(folder)), ("vehicle.cg_height", 0.7))
    set_parameter(other, "snapshot", kept)
    assert "taken from a different simulation" in refusal(other)
    monkeypatch.setattr(snapshot_store, "MOST_KEPT", 1)
    drive(node, 0.01)
    token(node)  # the one before is forgotten, but for its file
    text = file.read_text()
    file.rename(folder / "s0123456789abcdef.snapshot")
    assert "renamed" in refusal(node)
    (folder / "s0123456789abcdef.snapshot").write_text(text[:-9])
    assert "damaged" in refusal(node)


def test_a_file_that_cannot_be_written_is_told_of_and_leaves_nothing(make, tmp_path):
    folder = tmp_path / "saved"
    node = make(("snapshot_folder", str(folder)))
    folder.write_text("a file has taken the name")
    answer = call(node, "save")
    assert not answer.success
    assert answer.message.startswith("snapshot_folder: ")
    assert [each.name for each in tmp_path.iterdir() if each.name != "ros_log"] == ["saved"]


def test_without_a_folder_only_the_latest_are_kept(make, monkeypatch):
    monkeypatch.setattr(snapshot_store, "MOST_KEPT", 2)
    node = make()
    tokens = []
    for _ in range(3):
        tokens.append(token(node))
        drive(node, 0.01, 1)
    set_parameter(node, "snapshot", tokens[0])
    assert "not in memory" in refusal(node)
    set_parameter(node, "snapshot", tokens[1])
    assert call(node, "restore").success


def test_what_is_saved_before_the_first_set_begins_with_its_commands(context, tmp_path, make):
    saved = make(("snapshot_folder", str(tmp_path)))
    drive(saved, 0.02)
    kept = token(saved)
    straight = drive(saved, 0.0)
    waiting = Simulator(
        context=context,
        parameter_overrides=[
            Parameter("snapshot_folder", value=str(tmp_path)),
            Parameter("snapshot", value=kept),
            Parameter("mode", value="lockstep"),
        ],
    )
    assert call(waiting, "restore").success
    waiting.begin()
    assert call(waiting, "pause", True).success
    assert waiting.session.inbox.unanswered(["steering_cmd"]) == ["steering_cmd"]
    assert drive(waiting, 0.0) == straight
    waiting.destroy_node()


@pytest.mark.unmeasured
def test_in_lockstep_a_simulator_goes_on_to_the_bit_from_the_file_of_another(
    start, make_peer, tmp_path
):
    """The other has ended. The second has been elsewhere; it answers with the set of that time."""
    words = ("-p", f"snapshot_folder:={tmp_path}", "-p", f"{ACTUATED[0]}:={ACTUATED[1]}")
    answers = (0.03, 0.05, -0.02, 0.0)
    peer = make_peer()
    first = begin(start, peer, *words)
    [answered(peer, 0.02) for _ in range(3)]
    kept = peer.call(Trigger, "simulator/save").message
    straight = [list(answered(peer, value).data) for value in answers]
    assert first.finish(signal.SIGINT)[0] == 0
    peer = make_peer("again")
    begin(start, peer, *words, "-r", "__ns:=/again")
    [answered(peer, -0.1) for _ in range(2)]
    request = SetParameters.Request(
        parameters=[Parameter("snapshot", value=kept).to_parameter_msg()]
    )
    assert peer.call(SetParameters, "simulator/set_parameters", request).results[0].successful
    before = len(peer.received["state"])
    assert peer.call(Trigger, "simulator/restore").success
    peer.wait(lambda: len(peer.received["state"]) > before, "the set of the saved time")
    assert peer.received["state"][-1][1].data[0] == 0.03
    assert [list(answered(peer, value).data) for value in answers] == straight
