"""The ament linter that package.xml declares, run as in packages of ROS 2.

It fetches the schema of package.xml, which names its address.
"""

import pytest

XML = (
    "package.xml",
    "examples/lqr_roll_bar_cpp/package.xml",
    "policies/vehicle_roll_sim.policy.xml",
    "vehicle_roll_sim/config/plotjuggler.xml",
)


@pytest.mark.parametrize("name", XML)
def test_xmllint_finds_no_fault(root, name):
    """One file at a time: given several, some versions report the last one only."""
    linter = pytest.importorskip("ament_xmllint.main", reason="ament_xmllint is not installed")
    assert linter.main([str(root / name)]) == 0


def test_it_looks_at_every_file(root):
    found = {path.relative_to(root).as_posix() for path in root.glob("[a-z]*/**/*.xml")}
    built = ("build/", "docs/_build/", "install/", "log/", "run/")
    assert {name for name in found if not name.startswith(built)} | {"package.xml"} == {*XML}
