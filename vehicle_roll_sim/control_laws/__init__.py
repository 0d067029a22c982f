"""The laws of the example controllers, without ROS, and their names."""
