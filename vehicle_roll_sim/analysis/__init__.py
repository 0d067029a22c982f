"""Analysis of runs: metrics, figures, linearization, and comparison with a multibody engine."""
