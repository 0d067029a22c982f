"""Randomly damaged files: read, or refused in one line that names the file."""

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from vehicle_files import REFERENCE_TIR, REFERENCE_YAML

from vehicle_roll_sim import InputError, Tire, Vehicle, load_tire, load_vehicle

READERS = {
    "a.yaml": (load_vehicle, Vehicle, REFERENCE_YAML.encode()),
    "a.tir": (load_tire, Tire, REFERENCE_TIR.encode()),
}
DAMAGE = st.lists(
    st.tuples(st.integers(0, 10_000), st.integers(0, 40), st.binary(max_size=20)),
    min_size=1,
    max_size=4,
)
"""Each: from which byte on, how many are cut out, and what comes in their place."""


@pytest.mark.parametrize("name", READERS)
@given(damage=DAMAGE)
@settings(
    max_examples=150,
    deadline=None,  # the first example waits for the disk
    suppress_health_check=[HealthCheck.function_scoped_fixture],  # each example writes its own
)
def test_a_damaged_file_is_read_or_refused_in_one_line(tmp_path, name, damage):
    read, kind, content = READERS[name]
    for begin, cut, inserted in damage:
        place = begin % len(content)
        content = content[:place] + inserted + content[place + cut :]
    path = tmp_path / name
    path.write_bytes(content)
    (tmp_path / "reference.tir").write_text(REFERENCE_TIR)
    refusal = f"{tmp_path}"
    try:
        assert isinstance(read(path), kind)
    except InputError as error:
        refusal = str(error)
    assert str(tmp_path) in refusal
    assert len(refusal.splitlines()) == 1
