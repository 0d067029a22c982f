"""Processes that are forked from a program which has imported everything: see `fork_server`."""

import contextlib
import json
import os
import select
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace

from fork_server import EXECUTABLES
from patience import PATIENCE

PROGRAM = Path(__file__).with_name("fork_server.py")
READ_LATER = {
    *("ROS_DOMAIN_ID", "ROS_LOG_DIR", "ROS_AUTOMATIC_DISCOVERY_RANGE", "AMENT_PREFIX_PATH"),
    *("COVERAGE_PROCESS_CONFIG", "PYTEST_CURRENT_TEST"),
    "PYGAME_HIDE_SUPPORT_PROMPT",
}
"""Variables that nothing reads while it is imported: a forked process may have its own. The last is
set by gymnasium, when a test in this process imports it."""
LARGEST = 2**16
"""Bytes read at a time."""


class Forked:
    """A forked process, with as much of `subprocess.Popen` as tests use.

    status: reading end of the pipe that tells how it ended.
    """

    def __init__(self, pid: int, status: int, stdout: int | None, stderr: int | None):
        self.pid, self.returncode = pid, None
        self._status = status
        self.stdout, self.stderr = (end and open(end) for end in (stdout, stderr))  # noqa: SIM115
        self._read = {each: bytearray() for each in (self.stdout, self.stderr) if each}

    def poll(self) -> int | None:
        with contextlib.suppress(subprocess.TimeoutExpired):
            self.wait(0.0)
        return self.returncode

    def wait(self, timeout: float | None = None) -> int:
        if self.returncode is None:
            if not select.select([self._status], [], [], timeout)[0]:
                raise subprocess.TimeoutExpired(str(self.pid), timeout)
            told = os.read(self._status, 8)
            assert told, "the fork server has died"
            self.returncode = int.from_bytes(told, "little", signed=True)
            os.close(self._status)
        return self.returncode

    def communicate(self, timeout: float | None = None) -> tuple[str | None, str | None]:
        """What came on stdout and stderr, once the process has ended."""
        until = None if timeout is None else time.monotonic() + timeout
        left = lambda: None if until is None else max(until - time.monotonic(), 0.0)  # noqa: E731
        while waited := [each for each in self._read if not each.closed]:
            ready = select.select(waited, [], [], left())[0]
            if not ready:
                raise subprocess.TimeoutExpired(str(self.pid), timeout)
            for each in ready:
                if some := os.read(each.fileno(), LARGEST):
                    self._read[each] += some
                else:
                    each.close()
        self.wait(left())
        texts = (self._read.get(each, b"").decode() for each in (self.stdout, self.stderr))
        return tuple(texts)

    def send_signal(self, signum: int) -> None:
        if self.poll() is None:
            os.kill(self.pid, signum)

    def terminate(self) -> None:
        self.send_signal(signal.SIGTERM)

    def kill(self) -> None:
        self.send_signal(signal.SIGKILL)


class Server:
    """The program that forks, which is started by the first request."""

    def __init__(self):
        self._environment = dict(os.environ)
        self._process: subprocess.Popen | None = None
        self._requests: socket.socket | None = None

    def can_start(self, command: list[str], environment: dict[str, str]) -> bool:
        """Whether it is an executable of the package or a script, and whether what has been
        imported would be no other in this environment."""
        python, first, *_ = command
        known = first.endswith(".py") or command[1:3] == ["-m", EXECUTABLES]
        differing = self._environment.items() ^ environment.items()
        return python == sys.executable and known and {name for name, _ in differing} <= READ_LATER

    def start(
        self,
        command: list[str],
        *,
        env: dict[str, str],
        stdin: int | None = None,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session: bool = False,
    ) -> Forked:
        """Fork a process that runs a command which `can_start`; options as those of Popen.

        stdin: that of a forked process is always empty.
        """
        if self._process is None:
            self._begin()
        program = None if command[1] == "-m" else command[1]
        request = {"program": program, "words": command[2 if program else 3 :]}
        request |= {"environment": env, "folder": os.getcwd(), "new_session": start_new_session}
        with contextlib.ExitStack() as theirs:
            pipes = [_ends(place, theirs) for place in (stdout, stderr, subprocess.PIPE)]
            content, answer = json.dumps(request).encode(), b""
            with contextlib.suppress(ConnectionError):
                socket.send_fds(self._requests, [content], [end for _, end in pipes])
                answer = self._requests.recv(8)
        assert answer, f"the fork server has died: {self._process.stderr.read()}"
        (out, _), (err, _), (status, _) = pipes
        return Forked(int.from_bytes(answer, "little"), status, out, err)

    def _begin(self) -> None:
        self._requests, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs:
            self._process = subprocess.Popen(
                [sys.executable, str(PROGRAM), str(theirs.fileno())],
                env=self._environment,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,  # as of those that it forks
                stderr=subprocess.PIPE,
                text=True,
                pass_fds=[theirs.fileno()],
            )

    def close(self) -> None:
        """End the program, and with it all that it has forked."""
        if self._process:
            self._requests.close()
            self._process.communicate(timeout=PATIENCE)
            self._process = None


def _ends(place, theirs: contextlib.ExitStack) -> tuple[int | None, int]:
    """Our end of a pipe, where there is one, and the end of the process, closed with `theirs`."""
    if place == subprocess.DEVNULL:
        return None, theirs.enter_context(open(os.devnull, "wb")).fileno()
    if place != subprocess.PIPE:
        return None, place.fileno()
    ours, end = os.pipe()
    theirs.callback(os.close, end)
    return ours, end


SERVER = Server()
"""That of this test process; its environment is the one at the start of the tests."""


def open_process(
    command: list[str], *, env: dict[str, str], fresh: bool = False, **options
) -> Forked | subprocess.Popen:
    """A process that is forked if it can be, unless it is to be `fresh`, started from scratch."""
    if not fresh and SERVER.can_start(command, env):
        return SERVER.start(command, env=env, **options)
    return subprocess.Popen(command, env=env, text=True, **options)


def fork_nodes(monkeypatch, opened=open_process) -> None:
    """Have `compare`, `score` and `demo`, called in this process, fork the nodes that they start.

    opened: with the arguments of `open_process`.
    """
    forking = SimpleNamespace(**vars(subprocess) | {"Popen": opened})
    for name in ("comparison", "controller_processes", "demo"):
        monkeypatch.setattr(f"vehicle_roll_sim.ros.orchestration.{name}.subprocess", forking)
