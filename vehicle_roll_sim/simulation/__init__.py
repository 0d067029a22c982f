"""Running the model: stepping, commands, recording, what came out. No ROS."""
