"""Models 1 and 2 compared: what a roll centre that moves changes in the manoeuvres of the paper."""

import math

import numpy as np
import pytest

from vehicle_roll_sim import preset
from vehicle_roll_sim.files.table_file import read_table
from vehicle_roll_sim.paper import beyond
from vehicle_roll_sim.paper.study import J_TURN

pytestmark = pytest.mark.unmeasured


@pytest.fixture(scope="module")
def found() -> dict:
    runs = []
    pairs = beyond.pairs(preset(), lambda: runs.append(1))
    assert len(runs) == len(beyond.CASES) * len(beyond.MODELS)
    return {(pair.manoeuvre, pair.axles): pair for pair in pairs}


def test_both_models_begin_with_the_same_roll_centres(found):
    for (_, axles), pair in found.items():
        vehicle = preset() if axles == beyond.LINKS else beyond.on_swing_axles(preset())
        for axle, wheel in (("front", 0), ("rear", 2)):
            height = pair.signal("2", f"{axle}_roll_centre_height")[0]
            assert height == pytest.approx(vehicle.roll_centre_height[wheel], abs=1e-6)


def test_a_fixed_roll_centre_misses_that_swing_axles_jack_the_vehicle_up_until_it_rolls_over(found):
    pair = found[J_TURN, beyond.SWING_AXLES]
    assert math.isnan(pair.responses["1"].rollover)
    assert pair.responses["2"].rollover < 3.5  # s
    until = pair.jacked()
    assert pair.rise("2", until) > 4 * pair.rise("1", until)


def test_the_limit_is_where_the_roll_angles_part(found):
    for pair in found.values():
        two = np.abs(pair.responses["2"].roll)
        k = int(np.argmax(two >= pair.limit()))
        apart = abs(pair.responses["1"].roll[k] - pair.responses["2"].roll[k])
        assert apart == pytest.approx(max(0.5, 0.05 * two[k]), rel=0.1)  # samples are 10 ms apart
        assert 5.0 < pair.limit() < 12.0  # deg


def test_a_pair_is_drawn_and_its_data_written(found, tmp_path):
    pair = found[J_TURN, beyond.SWING_AXLES]
    beyond.draw(pair, tmp_path)
    assert (tmp_path / "beyond_j_turn_swing_axles.png").stat().st_size > 10_000
    header, rows = read_table(tmp_path / "beyond_j_turn_swing_axles.csv", 10_000_000)
    assert tuple(header) == ("model", *beyond.DATA)
    assert {texts[0] for _, texts in rows} == {"1", "2"}


def test_the_text_has_a_line_for_every_case(found):
    head, *lines = beyond.as_text([*found.values()]).splitlines()
    assert "model 2" in head
    assert len(lines) == len(beyond.CASES)
    assert all(" deg; rise" in line for line in lines)
