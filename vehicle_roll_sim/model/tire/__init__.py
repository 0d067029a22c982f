"""Tires: contact-patch forces from load and slip, and the transient slip behind them."""
