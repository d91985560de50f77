"""Solving a scene: paths by arc length, load, volume or displacement, critical points, typed results, listeners."""

from embedding.solving.assumptions import raised
from embedding.solving.driver import run
from embedding.solving.events import Field, Iteration, Listener, StepRecord
from embedding.solving.result import Result
from embedding.solving.solution import Assumption, Cost, CriticalPoint, ErrorEstimate, Solution

__all__ = [
    "Assumption",
    "Cost",
    "CriticalPoint",
    "ErrorEstimate",
    "Field",
    "Iteration",
    "Listener",
    "Result",
    "Solution",
    "StepRecord",
    "raised",
    "run",
]
