"""`vehicle_roll_sim identify`: values of a vehicle from measured logs."""

import argparse

from tqdm import tqdm

from vehicle_roll_sim.analysis import figure_size
from vehicle_roll_sim.arguments import OneLineParser, add_declared, declared_values, named_file
from vehicle_roll_sim.command_line import signals
from vehicle_roll_sim.command_line.commands import COMMANDS
from vehicle_roll_sim.command_line.compare import as_setting
from vehicle_roll_sim.command_line.plausibility_option import warn_or_refuse
from vehicle_roll_sim.command_line.vehicle_options import add_simulation_options, chosen_simulation
from vehicle_roll_sim.declaration import InputError, unknown_name
from vehicle_roll_sim.files.output_file import check_distinct, check_figure_format, check_writable
from vehicle_roll_sim.runs.summary import line


def identify_command(words: list[str], program: str) -> int:
    """Run the command with the arguments after its name; return the exit status."""
    arguments = _parser(program).parse_args(words)
    signals.import_interruptibly("offline.identifying")
    from vehicle_roll_sim.identification.settings import prior_texts
    from vehicle_roll_sim.offline import identifying

    map_file = named_file(arguments.map, "--map")
    if map_file is None:
        raise InputError("--map", None, "a map file: which column is which quantity")
    names, kinds = _listed(arguments.free), _listed(arguments.sensors)
    if not names and not kinds:
        raise InputError("--free", None, "names of what is identified, such as cg_height,damping")
    priors = prior_texts(arguments.prior)
    out, plot = named_file(arguments.out, "--out"), named_file(arguments.plot, "--plot")
    size = figure_size.named_size(arguments.size, "--size", plot)
    _check_outputs(out, plot, arguments.profile)
    try:
        chosen = [kind(**declared_values(arguments, kind)) for kind in identifying.SETTINGS]
        used, held = (
            identifying.load_logs([named_file(each, "LOG") for each in paths], map_file, chosen[0])
            for paths in (arguments.logs, arguments.hold_out)
        )
    except InputError as error:
        raise as_setting(error, identifying.SETTINGS) from None
    warn_or_refuse(
        [doubt for log in (*used.values(), *held.values()) for doubt in log.doubts], arguments
    )
    simulation = chosen_simulation(arguments)
    try:
        result, profile = _run(
            identifying, (used, held, simulation, names, kinds, priors, chosen[1:]), arguments
        )
    except InputError as error:
        raise _as_option(error, identifying.SETTINGS) from None
    print(result.summary)
    try:
        files = result.write_vehicle(out) if out else []
    except InputError as error:
        raise _as_option(error, identifying.SETTINGS) from None
    if plot:
        signals.import_interruptibly("identification.figures")
        identifying.draw_profile(profile, plot, profile.name, size)
    written = [line("vehicle file" if k == 0 else "tire file", f) for k, f in enumerate(files)]
    print("\n".join([*_profile_lines(profile), *written, *([line("plot", plot)] if plot else [])]))
    return 0


def _run(identifying, given: tuple, arguments: argparse.Namespace):
    """Identify with a counter of runs; returns the result and the profile, None if not wanted."""
    with (
        signals.exit_on_signal(),
        tqdm(delay=1.0, disable=None, leave=False, unit=" runs") as bar,
    ):

        def progress(runs: int) -> None:
            bar.update(runs - bar.n)

        used, _, _, names, kinds, *_ = given
        every = identifying.all_names(used, names, kinds)
        if arguments.profile and arguments.profile not in every:
            raise unknown_name(arguments.profile, every, "profile")
        result = identifying.identified(*given, progress=progress)
        if not arguments.profile:
            return result, None
        return result, identifying.profile(result.estimate, arguments.profile, progress)


def _profile_lines(profile) -> list[str]:
    if profile is None:
        return []
    low, high = profile.interval
    unit = f" {profile.unit}" if profile.unit else ""
    return [line(f"profile of {profile.name}", f"{low:.6g} to {high:.6g}{unit} (95 %)")]


def _listed(text: str | None) -> list[str]:
    """Names separated by commas."""
    return [name.strip() for name in text.split(",") if name.strip()] if text else []


OPTIONS = ("free", "sensors", "prior", "profile")


def _as_option(error: InputError, declaring: tuple[type, ...]) -> InputError:
    """The same error, reported for an option."""
    head, _, rest = error.field.partition(" ")
    if head in OPTIONS:
        field = f"--{head} {rest}".strip()
        return InputError(field, error.value, error.allowed, error.problem)
    return as_setting(error, declaring)


def _check_outputs(out, plot, profile: str | None) -> None:
    """Raise InputError unless the results can be written."""
    for file, field in ((out, "--out"), (plot, "--plot")):
        if file:
            check_writable(file, field)
    if plot:
        check_figure_format(plot, "--plot")
        if not profile:
            raise InputError("--plot", str(plot), "together with --profile NAME, which it shows")
    check_distinct({"--out": out, "--plot": plot})


def _parser(program: str) -> argparse.ArgumentParser:
    from vehicle_roll_sim.comparison.corridor import Tolerances
    from vehicle_roll_sim.comparison.driving import Driving
    from vehicle_roll_sim.logs.settings import Conditioning

    parser = OneLineParser(prog=program, description=COMMANDS["identify"])
    about = "measured logs of one vehicle: CSV, Parquet, MATLAB (.mat) or MDF (.mf4) files, or bags"
    parser.add_argument("logs", metavar="LOG", nargs="+", help=about)
    about = "map file (YAML): the column, unit and sign of each quantity of the logs"
    parser.add_argument("--map", metavar="FILE.yaml", help=about)
    group = parser.add_argument_group("identification")
    about = (
        "what is identified: parameters of vehicle files, tire.LKY and other scaling factors of "
        "the tires, steering_offset, yaw_rate_bias and the like; damping: one factor of both axles"
    )
    group.add_argument("--free", metavar="NAME,NAME...", help=about)
    about = "also identify these values of the sensors of all quantities: bias, delay, scale"
    group.add_argument("--sensors", metavar="KIND,KIND...", help=about)
    about = "what is known beforehand: mean and standard deviation of a value; repeatable"
    group.add_argument("--prior", metavar="NAME=MEAN,SD", action="append", default=[], help=about)
    about = "a log that is not used, on which the result is judged; repeatable"
    group.add_argument("--hold-out", metavar="LOG", action="append", default=[], help=about)
    about = "also compute the profile likelihood of this value"
    group.add_argument("--profile", metavar="NAME", help=about)
    add_declared(parser, Conditioning, "log")
    add_declared(parser, Driving, "log")
    add_declared(parser, Tolerances, "corridor")
    add_simulation_options(parser)
    group = parser.add_argument_group("results")
    about = "write the identified vehicle file, with the intervals in comments"
    group.add_argument("--out", metavar="FILE.yaml", help=about)
    about = "plot the profile likelihood (PNG, SVG or PDF)"
    group.add_argument("--plot", metavar="FILE", help=about)
    group.add_argument("--size", metavar="WIDTHxHEIGHT", help=figure_size.HELP)
    return parser
