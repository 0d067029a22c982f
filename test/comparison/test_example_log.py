"""The shipped log is the one that its generator makes."""

import csv

import numpy as np
from example_log import COLUMNS, FILE, example_log


def test_the_shipped_log_is_that_of_the_simulator_with_its_noise():
    with FILE.open(encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file, delimiter=";")
    shipped = np.array([[float(text.replace(",", ".")) for text in row] for row in rows]).T
    made = example_log()
    assert header == list(made)
    for values, expected, (_, _, _, digits) in zip(
        shipped, made.values(), COLUMNS.values(), strict=True
    ):
        # one unit of the last digit: rounding differs between processors
        np.testing.assert_allclose(values, expected, atol=1.01 * 10.0**-digits)
