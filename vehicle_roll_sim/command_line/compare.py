"""`vehicle_roll_sim compare`: a measured log against the model that is driven by it."""

import argparse

from vehicle_roll_sim.analysis import figure_size
from vehicle_roll_sim.arguments import (
    OneLineParser,
    add_declared,
    declared_values,
    named_file,
)
from vehicle_roll_sim.command_line import signals
from vehicle_roll_sim.command_line.commands import COMMANDS
from vehicle_roll_sim.command_line.plausibility_option import warn_or_refuse
from vehicle_roll_sim.command_line.vehicle_options import (
    add_simulation_options,
    as_option,
    chosen_simulation,
)
from vehicle_roll_sim.declaration import InputError, parameters_of
from vehicle_roll_sim.files.output_file import (
    check_distinct,
    check_figure_format,
    check_writable,
)
from vehicle_roll_sim.runs.summary import line

EPILOG = (
    "Not to be confused with `ros2 run vehicle_roll_sim compare`, which compares controllers. The "
    "corridor follows the manner of ISO 19364 and ISO 19365; the tolerances are not theirs."
)


def compare_command(words: list[str], program: str) -> int:
    """Run the command with the arguments after its name; return the exit status."""
    arguments = _parser_with_settings(program).parse_args(words)
    signals.import_interruptibly("offline.comparing")
    from vehicle_roll_sim.offline import comparing

    path, map_file = named_file(arguments.log, "LOG"), named_file(arguments.map, "--map")
    if map_file is None:
        raise InputError("--map", None, "a map file: which column is which quantity")
    csv, plot = named_file(arguments.csv, "--csv"), named_file(arguments.plot, "--plot")
    size = figure_size.named_size(arguments.size, "--size", plot)
    _check_outputs(csv, plot)
    try:
        chosen = [kind(**declared_values(arguments, kind)) for kind in comparing.SETTINGS]
        log = comparing.load_log(path, map_file, chosen[0])
    except InputError as error:
        raise as_setting(error, comparing.SETTINGS) from None
    warn_or_refuse(log.doubts, arguments)
    simulation = chosen_simulation(arguments)
    try:
        with signals.exit_on_signal():
            result = comparing.compared(log, simulation, *chosen[1:], arguments.align)
    except InputError as error:
        raise as_setting(error, comparing.SETTINGS) from None
    if csv:
        result.write_csv(csv)
    if plot:
        signals.import_interruptibly("comparison.figures")
        result.plot(plot, path.name, size)
    written = [line(label, each) for label, each in (("CSV", csv), ("plot", plot)) if each]
    print("\n".join([result.summary, *written]))
    return 0


def as_setting(error: InputError, declaring: tuple[type, ...]) -> InputError:
    """The same error; one of a setting is reported for its option."""
    is_setting = any(error.field in parameters_of(kind) for kind in declaring)
    return as_option(error) if is_setting else error


def _check_outputs(csv, plot) -> None:
    """Raise InputError unless the results can be written."""
    for file, field in ((csv, "--csv"), (plot, "--plot")):
        if file:
            check_writable(file, field)
    if plot:
        check_figure_format(plot, "--plot")
    check_distinct({"--csv": csv, "--plot": plot})


def _parser_with_settings(program: str) -> argparse.ArgumentParser:
    from vehicle_roll_sim.comparison.corridor import Tolerances
    from vehicle_roll_sim.comparison.driving import Driving
    from vehicle_roll_sim.logs.settings import Conditioning

    parser = OneLineParser(prog=program, description=COMMANDS["compare"], epilog=EPILOG)
    about = "measured log: a CSV, Parquet, MATLAB (.mat) or MDF (.mf4) file, or a bag"
    parser.add_argument("log", metavar="LOG", help=about)
    about = "map file (YAML): the column, unit and sign of each quantity of the log"
    parser.add_argument("--map", metavar="FILE.yaml", help=about)
    add_declared(parser, Conditioning, "log")
    add_declared(parser, Driving, "log")
    about = "remove the time shift of each measured quantity before it is compared"
    parser._action_groups[-1].add_argument("--align", action="store_true", help=about)
    add_declared(parser, Tolerances, "corridor")
    add_simulation_options(parser)
    group = parser.add_argument_group("results")
    about = "write measured, simulated and corridor of each quantity to a CSV file"
    group.add_argument("--csv", metavar="FILE", help=about)
    about = "plot measured over simulated and cross plots with corridors (PNG, SVG or PDF)"
    group.add_argument("--plot", metavar="FILE", help=about)
    group.add_argument("--size", metavar="WIDTHxHEIGHT", help=figure_size.HELP)
    return parser
