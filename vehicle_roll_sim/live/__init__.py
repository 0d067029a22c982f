"""A simulation driven from outside: commands that come in, pacing, status. No ROS."""
