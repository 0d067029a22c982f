"""Programs that start several nodes: `demo` and `compare`."""
