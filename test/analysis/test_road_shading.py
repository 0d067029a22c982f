"""The path panel of the standard figure shows where the road is slippery."""

import dataclasses

import numpy as np
from drawn_runs import drawn, labelled, panels, recorded, shown_texts

from vehicle_roll_sim.analysis.plots import standard_figure
from vehicle_roll_sim.simulation.road import Road

LABEL = "less friction (path)"


def on_patch(friction: float, **edges: float):
    patch = {"kind": "patch", "start": -100.0, "friction": friction, **edges}
    road = Road.from_values({"features": [patch]})
    return standard_figure([dataclasses.replace(drawn(recorded()), road=road)], "run")


def shades(figure) -> np.ma.MaskedArray:
    """Of the points of the panel, a row for each y: the friction that is missing."""
    _, _, path = panels(figure)
    (mesh,) = path.collections[-1:]
    return mesh.get_array()


def test_the_half_of_the_panel_with_the_patch_is_shaded_by_the_friction_that_is_missing():
    figure = on_patch(0.25, left=0.0)
    assert LABEL in shown_texts(figure)
    found = shades(figure)
    right = found[~found.mask]
    assert right.tolist() == [0.75] * len(right)
    assert found.mask[-1].all()  # furthest to the left
    assert not found.mask[0].any()


def test_without_slippery_places_nothing_is_shaded():
    for figure in (on_patch(1.0), standard_figure([drawn(recorded())], "run")):
        assert LABEL not in shown_texts(figure)
        assert not labelled(panels(figure)[2], LABEL)
