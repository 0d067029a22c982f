"""Comparison of a measured log with the model driven by it: errors, gradients, verdict."""
