"""Example controllers: one-page scripts to copy and change."""
