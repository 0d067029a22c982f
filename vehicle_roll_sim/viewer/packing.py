"""Numbers as the page gets them."""

import base64
from collections.abc import Iterable

import numpy as np


def packed(values: Iterable, kind: str) -> str:
    """Numbers as base64 of their bytes; kind: their numpy dtype."""
    with np.errstate(over="ignore"):  # beyond 32 bits: infinite
        return base64.b64encode(np.ascontiguousarray(values, kind).tobytes()).decode()
