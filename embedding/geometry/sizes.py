"""What is asked of a mesh: element sizes, grading and order; all lengths relative to the size of the shape."""

from __future__ import annotations

from dataclasses import dataclass

from embedding.geometry.bodies import Body

AT_POINTS = 16
"""The moment under a force grows with the logarithm of the distance: no order of the elements helps, only their
size."""


@dataclass(frozen=True)
class MeshSizes:
    """Dimensionless mesh request: sizes on the shell and far away, the ambient's radius (0: no ambient), grading.

    ``edges`` holds smaller sizes along named edges of the shell, from which elements grow as ``grading`` allows.
    Around ``points`` of a surface, where a force acts on a shell that bends, elements are ``AT_POINTS`` times smaller.
    The ambient ends at ``radius`` around its ``centre``, or at a ``box`` of these half edge lengths; ``beyond`` it a
    mapped region may stand for the rest of space. ``bodies`` lie in it.
    """

    shell: float
    far: float
    radius: float
    grading: float
    order: int
    edges: tuple[tuple[str, float], ...] = ()
    points: tuple[tuple[float, ...], ...] = ()
    beyond: bool = False
    box: tuple[float, ...] | None = None
    bodies: tuple[Body, ...] = ()

    @property
    def potential_order(self) -> int:
        """Order of the potential: one above the shell's.

        The field's energy enters the Lagrangian with a minus sign. At equal order a distorted mesh overestimates it by
        more than a soft membrane can afford, and creases that do not exist gain energy.
        """
        return self.order + 1

    def centre(self, dimension: int) -> tuple[float, ...]:
        """Of the sphere where the ambient ends: the origin, or below it on the surface of a half-space, so that this
        surface consists of rays."""
        levels = [body.level for body in self.bodies if body.kind == "half-space"]
        return (0.0,) * (dimension - 1) + (levels[0] if levels and self.box is None else 0.0,)

    def along(self, edge: str) -> float:
        """Element size along the edge ``edge``, never more than on the shell."""
        return min(self.shell, dict(self.edges).get(edge, self.shell))
