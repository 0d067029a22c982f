"""Reproduction of the paper: its manoeuvres with all of its models, its figures and its claims."""
