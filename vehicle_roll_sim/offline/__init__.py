"""The functions of the command line as Python calls: run, series, linearize, replay."""
