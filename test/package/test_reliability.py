"""The tests named in the table of faults exist."""

import re


def test_every_test_that_is_named_exists(root):
    named = set(re.findall(r"`(test_\w+)`", (root / "docs" / "reliability.md").read_text()))
    there = {
        name
        for path in (root / "test").rglob("test_*.py")
        for name in (path.stem, *re.findall(r"def (test_\w+)", path.read_text()))
    }
    assert len(named) > 40
    assert named <= there
