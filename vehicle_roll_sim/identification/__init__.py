"""Values of a vehicle from measured logs: least squares, and what the logs can tell."""
