"""For all tests: compiles the model; profiles of random cases; coverage of processes."""

import contextlib
import gc
import importlib.util
import os
import signal
import subprocess
from pathlib import Path

import pytest
from collecting import one_at_a_time, without_kernels
from hypothesis import settings

from vehicle_roll_sim import Simulation, preset
from vehicle_roll_sim.simulation.compilation import begin_compiling, compile_model

HAS_ROS = importlib.util.find_spec("rclpy") is not None
collect_ignore = [] if HAS_ROS else ["ros"]
MEASURING = "COVERAGE_PROCESS_CONFIG"
"""In the environment where coverage is measured; processes that are started take part by it."""
BEGUN = pytest.StashKey[subprocess.Popen | None]()
"""The process that compiles the model."""

LONGEST = (
    *("test_pages", "test_score", "test_driven_manoeuvres", "test_controllers"),
    *("test_executables", "test_signals", "test_environment", "test_paper_command"),
    *("test_speed_controller", "test_study_on_dask", "test_environment_of_nodes"),
    *("test_multibody", "test_lockstep", "test_compilation", "test_mutated_tire_files"),
    *("test_waiting_in_lockstep", "test_run_results", "test_identification", "test_stopped"),
    *("test_first_launch", "test_bags_offline_and_recorded", "test_plain_python"),
    *("test_double_lane_change", "test_vehicle_file", "test_drives", "test_compare"),
    *("test_busy_machine", "test_in_browser", "test_standard_figure", "test_tire_command"),
    *("test_install", "test_forked", "test_accepted_tire_files"),
)
"""Files of 7 to 60 s of processor time, or of waiting."""

settings.register_profile(
    "suite", derandomize=True, database=None, deadline=None, max_examples=100, print_blob=False
)
settings.register_profile(
    "soak", derandomize=False, database=None, deadline=None, max_examples=4000, print_blob=True
)
settings.load_profile("suite")


def pytest_report_header() -> str | None:
    """What is left out as a whole."""
    return None if HAS_ROS else "test/ros is left out: ROS 2 (rclpy) is not installed"


def have_children_heed_sigint() -> None:
    """Where this process was started to ignore SIGINT, as by a script that goes on (`pytest &`).

    It goes on doing so; but what is ignored is inherited, and what has a handler is not.
    """
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, lambda *_: None)


have_children_heed_sigint()


@pytest.fixture
def simulation():
    """The reference vehicle at 50 km/h, with a step of 1 ms."""
    return Simulation(preset())


@pytest.fixture
def started():
    """started(words, ...): a process (subprocess.Popen) that ends with its test at the latest."""
    processes = []

    def start(words, **options) -> subprocess.Popen:
        processes.append(subprocess.Popen(words, **options))
        return processes[-1]

    yield start
    for process in reversed(processes):
        with process:  # which closes its pipes and waits for it
            process.kill()


@pytest.fixture
def unplaced(monkeypatch):
    """Figures are drawn without finding room for their panels, half of the time that they take.

    For tests in which it matters that a figure is drawn, and not how it looks.
    """
    place = "vehicle_roll_sim.analysis.drawing.SteadyLayout.execute"
    monkeypatch.setattr(place, lambda *_: None)


@pytest.fixture(scope="session")
def study(tmp_path_factory):
    """The study of the reference vehicle; test processes that run together make its runs once."""
    from studies import Study, shared_study

    if "PYTEST_XDIST_WORKER" not in os.environ:
        yield Study(preset())  # makes the runs that are asked for
        return
    path = tmp_path_factory.getbasetemp().with_name("study")  # beside the folders of the processes
    yield shared_study(path)
    path.unlink(missing_ok=True)


@pytest.fixture(scope="session", autouse=True)
def compiled_model():
    """On a fresh machine the compilation is waited for; no test should meet that by chance."""
    compile_model()


def pytest_sessionstart(session) -> None:
    """On a fresh machine the model is compiled while the tests are collected, and unmeasured."""
    if not (is_worker(session.config) or session.config.option.collectonly):
        with pytest.MonkeyPatch.context() as patched:
            patched.delenv(MEASURING, raising=False)
            session.config.stash[BEGUN] = begin_compiling()


@pytest.hookimpl(wrapper=True)
def pytest_collection(session):
    """Workers take turns; the process that hands out the tests collects none and need not wait."""
    turn = one_at_a_time(Path(__file__)) if is_worker(session.config) else contextlib.nullcontext()
    with turn, without_kernels():
        return (yield)


def is_worker(config) -> bool:
    """Whether this is one of several test processes that run together."""
    return hasattr(config, "workerinput")


def pytest_collection_modifyitems(items) -> None:
    """Start with the files that take longest, so that no worker is left with one at the end."""
    files = list(dict.fromkeys(item.path for item in items))
    longest = sorted((f for f in files if f.stem in LONGEST), key=lambda f: LONGEST.index(f.stem))
    others = [file for file in files if file.stem not in LONGEST]
    places = {file: place for place, file in enumerate((*spread(longest), *spread(others)))}
    items.sort(key=lambda item: places[item.path])


def spread(files: list[Path]) -> list[Path]:
    """The same files; those with nodes, which mostly wait, are spread evenly among the others."""
    with_nodes = [file for file in files if file.is_relative_to(Path(__file__).with_name("ros"))]
    groups = with_nodes, [file for file in files if file not in with_nodes]
    shares = ((k / len(group), file) for group in groups for k, file in enumerate(group))
    return [file for _, file in sorted(shares)]


def pytest_collection_finish() -> None:
    """Thousands of tests stay to the end: collections of garbage need not look at them."""
    gc.collect()
    gc.freeze()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item):
    """A test that is marked as unmeasured takes no part, nor do its processes."""
    if MEASURING not in os.environ or not item.get_closest_marker("unmeasured"):
        return (yield)
    from coverage import Coverage  # not needed by those who do not measure

    measurement, how = Coverage.current(), os.environ.pop(MEASURING)
    measurement.stop()
    try:
        return (yield)
    finally:
        measurement.start()
        os.environ[MEASURING] = how
