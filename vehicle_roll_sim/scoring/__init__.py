"""Scores of controllers: catalogue, spread, figures of runs, and the report. No ROS."""
