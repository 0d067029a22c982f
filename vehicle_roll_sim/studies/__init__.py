"""Studies: many runs over varied values, their results, probabilities and thresholds."""
