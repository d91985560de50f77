"""OpenBLAS takes its working memory at its first call, and where there is none it asks again without end.

So it is let have it while there is some; NumPy and SciPy bring an OpenBLAS each.
"""

from __future__ import annotations

from functools import cache

import numpy as np

ENOUGH = 3 << 25
"""Bytes; three times what it takes."""


@cache
def numpy_ready() -> None:
    """Before linear algebra of NumPy. Raises MemoryError if there is none for it."""
    np.empty(ENOUGH, np.uint8)
    np.linalg.inv(np.eye(2))


@cache
def scipy_ready() -> None:
    """Before linear algebra of SciPy. Raises MemoryError if there is none for it."""
    from scipy.linalg import solve_triangular

    np.empty(ENOUGH, np.uint8)
    solve_triangular(np.eye(2), np.ones(2))
