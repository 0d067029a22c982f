"""From rates to motion: time steps, and the events and limits that are watched on the way."""
