"""Entry points of the example controllers: signal handlers are installed before large imports."""

from vehicle_roll_sim import early_signals


def active_roll_bar() -> None:
    _run("active_roll_bar")


def lqr_roll_bar() -> None:
    _run("lqr_roll_bar")


def rear_steering() -> None:
    _run("rear_steering")


def roll_braking() -> None:
    _run("roll_braking")


def rollover_mpc() -> None:
    _run("rollover_mpc")


def rollover_warning() -> None:
    _run("rollover_warning")


def stability_control() -> None:
    _run("stability_control")


def yaw_control() -> None:
    _run("yaw_control")


def _run(name: str) -> None:
    """Run the main function of a module in this folder, which ends the program."""
    early_signals.end_node_at_once()
    import importlib

    importlib.import_module(f"vehicle_roll_sim.examples.{name}").main()
