"""A forked process is one like another: what it has, says and how it ends."""

import contextlib
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from forked import SERVER, Server
from patience import PATIENCE, wait_until

PROGRAMS = {
    "surroundings": (
        "import os, signal, sys, threading\n"
        "print(sys.argv, sys.path, __name__, sys.modules['__main__'].__name__)\n"
        "print(sorted(os.environ), os.environ['ROS_LOG_DIR'])\n"
        "print(os.getcwd(), os.getsid(0) == os.getpid())\n"
        "print(*[(n, signal.getsignal(n)) for n in sorted(signal.valid_signals())], sep='\\n')\n"
        "print(signal.pthread_sigmask(signal.SIG_BLOCK, []), threading.active_count())\n"
        "print(repr(sys.stdin.read()), [(s.encoding, s.errors, s.line_buffering)\n"
        "      for s in (sys.stdout, sys.stderr)])\n"
        "print(sorted(os.listdir('/proc/self/fd'))[:3], os.path.exists('/proc/self/fd/9'))\n"
    ),
    "exit status": "import sys; sys.exit(7)",
    "reason": "import sys; sys.exit('why')",
    "exception": "print('before'); raise ValueError('äh')",
    "atexit": "import atexit; atexit.register(print, 'at the end'); print('now')",
    "thread": "import threading, time\n"
    "threading.Thread(target=lambda: (time.sleep(0.1), print('waited for'))).start()",
    "daemon": "import threading, time\n"
    "threading.Thread(target=time.sleep, args=(600,), daemon=True).start()",
    "at once": "import os; print('lost'); os._exit(3)",
    "killed": "import os; os.kill(os.getpid(), 9)",
    "interrupted": "import os; os.kill(os.getpid(), 2)",
}


def own_part(err: str, script: Path) -> str:
    """Without the lines of a traceback that lead to the script."""
    head, mark, trace = err.partition("Traceback (most recent call last):\n")
    return head + mark + trace[max(trace.rfind(f'  File "{script}"'), 0) :]


@pytest.mark.parametrize("new_session", [False, True])
@pytest.mark.parametrize("name", PROGRAMS)
def test_it_has_says_and_ends_as_one_from_scratch(opened, tmp_path, monkeypatch, name, new_session):
    monkeypatch.setenv("ROS_LOG_DIR", "another")
    monkeypatch.chdir(tmp_path)
    script = tmp_path / "script.py"
    script.write_text(PROGRAMS[name])
    found = []
    for fresh in (False, True):
        command = [sys.executable, str(script), "one", "two words"]
        process = opened(command, fresh=fresh, start_new_session=new_session)
        out, err = process.communicate(timeout=PATIENCE)
        found.append([process.returncode, *out.splitlines(), *own_part(err, script).splitlines()])
    assert found[0] == found[1]


def test_its_executables_are_those_that_python_runs(start):
    """By what they say of themselves."""
    forked, fresh = (start("manoeuvre", "--help", fresh=f).finish() for f in (False, True))
    assert forked == fresh
    assert fresh[0] == 0


@pytest.mark.parametrize("signum", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_a_signal_ends_it_and_is_its_return_code(opened, tmp_path, signum):
    script = tmp_path / "script.py"
    script.write_text("import time; print('there', flush=True); time.sleep(600)")
    process = opened([sys.executable, str(script)])
    assert process.stdout.readline() == "there\n"
    assert process.poll() is None
    with pytest.raises(subprocess.TimeoutExpired):
        process.communicate(timeout=0.01)
    process.send_signal(signum)
    process.communicate(timeout=PATIENCE)
    assert process.poll() == -signum
    process.kill()  # in vain


def test_what_would_be_imported_otherwise_is_not_forked():
    command, environment = [sys.executable, "script.py"], dict(os.environ)
    assert SERVER.can_start(command, environment)
    assert SERVER.can_start(command, environment | {"ROS_DOMAIN_ID": "7"})
    assert not SERVER.can_start(command, environment | {"NUMBA_DISABLE_JIT": "1"})
    assert not SERVER.can_start(["ros2", "bag"], environment)
    del environment["PATH"]
    assert not SERVER.can_start(command, environment)


@pytest.fixture
def own_server():
    server = Server()
    yield server
    server.close()


def test_all_of_it_ends_with_the_tests(own_server, tmp_path):
    script = tmp_path / "script.py"
    script.write_text("import time; time.sleep(600)")
    process = own_server.start([sys.executable, str(script)], env=dict(os.environ))
    with contextlib.ExitStack() as closing:
        closing.callback(process.communicate)
        own_server.close()  # as the end of this process would, whatever its cause
        wait_until(lambda: not Path(f"/proc/{process.pid}").exists(), "the end")
    assert process.returncode == -signal.SIGKILL
