"""The simulator's topics and messages, as serialized bytes; independent of any middleware."""
