"""Tire files to be changed at will."""

from pathlib import Path

from vehicle_files import edited

BASE = (Path(__file__).parent / "files" / "base.tir").read_text(encoding="utf-8")
"""A file of 5.2 with all that is required and little more."""
TO_6_1 = {
    "PROPERTY_FILE_FORMAT": "FITTYP = 61",
    "PKY1": "PKY1 = -18\nPKY4 = 1.7\nPKY6 = -0.9\nPPY1 = 0.4\nPPY2 = 0.9",
    "PKX1": "PKX1 = 21\nPPX1 = -0.3",
    "VERTICAL_STIFFNESS": "VERTICAL_STIFFNESS = 190000\nQ_FZ2 = 15\nQ_V1 = 0.0007",
    "UNLOADED_RADIUS": "UNLOADED_RADIUS = 0.3\nINFLPRES = 220000\nNOMPRES = 200000",
}


def changed(lines: dict[str, str], text: str = BASE) -> str:
    """The file with the lines of some keys replaced; an empty line drops a key."""
    for key, line in lines.items():
        text = edited(text, key, line)
    return text


BASE_6_1 = changed(TO_6_1)
"""A file of 6.1 made of it."""
