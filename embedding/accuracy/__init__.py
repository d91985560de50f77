"""The accuracy dial: mesh, order and models are raised until the error estimate meets what a scene asks for."""

from embedding.accuracy.dial import solve_to_accuracy

__all__ = ["solve_to_accuracy"]
