"""Puts the page together from its parts in `web/`; the result needs no other file."""

import base64
import functools
import hashlib
import html
import importlib.resources
import json
import re
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from vehicle_roll_sim.files.output_file import replaced_file
from vehicle_roll_sim.version import __version__
from vehicle_roll_sim.viewer.decimation import MOST_ROWS
from vehicle_roll_sim.viewer.recording import ViewedRun, panels_of, recording
from vehicle_roll_sim.viewer.study_map import StudyMap, told_map

MOST_RUNS = 4
"""As many as the page has colours."""
ROWS_OF_MANY = 600
"""As MOST_ROWS, of each run of a page that has more than MOST_RUNS."""
SCRIPTS = (
    *("recording.js", "body.js", "vehicle.js", "ground.js", "scene.js"),
    *("plots.js", "playback.js", "readings.js", "map.js", "choice.js", "controls.js", "main.js"),
)
"""In the order in which they use one another."""
PLACE = re.compile(r"\{\{(\w+)\}\}")
THINNED = "Long runs are thinned: peaks, lift-offs and events are kept."


def page(
    runs: Sequence[ViewedRun],
    title: str,
    cones: Iterable = (),
    notes: Iterable[str] = (),
    shown: Sequence[int] = (0,),
    study: StudyMap | None = None,
) -> str:
    """The HTML text of a page that shows at most MOST_RUNS runs over one another.

    cones: points (n, 2) on the ground (m). notes: sentences at the foot of the page. Of more
    than MOST_RUNS, the reader chooses which to show; shown: places of those shown at first.
    study: the map of the study that has the runs; it opens them one by one.
    """
    panels, signals = panels_of(runs)
    has_many = len(runs) > MOST_RUNS
    told = [recording(run, signals, ROWS_OF_MANY if has_many else MOST_ROWS) for run in runs]
    thinned = [THINNED] if any(each["is_thinned"] for each in told) else []
    data = {
        "runs": told,
        "shown": list(shown if has_many or study else range(len(runs))),
        "most": MOST_RUNS,
        "study": told_map(study) if study else None,
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
    parts["policy"] = _policy(parts)
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


def _policy(parts: dict[str, str]) -> str:
    """Content security policy: only the page's own scripts and style, and no request at all."""

    def hashes(*names: str) -> str:
        digests = (hashlib.sha256(parts[name].encode()).digest() for name in names)
        return " ".join(f"'sha256-{base64.b64encode(each).decode()}'" for each in digests)

    return (
        f"default-src 'none'; script-src {hashes('three', 'script')}; "
        f"style-src {hashes('style')}; img-src data:"
    )
