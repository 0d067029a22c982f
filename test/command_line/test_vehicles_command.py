"""`vehicles`: the shipped vehicles and their figures; a name in place of a vehicle file."""

import math

import pytest

from vehicle_roll_sim import Options, preset
from vehicle_roll_sim.analysis.handling import gradients_of
from vehicle_roll_sim.command_line.vehicles import COLUMNS
from vehicle_roll_sim.vehicle.figures import figures_of
from vehicle_roll_sim.vehicle.shipped import SHIPPED, lift_speeds


def test_it_lists_every_shipped_vehicle_with_its_figures(command):
    result = command("vehicles")
    assert (result.status, result.err) == (0, "")
    head, _, *rows = result.out.partition("\n\n")[0].splitlines()
    assert all(label in head for label in COLUMNS)
    table = {row.split()[0]: row.split()[1:] for row in rows}
    assert [*table] == [*SHIPPED]
    for name, cells in table.items():
        vehicle = preset(name)
        figures = figures_of(vehicle)
        numbers = [float(cell.replace("-", "nan") if cell == "-" else cell) for cell in cells]
        assert numbers[0] == pytest.approx(figures.mass, rel=1e-4)
        assert numbers[1:3] == pytest.approx(
            [figures.cg_height, figures.static_stability_factor], rel=5e-3
        )
        assert numbers[7] == pytest.approx(figures.roll_frequency, abs=5e-3)
        lift = lift_speeds()[name] * 3.6
        assert numbers[8] == pytest.approx(lift, abs=0.05, nan_ok=True)
    gradients = gradients_of(preset("van"), Options(model="2"), speed=50 / 3.6)
    per_g = [math.degrees(slope) * 9.81 for slope in gradients]
    assert [float(cell) for cell in table["van"][3:5]] == pytest.approx(per_g, abs=5e-3)
    assert all(result.value[name] == about for name, about in SHIPPED.items())


def test_a_name_is_taken_wherever_a_vehicle_file_is(command, refused):
    assert command("vehicle", "tenth_scale").value["mass"].startswith("3.74 kg")
    assert "| `sprung_mass` | m | 13000 |" in command("parameters", "--vehicle", "city_bus").out
    told = refused(("run", "j_turn", "--vehicle", "vann"), "vann does not exist", "van, ")
    assert "city_bus" in told
