"""The program that forks nodes for the tests, on request, once it has imported everything.

A node spends most of its start on imports and on loading compiled kernels; a forked one has all of
that. Started by `forked`, and ends once nobody can send requests any more, with all that it forked.

A request (JSON) is `program` (a script, or None for an executable of the package), `words`,
`environment`, `folder` and `new_session`, with the file descriptors of stdout, stderr and of a pipe
for the exit status. The answer is the process id.

The forked process returns to the top of this program and runs there, so that the interpreter ends
as ever: exit status, traceback, atexit, daemon threads. What differs from a process of its own:
- modules are there already, so that their imports can neither fail nor take time;
- threads that libraries begin when they are loaded, such as for tracing, are left behind;
- hashes of strings are the same in all, and /proc/PID/environ is that of this program;
- a traceback begins with lines of this file and of runpy;
- its parent is this program, which passes the exit status on.
"""

import contextlib
import gc
import importlib
import inspect
import json
import os
import runpy
import select
import signal
import socket
import sys

LARGEST = 2**17
"""Bytes of a request."""
EXECUTABLES = "vehicle_roll_sim.ros.executables"
MEASURING = "COVERAGE_PROCESS_CONFIG"
PRELOADED = (
    "vehicle_roll_sim.messages.run_messages",
    "vehicle_roll_sim.ros.clients.controller",
    "vehicle_roll_sim.ros.clients.manoeuvre",
    "vehicle_roll_sim.ros.clients.recorder",
    "vehicle_roll_sim.ros.orchestration.compare",
    "vehicle_roll_sim.ros.orchestration.score",
    "vehicle_roll_sim.ros.simulator.node",
)
"""Neither `executables`, which a forked process runs as its program, nor `controller`, which
handles signals from its import on."""


def preload() -> None:
    """Whatever a node does before it has a context of rcl, and with it threads."""
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # its threads and forks do not get along
    usual = {each: signal.getsignal(each) for each in (signal.SIGINT, signal.SIGTERM)}
    for name in PRELOADED:
        importlib.import_module(name)
    import rclpy
    from rclpy.type_support import check_for_type_support

    from vehicle_roll_sim.messages.command_topics import COMMANDS, WAYS_IN
    from vehicle_roll_sim.messages.topics import PUBLISHED, STAMPED
    from vehicle_roll_sim.ros.topics import is_installed, message_class
    from vehicle_roll_sim.simulation.compilation import call_every_kernel

    for topic in filter(is_installed, (*COMMANDS, *WAYS_IN, *PUBLISHED, *STAMPED)):
        check_for_type_support(message_class(topic.type))
    rclpy.get_rmw_implementation_identifier()
    call_every_kernel()
    inspect.getmodule(sys._getframe())  # it notes where every module is, for 0.1 s; logging asks it
    for signum, handler in usual.items():  # the package has its own, from its import on
        signal.signal(signum, handler)
    gc.collect()
    gc.freeze()  # what is there stays, and its pages stay shared


def serve(requests: socket.socket) -> dict | None:
    """Fork on every request; returns in the forked process, with the request, and at the end."""
    children = {}
    while True:
        for each in select.select([requests, *children], [], [])[0]:
            if each is not requests:
                report(each, *children.pop(each))
                continue
            asked, given, *_ = socket.recv_fds(requests, LARGEST, 3)
            if not asked:
                for handle, (process, told) in children.items():
                    os.kill(process, signal.SIGKILL)
                    report(handle, process, told)
                return None
            process = os.fork()
            if not process:
                requests.close()
                for handle, (_, told) in children.items():
                    os.close(handle)
                    os.close(told)
                take_place(given)
                return json.loads(asked)
            children[os.pidfd_open(process)] = process, given[2]
            for end in given[:2]:
                os.close(end)
            requests.send(process.to_bytes(8, "little"))


def report(handle: int, process: int, told: int) -> None:
    """Pass the exit status of a process that has ended on."""
    status = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
    with contextlib.suppress(BrokenPipeError):  # nobody waits for it any more
        os.write(told, status.to_bytes(8, "little", signed=True))
    os.close(told)
    os.close(handle)


def take_place(given: list[int]) -> None:
    """Take stdout and stderr of those that are given."""
    for end, number in zip(given, (1, 2), strict=False):
        os.dup2(end, number)
    for end in given:
        os.close(end)


def run(request: dict) -> None:
    """Be the process that was asked for; what it raises is raised."""
    if request["new_session"]:
        os.setsid()
    os.chdir(request["folder"])
    os.environ.clear()
    os.environ.update(request["environment"])
    if MEASURING not in os.environ:
        stop_measuring()
    program = request["program"]
    sys.path[0] = os.path.dirname(os.path.abspath(program)) if program else os.getcwd()
    sys.argv[:] = [program or EXECUTABLES, *request["words"]]
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    if program:
        runpy.run_path(program, run_name="__main__")
    else:
        runpy.run_module(EXECUTABLES, run_name="__main__", alter_sys=True)


def stop_measuring() -> None:
    """For a test that takes no part in the measurement of coverage."""
    coverage = sys.modules.get("coverage")
    if measurement := coverage and coverage.Coverage.current():
        measurement.stop()


if __name__ == "__main__":
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})  # Ctrl-C is for the tests
    preload()
    if request := serve(socket.socket(fileno=int(sys.argv[1]))):
        run(request)
