"""The README shows the parameters that the program has."""

from vehicle_roll_sim import preset
from vehicle_roll_sim.command_line.parameters import parameter_table


def test_the_readme_has_the_table_of_parameters_word_for_word(root):
    readme = (root / "README.md").read_text(encoding="utf-8")
    assert parameter_table(preset()) in readme
