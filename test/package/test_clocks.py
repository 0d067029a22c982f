"""The clock on the wall, which may be set back and forth, is asked nowhere."""

import ast


def test_no_source_asks_for_the_time_of_day(sources):
    """Its calls, whatever they are called on: stamps alone come from the clock of ROS."""
    of_day = {"time", "time_ns", "localtime", "gmtime", "now", "utcnow", "today"}
    asked = [
        (name, node.lineno)
        for name, text in sources.items()
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.Call)
        and isinstance(node.func, ast.Attribute)
        and node.func.attr in of_day
        and isinstance(node.func.value, ast.Name)
        and node.func.value.id in {"time", "datetime", "date"}
    ]
    assert asked == []
