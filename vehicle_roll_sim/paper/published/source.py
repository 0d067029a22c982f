"""Sources and what they say: the files of `data/`, one per source."""

import dataclasses
import functools
from importlib.resources import as_file, files
from pathlib import Path
from typing import NamedTuple

from vehicle_roll_sim.files.yaml_file import read_mapping
from vehicle_roll_sim.paper.published.vehicles import vehicle_of
from vehicle_roll_sim.vehicle.parameters import Vehicle

DATA = files("vehicle_roll_sim.paper.published") / "data"
FILES = ("nhtsa_2004", "tse_2019", "althoff_2020")
CONDITIONS = ("speed", "steering")
"""Keys of an entry that are passed on to its rerun (m/s, rad)."""


class Source(NamedTuple):
    """Where numbers were published, and which copy of it was read."""

    authors: str
    title: str
    year: int
    read_in: str

    def __str__(self) -> str:
        return f"{self.authors} ({self.year}): {self.title}. {self.where}"

    @property
    def where(self) -> str:
        """The copy, as a sentence."""
        return f"Read in {self.read_in}."


@dataclasses.dataclass(frozen=True)
class Number:
    """A published value of one vehicle, in `unit`; place: where in the source it is.

    rerun: name of the function that computes it (`reruns.RERUNS`), with these conditions.
    tolerance: in `unit`; None if the difference is not judged. because: the reason for either.
    """

    source: Source
    place: str
    name: str
    vehicle: Vehicle
    quantity: str
    unit: str
    published: float
    rerun: str
    conditions: dict[str, float]
    tolerance: float | None
    because: str


@functools.cache
def numbers() -> tuple[Number, ...]:
    """All published numbers, in the order of the files."""
    with as_file(DATA) as folder:
        return tuple(number for name in FILES for number in read(folder / f"{name}.yaml"))


def read(path: Path) -> list[Number]:
    """The numbers of one file of `data/`.

    Raises InputError for values that no vehicle has, KeyError for a name that is not in the file.
    """
    text, _ = read_mapping(path, "published numbers", "a source, vehicles and numbers")
    source, columns = Source(**text["source"]), text.get("columns", {})
    rows = {
        name: row if isinstance(row, dict) else dict(zip(columns, row, strict=True))
        for name, row in text["vehicles"].items()
    }
    found = []
    for entry in text["numbers"]:
        conditions = {key: entry[key] for key in CONDITIONS if key in entry}
        for name, published in _published(entry, rows).items():
            remark = entry.get("not_judged", {}).get(name)
            found.append(
                Number(
                    source=source,
                    place=entry["place"],
                    name=name,
                    vehicle=vehicle_of(rows[name] | entry.get("values", {}), columns, text),
                    quantity=entry["quantity"],
                    unit=entry["unit"],
                    published=published,
                    rerun=entry["rerun"],
                    conditions=conditions,
                    tolerance=None if remark else entry.get("tolerance"),
                    because=remark or entry["because"],
                )
            )
    return found


def _published(entry: dict, rows: dict[str, dict]) -> dict[str, float]:
    """Published values by vehicle: as given, or from the column that is named."""
    values = entry["published"]
    if isinstance(values, dict):
        return values
    return {name: rows[name][values] for name in entry.get("vehicles", rows)}
