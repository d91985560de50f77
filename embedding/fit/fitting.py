"""Least squares between a law and tests of a material, from several starts, with what the data leave open."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
from scipy.optimize import OptimizeResult, least_squares

from embedding.errors import SceneError
from embedding.fit.errors import FitError
from embedding.fit.families import FITTED, Family, families
from embedding.fit.measurements import Measurements, Mode, Series
from embedding.fit.stress import nominal_stress
from embedding.scene import Material
from embedding.scene.messages import choice
from embedding.shell.laws import Law, law_of

Array = npt.NDArray[Any]
SEED = 19720524  # the starts are the same in every run
SCREENING, FINAL = 200, 20000
"""Evaluations spent on each start, and on the best of them."""
TOLERANCE = 1e-14
UNFELT = 1e-6
"""A parameter lies on the limit of what is allowed if going there changes the stresses by less, in their scale."""
LOST = 1e-13
"""Singular values of the sensitivity, its columns of length one, below this part of the largest are rounding."""
MAX_TERMS = 6


@dataclass(frozen=True)
class Parameter:
    """``value`` and standard ``uncertainty`` of one parameter in ``unit``; infinite where the data say nothing."""

    name: str
    value: float
    uncertainty: float
    unit: str


@dataclass(frozen=True)
class Doubt:
    """A parameter not to be relied on: the data do not determine it, or it lies on the limit of what is allowed."""

    parameter: str
    reason: Literal["undetermined", "at-limit"]

    @property
    def message(self) -> str:
        """The same for people, with advice."""
        if self.reason == "undetermined":
            advice = "add another kind of test or larger stretches, or take a law with fewer parameters"
            return f"{self.parameter} is not determined by these data: {advice}"
        return f"{self.parameter} lies on the limit of what is allowed: these data ask for another law"


@dataclass(frozen=True)
class ModeError:
    """How far the law is from one kind of test: ``rms`` in Pa, and the largest error over the measured stress."""

    mode: Mode
    points: int
    rms: float
    largest_relative: float


@dataclass(frozen=True)
class Fit:
    """The ``material`` nearest to the measurements among those of its law, and how well it is known."""

    material: Material
    parameters: tuple[Parameter, ...]
    errors: tuple[ModeError, ...]
    doubts: tuple[Doubt, ...]
    measurements: Measurements

    @property
    def rms(self) -> float:
        """Root of the mean squared error over all points, in Pa."""
        return rms(self.material, self.measurements)


def fit_law(law: str, measurements: Measurements, *, terms: int = 3, relative: bool = False) -> Fit:
    """Fit the law named ``law`` ("neo-hookean", "mooney-rivlin", "yeoh", "gent" or "ogden" with ``terms`` terms).

    The sum of squared errors of the nominal stress is made least, or with ``relative`` that of the errors over the
    measured stress. Only materials that a scene accepts are searched; Ogden's terms are kept stable each.
    Uncertainties are standard ones, from the covariance of the linearised problem.

    Raises:
        FitError: no such law, terms out of range, or no more points than parameters.
    """
    searches = families(law, terms, max(_largest_excess(series) for series in measurements.series))
    if law not in FITTED:
        raise FitError(f"law: {choice(law, FITTED)}")
    if not 1 <= terms <= MAX_TERMS:
        raise FitError(f"terms: {terms} is not allowed: must be at least 1 and at most {MAX_TERMS}")
    count = len(searches[0].names)
    problem = _Problem(measurements, relative)
    if problem.count <= count:
        reason = f"{problem.count} points with stress cannot determine {count} parameters"
        raise FitError(f"{reason}: measure more, or take a law with fewer parameters")
    family, variables = _best(problem, searches)
    return _report(problem, family, variables)


class _Problem:
    """Residuals of a law, in stress scales of the data or relative to each point."""

    def __init__(self, measurements: Measurements, relative: bool) -> None:
        self.measurements = measurements
        stresses = np.concatenate([series.nominal_stress for series in measurements.series])
        self.scale = float(np.sqrt(np.mean(stresses**2)))
        if self.scale == 0.0:
            raise FitError("nominal_stress: all are 0: there is nothing to fit")
        self.weights = [self._weights(series, relative) for series in measurements.series]
        moved = [series.stretch != 1.0 for series in measurements.series]  # at rest every law is right
        self.count = int(sum((weight[at] > 0.0).sum() for weight, at in zip(self.weights, moved, strict=True)))

    def _weights(self, series: Series, relative: bool) -> Array:
        size = np.abs(series.nominal_stress)
        if not relative:
            return np.ones_like(size)
        return np.divide(self.scale, size, out=np.zeros_like(size), where=size > 0.0)

    def residual(self, law: Law) -> Array:
        """One row a point."""
        rows = [
            weight * (nominal_stress(law, series.mode, series.stretch) - series.nominal_stress / self.scale)
            for series, weight in zip(self.measurements.series, self.weights, strict=True)
        ]
        return np.concatenate(rows)

    def jacobian(self, law_at: Callable[[Array], Law], place: Array) -> Array:
        """Derivatives of the residual by what the law depends on; by complex steps, which lose no digits."""
        steps = place + 1e-30j * np.eye(len(place))
        return np.array([self.residual(law_at(step)).imag / 1e-30 for step in steps]).T


def _best(problem: _Problem, searches: list[Family]) -> tuple[Family, Array]:
    random = np.random.default_rng(SEED)
    found = [
        (family, _descend(problem, family, start, SCREENING))
        for family in searches
        for start in family.starts(random)
    ]
    family, best = min(found, key=lambda pair: float(pair[1].cost))
    return family, family.tidied(np.asarray(_descend(problem, family, best.x, FINAL).x))


def _descend(problem: _Problem, family: Family, start: Array, evaluations: int) -> OptimizeResult:
    low, high = family.box()
    margin = 1e-10 * np.maximum(1.0, np.abs(low))

    def residual(variables: Array) -> Array:
        return problem.residual(family.law_at(variables))

    with np.errstate(over="ignore", invalid="ignore"):
        return least_squares(
            residual, np.clip(start, low + margin, high - margin), jac="cs", bounds=(low, high), x_scale="jac",
            ftol=TOLERANCE, xtol=TOLERANCE, gtol=TOLERANCE, max_nfev=evaluations,
        )  # fmt: skip


def _report(problem: _Problem, family: Family, variables: Array) -> Fit:
    variables, at_limit = _settled(problem, family, variables)
    parameters = family.parameters(variables)
    spread = _uncertainty(problem, family, parameters)
    units = problem.scale ** np.array(family.powers)
    values = units * parameters
    named, doubts = [], []
    for i, name in enumerate(family.names):
        unit = "Pa" if family.powers[i] else "1"
        named.append(Parameter(name, float(values[i]), float(units[i] * spread[i]), unit))
        if at_limit[i]:
            doubts.append(Doubt(name, "at-limit"))
        elif not spread[i] <= abs(parameters[i]):
            doubts.append(Doubt(name, "undetermined"))
    try:
        material = family.material(values)
    except SceneError as error:
        raise FitError(f"no admissible material of this law is near these data: {error}") from error
    errors = tuple(_mode_error(material, series) for series in problem.measurements.series)
    return Fit(material, tuple(named), errors, tuple(doubts), problem.measurements)


def _settled(problem: _Problem, family: Family, variables: Array) -> tuple[Array, Array]:
    """The variables, those next to a limit put onto it, and which ones."""
    low, high = family.box()
    effect = np.linalg.norm(problem.jacobian(family.law_at, variables), axis=0)
    below, above = (variables - low) * effect < UNFELT, (high - variables) * effect < UNFELT
    return np.where(below, low, np.where(above, high, variables)), below | above


def _uncertainty(problem: _Problem, family: Family, parameters: Array) -> Array:
    """Standard uncertainties: square roots of the diagonal of s^2 (J^T J)^-1, infinite in directions J does not see."""
    residual = problem.residual(family.law(parameters))
    sensitivity = problem.jacobian(family.law, parameters)
    norms = np.linalg.norm(sensitivity, axis=0)
    sizes = 1.0 / np.where(norms > 0.0, norms, 1.0)
    _, singular, directions = np.linalg.svd(sensitivity * sizes, full_matrices=False)
    seen = singular > LOST * singular[0]
    variance = float(residual @ residual) / (problem.count - len(parameters))
    known = variance * ((directions[seen] / singular[seen, None]) ** 2).sum(axis=0)
    lost = (directions[~seen] ** 2).sum(axis=0) > 1e-12
    return np.where(lost, np.inf, sizes * np.sqrt(known))


def _largest_excess(series: Series) -> float:
    """Largest I1 - 3 of a series."""
    stretch = series.stretch
    second = {"uniaxial": stretch**-0.5, "equibiaxial": stretch, "pure-shear": np.ones_like(stretch)}[series.mode]
    return float((stretch**2 + second**2 + (stretch * second) ** -2 - 3).max())


def stress_of(material: Material, mode: Mode, stretch: Any) -> Any:
    """Nominal stress of a material in Pa; see `nominal_stress`."""
    return nominal_stress(law_of(material, 1.0), mode, stretch)


def rms(material: Material, measurements: Measurements) -> float:
    """Root of the mean squared error of the nominal stress of a ``material`` over all points, in Pa."""
    misses = [stress_of(material, s.mode, s.stretch) - s.nominal_stress for s in measurements.series]
    return float(np.sqrt(np.mean(np.concatenate(misses) ** 2)))


def _mode_error(material: Material, series: Series) -> ModeError:
    miss = stress_of(material, series.mode, series.stretch) - series.nominal_stress
    size, loaded = np.abs(series.nominal_stress), series.nominal_stress != 0.0
    largest = float((np.abs(miss)[loaded] / size[loaded]).max()) if loaded.any() else 0.0
    return ModeError(series.mode, len(miss), float(np.sqrt(np.mean(miss**2))), largest)
