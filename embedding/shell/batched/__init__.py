"""Bent surfaces, many elements at once: ``membrane`` and ``bending.surface`` with derivatives in closed form.

The symbolic forms stay the definition, and serve what is not supported here. Each array has the elements along its last
axis, so that one operation serves all of them, and what differs from point to point is joined with the shape functions
by products of large matrices. Tensors are given by components in the coordinates of the reference triangle.
"""

from embedding.shell.batched.elements import ShellElements, Spaces, supported

__all__ = ["ShellElements", "Spaces", "supported"]
