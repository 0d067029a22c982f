"""The node `simulator` and its parts."""
