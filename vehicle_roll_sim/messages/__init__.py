"""What the simulator says: its topics, and its messages as bytes. Below any middleware."""
