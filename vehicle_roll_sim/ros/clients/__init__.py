"""Nodes beside a running simulator: manoeuvre, recorder, the base of controllers."""
