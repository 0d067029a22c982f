"""Sphinx configuration of the documentation: `make docs`."""

import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parent / "_extensions"), str(Path(__file__).parents[1])]

from vehicle_roll_sim.version import __version__  # noqa: E402

project = "vehicle_roll_sim"
author = "The vehicle_roll_sim authors"
copyright = f"{author}, Apache-2.0"
version = release = __version__

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "command_line",
    "outside_links",
]
exclude_patterns = ["_build", "**.ipynb_checkpoints"]

# Nothing is fetched, neither by the build nor by a reader's browser.
html_theme = "furo"
html_title = f"{project} {release}"
html_theme_options = {"top_of_page_buttons": []}
html_copy_source = False
html_show_sphinx = False

myst_heading_anchors = 4
myst_enable_extensions = ["colon_fence", "deflist"]

# Notebooks run at every build, and a cell that fails makes the build fail.
nb_execution_mode = "force"
nb_execution_timeout = 300
nb_execution_raise_on_error = True

default_role = "code"
smartquotes = False  # `--option` stays as it is typed
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
