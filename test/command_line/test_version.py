"""The version is the same in the command, the library, the installed package and package.xml."""

from pathlib import Path
from xml.etree import ElementTree

import pytest

import vehicle_roll_sim
from vehicle_roll_sim.simulation.description import VERSION

MANIFEST = Path(__file__).parents[2] / "package.xml"


def test_library_recordings_and_manifest_have_the_same_version():
    version = ElementTree.parse(MANIFEST).findtext("version")
    assert vehicle_roll_sim.__version__ == VERSION == version


def test_the_command_prints_it(command, capsys):
    with pytest.raises(SystemExit) as end:
        command("--version")
    printed = capsys.readouterr()
    assert (end.value.code, printed.err) == (0, "")
    assert printed.out == f"vehicle_roll_sim {vehicle_roll_sim.__version__}\n"
