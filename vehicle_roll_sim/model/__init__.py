"""The physics: equations of motion, tires, integration. No ROS, no files, no clocks."""
