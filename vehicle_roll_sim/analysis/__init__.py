"""Pictures of what a run was."""
