"""Bending of the shell by the mixed method of Hellan, Herrmann and Johnson: on surfaces, and on curves."""

from embedding.shell.bending.curve import CurveBending
from embedding.shell.bending.stiffness import Stiffness
from embedding.shell.bending.surface import SurfaceBending

__all__ = ["CurveBending", "Stiffness", "SurfaceBending"]
