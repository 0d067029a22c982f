"""The installation by `colcon build`: files where `ros2 run` looks, complete enough to run."""

import os
import re
import subprocess
from pathlib import Path

import pytest
from patience import PATIENCE

from vehicle_roll_sim.command_line.main import main

CONTROLLERS = (
    *("active_roll_bar", "lqr_roll_bar", "rear_steering", "roll_braking", "rollover_mpc"),
    *("rollover_warning", "stability_control", "yaw_control"),
)
EXECUTABLES = (
    *("simulator", "manoeuvre", "recorder", "live_view", "demo", "compare", "score"),
    *("vehicle_roll_sim", "offline"),
    *CONTROLLERS,
)
PACKAGE = "vehicle_roll_sim"
HELP_OF_EACH = """
import os, runpy, sys
import vehicle_roll_sim.ros.clients.controller

for program in sys.argv[1:]:
    if not (child := os.fork()):
        sys.argv[:] = [program, "--help"]
        runpy.run_path(program, run_name="__main__")
        sys.exit("the program has not ended by itself")
    if os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]):
        sys.exit(program)
"""
"""Runs programs with --help, each in a process that has imported what all of them need."""
LINK = re.compile(r"\]\(([^)#\s]+)[^)]*\)")
"""In Markdown, without the heading in a page."""


@pytest.fixture
def site_packages(installed) -> Path:
    (folder,) = installed.glob("lib/python3*/site-packages")
    return folder


def test_the_executables_lie_where_ros2_run_finds_them_and_no_others(installed):
    folder = installed / "lib" / PACKAGE
    found = {file.name for file in folder.iterdir() if file.is_file()}
    assert found == set(EXECUTABLES)
    for name in EXECUTABLES:
        assert os.access(folder / name, os.X_OK)


def test_every_example_controller_has_an_executable(root):
    scripts = {path.stem for path in (root / PACKAGE / "examples").glob("*.py")}
    assert scripts - {"__init__", "executables"} == set(CONTROLLERS)


def test_example_controllers_are_shared_as_scripts_for_users_to_copy(installed, root):
    for name in CONTROLLERS:
        shared = installed / "share" / PACKAGE / "msg_examples" / f"{name}.py"
        assert not shared.is_symlink()
        assert shared.read_bytes() == (root / PACKAGE / "examples" / f"{name}.py").read_bytes()


def test_the_package_is_in_the_resource_index_with_its_manifest(installed, root):
    assert (installed / "share/ament_index/resource_index/packages" / PACKAGE).is_file()
    manifest = installed / "share" / PACKAGE / "package.xml"
    assert manifest.read_bytes() == (root / "package.xml").read_bytes()


def test_presets_are_shared_as_files_for_users_to_copy(installed, root):
    shared = {
        file.name: file.read_bytes()
        for file in (installed / "share" / PACKAGE / "presets").iterdir()
    }
    presets = root / PACKAGE / "vehicle" / "presets"
    assert {"reference.yaml", "reference.tir"} <= set(shared)
    assert shared == {file.name: file.read_bytes() for file in presets.iterdir()}


def test_the_files_of_the_readme_are_shared_to_start_from(installed, root):
    folders = (installed / "share" / PACKAGE / "examples", root / "examples")
    shared, there = (
        {file.relative_to(each): file.read_bytes() for file in each.rglob("*.*")}
        for each in folders
    )
    assert shared == there
    assert {"car.yaml", "tire.tir", "commands.csv", "fishhook.yaml"} <= {f.name for f in shared}


@pytest.mark.parametrize("folder", ["launch", "config"])
def test_launch_files_and_layouts_lie_where_ros2_launch_and_the_documentation_say(
    installed, root, folder
):
    shared = {
        file.name: file.read_bytes() for file in (installed / "share" / PACKAGE / folder).iterdir()
    }
    there = {file.name: file.read_bytes() for file in (root / PACKAGE / folder).glob("*.*")}
    assert shared == there
    assert len(there) >= 3


def test_every_link_of_what_is_there_to_read_leads_somewhere(installed):
    share = installed / "share" / PACKAGE
    # CONTRIBUTING.md is about a checkout, and leads to files that only a checkout has.
    pages = sorted({*share.rglob("*.md")} - {share / "CONTRIBUTING.md"})
    assert {"README.md", "docs/interfaces.md", "msg_examples/README.md"} <= {
        page.relative_to(share).as_posix() for page in pages
    }
    links = [
        (page, link)
        for page in pages
        for link in LINK.findall(page.read_text(encoding="utf-8"))
        if "://" not in link
    ]
    assert len(links) > 30
    for page, link in links:
        assert (page.parent / link).exists(), (page.name, link)
    assert (share / "LICENSE").is_file()


def test_every_module_of_the_checkout_is_installed(site_packages, sources):
    installed = {
        ".".join(path.relative_to(site_packages).with_suffix("").parts).removesuffix(".__init__")
        for path in (site_packages / PACKAGE).rglob("*.py")
    }
    assert installed == set(sources)


def test_the_parts_of_the_viewers_page_are_installed(site_packages, root):
    folders = (each / PACKAGE / "viewer" / "web" for each in (site_packages, root))
    installed, there = (
        {file.relative_to(each): file.read_bytes() for file in each.rglob("*") if file.is_file()}
        for each in folders
    )
    assert installed == there
    assert {"page.html", "main.js", "three.min.js", "LICENSE"} <= {f.name for f in there}


@pytest.fixture
def run_installed(installed, site_packages, environment, tmp_path):
    """Runs words with the install space in front of any other installation."""

    def call(*words) -> subprocess.CompletedProcess:
        # plain Python: compiling for a new place would take some 20 s
        ours = {"PYTHONPATH": str(site_packages), "NUMBA_DISABLE_JIT": "1"}
        return subprocess.run(
            [str(word) for word in words],
            cwd=tmp_path,
            env=environment | ours,
            capture_output=True,
            text=True,
            timeout=PATIENCE,
            check=False,
        )

    return call


@pytest.mark.parametrize("name", [PACKAGE, "offline"])
def test_the_installed_command_runs_a_manoeuvre_like_the_one_of_the_checkout(
    run_installed, installed, capsys, name
):
    words = ["run", "step_steer", "--start", "0", "--duration", "0.2"]
    assert main(words) == 0
    result = run_installed(installed / "lib" / PACKAGE / name, *words)
    assert (result.returncode, result.stderr) == (0, "")
    assert result.stdout == capsys.readouterr().out
    assert "0.200 s, complete" in result.stdout


def test_the_installed_executables_of_controllers_start(run_installed, installed):
    names, folder = ("compare", *CONTROLLERS), installed / "lib" / PACKAGE
    result = run_installed("python", "-c", HELP_OF_EACH, *(folder / name for name in names))
    assert (result.returncode, result.stderr) == (0, "")
    assert re.findall(r"^usage: (\w+) ", result.stdout, re.MULTILINE) == [*names]


def test_the_installed_package_reads_its_own_presets_and_published_numbers(
    run_installed, installed
):
    program = (
        "import vehicle_roll_sim, importlib.resources as r;"
        "print(vehicle_roll_sim.__file__);"
        "print(r.files('vehicle_roll_sim.vehicle') / 'presets');"
        "print(vehicle_roll_sim.preset('reference').sprung_mass, vehicle_roll_sim.__version__);"
        "from vehicle_roll_sim.paper.published.source import numbers;"
        "print(len(numbers()) > 0)"
    )
    result = run_installed("python", "-c", program)
    assert result.returncode == 0, result.stderr
    module, presets, values, has_numbers = result.stdout.splitlines()
    assert Path(module).is_relative_to(installed)
    assert Path(presets).is_relative_to(installed)
    assert (values, has_numbers) == ("1440.0 0.1.0", "True")
