"""The laws that can be fitted: their parameters, the admissible ones, and where a search begins.

A search moves in variables of its own, stresses counted in a scale of the data, in which the admissible parameters are
a box; ``parameters`` turns them into those of the law. Both are arrays, real or complex.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from embedding.scene import Gent, Material, MooneyRivlin, NeoHookean, Ogden, Yeoh
from embedding.shell.laws import GentLaw, Law, MooneyRivlinLaw, OgdenLaw, YeohLaw

Array = npt.NDArray[Any]
LEAST = 1e-9
"""Smallest value, in stress scales, of a parameter that must be positive."""


class Family(ABC):
    """A law with free parameters; ``names`` and ``powers`` (1: a stress, 0: a plain number) describe each of them."""

    names: tuple[str, ...]
    powers: tuple[int, ...]

    @abstractmethod
    def law(self, parameters: Array) -> Law:
        """The law with these parameters."""

    @abstractmethod
    def material(self, parameters: Array) -> Material:
        """The same as a material of a scene, stresses in Pa."""

    @abstractmethod
    def box(self) -> tuple[Array, Array]:
        """Least and largest values of the variables."""

    def parameters(self, variables: Array) -> Array:
        """Parameters of the law at some variables."""
        return variables

    def law_at(self, variables: Array) -> Law:
        """The law at some variables."""
        return self.law(self.parameters(variables))

    def tidied(self, variables: Array) -> Array:
        """The same law, its terms in a fixed order."""
        return variables

    def starts(self, random: np.random.Generator) -> list[Array]:
        """Variables to start from, in stress scales."""
        return [10.0 ** random.uniform(-2.0, 0.5, len(self.names)) for _ in range(4)]


class NeoHookeanFamily(Family):
    names, powers = ("shear_modulus",), (1,)

    def law(self, parameters: Array) -> Law:
        return MooneyRivlinLaw(parameters[0] / 2)

    def material(self, parameters: Array) -> Material:
        return NeoHookean(shear_modulus=float(parameters[0]))

    def box(self) -> tuple[Array, Array]:
        return np.array([LEAST]), np.array([np.inf])


class MooneyRivlinFamily(Family):
    names, powers = ("c1", "c2"), (1, 1)

    def law(self, parameters: Array) -> Law:
        return MooneyRivlinLaw(*parameters)

    def material(self, parameters: Array) -> Material:
        return MooneyRivlin(c1=float(parameters[0]), c2=float(parameters[1]))

    def box(self) -> tuple[Array, Array]:
        return np.array([LEAST, 0.0]), np.array([np.inf, np.inf])


class YeohFamily(Family):
    """Variables (c1, c2 + sqrt(3 c1 c3), c3), so that the least admissible c2 is a side of the box."""

    names, powers = ("c1", "c2", "c3"), (1, 1, 1)

    def law(self, parameters: Array) -> Law:
        return YeohLaw(*parameters)

    def material(self, parameters: Array) -> Material:
        c1, c2, c3 = (float(p) for p in parameters)
        return Yeoh(c1=c1, c2=c2, c3=c3)

    def box(self) -> tuple[Array, Array]:
        return np.array([LEAST, LEAST, LEAST**2]), np.full(3, np.inf)

    def parameters(self, variables: Array) -> Array:
        c1, above, c3 = variables
        return np.array([c1, above - np.sqrt(3.0 * c1 * c3), c3])


@dataclass
class GentFamily(Family):
    """Variables (mu, x / Jm) with x the largest I1 - 3 of the data, which the limit must exceed."""

    largest: float
    names, powers = ("shear_modulus", "limit"), (1, 0)

    def law(self, parameters: Array) -> Law:
        return GentLaw(*parameters)

    def material(self, parameters: Array) -> Material:
        return Gent(shear_modulus=float(parameters[0]), limit=float(parameters[1]))

    def box(self) -> tuple[Array, Array]:
        return np.array([LEAST, 1e-4]), np.array([np.inf, 1.0 - 1e-6])

    def parameters(self, variables: Array) -> Array:
        return np.array([variables[0], self.largest / variables[1]])

    def starts(self, random: np.random.Generator) -> list[Array]:
        return [np.array([0.3, share]) for share in (0.05, 0.3, 0.8, 0.97)]


class OgdenFamily(Family):
    """Variables (mu_p alpha_p / 2, alpha_p) a term, with the sign of each exponent fixed in a search.

    Every term is kept stable on its own (mu_p alpha_p >= 0), which makes the law so (Hill; Ogden 1972).
    """

    def __init__(self, signs: Sequence[int]) -> None:
        self.signs = np.array(signs, float)
        terms = range(len(signs))
        self.names = (*(f"moduli.{p}" for p in terms), *(f"exponents.{p}" for p in terms))
        self.powers = (*(1 for _ in terms), *(0 for _ in terms))

    def law(self, parameters: Array) -> Law:
        moduli, exponents = np.split(parameters, 2)
        return OgdenLaw(tuple(moduli), tuple(exponents))

    def material(self, parameters: Array) -> Material:
        moduli, exponents = np.split(parameters, 2)
        return Ogden(moduli=tuple(map(float, moduli)), exponents=tuple(map(float, exponents)))

    def box(self) -> tuple[Array, Array]:
        """Exponents from 0.1 to 20 in size: beyond, a power is not told from a logarithm or from a wall."""
        least, largest = np.where(self.signs > 0, 0.1, -20.0), np.where(self.signs > 0, 20.0, -0.1)
        return np.concatenate([0 * self.signs, least]), np.concatenate([np.inf + 0 * self.signs, largest])

    def parameters(self, variables: Array) -> Array:
        weights, exponents = np.split(variables, 2)
        return np.concatenate([2.0 * weights / exponents, exponents])

    def tidied(self, variables: Array) -> Array:
        """Smaller exponents first among those of one sign."""
        weights, exponents = np.split(variables, 2)
        order = np.lexsort((np.abs(exponents), -self.signs))
        return np.concatenate([weights[order], exponents[order]])

    def starts(self, random: np.random.Generator) -> list[Array]:
        """Exponents spread over the box, the smallest with the largest weight."""
        found = []
        for _ in range(6):
            sizes = np.sort(10.0 ** random.uniform(-0.3, 0.9, len(self.signs)))
            found.append(np.concatenate([0.5 * 10.0 ** -np.arange(len(sizes), dtype=float), self.signs * sizes]))
        return found


def families(name: str, terms: int, largest_excess: float) -> list[Family]:
    """The searches that together cover the law ``name``; empty if there is no such law to fit."""
    match name:
        case "neo-hookean":
            return [NeoHookeanFamily()]
        case "mooney-rivlin":
            return [MooneyRivlinFamily()]
        case "yeoh":
            return [YeohFamily()]
        case "gent":
            return [GentFamily(largest_excess)]
        case "ogden":
            return [OgdenFamily([1] * (terms - negative) + [-1] * negative) for negative in range(terms + 1)]
    return []


FITTED = ("neo-hookean", "mooney-rivlin", "yeoh", "gent", "ogden")
"""Names of the laws that can be fitted."""
