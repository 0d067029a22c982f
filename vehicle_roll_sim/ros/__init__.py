"""The model on ROS 2: nodes, messages, topics. Everything else works without it."""
