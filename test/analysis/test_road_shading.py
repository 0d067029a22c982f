"""The path panel of the standard figure shows where the road is slippery, and its heights."""

import dataclasses

import numpy as np
from drawn_runs import drawn, labelled, panels, recorded, shown_texts

from vehicle_roll_sim.analysis.plots import standard_figure
from vehicle_roll_sim.simulation.road import Road

LABEL = "less friction (path)"
HEIGHT = "height of the road, a line every "
ORDER = 0.5
"""Of contour lines, behind everything but the shades."""


def on_road(*features: dict):
    road = Road.from_values({"features": features})
    return standard_figure([dataclasses.replace(drawn(recorded()), road=road)], "run")


def on_patch(friction: float, **edges: float):
    return on_road({"kind": "patch", "start": -100.0, "friction": friction, **edges})


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


def test_contour_lines_are_where_the_road_has_their_height():
    """On a slope of 1 : 10, whose heights are exact between the points that are looked at."""
    slope = {"kind": "ramp", "start": -50.0, "length": 200.0, "height": 20.0, "rounding": 0.01}
    figure = on_road(slope)
    (label,) = (text for text in shown_texts(figure) if text.startswith(HEIGHT))
    step = float(label.removeprefix(HEIGHT).split()[0])
    _, _, path = panels(figure)
    places = [
        line[:, 0]
        for collection in path.collections
        for found in collection.get_paths()
        for line in found.to_polygons(closed_only=False)
        if collection.get_zorder() == ORDER
    ]
    assert len(places) > 2
    heights = [0.1 * (x.mean() + 50.0) for x in places]
    assert max(np.ptp(x) for x in places) < 1e-3  # the rounding at the ends of the slope
    np.testing.assert_allclose(np.diff(sorted(heights)), step, atol=1e-3)


def test_a_level_road_has_no_contour_lines():
    figures = [on_patch(0.5), on_road({"kind": "soft_soil", "start": 0.0})]
    for figure in figures:
        assert not [text for text in shown_texts(figure) if text.startswith(HEIGHT)]
