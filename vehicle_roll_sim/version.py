"""The version of this package, as whoever installed it noted it down."""

import importlib.metadata


def _installed_version() -> str:
    try:
        return importlib.metadata.version("vehicle_roll_sim")
    except importlib.metadata.PackageNotFoundError:  # a source tree that is not installed
        return "unknown"


__version__ = _installed_version()
