"""Manoeuvres that bring the road on which they are driven."""
