"""Whether intervals of identified values are honest: `python -m benchmarks.identification PAGE`.

Vehicles with hidden values are driven on two manoeuvres, in one of which wheels lift off. Their
logs get noise, bias, delay and an offset of the steering. Everything is identified, from the values
of the reference vehicle on, and the intervals of 95 % are counted that contain the hidden values.

With --keep, a run that was interrupted goes on where it was: each result is a line of the file.
"""

import argparse
import concurrent.futures
import json
import multiprocessing
import os
import sys
from pathlib import Path

import numpy as np

from benchmarks.coverage import table, text_on_fits
from benchmarks.hidden_vehicles import RUN_UP, STEP, UNSEEN, Faults, log_of_run
from vehicle_roll_sim import InputError, Options, Simulation, preset
from vehicle_roll_sim.comparison.comparison import compare
from vehicle_roll_sim.comparison.corridor import Tolerances
from vehicle_roll_sim.comparison.driving import TORQUES_APPLIED, Driving
from vehicle_roll_sim.identification.estimate import Estimate, estimated
from vehicle_roll_sim.identification.free import applied, free_of
from vehicle_roll_sim.identification.problem import Problem

SEED = 20261129
COUNT = 200
MARK = "<!-- measured by make identification -->\n"
HIDDEN = {
    "cg_height": (0.75, 0.05),
    "roll_inertia": (900.0, 0.1),
    "yaw_inertia": (2000.0, 0.1),
    "spring_stiffness": (1.0, 0.1),
    "damping": (1.0, 0.15),
    "tire.LKY": (1.0, 0.08),
}
"""Middle of the hidden values, and the largest relative difference from it."""
BIASES = {
    "yaw_rate": 0.004,
    "roll_rate": 0.004,
    "roll": 0.003,
    "lateral_acceleration": 0.1,
}
"""Standard deviation of the bias of each sensor (SI units)."""
LATEST = 0.03
"""s: largest delay of the yaw rate."""
OFFSET = 0.03
"""rad: standard deviation of the offset of the handwheel."""
ABOUT_MODELS = """\
The last two columns are medians of the half widths: over that of white residuals, and as they are.
Verdicts of `compare` on the logs of vehicle 0, for its own values and after c.g. height, inertias,
springs, damping and cornering stiffness were fitted with the model of the row:"""
MODELS = {
    "that of the logs": Options(),
    "8 DOF": Options(model="8dof"),
    "without roll centre": Options(no_roll_centre=True),
}
MANOEUVRES = ("ramp_and_sine", "fishhook")


def hidden(number: int) -> dict[str, float]:
    """The values of a hidden vehicle and its sensors, by name."""
    draw = np.random.default_rng((SEED, number))
    values = {
        name: middle * (1.0 + draw.uniform(-spread, spread))
        for name, (middle, spread) in HIDDEN.items()
    }
    values["steering_offset"] = draw.normal(0.0, OFFSET)
    values |= {f"{name}_bias": draw.normal(0.0, each) for name, each in BIASES.items()}
    values["yaw_rate_delay"] = draw.uniform(0.0, LATEST)
    return values


def problem_of(number: int, names: list[str] | None = None) -> Problem:
    """The logs of a hidden vehicle, and what is to be found in them, with the noise of its seed."""
    truth = hidden(number)
    vehicle, _ = applied(preset(), {name: truth[name] for name in HIDDEN})
    biases = {name: truth[f"{name}_bias"] for name in BIASES}
    delays = {"yaw_rate": truth["yaw_rate_delay"]}
    faults = Faults(1.0, biases, delays, truth["steering_offset"])
    logs = [
        log_of_run(vehicle, manoeuvre, faults, seed=(SEED, number, i), unseen=UNSEEN)
        for i, manoeuvre in enumerate(MANOEUVRES)
    ]
    simulation = Simulation(preset(), step=STEP)
    free = free_of(names or list(truth), preset(), logs[0].compared)
    driving = Driving(drive_by=TORQUES_APPLIED, run_up=RUN_UP)
    return Problem(logs, simulation, free, driving, {}, workers=1)


def found(number: int) -> dict | None:
    """What is found in the logs of a hidden vehicle; None if the fit failed.

    rows: of `rows_of`. beside: of the estimate. doubt: whether the report says that the fit may not
    have found the best values.
    """
    try:
        estimate = estimated(problem_of(number))
    except InputError:
        return None
    doubt = estimate.is_beside or not estimate.is_converged
    return {"rows": rows_of(estimate, hidden(number)), "beside": estimate.beside, "doubt": doubt}


def rows_of(
    estimate: Estimate, truth: dict[str, float]
) -> dict[str, tuple[float, float, float, float]]:
    """By name: hidden and identified value, and both half widths."""
    uncertainty = estimate.uncertainty
    white = np.sqrt(np.diag(uncertainty.naive)) * estimate.problem.scales
    factor, errors = uncertainty.quantile, estimate.errors
    return {
        each.name: (
            truth[each.name],
            estimate.values[each.name],
            factor * errors[each.name],
            factor * float(white[j]),
        )
        for j, each in enumerate(estimate.free)
    }


def wrong_models() -> list[list[str]]:
    """Rows of a table: models that are not that of the logs, with the hidden values and fitted.

    A cell has the verdict of `compare` on the turn and on the manoeuvre in which wheels lift off.
    """
    truth = hidden(0)
    vehicle = applied(preset(), {name: truth[name] for name in HIDDEN})[0]
    logs = [log_of_run(vehicle, each, Faults(1.0), seed=i) for i, each in enumerate(MANOEUVRES)]
    driving = Driving(drive_by=TORQUES_APPLIED, run_up=RUN_UP)
    rows = []
    for label, options in MODELS.items():
        model = Simulation(preset(), options, step=STEP)
        free = free_of(list(HIDDEN), preset(), logs[0].compared)
        problem = Problem(logs, model, free, driving, {}, workers=1)
        fitted = applied(preset(), estimated(problem).values)[0]
        cells = [
            compare(log, problem.like(each), driving, Tolerances()).accepted
            for each in (vehicle, fitted)
            for log in logs
        ]
        rows.append([label, *("accepted" if cell else "**rejected**" for cell in cells)])
    return rows


def table_of_models() -> str:
    """The table of wrong models in Markdown."""
    head = ["model", "turn", "lift-off", "turn, fitted", "lift-off, fitted"]
    rows = [head, ["---"] * len(head), *wrong_models()]
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


def replaced(text: str, measured: str) -> str:
    """The page with what is measured below the mark; exits if there is no mark."""
    before, mark, rest = text.partition(MARK)
    if not mark:
        raise SystemExit("identification: error: no mark to write below")
    end = "<!-- end -->"
    return before + mark + measured + "\n\n" + end + rest.partition(end)[2]


def found_of(count: int, processes: int, keep: Path | None) -> list[dict | None]:
    """What is found in the logs of the first vehicles, in their order.

    keep: a file that gets each result as a line once it is known; those that it has already are not
    computed again.
    """
    known = {}
    if keep and keep.exists():
        known = dict(json.loads(text) for text in keep.read_text(encoding="utf-8").splitlines())
        if any(each is not None and "rows" not in each for each in known.values()):
            raise SystemExit(f"identification: error: {keep}: results of an earlier version")
    missing = [number for number in range(count) if number not in known]
    context = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(processes, context) as pool:
        jobs = {pool.submit(found, number): number for number in missing}
        try:
            for done in concurrent.futures.as_completed(jobs):
                known[jobs[done]] = done.result()
                if keep:
                    with keep.open("a", encoding="utf-8") as file:
                        file.write(json.dumps([jobs[done], done.result()]) + "\n")
        finally:
            pool.shutdown(cancel_futures=True)
    return [known[number] for number in range(count)]


def main(words: list[str]) -> None:
    parser = argparse.ArgumentParser(prog="identification", description=__doc__)
    parser.add_argument("page", nargs="?", help="page whose table is replaced")
    parser.add_argument("--count", type=int, default=COUNT, help="number of hidden vehicles")
    parser.add_argument("--processes", type=int, default=os.cpu_count())
    about = "file of results: those in it are not computed again"
    parser.add_argument("--keep", type=Path, metavar="FILE", help=about)
    arguments = parser.parse_args(words)
    results = found_of(arguments.count, arguments.processes, arguments.keep)
    text = (
        f"{len(results)} hidden vehicles, seeds ({SEED}, 0) to ({SEED}, {len(results) - 1}):\n\n"
        f"{table(results, HIDDEN)}\n\n{text_on_fits(results)}\n\n"
        f"{ABOUT_MODELS}\n\n{table_of_models()}"
    )
    print(text)
    if arguments.page:
        page = Path(arguments.page)
        page.write_text(replaced(page.read_text(encoding="utf-8"), text), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
