"""What the scripts of controllers name, topics and parameters among it."""

import ast
from collections.abc import Iterable
from pathlib import Path


def texts_of(script: Path) -> set:
    """The constants of a script."""
    tree = ast.parse(script.read_text(encoding="utf-8"))
    return {node.value for node in ast.walk(tree) if isinstance(node, ast.Constant)}


def assigned(parameters: Iterable[str], scripts: Iterable[Path]) -> dict[Path, list[str]]:
    """Command-line words by script: each NAME:=VALUE for those that name it, or for all if none do.

    A controller refuses a parameter that is meant for another.
    """
    texts = {script: texts_of(script) for script in scripts}
    words = {script: [] for script in texts}
    for parameter in parameters:
        name = parameter.partition(":=")[0]
        for script in [each for each in texts if name in texts[each]] or texts:
            words[script] += ["-p", parameter]
    return words
