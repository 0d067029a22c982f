"""The version of this package, from the metadata of its installation."""

import importlib.metadata


def _installed_version() -> str:
    try:
        return importlib.metadata.version("vehicle_roll_sim")
    except importlib.metadata.PackageNotFoundError:  # imported from a source tree, not installed
        return "unknown"


__version__ = _installed_version()
