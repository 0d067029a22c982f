"""Studies on a Dask cluster: a scheduler and workers are processes that talk over the loopback."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from patience import PATIENCE, wait_until

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.studies import cluster, folder
from vehicle_roll_sim.studies.folder import run_study
from vehicle_roll_sim.studies.source import Source
from vehicle_roll_sim.studies.study_file import study_of

dask = pytest.importorskip("dask", reason="distributed is not installed")
pytest.importorskip("distributed", reason="distributed is not installed")

EXAMPLES = Path(__file__).parents[2] / "examples"
LAW = """\
import dataclasses

from vehicle_roll_sim import ControlLaw, parameter

DIRECTION = -1.0


@dataclasses.dataclass(kw_only=True)
class Damper(ControlLaw):
    commands = ("rear_steering",)
    gain: float = parameter("angle per yaw rate", "s", 0.0, 1.0, default=0.1)

    def answer(self, sensed):
        return {"rear_steering": DIRECTION * self.gain * sensed.state["yaw_rate"]}
"""
TEXT = """\
manoeuvre: step_steer
controller: damper.py:Damper
vehicle: car.yaml
fixed: {manoeuvre.duration: 0.3}
factors:
  vehicle.cg_height: {lowest: 0.5, highest: 0.7, count: 20}
  manoeuvre.speed: [10, 20, 30]
chunk: 2
"""
"""30 chunks."""


class Cluster:
    """A scheduler, and workers that are started one by one; none has a file of the study."""

    def __init__(self, place: Path):
        self.place, self.workers = place, []
        file = place / "scheduler.json"
        words = ("--host", "127.0.0.1", "--port", "0", "--scheduler-file", file)
        self.scheduler = self._started("dask_scheduler", *words)
        wait_until(lambda: file.exists() and file.read_text(), "the scheduler")
        self.address = json.loads(file.read_text())["address"]

    def _started(self, program: str, *words, path: str = "") -> subprocess.Popen:
        nothing = subprocess.DEVNULL
        return subprocess.Popen(
            [sys.executable, "-m", f"distributed.cli.{program}", *words, "--no-dashboard"],
            cwd=self.place,
            env=os.environ
            | {"DASK_TEMPORARY_DIRECTORY": str(self.place)}
            | ({"PYTHONPATH": path} if path else {}),
            stdout=nothing,
            stderr=nothing,
        )

    def add_worker(self, path: str = "") -> None:
        words = (self.address, "--nthreads", "1", "--no-nanny", "--host", "127.0.0.1")
        self.workers.append(self._started("dask_worker", *words, path=path))

    def lose(self, process: subprocess.Popen) -> None:
        process.kill()
        process.wait(PATIENCE)


@pytest.fixture(scope="module")
def scheduler(tmp_path_factory):
    """A cluster that has no worker yet."""
    with dask.config.set({"distributed.comm.timeouts.connect": "2s"}):
        started = Cluster(tmp_path_factory.mktemp("dask"))
        yield started
        for process in (*started.workers, started.scheduler):
            started.lose(process)


@pytest.fixture(scope="module")
def dask_cluster(scheduler):
    scheduler.add_worker()
    scheduler.add_worker()
    return scheduler


@pytest.fixture
def study(tmp_path, monkeypatch):
    """A study whose vehicle and tire files, and code of the user's own, no longer exist."""
    monkeypatch.setattr(folder, "draw", lambda results, path: [])
    place = tmp_path / "files"
    place.mkdir()
    for name in ("car.yaml", "tire.tir"):
        shutil.copy(EXAMPLES / name, place)
    (place / "study.yaml").write_text(TEXT)
    (place / "damper.py").write_text(LAW)
    found = study_of(Source.of_file(place / "study.yaml"))
    shutil.rmtree(place)
    return found


def on(started: Cluster, study, path: Path, progress=lambda runs, kept: None) -> None:
    with cluster.computing(started.address, "dask") as compute:
        run_study(study, path, "csv", progress=progress, compute=compute)


def content(path: Path) -> dict[str, bytes]:
    return {str(p.relative_to(path)): p.read_bytes() for p in path.rglob("*") if p.is_file()}


def test_a_worker_without_this_package_is_refused(study, tmp_path, scheduler):
    """The first that there is; later ones have the package."""
    (tmp_path / "vehicle_roll_sim.py").touch()
    scheduler.add_worker(path=str(tmp_path))
    with pytest.raises(InputError, match="a worker cannot compute a chunk: ModuleNotFoundError"):
        on(scheduler, study, tmp_path / "out")
    scheduler.lose(scheduler.workers.pop())


def test_workers_lost_and_added_and_an_interruption_leave_the_bytes_of_one_machine(
    study, tmp_path, dask_cluster
):
    run_study(study, tmp_path / "alone", "csv")
    done = []

    def progress(runs, kept):
        done.append((runs, kept))
        if len(done) == 3:
            dask_cluster.lose(dask_cluster.workers[0])
            dask_cluster.add_worker()
        if len(done) == 12:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        on(dask_cluster, study, tmp_path / "many", progress)
    kept = len(list((tmp_path / "many" / "chunks").iterdir()))
    assert 12 <= kept < 30
    on(dask_cluster, study, tmp_path / "many", progress)
    assert done[12:] == [(2, True)] * kept + [(2, False)] * (30 - kept)
    assert content(tmp_path / "many") == content(tmp_path / "alone")


def test_a_worker_that_differs_is_refused_before_it_computes(
    study, tmp_path, dask_cluster, monkeypatch
):
    other = cluster.fingerprint() | {"numpy": "0.1"}
    monkeypatch.setattr(cluster, "fingerprint", lambda: other)
    with pytest.raises(InputError, match=r"dask: worker tcp:.* has numpy .*, this process 0.1: "):
        on(dask_cluster, study, tmp_path / "out")
    assert not list((tmp_path / "out" / "chunks").iterdir())


def test_a_chunk_whose_workers_are_always_lost_ends_the_study(
    study, tmp_path, dask_cluster, monkeypatch
):
    monkeypatch.setattr(cluster, "_results", lambda future, field: None)
    with pytest.raises(InputError, match=r"dask: chunk \d+ was given up 6 times, its workers"):
        on(dask_cluster, study, tmp_path / "out")


def test_without_a_scheduler_any_more_the_study_ends(study, tmp_path, dask_cluster):
    def progress(runs, kept):
        dask_cluster.lose(dask_cluster.scheduler)

    with pytest.raises(ConnectionError, match="the connection to the Dask scheduler was lost"):
        on(dask_cluster, study, tmp_path / "out", progress)
