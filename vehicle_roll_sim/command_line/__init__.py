"""The command `vehicle_roll_sim`: everything that works without a running node."""
