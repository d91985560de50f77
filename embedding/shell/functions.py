"""The functions of the expressions of a scene, for NGSolve's coefficient functions and for numpy's arrays."""

from __future__ import annotations

from typing import Any

import ngsolve
import numpy as np

from embedding.scene.expression import Functions

SYMBOLIC: Functions = {
    "sin": ngsolve.sin,
    "cos": ngsolve.cos,
    "exp": ngsolve.exp,
    "log": ngsolve.log,
    "sqrt": ngsolve.sqrt,
    "tanh": lambda a: 1 - 2 / (ngsolve.exp(2 * a) + 1),
}
NUMERIC: Functions = {
    "sin": np.sin, "cos": np.cos, "exp": np.exp, "log": np.log, "sqrt": np.sqrt, "tanh": np.tanh,
}  # fmt: skip


def functions_for(*values: Any) -> Functions:
    """Those that take ``values``: coefficient functions, or numbers and arrays."""
    symbolic = any(isinstance(value, ngsolve.CoefficientFunction) for value in values)
    return SYMBOLIC if symbolic else NUMERIC
