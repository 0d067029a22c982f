"""Probability of a rollover by subset simulation, compared with brute force.

Three minutes of processor time: `python benchmarks/rare_rollover.py`. Ends with status 1 if a 95 %
interval of subset simulation does not overlap that of brute force.
"""

import sys
import tempfile
import warnings
from pathlib import Path

import numpy as np

from vehicle_roll_sim import study
from vehicle_roll_sim.studies.statistics import probability
from vehicle_roll_sim.vehicle.plausibility import PlausibilityWarning

OVER = 1.48
"""rad: a roll angle from which no vehicle comes back."""
STUDY = {
    "manoeuvre": "j_turn",
    "fixed": {"manoeuvre.duration": 3.5, "manoeuvre.start": 0.2},
    "factors": {
        "manoeuvre.speed": {"distribution": "normal", "mean": 13.0, "sd": 0.5},
        "vehicle.cg_height": {"distribution": "normal", "mean": 0.725, "sd": 0.02},
        "tire.LMUY": {"distribution": "normal", "mean": 1.0, "sd": 0.05},
    },
    "step": 0.0025,
    "events": {"over": {"metric": "peak_roll", "above": OVER}},
}
SEEDS, LEVEL_RUNS = (1, 2, 3), 1000
BRUTE_FORCE = {"seed": 99, "design": "random", "runs": 10_000, "chunk": 1000}


def main() -> int:
    warnings.simplefilter("ignore", PlausibilityWarning)
    with tempfile.TemporaryDirectory() as folder:
        agrees = compare(Path(folder))
    return 0 if agrees else 1


def compare(folder: Path) -> bool:
    """Print the estimates; returns whether all intervals overlap that of brute force."""
    drawn = study({**STUDY, **BRUTE_FORCE}, folder / "brute_force", format="csv")
    happened = np.abs(drawn["peak_roll"]) >= OVER
    by_force = probability(int(happened.sum()), len(happened))
    low, high = by_force.low, by_force.high
    print(f"brute force: {by_force.value:.4f} ({low:.4f} to {high:.4f}), {len(happened)} runs")
    agrees = True
    for seed in SEEDS:
        rare = {"event": "over", "level_runs": LEVEL_RUNS}
        given = {**STUDY, "seed": seed, "rare": rare}
        found = study(given, folder / f"subset_{seed}", format="csv").estimate
        least, most = found.interval
        print(f"subset: {found.probability:.4f} ({least:.4f} to {most:.4f}), {found.runs} runs")
        agrees = agrees and least <= high and low <= most
    return agrees


if __name__ == "__main__":
    sys.exit(main())
