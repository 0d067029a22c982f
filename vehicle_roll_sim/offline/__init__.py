"""What the command line does, as Python calls: a run, a series, a linear model, a replay."""
