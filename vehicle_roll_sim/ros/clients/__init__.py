"""Nodes that use a running simulator: manoeuvre, recorder and the base class of controllers."""
