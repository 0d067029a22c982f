"""What runs were: metrics, figures, the comparison with a multibody engine and with the source."""
