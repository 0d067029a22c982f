"""Text and result files: read and written whole, or refused in one line."""
