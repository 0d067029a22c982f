"""The chunks of a study on the workers of a running Dask cluster.

A chunk carries the study with the contents of its vehicle and tire files, and the user's own code,
so a worker reads no files. It checks that its program, libraries and arithmetic are those of the
process that sent it.
"""

import asyncio
import contextlib
import dataclasses
import functools
import itertools
import logging
import pickle
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.input_errors import shown
from vehicle_roll_sim.studies.chunks import Chunk, Compute, one_by_one, results_at
from vehicle_roll_sim.studies.fingerprint import fingerprint
from vehicle_roll_sim.studies.own_code import pickled
from vehicle_roll_sim.studies.study import Study
from vehicle_roll_sim.vehicle.plausibility import unwarned

PATIENCE = 10.0
"""s to wait for an answer of the scheduler."""
AHEAD = 2
"""Chunks sent for each thread of the workers: one is computed while the next one waits."""
MOST_LOSSES = 5
"""How often the scheduler may give up a chunk, each time after losing some workers with it."""
LOGS = ("distributed", "distributed.client")
LOST = "the connection to the Dask scheduler was lost; completed chunks are kept"
WANTED = "the address of a running Dask scheduler, such as tcp://192.168.0.1:8786"
ALIKE = "workers with the same installation as this process, on the same kind of processor"


@dataclasses.dataclass
class _Job:
    """A chunk that was sent. call: a _Call, pickled. losses: number of times it was given up."""

    number: int
    call: bytes
    losses: int = 0


@dataclasses.dataclass
class _Call:
    """A function call that `pickle.loads` makes when it reads this.

    A worker without this package can thus report that it is missing; Dask itself ends workers that
    cannot read a task. The scheduler does not need the package.
    """

    function: Callable
    arguments: tuple

    def __reduce__(self):
        return self.function, self.arguments


@contextlib.contextmanager
def computing(address: str | None, field: str) -> Iterator[Compute]:
    """Yields a function that computes chunks on the workers of the Dask scheduler at an address.

    None: on this machine, without Dask. field: names the address in messages. Raises InputError
    without a scheduler there, without the Python package distributed, and for workers that differ;
    ConnectionError if the scheduler is lost.
    """
    if address is None:
        yield one_by_one
        return
    if not isinstance(address, str):
        raise InputError(field, address, WANTED)
    check_distributed(field)
    import distributed  # optional, and takes a second

    full = address if "://" in address else f"tcp://{address}"
    _check_scheduler(full, address, field)
    with (
        _without_log(),
        _closed(distributed.Client(full, set_as_default=False)) as client,
        client.as_current(),
    ):
        yield functools.partial(_computed, client, field)


def check_distributed(field: str) -> None:
    """Raise InputError naming `field` unless Dask is installed."""
    try:
        import distributed  # noqa: F401
    except ImportError:
        allowed = "pip install distributed, or vehicle_roll_sim[cluster]"
        raise InputError(field, "", allowed, "no Python package distributed") from None


def _check_scheduler(full: str, address: str, field: str) -> None:
    """Raise InputError unless a scheduler answers; a Client would wait for it forever."""
    from distributed.comm import connect
    from distributed.security import Security

    async def answer() -> None:
        secured = Security().get_connection_args("client")
        comm = await asyncio.wait_for(connect(full, timeout=2 * PATIENCE, **secured), PATIENCE)
        comm.abort()

    try:
        with ThreadPoolExecutor(1) as pool:  # this thread may have an event loop of its own
            pool.submit(asyncio.run, answer()).result()
    except TimeoutError:
        problem = f"{shown(address)}: no answer within {PATIENCE:g} s"
        raise InputError(field, address, WANTED, problem) from None
    except (OSError, ValueError, TypeError, RuntimeError, ImportError) as error:  # from Dask
        raise InputError(field, address, WANTED, f"{shown(address)}: {error}") from None


@contextlib.contextmanager
def _closed(client) -> Iterator:
    """Close a client at the end. Its results are here by then, or the scheduler is lost, which an
    error of closing must not hide: Dask stops timers that may just be expiring."""
    try:
        yield client
    finally:
        with contextlib.suppress(RuntimeError):
            client.close()


@contextlib.contextmanager
def _without_log() -> Iterator[None]:
    """Keep Dask from writing to stderr what is reported as an error here."""
    logs = [logging.getLogger(name) for name in LOGS]
    levels = [log.level for log in logs]
    for log in logs:
        log.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        for log, level in zip(logs, levels, strict=True):
            log.setLevel(level)


def _computed(
    client, field: str, study: Study, chunks: Iterable[Chunk]
) -> Iterator[tuple[int, list[list]]]:
    """Compute chunks on the workers; yields the number and the results of each as it is done."""
    import distributed

    expected, waiting, running = fingerprint(), iter(chunks), {}
    done = distributed.as_completed()

    def submit(job: _Job) -> None:
        future = client.submit(pickle.loads, job.call, pure=False)
        running[future] = job
        done.add(future)

    while True:
        for number, points in itertools.islice(waiting, _room(client, len(running))):
            packed = pickled((study, points), (study.manoeuvre, study.controller))
            call = _Call(on_worker, (expected, packed))
            submit(_Job(number, pickle.dumps(call)))
        if not running:
            return
        future = next(done)
        job = running.pop(future)
        if client.status != "running":
            raise ConnectionError(LOST)
        results = _results(future, field)
        if results is not None:
            yield job.number, results
            continue
        job.losses += 1
        if job.losses > MOST_LOSSES:
            problem = f"chunk {job.number} was given up {job.losses} times, its workers were lost"
            raise InputError(field, "", "workers that have enough memory", problem)
        submit(job)


def _room(client, running: int) -> int:
    """Number of further chunks to send: workers come and go."""
    try:
        threads = sum(client.nthreads().values())
    except OSError:
        raise ConnectionError(LOST) from None
    return max(0, max(1, AHEAD * threads) - running)


def _results(future, field: str) -> list[list] | None:
    """The results of a chunk; None if its workers were lost. Raises InputError."""
    from distributed import KilledWorker

    if future.cancelled() or isinstance(future.exception(), KilledWorker):
        return None
    error = future.exception()
    if error is not None:
        problem = f"a worker cannot compute a chunk: {type(error).__name__}: {error}"
        raise InputError(field, "", ALIKE, " ".join(problem.split()))
    found = future.result()
    if isinstance(found, tuple):
        name, here, there, worker = found
        problem = f"worker {worker} has {name} {there}, this process {here}"
        raise InputError(field, "", ALIKE, problem)
    return found


def on_worker(expected: dict[str, str], packed: bytes) -> list[list] | tuple[str, ...]:
    """The results of a chunk.

    If this worker differs: in what, the expected value, its own value, and its address.
    """
    from distributed import get_worker

    found = fingerprint()
    for name, value in expected.items():
        if found.get(name) != value:
            return name, value, str(found.get(name)), get_worker().address
    with unwarned():  # values are drawn, not typed
        return results_at(*pickle.loads(packed), workers=1)
