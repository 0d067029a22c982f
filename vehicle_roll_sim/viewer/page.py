"""Puts the page together from its parts in `web/`; the result needs no other file."""

import base64
import dataclasses
import functools
import hashlib
import html
import importlib.resources
import json
import re
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from vehicle_roll_sim.analysis.panels import Signal
from vehicle_roll_sim.files.output_file import replaced_file
from vehicle_roll_sim.version import __version__
from vehicle_roll_sim.viewer.decimation import MOST_ROWS
from vehicle_roll_sim.viewer.recording import ViewedRun, panels_of, recording
from vehicle_roll_sim.viewer.road import roads_of, values_of_roads
from vehicle_roll_sim.viewer.study_map import StudyMap, values_of_map

MOST_RUNS = 4
"""As many as the page has colours."""
ROWS_OF_MANY = 600
"""As MOST_ROWS, of each run of a page that has more than MOST_RUNS."""
SCRIPTS = (
    *("recording.js", "body.js", "vehicle.js", "ground.js", "road.js", "scene.js"),
    *("plots.js", "playback.js", "readings.js", "map.js", "choice.js", "controls.js"),
    *("feed.js", "main.js"),
)
"""In the order in which they use one another."""
PLACE = re.compile(r"\{\{(\w+)\}\}")
THINNED = "Long runs are thinned: peaks, lift-offs and events are kept."


@dataclasses.dataclass(frozen=True)
class Feed:
    """Where a page finds what is added to its run: server-sent events, each JSON of a `recording`.

    panels: commands with a panel even while they are 0. page: the name of this page; the page is
    loaded again when an event has another.
    """

    address: str
    page: str
    panels: tuple[Signal, ...] = ()


def page(
    runs: Sequence[ViewedRun],
    title: str,
    cones: Iterable = (),
    notes: Iterable[str] = (),
    shown: Sequence[int] = (0,),
    study: StudyMap | None = None,
    feed: Feed | None = None,
    meshes: Sequence[dict | None] | None = None,
) -> str:
    """The HTML text of a page that shows at most MOST_RUNS runs over one another.

    cones: points (n, 2) on the ground (m). notes: sentences at the foot of the page. Of more
    than MOST_RUNS, the reader chooses which to show; shown: places of those shown at first.
    study: the map of the study that has the runs; it opens them one by one. feed: where the page
    finds what is added to its only run. meshes: those of the roads, if they are known already.
    """
    panels, signals = panels_of(runs, feed.panels if feed else ())
    has_many = len(runs) > MOST_RUNS
    most = ROWS_OF_MANY if has_many else MOST_ROWS
    told = [recording(run, signals, most, are_apart=feed is not None) for run in runs]
    thinned = [THINNED] if any(each["is_thinned"] for each in told) else []
    roads = roads_of(runs)
    data = {
        "runs": told,
        "roads": values_of_roads(runs) if meshes is None else meshes,
        "on": [roads.index(run.road) if run.road in roads else None for run in runs],
        "shown": list(shown if has_many or study else range(len(runs))),
        "most": MOST_RUNS,
        "study": values_of_map(study) if study else None,
        "feed": feed and {"address": feed.address, "page": feed.page},
        "panels": panels,
        "cones": np.reshape(list(cones), (-1, 2)).tolist(),
        "notes": [*notes, *thinned],
    }
    parts = {
        "title": html.escape(_as_text(title)),
        "generator": html.escape(f"vehicle_roll_sim {__version__}"),
        "data": _as_json(data),
        "style": _part("style.css"),
        "three": f"/*\n{_part('three/LICENSE')}*/\n{_part('three/three.min.js')}",
        "script": "".join(_part(name) for name in SCRIPTS),
    }
    parts["policy"] = _policy(parts, feed)
    return PLACE.sub(lambda place: parts[place[1]], _part("page.html"))


def write_page(path: Path, *arguments, **settings) -> None:
    """Write `page` to a file, completely or not at all."""
    text = page(*arguments, **settings)
    with replaced_file(path) as partial:
        partial.write_text(text, encoding="utf-8", newline="\n")


@functools.cache
def _part(name: str) -> str:
    place = importlib.resources.files(__package__) / "web" / name
    return place.read_text(encoding="utf-8")


def _as_text(name: str) -> str:
    """A name without the bytes that are no UTF-8, which a file name may have; `?` for each."""
    return name.encode(errors="replace").decode()


def _as_json(data: dict) -> str:
    """JSON that is safe in a script element: no text in it can end the element."""
    text = json.dumps(data, allow_nan=False, separators=(",", ":"))
    return text.replace("&", "\\u0026").replace("<", "\\u003c").replace(">", "\\u003e")


def _policy(parts: dict[str, str], feed: Feed | None) -> str:
    """Content security policy: own scripts and style only, and no request but for the feed."""

    def hashes(*names: str) -> str:
        digests = (hashlib.sha256(parts[name].encode()).digest() for name in names)
        return " ".join(f"'sha256-{base64.b64encode(each).decode()}'" for each in digests)

    connected = "; connect-src 'self'" if feed else ""
    return (
        f"default-src 'none'; script-src {hashes('three', 'script')}; "
        f"style-src {hashes('style')}; img-src data:{connected}"
    )
