"""The driver who follows a path: preview, and the single-track vehicle that he has in mind."""
