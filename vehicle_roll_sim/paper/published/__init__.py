"""Numbers published elsewhere than in Shim and Ghike (2007), with their sources, and their rerun.

The files of `data/` have what was read in each source: vehicles, published values, tolerances.
"""
