"""The source rerun: its manoeuvres with all of its models, its figures, and each of its claims."""
