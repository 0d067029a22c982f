"""Every command and example of the documentation is run or checked, page by page."""

import shutil

import pytest
from not_run import NOT_RUN, pattern_of
from pages import COMMANDS, ROOT, lessons, pages, snippets, snippets_in
from reader import Reader, nodes
from shell import commands_of, lines_of

pytestmark = [pytest.mark.unmeasured, pytest.mark.usefixtures("unplaced")]

SHARED = ("config", "msg_examples", "policies")
"""Folders of share/ that the pages mention."""


@pytest.fixture(scope="session", autouse=True)
def fork_server():
    """The program from which nodes are forked ends with the tests."""
    yield
    if nodes:
        nodes.forked.SERVER.close()


@pytest.fixture
def share(tmp_path, monkeypatch):
    """The content of share/ in an installation, and launch files that can be loaded."""
    (tmp_path / "share").mkdir()
    for name in SHARED:
        inside = ROOT / "vehicle_roll_sim" / name
        shutil.copytree(inside if inside.exists() else ROOT / name, tmp_path / "share" / name)
    if nodes is None:
        yield
        return
    with nodes.launch_files.stand_in(monkeypatch, tmp_path / "install"):
        yield


@pytest.fixture
def read(tmp_path, monkeypatch, share):
    """read(snippets): a reader who has followed the snippets in an empty folder."""
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "ros_log"))
    monkeypatch.setenv("MPLBACKEND", "agg")
    (tmp_path / "reader").mkdir()

    def read_all(found) -> Reader:
        manual = [each for each in snippets("docs/controllers.md") if each.file_name]
        own = {each.file_name: each.text for each in (*manual, *found) if each.file_name}
        reader = Reader(tmp_path / "reader", own)
        for snippet in found:
            reader.read(snippet)
        return reader

    return read_all


@pytest.mark.parametrize("page", sorted({*pages()} - {*lessons()}))
def test_what_a_page_has_the_reader_type_can_be_done(page, read):
    print(page, read(snippets(page)).count)


def test_the_tutorials_can_be_followed_one_after_the_other(read):
    assert {*lessons()} <= {*pages()}
    print("tutorials", read([each for page in lessons() for each in snippets(page)]).count)


def test_what_is_not_run_is_somewhere_on_a_page():
    typed = [
        " ".join(words)
        for page in pages()
        for snippet in snippets(page)
        if snippet.language in (*COMMANDS, "inline")
        for line in lines_of(snippet.language, snippet.text)
        for words in commands_of(line.typed)
    ]
    found = {pattern_of(command) for command in typed}
    assert set(NOT_RUN) == found - {None}


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("```\nvehicle_roll_sim run j_tum\n```", "j_tum"),
        ("```\nvehicle_roll_sim run j_turn --sped 3\n```", "--speed"),
        ("```\nmake tset\n```", "no target tset"),
        ("```\ngnuplot run.csv\n```", "nobody knows how to try gnuplot run.csv"),
        ("```python\nimport vehicle_roll\n```", "vehicle_roll"),
        ("```python\nprint(1)\n```\n<!-- output -->\n```text\n2\n```", "what comes out is\n1"),
        ("```console\n$ vehicle_roll_sim run j_turn --duration 1\nend: 2.000 s\n```", "1.000 s"),
        ("```console\n$ vehicle_roll_sim run x\n```", "is not allowed"),
        ("```console\n$ ls\nx: error: y\n```", "what comes out is\n"),
        ("```fortran\nEND\n```", "nobody knows how to try fortran"),
        ("`vehicle_roll_sim run NAME --sped 3`", "run has no option --sped"),
        ("`vehicle_roll_sim rnu`", "no command rnu"),
        ("`ros2 run vehicle_roll_sim simulater`", "no executable simulater"),
    ],
)
def test_what_cannot_be_done_is_named_with_its_place(text, problem, read):
    with pytest.raises(AssertionError, match=r"^a\.md:\d+: ") as raised:
        read(list(snippets_in(text + "\n", "a.md")))
    assert problem in str(raised.value)


@pytest.mark.skipif(nodes is None, reason="ROS 2 (rclpy) is not installed")
@pytest.mark.parametrize(
    ("command", "problem"),
    [
        ("ros2 run vehicle_roll_sim simulator --ros-args -p modle:=1", "modle"),
        ("ros2 run vehicle_roll_sim simulator --ros-args -p model:=9", "9"),
        ("ros2 run vehicle_roll_sim active_roll_bar --ros-args -p shore:=1.0", "shore"),
        ("ros2 run vehicle_roll_sim manoeuvre j_turn --sped 3", "--speed"),
        ("ros2 run vehicle_roll_sim compare ./nobody.py", "nobody.py"),
        ("ros2 launch vehicle_roll_sim controller.launch.py bags:=x", "no argument bags"),
        ("ros2 launch vehicle_roll_sim simulator.launch.py model:=9", "9"),
        ("ros2 launch vehicle_roll_sim manoeuvre.launch.py options:='--sped 3'", "--speed"),
        ("ros2 topic pub /steering_cmd std_msgs/msg/Float32 '{data: 1.0}'", "std_msgs/msg/Float64"),
        ("ros2 topic pub /steering_cmd std_msgs/msg/Float64 '{angle: 1.0}'", "no field angle"),
        ("ros2 topic echo /stat", "no topic"),
        ("ros2 param set /simulator command_timeout -1", "command_timeout"),
        ("ros2 service call /simulator/start std_srvs/srv/Trigger", "no service"),
    ],
)
def test_what_ros_would_refuse_is_named(command, problem, read):
    with pytest.raises(AssertionError, match=r"^a\.md:1: ") as raised:
        read(list(snippets_in(f"```\n{command}\n```\n", "a.md")))
    assert problem in str(raised.value)
