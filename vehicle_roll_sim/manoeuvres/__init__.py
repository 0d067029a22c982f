"""Manoeuvres: what is asked of the vehicle, as a function of time. No ROS."""
