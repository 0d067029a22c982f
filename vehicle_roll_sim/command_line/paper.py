"""`vehicle_roll_sim paper`: rerun the studies of Shim and Ghike (2007) and check its claims."""

import sys
from pathlib import Path

from tqdm import tqdm

from vehicle_roll_sim.arguments import OneLineParser, named_file
from vehicle_roll_sim.command_line import signals
from vehicle_roll_sim.command_line.commands import COMMANDS
from vehicle_roll_sim.command_line.compiling import compile_model
from vehicle_roll_sim.files.output_file import check_folder, filled_folder
from vehicle_roll_sim.paper.claim import HOLDS, Finding
from vehicle_roll_sim.paper.report import (
    NO_ENGINE,
    as_markdown,
    as_text,
    check_claims,
    numbers_as_markdown,
    numbers_as_text,
)
from vehicle_roll_sim.paper.study import Study
from vehicle_roll_sim.vehicle.vehicle_file import preset

DEFAULT_FOLDER = "paper"
CLAIM_FAILED = 1
"""Exit status with --strict if a claim fails or was not checked, or a published number differs."""


def paper_command(words: list[str], program: str) -> int:
    """Run the command with the arguments after its name; return the exit status."""
    parser = OneLineParser(prog=program, description=COMMANDS["paper"])
    parser.add_argument(
        "--out",
        metavar="DIR",
        default=DEFAULT_FOLDER,
        help="folder for the figures (PNG), their data (CSV) and the table of claims "
        f"(default: {DEFAULT_FOLDER})",
    )
    parser.add_argument(
        "--strict",
        action="store_true",
        help="exit with status 1 unless every claim was checked and holds, or every published "
        "number that is judged agrees",
    )
    more = parser.add_mutually_exclusive_group()
    more.add_argument(
        "--beyond",
        action="store_true",
        help="also draw what a moving roll centre changes: models 1 and 2, also on swing axles",
    )
    more.add_argument(
        "--published",
        action="store_true",
        help="rerun published numbers of other sources instead; print differences and tolerances",
    )
    arguments = parser.parse_args(words)
    folder = named_file(arguments.out, "--out")
    check_folder(folder, "--out")
    with signals.exit_on_signal():
        compile_model()
    if arguments.published:
        return _rerun_published(folder, arguments.strict)
    with tqdm(disable=None, leave=False, unit="result") as bar:
        study = Study(preset(), bar.update)
        if not study.has_engine:
            print(f"{program}: {NO_ENGINE}; claim 22 is not checked", file=sys.stderr)
        findings, moving = _write_results(study, folder, bar, arguments.beyond)
    print(f"{as_text(findings)}\n\n{numbers_as_text(study)}\n\n{moving}results: {folder}")
    return CLAIM_FAILED if arguments.strict and not _all_hold(findings) else 0


def _write_results(
    study: Study, folder: Path, bar: tqdm, with_beyond: bool
) -> tuple[list[Finding], str]:
    """Make all runs, then write figures, data and tables, all of them or none.

    Returns the findings, and the text about moving roll centres, '' without them.
    """
    with signals.exit_on_signal():
        from vehicle_roll_sim.paper import beyond, figures  # matplotlib takes 0.5 s to import

    further = len(beyond.CASES) * len(beyond.MODELS) if with_beyond else 0
    bar.reset(len(study.runs) + len(figures.FIGURES) + further)
    for manoeuvre, case in study.runs:
        study.response(manoeuvre, case)
    findings = check_claims(study)
    moving = beyond.pairs(study.vehicle, bar.update) if with_beyond else []
    about_them = f"{beyond.as_text(moving)}\n\n" if moving else ""
    with filled_folder(folder) as partial:
        for figure in figures.FIGURES:
            figures.draw(figure, study, partial)
            bar.update()
        figures.draw(figures.LAG, study, partial)
        figures.draw_roll_plane(study, partial)
        for pair in moving:
            beyond.draw(pair, partial)
        if moving:
            (partial / "beyond.txt").write_text(about_them.rstrip() + "\n", encoding="utf-8")
        text = f"{as_text(findings)}\n\n{numbers_as_text(study)}\n"
        table = f"{as_markdown(findings)}\n\n{numbers_as_markdown(study)}\n"
        (partial / "claims.txt").write_text(text, encoding="utf-8")
        (partial / "claims.md").write_text(table, encoding="utf-8")
    return findings, about_them


def _rerun_published(folder: Path, is_strict: bool) -> int:
    """Compute the numbers of other sources, write and print them; return the exit status."""
    with signals.exit_on_signal():
        from vehicle_roll_sim.paper.published import comparison, report, source

        numbers = source.numbers()
    with tqdm(disable=None, leave=False, unit="number", total=len(numbers)) as bar:
        found = comparison.compare(numbers, bar.update)
    text = report.as_text(found)
    with filled_folder(folder) as partial:
        (partial / "published.txt").write_text(f"{text}\n", encoding="utf-8")
        table = f"{report.as_markdown(found)}\n"
        (partial / "published.md").write_text(table, encoding="utf-8")
    print(f"{text}\n\nresults: {folder}")
    differs = any(one.verdict == comparison.DIFFERS for one in found)
    return CLAIM_FAILED if is_strict and differs else 0


def _all_hold(findings: list[Finding]) -> bool:
    return all(finding.verdict == HOLDS for finding in findings)
