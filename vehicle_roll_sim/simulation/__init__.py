"""Running the model: stepping, commands, histories and their files. No ROS."""
