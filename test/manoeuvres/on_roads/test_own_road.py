"""Manoeuvres that bring their road, in every way of driving them."""

import dataclasses

import numpy as np
import pytest

from vehicle_roll_sim import Batch, InputError, Road, Simulation, preset, run, study
from vehicle_roll_sim.manoeuvres.catalogue import MANOEUVRES, ON_ROADS, manoeuvre_named
from vehicle_roll_sim.offline.running import drive

REFUSED = "road: another road is given: no road, grade or bank: this manoeuvre brings its own road"
SHORT = {"duration": 4.5, "step": 2e-3}


@pytest.mark.parametrize("name", ON_ROADS)
def test_another_road_is_refused_but_its_own_is_not(name):
    manoeuvre = dataclasses.replace(MANOEUVRES[name], duration=0.1)
    with pytest.raises(InputError) as refused:
        run(manoeuvre, road=Road(bank=0.1))
    assert str(refused.value) == REFUSED
    own = manoeuvre.own_road()
    runs = [run(manoeuvre, road=road).to_numpy() for road in (None, Road(), own)]
    assert runs[0].tobytes() == runs[1].tobytes() == runs[2].tobytes()
    with pytest.raises(InputError, match=r"^road: the simulation has another road"):
        drive(manoeuvre, Simulation(preset()))
    assert Road.from_values(own.values()) == own


@pytest.mark.parametrize("name", ON_ROADS)
def test_a_node_is_not_driven_through_it(name):
    with pytest.raises(InputError, match=f"{name} brings its own road; drive it with"):
        manoeuvre_named(name)


def test_a_batch_and_a_study_drive_it_as_run_does(tmp_path):
    speeds = [3.0, 5.5]
    alone = [run("curb_trip", sliding_speed=speed, **SHORT).metrics for speed in speeds]
    curbs = [dataclasses.replace(MANOEUVRES["curb_trip"], sliding_speed=each) for each in speeds]
    batch = Batch(preset(), manoeuvre=curbs, **SHORT).run()
    assert batch.failures == ["", ""]
    assert batch["peak_roll"].tolist() == [each["peak_roll"] for each in alone]
    values = {
        "manoeuvre": "curb_trip",
        "fixed": {"manoeuvre.duration": SHORT["duration"]},
        "factors": {"manoeuvre.sliding_speed": speeds},
        "step": SHORT["step"],
    }
    found = study(values, tmp_path / "study").to_numpy()
    np.testing.assert_array_equal(found["peak_roll"], batch["peak_roll"])
