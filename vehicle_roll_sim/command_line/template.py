"""`vehicle_roll_sim template`: write a vehicle, tire or command file to start from."""

import argparse

from vehicle_roll_sim.arguments import OneLineParser, named_file
from vehicle_roll_sim.command_line.commands import COMMANDS
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.files.output_file import check_writable, replaced_file
from vehicle_roll_sim.manoeuvres.command_file import EXAMPLE
from vehicle_roll_sim.runs.summary import line
from vehicle_roll_sim.vehicle.template import tire_template, vehicle_template


def template_command(words: list[str], program: str) -> int:
    """Run the command with the arguments after its name; return the exit status."""
    arguments = _parser(program).parse_args(words)
    path = named_file(arguments.file, "FILE")
    if arguments.tire:
        label, text = "tire file", tire_template()
    elif arguments.commands:
        label, text = "command file", EXAMPLE
    else:
        label, text = "vehicle file", vehicle_template()
    if path is None:
        print(text, end="")
        return 0
    if path.is_symlink() or path.exists():
        raise InputError("FILE", str(path), "a file that does not exist yet")
    check_writable(path, "FILE")
    with replaced_file(path) as partial:
        partial.write_text(text, encoding="utf-8")
    print(line(label, path))
    return 0


def _parser(program: str) -> argparse.ArgumentParser:
    parser = OneLineParser(prog=program, description=COMMANDS["template"])
    parser.add_argument(
        "file", metavar="FILE", nargs="?", help="file to write (default: standard output)"
    )
    kind = parser.add_mutually_exclusive_group()
    kind.add_argument("--tire", action="store_true", help="write a tire file, not a vehicle file")
    kind.add_argument(
        "--commands", action="store_true", help="write a command file (CSV), not a vehicle file"
    )
    return parser
