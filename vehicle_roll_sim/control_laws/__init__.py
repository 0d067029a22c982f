"""Control laws without ROS: from the signals of one sample to commands."""
