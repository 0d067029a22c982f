"""Runs per second of a batch of fishhooks, on one processor and on two, and of single runs."""

import dataclasses
import math
import multiprocessing
import resource
import time

from benchmarks.report import MILLI
from vehicle_roll_sim import Vehicle, preset, run
from vehicle_roll_sim.batch.case import Case
from vehicle_roll_sim.batch.evaluate import outcomes
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD

TITLE = "Batches"
ABOUT = (
    "NHTSA's fishhook of 10 s, driven to its end by vehicles that differ in their mass. Single "
    "runs: `run` in a loop; batch: `outcomes` without histories. Own angle: the handwheel angle at "
    "0.3 g is found for each vehicle, by two more runs; otherwise it is given. Efficiency: runs "
    "per second with two threads over twice those with one. Memory: peak of the process, which "
    "does nothing else."
)
COLUMNS = {
    "what": "",
    "step_ms": "step (ms)",
    "runs": "runs",
    "runs_per_s": "runs per second",
    "of_single": "over single runs",
    "efficiency": "efficiency",
    "ten_thousand_s": "10 000 runs in (s)",
    "memory_mib": "memory (MiB)",
}
RUNS, QUICK = 400, 60
"""Runs of a batch; of the slower kinds a tenth."""
HANDWHEEL = 20.0
"""deg, close to the handwheel angle at 0.3 g of these vehicles."""
CENTRE, LIGHTEST, HEAVIER = {"cg_height": 0.55}, 1300.0, 0.1
"""A vehicle that the fishhook does not tip; and its mass, growing from run to run (kg)."""
STEPS_MS = (1.0, 2.5, 5.0)
KINDS = {"single runs": 0, "batch, one thread": 1, "batch, two threads": 2}
"""Number of threads; 0 for single runs."""


def measure(quick: bool) -> list[dict]:
    """Rows of the table."""
    runs = QUICK if quick else RUNS
    rows = []
    for step_ms in STEPS_MS:
        rates = {}
        for kind, workers in KINDS.items():
            count = runs if workers else runs // 10
            rates[workers], memory = _in_a_process(workers, step_ms, count, HANDWHEEL)
            rows.append(_row(kind, step_ms, count, workers, rates, memory))
    own, memory = _in_a_process(2, STEPS_MS[-1], runs // 10, 0.0)
    rates = {0: math.nan, 1: math.nan, 2: own}
    rows.append(_row("own angle, two threads", STEPS_MS[-1], runs // 10, 2, rates, memory))
    return rows


def _row(
    kind: str, step_ms: float, runs: int, workers: int, rates: dict[int, float], memory: float
) -> dict:
    return {
        "what": kind,
        "step_ms": step_ms,
        "runs": runs,
        "runs_per_s": rates[workers],
        "of_single": rates[workers] / rates[0],
        "efficiency": rates[2] / (2 * rates[1]) if workers == 2 else math.nan,
        "ten_thousand_s": 10_000 / rates[workers],
        "memory_mib": memory,
    }


def _in_a_process(*arguments) -> tuple[float, float]:
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        return pool.apply(driven, arguments)


def driven(workers: int, step_ms: float, runs: int, handwheel: float) -> tuple[float, float]:
    """Runs per second, and the peak of memory (MiB); handwheel: its angle at 0.3 g (deg) or 0."""
    fishhook = dataclasses.replace(STANDARD["nhtsa_fishhook"], steering_at_03g=handwheel)
    step, low = step_ms / MILLI, preset().with_values(CENTRE)
    vehicles = [_heavier(low, i) for i in range(runs + 1)]
    cases = [Case(vehicle=each, manoeuvre=fishhook, step=step) for each in vehicles]
    next(outcomes(cases, workers=1))
    begun = time.perf_counter()
    if workers:
        ends = [each.metrics["end_time"] for each in outcomes(cases[1:], workers=workers)]
    else:
        ends = [run(fishhook, each, step=step).time for each in vehicles[1:]]
    took = time.perf_counter() - begun
    if {*ends} != {fishhook.duration}:
        raise RuntimeError("a fishhook has not been driven to its end")
    return runs / took, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def _heavier(vehicle: Vehicle, i: int) -> Vehicle:
    return vehicle.with_values({"sprung_mass": LIGHTEST + HEAVIER * i})
