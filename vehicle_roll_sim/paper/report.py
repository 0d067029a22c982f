"""The findings, as text and as Markdown."""

import textwrap

import numpy as np

from vehicle_roll_sim.model.roll_plane import RollPlane
from vehicle_roll_sim.paper import assumptions, simplified_models
from vehicle_roll_sim.paper.claim import FAILS, HOLDS, NOT_CHECKED, Finding
from vehicle_roll_sim.paper.layout import columns, table
from vehicle_roll_sim.paper.responses import HEADER as RESPONSES
from vehicle_roll_sim.paper.responses import response_rows
from vehicle_roll_sim.paper.study import Study
from vehicle_roll_sim.vehicle.derived_values import GRAVITY

CLAIMS = (*simplified_models.CLAIMS, *assumptions.CLAIMS)
HEADER = ("#", "section, figures", "claim of the paper", "measured (criterion)", "")
THRESHOLDS = ("first lift-off", "lateral acceleration (g)")
WIDTH = 100
"""Line width of the text report (characters)."""
MARGIN = " " * 5
NO_ENGINE = "the multibody engine is not installed: pip install mujoco"


def check_claims(study: Study) -> list[Finding]:
    """Check every claim of the paper against the runs of `study`."""
    return [claim.check(study) for claim in CLAIMS]


def as_text(findings: list[Finding]) -> str:
    """The findings as text: claim and verdict in one line, the measurements below it."""
    lines = []
    for finding in findings:
        claim = finding.claim
        head = f"{claim.number:>3}  {finding.verdict:{len(NOT_CHECKED)}}  {claim.text}"
        lines.append(f"{head} [{claim.place}]")
        numbers = _measured(finding)
        lines += textwrap.wrap(numbers, WIDTH, initial_indent=MARGIN, subsequent_indent=MARGIN)
    return "\n".join([*lines, "", tally(findings)])


def as_markdown(findings: list[Finding]) -> str:
    """The findings as a Markdown table, one claim per row."""
    rows = [
        (
            str(finding.claim.number),
            finding.claim.place,
            finding.claim.text,
            _measured(finding),
            finding.verdict if finding.verdict == HOLDS else f"**{finding.verdict}**",
        )
        for finding in findings
    ]
    return table(HEADER, rows)


def tally(findings: list[Finding]) -> str:
    """How many claims hold, fail and were not checked, in one line."""
    verdicts = [finding.verdict for finding in findings]
    hold, fail, unchecked = (verdicts.count(v) for v in (HOLDS, FAILS, NOT_CHECKED))
    return f"{len(findings)} claims: {hold} hold, {fail} fail, {unchecked} not checked"


def _measured(finding: Finding) -> str:
    if finding.verdict == NOT_CHECKED:
        return NO_ENGINE
    return "; ".join(map(str, finding.measured))


def lift_off_thresholds(study: Study) -> dict[str, float]:
    """Lateral acceleration (g) at first lift-off: predicted by simpler models, and of model 1."""
    rigid, suspended = (RollPlane(study.vehicle.record(), s) for s in (False, True))
    thresholds = {
        "rigid roll plane (static stability factor)": rigid.lift_off_threshold / GRAVITY,
        "suspended roll plane": suspended.lift_off_threshold / GRAVITY,
    }
    for case in ("8dof", "1"):
        response = study.ramp(case)
        acceleration = response.history["lateral_acceleration"]
        at_lift_off = np.interp(response.first_lift_off, response.time, acceleration)
        thresholds[f"model {case}, ramp steer"] = float(at_lift_off / GRAVITY)
    return thresholds


def numbers_as_text(study: Study) -> str:
    """The responses of all models and the lift-off thresholds, as text in columns."""
    responses, thresholds = _numbers(study)
    return "\n".join([*columns(*responses), "", *columns(*thresholds)])


def numbers_as_markdown(study: Study) -> str:
    """The responses of all models and the lift-off thresholds, as Markdown tables."""
    responses, thresholds = _numbers(study)
    return f"{table(*responses)}\n\n{table(*thresholds)}"


def _numbers(study: Study) -> tuple[tuple, tuple]:
    """(header, rows) of both tables."""
    thresholds = [(name, f"{g:.3f}") for name, g in lift_off_thresholds(study).items()]
    return (RESPONSES, response_rows(study)), (THRESHOLDS, thresholds)
