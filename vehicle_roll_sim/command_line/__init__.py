"""The command `vehicle_roll_sim`: what needs no running node."""
