"""Tires: the forces of the contact patch from load and slip, and the slip that a tire reacts to."""
