"""Vectors (3, ...) and symmetric tensors of the tangent plane (3, ...), components 11, 12 and 22, at many points.

A tensor's 12 component counts once as an unknown and twice in products: ``TWICE``.
"""

from __future__ import annotations

import numpy as np

from embedding.shell.batched.polynomials import Array

TWICE = np.array([1.0, 2.0, 1.0])[:, None, None]
DETERMINANT = np.array([[0.0, 0.0, 1.0], [0.0, -2.0, 0.0], [1.0, 0.0, 0.0]])[:, :, None, None]
"""Second derivative of the determinant of a tensor in its three components."""
IDENTITY = np.eye(3)[:, :, None, None]


def dot(a: Array, b: Array) -> Array:
    """a . b, or the contraction of what is given by three components."""
    return np.asarray(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])


def cross(a: Array, b: Array) -> Array:
    """a x b."""
    return np.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def turning(a: Array) -> Array:
    """The matrix (3, 3, ...) of b -> a x b."""
    zero = np.zeros_like(a[0])
    return np.stack(
        [np.stack([zero, -a[2], a[1]]), np.stack([a[2], zero, -a[0]]), np.stack([-a[1], a[0], zero])],
    )


def outer(a: Array, b: Array) -> Array:
    """a (x) b, shape (len(a), len(b), ...)."""
    return a[:, None] * b[None, :]


def both(a: Array, b: Array) -> Array:
    """a (x) b + b (x) a."""
    product = outer(a, b)
    return product + np.swapaxes(product, 0, 1)


def determinant(tensor: Array) -> Array:
    """t11 t22 - t12^2."""
    return np.asarray(tensor[0] * tensor[2] - tensor[1] * tensor[1])


def determinant_slope(tensor: Array) -> Array:
    """Derivative of the determinant in the three components."""
    return np.stack([tensor[2], -2 * tensor[1], tensor[0]])


def metric(first: Array, second: Array) -> Array:
    """The metric tensor of two tangent vectors."""
    return np.stack([dot(first, first), dot(first, second), dot(second, second)])


def metric_slope(first: Array, second: Array) -> Array:
    """Derivative (3, 6, ...) of the metric tensor in the components of the two vectors."""
    out = np.zeros((3, 6, *first.shape[1:]))
    out[0, :3], out[1, :3], out[1, 3:], out[2, 3:] = 2 * first, second, first, 2 * second
    return out
