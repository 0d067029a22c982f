"""The road as the equations of motion see it."""
