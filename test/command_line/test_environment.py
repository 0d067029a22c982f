"""Disturbances of a command: hang-up, full disk, interruption, damaged cache."""

import os
import resource
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from patience import PATIENCE, wait_until

from vehicle_roll_sim.model.compiled.jit import CACHE, COMPILED, interruptible

pytestmark = pytest.mark.unmeasured

COMMAND = (sys.executable, "-u", "-m", "vehicle_roll_sim")
"""With output that is not buffered: every line meets the surroundings at once."""
ENDINGS = {
    signal.SIGINT: (130, "vehicle_roll_sim: interrupted\n"),
    signal.SIGTERM: (143, ""),
}
"""Exit status and stderr after a signal."""
SAYS_THAT_IT_COMPUTES = """
import os, sys
from vehicle_roll_sim.command_line import entry, run

drive = run.drive

def announced(*words, **options):
    os.write(1, b"computing\\n")
    return drive(*words, **options)

run.drive = announced
sys.exit(entry.main())
"""
"""The command, which says so before it begins to compute."""
WITHOUT_A_CACHE = """
import os, sys
from pathlib import Path
from vehicle_roll_sim.model.compiled import jit

assert jit.CACHE is None
print(jit.kernel(lambda x, y: jit.square_root(x * x + y * y))(3.0, 4.0))
jit.CACHE = Path(os.environ["COMPILED"])
from vehicle_roll_sim.command_line import main
from vehicle_roll_sim.simulation import compilation  # and with it every kernel

jit.CACHE = None
sys.exit(main.main())
"""
"""The command where no cache can be made, after it has compiled a kernel in memory. The kernels of
the model are taken from a cache nevertheless, since they take 40 s to compile."""
LARGEST_KERNEL = "advance."
"""Takes 40 s to compile, as it does at the first start."""
IN_THE_MIDDLE = 0.3
"""s of processor time: far more than there is between saying so and computing."""


def processor_time(process: subprocess.Popen) -> float:
    """Seconds that a process has computed so far, however long it took."""
    fields = Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
    return int(fields[11]) / os.sysconf("SC_CLK_TCK")


def run(*words, **options):
    options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True} | options
    return subprocess.run([*COMMAND, "run", *words], timeout=PATIENCE, **options)


def test_a_reader_that_has_gone_costs_no_result(tmp_path):
    reading, writing = os.pipe()
    os.close(reading)
    result = run("step_steer", "--csv", str(tmp_path / "rows.csv"), stdout=writing)
    os.close(writing)
    assert (result.returncode, result.stderr) == (0, "")
    assert (tmp_path / "rows.csv").stat().st_size > 0


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no /dev/full on this system")
def test_an_output_that_is_full_is_said_in_one_line():
    with open("/dev/full", "w") as full:
        result = run("step_steer", stdout=full)
    assert result.returncode == 1
    assert len(result.stderr.splitlines()) == 1
    assert "No space left" in result.stderr


@pytest.mark.parametrize(("closed", "name", "status"), [(1, "step_steer", 0), (2, "step_ster", 2)])
def test_an_output_that_is_closed_is_done_without(closed, name, status):
    result = run(name, "--duration", "0.1", preexec_fn=lambda: os.close(closed))
    assert (result.returncode, result.stdout, result.stderr) == (status, "", "")


@pytest.mark.parametrize("encoding", ["ascii", "utf-8"])
def test_what_the_terminal_cannot_show_is_escaped(tmp_path, encoding):
    path = os.fsencode(tmp_path) + b"/\xff.csv"
    words = ("step_steer", "--duration", "0.1", "--csv", path)
    result = run(*words, env=os.environ | {"PYTHONIOENCODING": encoding, "PYTHONUTF8": "1"})
    assert (result.returncode, result.stderr) == (0, "")
    assert "\\udcff.csv" in result.stdout
    assert os.path.exists(path)


@pytest.mark.parametrize("option", ["--csv", "--bag"])
def test_a_result_that_is_refused_while_it_is_written_is_no_wrong_input(command, folder, option):
    if option == "--bag":
        pytest.importorskip("rosbags", reason="bags need the library rosbags")
    usual = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, usual[1]))
    try:
        result = command("run", "step_steer", option, "result")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, usual)
    assert result.status == 1
    assert len(result.err.splitlines()) == 1
    assert "File too large" in result.err
    assert list(folder.iterdir()) == []


def test_a_run_that_is_terminated_leaves_nothing_half_written(started, tmp_path):
    pytest.importorskip("rosbags", reason="bags need the library rosbags")
    words = ("step_steer", "--amplitude", "0", "--duration", "80000", "--bag", "bag")
    process = started([*COMMAND, "run", *words], cwd=tmp_path)
    wait_until(lambda: list(tmp_path.iterdir()) or process.poll() is not None, "the bag")
    process.terminate()
    assert process.wait(PATIENCE) == 128 + signal.SIGTERM
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(not COMPILED, reason="interrupting compiled code needs compiled code")
@pytest.mark.parametrize("signum", ENDINGS)
def test_a_signal_in_the_middle_of_a_computation_is_no_crash(started, signum):
    words = ("step_steer", "--amplitude", "0", "--duration", "3600", "--sample", "0.1")
    process = started(
        [sys.executable, "-c", SAYS_THAT_IT_COMPUTES, "run", *words, "--step", "1e-5"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stdout.readline() == "computing\n"
    enough = processor_time(process) + IN_THE_MIDDLE
    wait_until(lambda: processor_time(process) > enough, "the middle of the computation")
    assert process.poll() is None
    process.send_signal(signum)
    _, err = process.communicate(timeout=PATIENCE)
    assert (process.returncode, err) == ENDINGS[signum]


@pytest.mark.parametrize("signum", ENDINGS)
def test_a_signal_that_breaks_the_compiler_is_no_crash(signum):
    code = f"""
import ctypes, signal
from vehicle_roll_sim.command_line import main, vehicle_options

def breaks():
    ctypes.CFUNCTYPE(None)(lambda: signal.raise_signal({int(signum)}))()
    raise RuntimeError("of the compiler, whose callback lost the exception")

vehicle_options.compile_model = breaks
main.main()
"""
    words = [sys.executable, "-c", code, "run", "step_steer"]
    result = subprocess.run(words, capture_output=True, text=True, timeout=PATIENCE)
    assert (result.returncode, result.stderr) == ENDINGS[signum]


@pytest.mark.parametrize("raised", [KeyboardInterrupt(), SystemExit(143)])
def test_what_a_signal_raises_in_compiled_code_comes_as_what_it_is(raised):
    def compiled():
        raise SystemError("returned a result with an exception set") from raised

    with pytest.raises(type(raised)) as caught:
        interruptible(compiled, ())
    assert caught.value is raised


def test_a_link_stays_and_what_it_leads_to_is_written(command, folder):
    target, link = folder / "target.csv", folder / "link.csv"
    target.write_text("old")
    link.symlink_to(target)
    assert command("run", "step_steer", "--duration", "0.1", "--csv", link).status == 0
    assert link.is_symlink()
    assert target.read_text().startswith("time,")


@pytest.mark.skipif(not COMPILED, reason="only compiled code is cached")
def test_damaged_compiled_code_is_made_anew(command, tmp_path):
    environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)}
    words = ("step_steer", "--duration", "0.1")
    shutil.copytree(CACHE, tmp_path / CACHE.name)
    for compiled in tmp_path.rglob("*.nbc"):
        if not compiled.name.startswith(LARGEST_KERNEL):
            compiled.write_bytes(compiled.read_bytes()[:100])
    damaged = run(*words, env=environment)
    assert damaged.returncode == 0
    assert "damaged" in damaged.stderr
    assert damaged.stdout == command("run", *words).out
    assert run(*words, env=environment).stderr == ""  # nothing is left to compile


@pytest.mark.skipif(not COMPILED, reason="only compiled code is cached")
def test_without_a_home_and_a_cache_it_works_and_says_that_it_compiles():
    """Under /proc nobody can make a folder, not even root."""
    environment = {key: os.environ[key] for key in os.environ if not key.startswith("XDG_")}
    environment |= {"HOME": "/proc/none", "COMPILED": str(CACHE)}
    words = [sys.executable, "-c", WITHOUT_A_CACHE, "run", "step_steer", "--duration", "0.1"]
    result = subprocess.run(
        words, env=environment, capture_output=True, text=True, timeout=PATIENCE, check=False
    )
    assert result.returncode == 0, result.stderr
    assert result.stdout.startswith("5.0\n")
    assert "complete" in result.stdout
    assert len(result.stderr.splitlines()) == 1
    assert "is compiled at every start" in result.stderr
