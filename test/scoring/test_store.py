"""The folder of a score: an interrupted one goes on, another one is refused."""

import numpy as np
import pytest

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.model.records import COMMAND
from vehicle_roll_sim.scoring.driven import Driven
from vehicle_roll_sim.scoring.store import RUNS, Store, fingerprint

IDENTITY = {"controllers": {"mine": "mine.py"}}
DRIVEN = Driven(np.ones(5, COMMAND), np.zeros(6, bool))


def test_a_run_that_was_kept_is_there_for_the_same_score_only(tmp_path):
    folder = tmp_path / "deep" / "score"
    Store(folder, IDENTITY, "--out").save("mine", "run", DRIVEN)
    again = Store(folder, dict(IDENTITY), "--out")
    assert again.load("mine", "run") == DRIVEN
    assert again.load("mine", "other") is None
    with pytest.raises(InputError, match=r"--out: .*has another score"):
        Store(folder, {"controllers": {}}, "--out")


def test_a_folder_of_anything_else_is_refused_and_left_as_it_is(tmp_path):
    (tmp_path / "mine.txt").write_text("precious")
    with pytest.raises(InputError, match=r"--out: .*: a new or empty folder"):
        Store(tmp_path, IDENTITY, "--out")
    assert [each.name for each in tmp_path.iterdir()] == ["mine.txt"]


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04", b"nonsense", b"\x93NUMPY\x01\x00"])
def test_a_damaged_run_is_driven_again(tmp_path, content):
    store = Store(tmp_path, IDENTITY, "--out")
    store.save("mine", "run", DRIVEN)
    (file,) = (tmp_path / RUNS).iterdir()
    file.write_bytes(content)
    assert store.load("mine", "run") is None
    store.save("mine", "run", DRIVEN)
    assert store.load("mine", "run") == DRIVEN
    store.forget("mine", "run")
    assert store.load("mine", "run") is None


def test_any_change_shows_in_a_fingerprint():
    assert fingerprint(b"one") == fingerprint(b"one")
    assert fingerprint(b"one") != fingerprint(b"One")
