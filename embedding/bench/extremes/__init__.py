"""The map of extremes: scenes pushed until something gives, each cell held against a reference nobody here made up.

``embedding bench extremes`` prints it; docs/extremes.md has it.
"""

from embedding.bench.extremes.cell import FAILED, REFUSED, RIGHT, TOLD, WRONG, Cell, Finding
from embedding.bench.extremes.families import FAMILIES, cells_of
from embedding.bench.extremes.judging import judge
from embedding.bench.extremes.running import find

__all__ = ["FAILED", "FAMILIES", "REFUSED", "RIGHT", "TOLD", "WRONG", "Cell", "Finding", "cells_of", "find", "judge"]
