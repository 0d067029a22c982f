"""Measured logs: columns of any names and units become quantities in SI units at one clock."""
