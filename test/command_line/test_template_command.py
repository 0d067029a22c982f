"""`template`: files to start from, never overwritten, and accepted by `run`."""

from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[2] / "examples"
FILES = {"car.yaml": (), "tire.tir": ("--tire",), "commands.csv": ("--commands",)}


@pytest.mark.parametrize("name", FILES)
def test_a_file_is_written_as_it_is_printed_and_as_it_is_shipped(command, folder, name):
    printed = command("template", *FILES[name])
    assert (printed.status, printed.err) == (0, "")
    written = command("template", *FILES[name], name)
    assert (written.status, written.err) == (0, "")
    assert name in written.out
    shipped = (EXAMPLES / name).read_text(encoding="utf-8")
    assert (folder / name).read_text(encoding="utf-8") == printed.out == shipped


def test_run_takes_the_three_as_they_are_and_the_first_two_are_the_reference(command, folder):
    for name, words in FILES.items():
        assert command("template", *words, name).status == 0
    words = ("run", "--commands", "commands.csv", "--csv")
    assert command(*words, "plain.csv").status == 0
    given = command(*words, "given.csv", "--vehicle", "car.yaml", "--tire", "tire.tir")
    assert (given.status, given.err) == (0, "")
    assert (folder / "given.csv").read_bytes() == (folder / "plain.csv").read_bytes()


@pytest.mark.parametrize("name", ["there.yaml", "link.yaml", "folder"])
def test_a_file_of_ones_own_is_never_replaced(refused, folder, name):
    (folder / "there.yaml").write_text("mine\n")
    (folder / "link.yaml").symlink_to("nowhere")
    (folder / "folder").mkdir()
    refused(("template", name), "FILE", name, "does not exist yet")
    assert (folder / "there.yaml").read_text() == "mine\n"


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("none/car.yaml",), ("FILE", "none")),
        (("",), ("FILE", "the name of a file")),
        (("--tire", "--commands"), ("--tire", "--commands")),
        (("--tyre",), ("--tyre", "did you mean --tire?")),
        (("a.yaml", "b.yaml"), ("b.yaml",)),
    ],
)
def test_what_is_wrong_is_refused_in_one_line(refused, words, named):
    refused(("template", *words), *named)
