"""A run from start to end: its history, and what is computed from it."""
