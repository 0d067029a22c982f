"""The system clock, which may be set back or forward, is used for stamps and names only."""

import ast
import inspect
import time

from vehicle_roll_sim.live.log_limiter import LogLimiter
from vehicle_roll_sim.live.pacing import Pacer

OF_TIME = {
    *("time", "time_ns", "localtime", "gmtime", "ctime", "asctime", "strftime"),
    *("clock_gettime", "clock_gettime_ns"),
}
"""Of the module `time`."""
OF_DAY = {"datetime", "get_clock", "SYSTEM_TIME", "ROS_TIME", "ROSClock"}
"""Wherever they come from."""
ALLOWED = {
    ("vehicle_roll_sim.ros.simulator.publications", "get_clock"),  # stamps
    ("vehicle_roll_sim.ros.simulator.compile_status", "get_clock"),  # stamps of diagnostics
    ("vehicle_roll_sim.ros.launching.arguments", "strftime"),  # name of a bag
    ("vehicle_roll_sim.ros.orchestration.demo", "strftime"),  # name of a folder
}


def asked_for(node: ast.AST) -> list[str]:
    """What a node of the syntax tree takes from the clock on the wall."""
    match node:
        case ast.Attribute(value=ast.Name(id="time"), attr=name) if name in OF_TIME:
            return [name]
        case ast.Attribute(attr=name) if name in OF_DAY:
            return [name]
        case ast.ImportFrom(module=module, names=names):
            known = OF_DAY | OF_TIME if module == "time" else OF_DAY
            return [name for name in (module, *(each.name for each in names)) if name in known]
        case ast.Import(names=names):  # under another name it could not be followed
            return [each.name for each in names if each.name == "datetime" or is_hidden(each)]
        case ast.Call(func=ast.Name(id=name) | ast.Attribute(attr=name), keywords=keywords):
            return [name] if takes_a_clock(name) and not any(map(is_given, keywords)) else []
    return []


def is_hidden(alias: ast.alias) -> bool:
    return alias.name == "time" and alias.asname is not None


def takes_a_clock(name: str) -> bool:
    """Those that go by the clock on the wall unless they are given another one."""
    return name in {"create_timer", "create_rate", "Clock", "RosClock"}


def is_given(keyword: ast.keyword) -> bool:
    return keyword.arg in {"clock", "clock_type"}


def test_no_source_asks_for_the_time_of_day(sources):
    found = {
        (module, name)
        for module, text in sources.items()
        for node in ast.walk(ast.parse(text))
        for name in asked_for(node)
    }
    assert found == ALLOWED


def test_what_is_paced_or_throttled_goes_by_the_steady_clock():
    assert inspect.signature(Pacer).parameters["clock"].default is time.monotonic_ns
    assert inspect.signature(LogLimiter).parameters["clock"].default is time.monotonic
