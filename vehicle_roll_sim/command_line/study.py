"""`vehicle_roll_sim study`: many runs over varied values, kept in a folder that can be resumed."""

import sys

from tqdm import tqdm

from vehicle_roll_sim.arguments import OneLineParser, named_file
from vehicle_roll_sim.command_line import signals, study_page
from vehicle_roll_sim.command_line.commands import COMMANDS
from vehicle_roll_sim.command_line.compiling import compile_model
from vehicle_roll_sim.command_line.plausibility_option import add_strict, warn_or_refuse
from vehicle_roll_sim.command_line.signals import PROGRAM
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.runs.summary import line
from vehicle_roll_sim.vehicle.plausibility import plausibility


def study_command(words: list[str], program: str) -> int:
    """Run the command with the arguments after its name; return the exit status."""
    arguments = _parser(program).parse_args(words)
    signals.import_interruptibly("studies.folder", "studies.cluster")
    from vehicle_roll_sim.studies import driven_again, folder, tables

    page = study_page.page_of(arguments, named_file(arguments.out, "--out"))
    numbers = study_page.runs_of(arguments)
    if arguments.show is not None:
        others = (arguments.study, arguments.out, arguments.format, arguments.dask)
        if any(each is not None for each in others):
            raise InputError("--show", arguments.show, "nothing but the folder of a study")
        shown = named_file(arguments.show, "--show")
        report = folder.show_study(shown, "--show")
        print(report.summary, line("results", arguments.show), sep="\n")
        if page:
            _write_page(page, driven_again.kept_results(shown, "--view"), numbers, shown)
        return 0
    path, out = named_file(arguments.study, "STUDY.yaml"), named_file(arguments.out, "--out")
    for field, given in (("STUDY.yaml", path), ("--out", out)):
        if given is None:
            raise InputError(field, None, "a study file and --out DIR, or --show DIR")
    chosen = tables.PARQUET if arguments.format is None else arguments.format
    tables.check_format(chosen, "--format")
    report = _run(folder, path, out, chosen, arguments)
    print(report.summary, line("results", out), sep="\n")
    _check_runs(path, report.results)
    if page:
        _write_page(page, report.results, numbers, out)
    return 0


def _write_page(page, results, numbers, out) -> None:
    study_page.write_study_page(page, results, numbers, f"study {out.name}")
    print(line("page", page))


def _check_runs(path, results) -> None:
    """Raise InputError if not a single run could be made."""
    reasons = results.columns.reasons
    refusals = {reason: n for reason, n in reasons.items() if reason.startswith("refused: ")}
    if sum(refusals.values()) == len(results.runs):
        problem = f"all {len(results.runs)} runs were refused"
        allowed = f"values with which runs can be made; one was {min(refusals)}"
        raise InputError(f"study file {path}", "", allowed, problem)


def _run(folder, path, out, chosen, arguments):
    """Run the study with a progress bar; if it is interrupted, report how far it got."""
    from vehicle_roll_sim.studies import cluster

    study = folder.study_of(folder.Source.of_file(path))
    warn_or_refuse(plausibility(study.vehicle), arguments)
    with signals.exit_on_signal():
        if arguments.dask is not None:
            cluster.check_distributed("--dask")
        compile_model()
    total = None if study.search or study.rare else study.points
    with tqdm(total=total, delay=1.0, disable=None, leave=False, unit=" runs") as bar:
        done = 0

        def progress(runs: int, kept: bool) -> None:
            nonlocal done
            done += runs
            if kept and not bar.disable:
                bar.initial += runs  # so that the rate is that of the others
            bar.update(runs)

        try:
            with cluster.computing(arguments.dask, "--dask") as compute:
                return folder.run_study(study, out, chosen, "--out", progress, compute)
        except (KeyboardInterrupt, SystemExit):
            bar.close()
            text = f"{done} runs are done; the same command continues, --show {out} shows them"
            print(f"{PROGRAM}: {text}", file=sys.stderr)
            raise


def _parser(program: str) -> OneLineParser:
    parser = OneLineParser(prog=program, description=COMMANDS["study"])
    parser.add_argument("study", metavar="STUDY.yaml", nargs="?", help="study file")
    group = parser.add_argument_group("results")
    about = "folder for the results; an interrupted study is resumed in its folder"
    group.add_argument("--out", metavar="DIR", help=about)
    about = "file format of the tables: parquet, which needs pyarrow, or csv (default parquet)"
    group.add_argument("--format", metavar="FORMAT", help=about)
    about = "show the results in this folder: write summary and figures again, without any runs"
    group.add_argument("--show", metavar="DIR", help=about)
    study_page.add_page_options(group)
    about = "compute the runs on workers of the Dask scheduler at this address, such as HOST:8786"
    group.add_argument("--dask", metavar="ADDRESS", help=about)
    add_strict(parser.add_argument_group("vehicle"))
    return parser
