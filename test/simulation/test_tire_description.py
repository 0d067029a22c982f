"""Tires in the description of a simulation: an equal one can be rebuilt, of any version."""

import dataclasses
import json

import magic_formula
import pytest

from vehicle_roll_sim import Options, Simulation, load_tire, preset
from vehicle_roll_sim.simulation.description import describe, described, difference

DATA = magic_formula.__path__[0] + "/../tire/data"
PERIOD_NS = 10_000_000


def rebuilt(vehicle, **options):
    """A simulation and what is rebuilt from its description."""
    simulation = Simulation(vehicle, Options(**options), check_step=False)
    return simulation, described(describe(simulation, PERIOD_NS)).simulation


@pytest.mark.parametrize("moments", ["on", "off"])
@pytest.mark.parametrize("name", ["mf52_full", "mf61", "mf62"])
@pytest.mark.parametrize("combined", [True, False])
def test_a_tire_of_any_version_is_described_in_full(name, combined, moments):
    tire = dataclasses.replace(load_tire(f"{DATA}/{name}.tir"), combined=combined)
    vehicle = dataclasses.replace(preset(), tire=tire)
    simulation, again = rebuilt(vehicle, tire_moments=moments)
    assert difference(simulation, again) is None
    other = again.vehicle.tire
    assert (other.version, other.combined, other.side) == (tire.version, combined, tire.side)
    assert other.coefficients == tire.coefficients
    assert other.record(moments=True).tobytes() == tire.record(moments=True).tobytes()


def test_of_a_tire_that_stays_upright_only_what_acts_on_it_is_described():
    simulation, again = rebuilt(preset())
    told = json.loads(describe(simulation, PERIOD_NS))
    assert "LGAX" not in told["tire"]
    assert "tire_version" not in told
    assert again.vehicle.tire.record()["plain"].all()
    assert difference(simulation, again) is None


def test_a_difference_of_versions_is_found():
    tire = load_tire(f"{DATA}/mf61.tir")
    vehicle = dataclasses.replace(preset(), tire=tire)
    one, _ = rebuilt(vehicle)
    other, _ = rebuilt(dataclasses.replace(preset(), tire=dataclasses.replace(tire, version="6.2")))
    assert difference(one, other) == ("tire_version", "6.1", "6.2")
