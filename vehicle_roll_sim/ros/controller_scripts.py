"""Controller scripts: where they are, and the topics and parameters that they name."""

import ast
import importlib
from collections.abc import Iterable, Sequence
from pathlib import Path

from vehicle_roll_sim.declaration import InputError, parameters_of
from vehicle_roll_sim.ros.simulator.settings import COMMANDED

PACKAGE = "vehicle_roll_sim"
EXAMPLES = Path(__file__).parents[1] / "examples"
NO_CONTROLLERS = ("__init__", "executables")
NEEDED = {"roll_braking": ("rollover_warning",)}
"""Examples that need others, which are started with them."""
SAID = "said"
"""The attribute in which a controller declares its answers."""


def scripts_of(names: Iterable[str], field: str) -> list[Path]:
    """The scripts of controllers, given by example name or path; those that others need come first.

    Raises InputError naming `field` for a name that is neither.
    """
    found = []
    for name in names:
        found += [_script(each, field) for each in (*NEEDED.get(name, ()), name)]
    return list(dict.fromkeys(found))


def examples() -> list[str]:
    """The names of the example controllers."""
    return sorted(path.stem for path in EXAMPLES.glob("*.py") if path.stem not in NO_CONTROLLERS)


def _script(name: str, field: str) -> Path:
    there = examples()
    if name in there:
        return EXAMPLES / f"{name}.py"
    if Path(name).is_file():
        return Path(name)
    raise InputError(field, name, f"the path of a script, or one of {', '.join(there)}")


def commanded_by(scripts: Iterable[Path], field: str) -> list[str]:
    """The command topics of the simulator that controllers publish.

    These are the topics that they declare as `said`. If a declaration is not a literal, all command
    topics that occur as strings in the script count.
    """
    named = set()
    for script in scripts:
        named |= _said_in(_tree(script, field))
    return [topic for topic in COMMANDED if topic in named]


def texts_of(script: Path, field: str) -> set:
    """The literal constants in a script; raises InputError naming `field` if it is not Python."""
    return _constants(_tree(script, field))


def _tree(script: Path, field: str) -> ast.AST:
    try:
        return ast.parse(script.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(field, str(script), "a Python script", error.strerror) from None
    except (SyntaxError, ValueError) as error:
        problem = f"{script}: {getattr(error, 'msg', error)}"
        raise InputError(field, str(script), "a Python script", problem) from None


def _constants(tree: ast.AST) -> set:
    return {node.value for node in ast.walk(tree) if isinstance(node, ast.Constant)}


def _said_in(tree: ast.AST) -> set:
    declared = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            declared += [node.value] if SAID in map(ast.unparse, targets) else []
    if declared and all(map(_is_written_out, declared)):
        return set().union(*map(_constants, declared))
    return _constants(tree)


def _declared_in(tree: ast.AST) -> set[str]:
    """The parameters of the classes of this package that a script gives to `parameters_for`."""
    imported, names = {}, set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            imported |= {a.asname or a.name: f"{node.module}.{a.name}" for a in node.names}
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and ast.unparse(node.func).endswith(".parameters_for"):
            head, dot, inside = ast.unparse(node.args[0]).partition(".")
            module, _, kind = f"{imported.get(head, '')}{dot}{inside}".rpartition(".")
            if module.startswith(f"{PACKAGE}."):
                names |= parameters_of(getattr(importlib.import_module(module), kind)).keys()
    return names


def _is_written_out(value: ast.AST | None) -> bool:
    """Whether topics are literal: a string or `Topic(...)`, alone or in a tuple or list."""
    if isinstance(value, ast.Tuple | ast.List):
        return all(map(_is_written_out, value.elts))
    if isinstance(value, ast.Call):
        return all(isinstance(argument, ast.Constant) for argument in value.args)
    return isinstance(value, ast.Constant)


def assigned(
    parameters: Iterable[str], scripts: Sequence[Path], field: str
) -> dict[Path, list[str]]:
    """Arguments by script: each NAME:=VALUE goes to those that mention NAME, else to all.

    Controllers refuse unknown parameters, so one that is meant for another must not reach them.
    """
    trees = {script: _tree(script, field) for script in scripts}
    texts = {script: _constants(tree) | _declared_in(tree) for script, tree in trees.items()}
    words = {script: [] for script in texts}
    for parameter in parameters:
        name = parameter.partition(":=")[0]
        for script in [each for each in texts if name in texts[each]] or texts:
            words[script] += ["-p", parameter]
    return words
