"""Solving a scene: load and volume control, Newton's method, typed results, listeners."""

from embedding.solving.driver import run
from embedding.solving.events import Field, Iteration, Listener, StepRecord
from embedding.solving.result import Result
from embedding.solving.solution import Cost, ErrorEstimate, Solution

__all__ = [
    "Cost",
    "ErrorEstimate",
    "Field",
    "Iteration",
    "Listener",
    "Result",
    "Solution",
    "StepRecord",
    "run",
]
