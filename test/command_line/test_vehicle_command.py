"""`vehicle`: what a vehicle file contains and what follows from it."""

import math

import pytest

from vehicle_roll_sim import preset
from vehicle_roll_sim.analysis.handling import gradients_of
from vehicle_roll_sim.command_line.vehicle import AXLE_ROWS
from vehicle_roll_sim.vehicle.figures import figures_of

SPRING, TIRE, DAMPING = 20e3, 400e3, 50.0
MASS, ARM, HEIGHT, PITCH_INERTIA, UNSPRUNG = 1200.0, 1.3, 0.75, 1500.0, 20.0
SIMPLE = {
    "sprung_mass": MASS,
    "pitch_inertia": PITCH_INERTIA,
    "cg_to_front_axle": ARM,
    "cg_to_rear_axle": ARM,
    "cg_height": HEIGHT,
    **{f"{axle}_spring_stiffness": SPRING for axle in ("front", "rear")},
    **{f"{axle}_tire_stiffness": TIRE for axle in ("front", "rear")},
    **{f"{axle}_damping": DAMPING for axle in ("front", "rear")},
    **{f"{axle}_unsprung_mass": UNSPRUNG for axle in ("front", "rear")},
}
"""A vehicle whose bounce and pitch are not coupled and hardly damped."""


@pytest.fixture
def modes_of(command):
    """Runs `vehicle` with values; returns frequency (Hz) and damping ratio of each motion."""

    def call(values: dict) -> dict[str, tuple[float, float]]:
        result = command("vehicle", *(w for n, v in values.items() for w in ("--set", f"{n}={v}")))
        rows = result.out.partition("  motion\n")[2].splitlines()[1:]
        cells = [row.split(maxsplit=5) for row in rows[: rows.index("")]]
        return {motion: (float(c[0]), float(c[1])) for _, _, *c, _, motion in cells}

    return call


def test_the_modes_are_those_of_masses_on_their_springs(modes_of):
    """To 2 %: wheels and dampers are not quite out of the way.

    The points of contact of model 1 lie on the body's z axis: they move with it in pitch.
    """
    modes = modes_of(SIMPLE)
    ride = SPRING * TIRE / (SPRING + TIRE)
    expected = {
        "bounce": 4 * ride / MASS,
        "pitch": (4 * ride * ARM**2 - MASS * 9.81 * HEIGHT) / PITCH_INERTIA,
        "front hop": (SPRING + TIRE) / UNSPRUNG,
        "rear hop": (SPRING + TIRE) / UNSPRUNG,
    }
    for motion, square in expected.items():
        assert modes[motion][0] == pytest.approx(math.sqrt(square) / (2 * math.pi), rel=0.02)
    assert modes["bounce"][1] == pytest.approx(4 * DAMPING / (2 * math.sqrt(4 * ride * MASS)), 0.1)


def test_every_value_is_shown_with_its_origin_and_the_figures_follow(command):
    result = command("vehicle")
    assert (result.status, result.err) == (0, "")
    rows = {row.split()[0]: row.split(maxsplit=2) for row in result.out.splitlines() if row.strip()}
    assert rows["cg_height"] == ["cg_height", "0.75", "m"]
    assert rows["drag_area"][2] == "m^2  (default)"
    assert rows["front_roll_centre_height"][1:] == [
        "0.1",
        "m  (cg_height less front_roll_centre_depth)",
    ]
    of_file = "N/m  (VERTICAL_STIFFNESS of the tire file: 200000)"
    assert rows["rear_tire_stiffness"][1:] == ["200000", of_file]
    said, figures = result.value, figures_of(preset())
    assert said["mass"] == "1760 kg, 320 kg of it unsprung"
    assert result.number("static stability factor") == pytest.approx(
        figures.static_stability_factor, rel=1e-3
    )
    for label, (field, factor, _) in AXLE_ROWS.items():
        (row,) = [row for row in result.out.splitlines() if row.startswith(f"{label:28}")]
        shown = [float(cell) for cell in row[len(label) :].split()[:2]]
        assert shown == pytest.approx(
            [factor * getattr(axle, field) for axle in figures.axles.values()], rel=1e-3
        )


def test_the_gradients_are_those_of_steady_turns(command):
    result = command("vehicle", "--speed", "20")
    gradients = gradients_of(preset(), speed=20.0)
    shown = (result.number("understeer gradient"), result.number("roll gradient"))
    per_g = [math.degrees(slope) * 9.81 for slope in gradients]
    assert shown == pytest.approx(per_g, rel=1e-2)
    at_rest = math.degrees(figures_of(preset()).roll_gradient) * 9.81
    assert per_g[1] == pytest.approx(at_rest, rel=0.15)  # whose axles roll on their wheels too


def test_odd_values_and_combinations_are_warnings_or_refused(command, refused):
    words = ("vehicle", "--set", "rear_damping=0", "--set", "front_spring_stiffness=1500")
    result = command(*words)
    assert (result.status, result.err) == (0, "")
    warnings = [row for row in result.out.splitlines() if row.startswith("warning:")]
    assert any("rear_damping: 0 N s/m" in row for row in warnings)
    assert any("of the roll stiffness: typically" in row for row in warnings)
    refused((*words, "--strict"), "--strict: not plausible: ", "; rear_damping: 0 N s/m")


def test_a_vehicle_that_cannot_turn_is_shown_all_the_same(command):
    result = command("vehicle", "--speed", "0.5")
    assert result.status == 0
    assert result.value["steady turn"].startswith("none at 0.5 m/s: speed: ")
    assert result.value["modes"].startswith("none at 0.5 m/s: speed: ")


def test_a_file_that_is_not_there_is_refused(refused):
    refused(("vehicle", "absent.yaml"), "absent.yaml")
