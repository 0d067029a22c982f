"""Manoeuvres: commands to the vehicle as a function of time or state, without ROS."""
