"""What `make bench` measures; nothing in the package depends on it."""
