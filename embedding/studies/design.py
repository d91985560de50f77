"""The design of a study: which values its parameters take together, case by case."""

from __future__ import annotations

import itertools
import math
from typing import Any

from pydantic_core import PydanticCustomError

from embedding.errors import Problem, SceneError
from embedding.scene.messages import show
from embedding.scene.units import Number
from embedding.studies.parameters import number_at
from embedding.studies.study import Grid, LatinHypercube, Study


def designed(study: Study) -> list[dict[str, Any]]:
    """The stated value of every parameter, for each case in the order of the table.

    Raises:
        SceneError: bounds of what is no number in the scene, or that are wrong.
    """
    if isinstance(study.design, LatinHypercube):
        return _sampled(study, study.design)
    axes = study.axes if isinstance(study.design, Grid) else (tuple(study.parameters),)
    columns = [list(zip(*(study.parameters[path] for path in axis), strict=True)) for axis in axes]
    rows = []
    for row in itertools.product(*columns):
        stated = dict(zip(itertools.chain(*axes), itertools.chain(*row), strict=True))
        rows.append({path: stated[path] for path in study.parameters})
    return rows


def neighbours(study: Study) -> list[int | None]:
    """For each case of a continuation the number of the one before it along the parameter, None for the first ones;
    empty for other studies. A number is always less than that of its case."""
    design = study.design
    if not isinstance(design, Grid) or design.along is None:
        return []
    counts = [len(study.parameters[axis[0]]) for axis in study.axes]
    axis = next(number for number, paths in enumerate(study.axes) if design.along in paths)
    stride = math.prod(counts[axis + 1 :])
    return [number - stride if number // stride % counts[axis] else None for number in range(math.prod(counts))]


def _sampled(study: Study, design: LatinHypercube) -> list[dict[str, Any]]:
    import numpy as np
    from scipy.stats import qmc

    numbers, problems = [], []
    for path, bounds in study.parameters.items():
        try:
            numbers.append(_bounded(number_at(study.scene, path), bounds))
        except ValueError as error:
            problems.append(Problem(f"parameters.{path}", str(error)))
    if problems:
        raise SceneError(problems)
    sampler = qmc.LatinHypercube(len(numbers), rng=np.random.default_rng(design.seed))
    rows = sampler.random(design.samples).tolist()
    return [
        {path: _between(*bounds, part) for path, bounds, part in zip(study.parameters, numbers, row, strict=True)}
        for row in rows
    ]


def _bounded(number: Number | None, bounds: dict[str, Any]) -> tuple[float, float, bool]:
    """Both bounds in SI units, and whether only whole numbers lie between."""
    if number is None:
        raise ValueError("a latin hypercube needs a path to a number that the scene states")
    found = []
    for name, value in bounds.items():
        try:
            found.append(number(value))
        except PydanticCustomError as error:
            shown = show(value, number.unit or "")
            raise ValueError(f"{name} = {shown} is not allowed: {(error.context or {})['reason']}") from None
    low, high = (found[list(bounds).index(name)] for name in ("low", "high"))
    if low >= high:
        raise ValueError(f"low = {show(low)} is not allowed: must be less than high = {show(high)}")
    return low, high, number.whole


def _between(low: float, high: float, whole: bool, part: float) -> float | int:
    """The number at ``part``, from 0 to 1, of the way."""
    return math.floor(low + part * (high - low + 1)) if whole else low + part * (high - low)
