"""Small meshed bodies, smooth and rough displacements on them, and Taylor tests of forms."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import BND, CF, BilinearForm, sin

from embedding import Disc, InfiniteCylinder, Plate, Sphere
from embedding.geometry.domain import Domain, MeshSizes, Shape, build
from embedding.geometry.reduction import Name, Reduction

Array = npt.NDArray[np.float64]

SHAPES: dict[str, Shape] = {
    "plate": Plate(length=1.0, width=0.6),
    "disc": Disc(radius=1.0),
    "sphere": Sphere(radius=1.0),
    "cylinder": InfiniteCylinder(radius=1.0),
}
BODIES: dict[str, tuple[str, Name, tuple[str, ...]]] = {
    "plate": ("plate", "3d", ()),
    "disc": ("disc", "3d", ()),
    "quarter disc": ("disc", "3d", ("x", "y")),
    "axisymmetric disc": ("disc", "axisymmetric", ()),
    "sphere": ("sphere", "3d", ()),
    "octant": ("sphere", "3d", ("x", "y", "z")),
    "axisymmetric sphere": ("sphere", "axisymmetric", ()),
    "ring": ("cylinder", "plane-strain", ()),
    "quarter ring": ("cylinder", "plane-strain", ("x", "y")),
}
"""Every shape in every reduction that fits it: shape, reduction, mirror planes."""
CLOSED = tuple(name for name, (shape, _, _) in BODIES.items() if shape in ("sphere", "cylinder"))


def body(name: str, size: float = 0.6, order: int = 2, *, radius: float = 0.0) -> Domain:
    """The body ``name`` of ``BODIES``; with ``radius`` inside an ambient of that radius."""
    shape, reduction, planes = BODIES[name]
    sizes = MeshSizes(size, max(size, radius / 2), radius, 0.5, order)
    return build(SHAPES[shape], Reduction(reduction, planes), sizes)


def smooth(domain: Domain, amount: float = 0.2) -> Any:
    """A smooth displacement that bends, shears and stretches, and keeps to mirror planes and the axis."""
    place = domain.reduction.position
    if domain.mesh.dim == 3:
        x, y, z = place[0], place[1], place[2]
        out: tuple[Any, ...] = (
            x * (0.5 + 0.3 * y * y + 0.4 * z * z),
            y * (0.7 - 0.4 * x * x + 0.3 * z * z),
            (0.6 - 0.5 * x * x + 0.4 * y * y) * (z if domain.closed else CF(1.0)),
        )
    else:
        a, b = place[0], place[1]
        out = (
            a * (0.6 + 0.4 * b * b - 0.3 * a * a),
            (0.5 - 0.4 * a * a + 0.2 * sin(b) * b) * (b if domain.closed else CF(1.0)),
        )
    return amount * CF(out)


def set_on_shell(field: Any, value: Any, free: Any, domain: Domain) -> None:
    """Interpolate ``value`` on the shell, zero where the unknowns are not ``free``."""
    field.Set(value, BND, definedon=domain.shell)
    field.vec.FV().NumPy()[~free] = 0.0


def random_directions(free: npt.NDArray[np.bool_], size: float, *, count: int = 4, seed: int = 3) -> Array:
    """``count`` rows of random numbers of largest size ``size`` on the free unknowns."""
    numbers = np.random.default_rng(seed).uniform(-1.0, 1.0, (count, len(free)))
    return size * numbers * free


def observed_orders(errors: Sequence[float]) -> list[float]:
    """Orders between errors of successively halved steps."""
    return [math.log2(a / b) if b > 0 else math.inf for a, b in zip(errors, errors[1:], strict=False)]


class Taylor:
    """Energy, gradient and Hessian of a ``form`` along some ``directions`` from one state, over halved steps.

    Remainders are added up over the directions (root of squares): along a single one a leading term may vanish.
    """

    STEPS = (1.0, 0.5, 0.25)

    def __init__(self, form: BilinearForm, state: Any, directions: Array) -> None:
        self.form, self.directions = form, directions
        self.start = np.array(state.FV().NumPy())
        self._vector, self._residual = state.CreateVector(), state.CreateVector()
        rest = np.zeros_like(self.start)
        self.gradient = self.residual(rest)
        form.AssembleLinearization(self._place(rest))
        self.curvatures = np.array([self._times(direction) for direction in directions])

    def _place(self, move: Array) -> Any:
        self._vector.FV().NumPy()[:] = self.start + move
        return self._vector

    def _times(self, direction: Array) -> Array:
        self._vector.FV().NumPy()[:] = direction
        self._residual.data = self.form.mat * self._vector
        return np.array(self._residual.FV().NumPy())

    def energy(self, move: Array) -> float:
        """Energy after a ``move`` of the state."""
        return float(self.form.Energy(self._place(move)))

    def residual(self, move: Array) -> Array:
        """Residual after a ``move`` of the state."""
        self.form.Apply(self._place(move), self._residual)
        return np.array(self._residual.FV().NumPy())

    def _energy_orders(self, bend: float) -> list[float]:
        start = self.energy(0 * self.start)

        def remainder(h: float, direction: Array, curvature: Array) -> float:
            expansion = h * float(self.gradient @ direction) + bend * 0.5 * h * h * float(curvature @ direction)
            return self.energy(h * direction) - start - expansion

        pairs = list(zip(self.directions, self.curvatures, strict=True))
        return observed_orders([math.hypot(*(remainder(h, d, c) for d, c in pairs)) for h in self.STEPS])

    def gradient_orders(self) -> list[float]:
        """Orders of energy minus its first-order expansion: 2 for the right gradient."""
        return self._energy_orders(0.0)

    def hessian_orders(self) -> list[float]:
        """Orders of energy minus its second-order expansion: 3 for the right gradient and Hessian."""
        return self._energy_orders(1.0)

    def tangent_orders(self, rows: npt.NDArray[np.bool_] | None = None) -> list[float]:
        """Orders of residual minus its linearisation, on some ``rows``: 2 for the right matrix.

        Empty where the residual is linear and nothing but rounding is left.
        """
        on = slice(None) if rows is None else rows

        def remainder(h: float, direction: Array, curvature: Array) -> float:
            miss = self.residual(h * direction) - self.gradient - h * curvature
            return float(np.linalg.norm(miss[on]))

        pairs = list(zip(self.directions, self.curvatures, strict=True))
        remainders = [math.hypot(*(remainder(h, d, c) for d, c in pairs)) for h in self.STEPS]
        linear = max(remainders) < 1e-12 * max(1.0, float(np.linalg.norm(self.curvatures)))
        return [] if linear else observed_orders(remainders)


def close_to(orders: Sequence[float], expected: float, within: float = 0.15) -> bool:
    """Are all ``orders`` close to ``expected``?"""
    return all(abs(order - expected) < within for order in orders)


def relative(a: Any, b: Any) -> float:
    """Largest difference of two arrays over the largest entry of the second."""
    return float(np.abs(np.asarray(a) - np.asarray(b)).max() / max(np.abs(np.asarray(b)).max(), 1e-300))
