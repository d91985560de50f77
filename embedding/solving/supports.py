"""The supports of a scene, as components held at places of a mesh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from embedding.errors import Problem, SceneError
from embedding.geometry.domain import Domain
from embedding.geometry.places import CLOSE, Place, corner
from embedding.geometry.positions import reference_positions
from embedding.scene import Scales, Scene, Support
from embedding.shell.edges import conormal, edge_mean

SQUARE = 0.99
"""Mean square of the cosine between conormal and axis from which on they count as parallel; a mesh is not exact."""


@dataclass(frozen=True)
class Held:
    """What the supports hold: (place, component) pairs, those with a displacement, and clamped edges."""

    components: tuple[tuple[Place, int], ...]
    prescribed: tuple[tuple[Place, int, float], ...]
    clamped: tuple[str, ...]


def held_by_supports(scene: Scene, domain: Domain, scales: Scales) -> Held:
    """The supports of ``scene`` on ``domain``; displacements in shell sizes at full strength.

    Raises:
        SceneError: a point without a corner of the shape, or an edge of symmetry that is not in a plane across an axis.
    """
    components: list[tuple[Place, int]] = []
    prescribed: list[tuple[Place, int, float]] = []
    problems: list[Problem] = []
    meshed = [(n, support) for n, support in enumerate(scene.supports) if _is_meshed(support, domain)]
    for number, support in meshed:
        place = _place(support, domain, scales)
        if not isinstance(place, str) and corner(domain, place) is None:
            problems.append(_no_corner(number, support))
            continue
        axes: list[str] = [direction for direction in support.held if direction != "rotation"]
        if support.kind == "symmetry":
            axis = _axis_across(domain, str(support.where))
            if axis is None:
                problems.append(_no_plane(number, support))
                continue
            axes = [axis]
        for axis in axes:
            shift = support.displacement["xyz".index(axis)] / scales.length
            for component in domain.reduction.components(axis):
                components.append((place, component))
                if shift != 0.0:
                    prescribed.append((place, component, shift))
    if problems:
        raise SceneError(problems)
    clamped = tuple(str(support.where) for _, support in meshed if "rotation" in support.held)
    return Held(tuple(components), tuple(prescribed), clamped)


def _is_meshed(support: Support, domain: Domain) -> bool:
    """Is its place in the meshed part? An edge beyond a mirror plane has its image there, held by another support."""
    beyond = domain.reduction.planes and isinstance(support.where, str) and support.where != "surface"
    return not beyond or support.where in domain.mesh.GetBBoundaries()


def _place(support: Support, domain: Domain, scales: Scales) -> Place:
    if isinstance(support.where, str):
        return support.where
    return tuple(c / scales.length for c in domain.reduction.project(support.where))


def _axis_across(domain: Domain, edge: str) -> str | None:
    """The axis across the plane in which the reference shell ends square at ``edge``, or None."""
    numbers = {v.nr for element in domain.mesh.BBoundaries(edge).Elements() for v in element.vertices}
    places = reference_positions(domain.mesh)[sorted(numbers)]
    outward = conormal(domain)
    for i, axis in enumerate(domain.reduction.axes):
        in_plane = np.ptp(places[:, i]) < CLOSE
        square = edge_mean(domain, edge, outward[i] * outward[i]) > SQUARE
        if axis != "r" and in_plane and square:
            return axis
    return None


def _no_corner(number: int, support: Support) -> Problem:
    reason = "must be a corner of the shape: there is no vertex of the mesh"
    return Problem(f"supports.{number}.where", f"{list(support.where)} is not allowed: {reason}")


def _no_plane(number: int, support: Support) -> Problem:
    reason = f'the shell does not end square in a plane across the x, y or z axis at "{support.where}"'
    return Problem(f"supports.{number}.kind", f'"symmetry" is not allowed: {reason}')
