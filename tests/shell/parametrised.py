"""Surfaces and deformations given by formulas: every quantity of the tables by its definition, in numpy.

Positions are differentiated by central differences of eighth order (errors near 1e-12), dual bases are rows of inverse
matrices, layers are differentiated as points r + eta lambda n: no formula of the library is used.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from tests.forms import Array

Points = Callable[[Array, Array], Array]
"""Coordinates p, q of shape (n,) to points or values (n, ...)."""
STEP = 1e-2
FIRST = np.array([4 / 5, -1 / 5, 4 / 105, -1 / 280])
SECOND = np.array([-205 / 72, 8 / 5, -1 / 5, 8 / 315, -1 / 560])
"""Weights of the central differences of eighth order (B. Fornberg, Math. Comp. 51 (1988) 699-706, table 1)."""


def slope(f: Points, p: Array, q: Array, variable: int) -> Array:
    """First derivative by p (``variable`` 0) or q (1)."""
    dp, dq = (STEP, 0.0) if variable == 0 else (0.0, STEP)
    pairs = [f(p + i * dp, q + i * dq) - f(p - i * dp, q - i * dq) for i in range(1, 5)]
    return np.asarray(sum(w * v for w, v in zip(FIRST, pairs, strict=True))) / STEP


def bend(f: Points, p: Array, q: Array, variable: int) -> Array:
    """Second derivative by p (``variable`` 0) or q (1)."""
    dp, dq = (STEP, 0.0) if variable == 0 else (0.0, STEP)
    around = [f(p + i * dp, q + i * dq) + f(p - i * dp, q - i * dq) for i in range(1, 5)]
    return np.asarray(SECOND[0] * f(p, q) + sum(w * v for w, v in zip(SECOND[1:], around, strict=True))) / STEP**2


def normal(place: Points, p: Array, q: Array) -> Array:
    """Unit normal a_p x a_q / |a_p x a_q|."""
    cross = np.cross(slope(place, p, q, 0), slope(place, p, q, 1))
    return np.asarray(cross / np.linalg.norm(cross, axis=1)[:, None])


@dataclass(frozen=True)
class Geometry:
    """Table 1 at points: rows are points; ``christoffel[:, a]`` holds the symbols (11, 12, 22) with upper index a."""

    tangents: Array
    duals: Array
    normal: Array
    metric: Array
    second: Array
    christoffel: Array

    @property
    def projector(self) -> Array:
        """I - n (x) n."""
        return np.asarray(np.eye(3) - np.einsum("ni,nj->nij", self.normal, self.normal))

    @property
    def curvature(self) -> Array:
        """b_ab a^a (x) a^b."""
        return np.asarray(np.einsum("nab,nai,nbj->nij", self.second, self.duals, self.duals))

    @property
    def mixed(self) -> Array:
        """b_a^b."""
        return np.asarray(self.second @ np.linalg.inv(self.metric))


def geometry(place: Points, p: Array, q: Array) -> Geometry:
    """All of table 1 for the surface ``place`` at the points (p, q), by definition."""
    tangents = np.stack([slope(place, p, q, 0), slope(place, p, q, 1)], axis=1)
    mixed = slope(lambda p, q: slope(place, p, q, 0), p, q, 1)
    seconds = np.stack([bend(place, p, q, 0), mixed, bend(place, p, q, 1)], axis=1)
    n = normal(place, p, q)
    duals = np.linalg.inv(np.concatenate([tangents, n[:, None]], axis=1)).transpose(0, 2, 1)[:, :2]
    form = np.einsum("nsi,ni->ns", seconds, n)
    metric = tangents @ tangents.transpose(0, 2, 1)
    return Geometry(tangents, duals, n, metric, form[:, [[0, 1], [1, 2]]], np.einsum("nai,nsi->nas", duals, seconds))


@dataclass(frozen=True)
class ExactShell:
    """A shell of ``thickness`` whose mid-surface ``before`` is moved to ``after``, both as functions of (p, q)."""

    before: Points
    after: Points
    thickness: float

    def stretch(self, p: Array, q: Array) -> Array:
        """lambda = sqrt(A / a)."""
        reference, deformed = (
            np.stack([slope(f, p, q, 0), slope(f, p, q, 1)], axis=1) for f in (self.before, self.after)
        )
        areas = [np.linalg.norm(np.cross(t[:, 0], t[:, 1]), axis=1) for t in (reference, deformed)]
        return np.asarray(areas[0] / areas[1])

    def quantities(self, p: Array, q: Array, place: float) -> dict[str, Array]:
        """Every quantity by its name, for layers at eta = ``place`` T."""
        before, after, thin = geometry(self.before, p, q), geometry(self.after, p, q), self.stretch(p, q)
        out: dict[str, Array] = {}
        layers = []
        for name, surface, points, height in (
            ("reference", before, self.before, 0 * thin + place * self.thickness),
            ("deformed", after, self.after, place * self.thickness * thin),
        ):
            n_slopes = np.stack([slope(partial(normal, points), p, q, i) for i in range(2)], axis=1)
            tangents = surface.tangents + height[:, None, None] * n_slopes
            layers.append(tangents)
            named = _surface(surface, before) | _layer(surface, before, tangents)
            named |= self._faces(points, name == "deformed", p, q, place, before)
            for letter, number in (("1", 0), ("2", 1)):
                named[f"edge_normal_{letter}"] = _edge_normal(before, surface, number)
                if name == "deformed":
                    named[f"lateral_area_ratio_{letter}"] = named[f"lateral_area_ratio_{letter}"] * thin
            out |= {f"{key}_{name}": value for key, value in named.items()}
        return out | _between(before, after, layers, thin, self._thickness_slopes(p, q))

    def _thickness_slopes(self, p: Array, q: Array) -> Array:
        return np.stack([slope(self.stretch, p, q, i) for i in range(2)], axis=1)

    def _faces(
        self, points: Points, deformed: bool, p: Array, q: Array, place: float, before: Geometry
    ) -> dict[str, Array]:
        """Normal and area of the true layer, whose height varies with lambda; its area seen along n."""

        def moved(e: float, p: Array, q: Array) -> Array:
            height = e * self.thickness * (self.stretch(p, q) if deformed else np.ones_like(p))
            return np.asarray(points(p, q) + height[:, None] * normal(points, p, q))

        def area(e: float) -> Array:
            cross = np.cross(slope(partial(moved, e), p, q, 0), slope(partial(moved, e), p, q, 1))
            return np.asarray(cross / np.sqrt(np.linalg.det(before.metric))[:, None])

        out = {"face_normal": _unit(area(place)), "face_area_ratio": np.linalg.norm(area(place), axis=1)}
        for name, e in (("area_ratio", place), ("top_area_ratio", 0.5), ("bottom_area_ratio", -0.5)):
            out[name] = np.einsum("ni,ni->n", area(e), normal(points, p, q))
        return out


def _surface(s: Geometry, before: Geometry) -> dict[str, Array]:
    determinant = np.linalg.det(s.metric)
    contracted = np.stack(
        [s.christoffel[:, 0, 0] + s.christoffel[:, 1, 1], s.christoffel[:, 0, 1] + s.christoffel[:, 1, 2]]
    )
    inverse = np.linalg.inv(s.metric)
    return {
        "basis_1": s.tangents[:, 0],
        "basis_2": s.tangents[:, 1],
        "dual_basis_1": s.duals[:, 0],
        "dual_basis_2": s.duals[:, 1],
        "normal": s.normal,
        "projector": s.projector,
        "metric": np.einsum("nab,nai,nbj->nij", s.metric, before.duals, before.duals),
        "metric_components": s.metric,
        "metric_determinant": determinant,
        "contravariant_metric": np.einsum("nab,nai,nbj->nij", inverse, before.tangents, before.tangents),
        "contravariant_metric_components": inverse,
        "contravariant_metric_determinant": 1 / determinant,
        "metric_determinant_slope_1": 2 * determinant * contracted[0],
        "metric_determinant_slope_2": 2 * determinant * contracted[1],
        "christoffel": s.christoffel,
        "curvature": s.curvature,
        "curvature_components": s.second,
        "mixed_curvature_components": s.mixed,
        "mean_curvature": np.trace(s.mixed, axis1=1, axis2=2) / 2,
        "gauss_curvature": np.linalg.det(s.mixed),
        "edge_tangent_1": _unit(s.tangents[:, 0]),
        "edge_tangent_2": _unit(s.tangents[:, 1]),
    }


def _layer(s: Geometry, before: Geometry, tangents: Array) -> dict[str, Array]:
    """From the layer's tangents g_a = mu a_a: mu = g_a (x) a^a, and the rest from 3 x 3 inverses."""
    shifter = np.einsum("nai,naj->nij", tangents, s.duals)
    full = shifter + np.einsum("ni,nj->nij", s.normal, s.normal)
    duals = np.linalg.inv(np.concatenate([tangents, s.normal[:, None]], axis=1)).transpose(0, 2, 1)[:, :2]
    metric = tangents @ tangents.transpose(0, 2, 1)
    out = {
        "shifter": shifter,
        "shifter_inverse": np.linalg.inv(full) - np.einsum("ni,nj->nij", s.normal, s.normal),
        "shifter_determinant": np.linalg.det(full),
        "layer_basis_1": tangents[:, 0],
        "layer_basis_2": tangents[:, 1],
        "layer_dual_basis_1": duals[:, 0],
        "layer_dual_basis_2": duals[:, 1],
        "layer_metric_components": metric,
        "layer_contravariant_metric_components": np.linalg.inv(metric),
    }
    for letter, number in (("1", 0), ("2", 1)):
        length = np.linalg.norm(tangents[:, number], axis=1)
        out[f"lateral_area_ratio_{letter}"] = length / np.linalg.norm(before.tangents[:, number], axis=1)
        out[f"lateral_tangent_{letter}"] = _unit(tangents[:, number])
        out[f"lateral_normal_{letter}"] = np.cross(_unit(tangents[:, number]), s.normal)
    return out


def _edge_normal(before: Geometry, surface: Geometry, number: int) -> Array:
    """nu_a a^a with nu = tau x N."""
    nu = np.cross(_unit(before.tangents[:, number]), before.normal)
    return np.asarray(np.einsum("ni,nai,naj->nj", nu, before.tangents, surface.duals))


def _between(before: Geometry, after: Geometry, layers: list[Array], thin: Array, slopes: Array) -> dict[str, Array]:
    """What relates both configurations, from F G_a = g_a and F N = lambda n."""
    source = np.concatenate([layers[0], before.normal[:, None]], axis=1).transpose(0, 2, 1)
    image = np.concatenate([layers[1], (thin[:, None] * after.normal)[:, None]], axis=1).transpose(0, 2, 1)
    gradient = image @ np.linalg.inv(source)
    areas = [np.linalg.norm(np.cross(t[:, 0], t[:, 1]), axis=1) for t in layers]
    ratio = np.linalg.det(after.metric) / np.linalg.det(before.metric)
    return {
        "metric_determinant_ratio": ratio,
        "surface_stretch": np.sqrt(ratio),
        "thickness_stretch_gradient": np.einsum("na,nai->ni", slopes, before.duals),
        "layer_stretch": areas[1] / areas[0],
        "volume_ratio": np.linalg.det(gradient),
        "deformation_gradient": gradient,
        "inverse_deformation_gradient": np.linalg.inv(gradient),
        "cauchy_green": gradient.transpose(0, 2, 1) @ gradient,
    }


def _unit(vectors: Array) -> Array:
    return np.asarray(vectors / np.linalg.norm(vectors, axis=1)[:, None])
