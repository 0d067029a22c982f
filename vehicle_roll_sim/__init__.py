"""Vehicle roll dynamics in real time: the 14 degree-of-freedom model of Shim and Ghike (2007)."""

_HOMES = {
    "__version__": "version",
    "Batch": "batch.batch",
    "InputError": "declaration",
    "Condition": "model.integration.events",
    **dict.fromkeys(("ControlLaw", "Sensed"), "runs.control_law"),
    **dict.fromkeys(("LF", "LR", "RF", "RR", "WHEELS"), "model.records"),
    "RollPlane": "model.roll_plane",
    "compare": "offline.comparing",
    "identify": "offline.identifying",
    "linearize": "offline.linearizing",
    "parameter": "declaration",
    "replay": "offline.replaying",
    "run": "offline.running",
    "series": "offline.series",
    "study": "offline.studying",
    **dict.fromkeys(("Command", "Feedback"), "simulation.command"),
    "Options": "simulation.options",
    "Road": "simulation.road",
    "Simulation": "simulation.simulation",
    "Vehicle": "vehicle.parameters",
    **dict.fromkeys(("PlausibilityWarning", "plausibility"), "vehicle.plausibility"),
    **dict.fromkeys(("Tire", "load_tire"), "vehicle.tire_file"),
    **dict.fromkeys(("load_vehicle", "preset"), "vehicle.vehicle_file"),
}
"""The module that defines each public name.

A module is imported on first access to its name. Importing numba takes about a second, and signal
handlers must be installed before that.
"""
__all__ = sorted(_HOMES)


def __getattr__(name: str):
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    import importlib  # a millisecond that no entry point waits for

    value = globals()[name] = getattr(importlib.import_module(f"{__name__}.{_HOMES[name]}"), name)
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
