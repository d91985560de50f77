"""A study: a scene, the parameters that change in it, and what is asked of every case. Checked when it is made."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, BeforeValidator, Discriminator, Tag, model_validator

from embedding.scene import Scene
from embedding.scene.messages import printable, refusal
from embedding.scene.options import Fixed
from embedding.scene.part import Part, kind_under
from embedding.scene.texts import Name
from embedding.scene.units import Number
from embedding.studies.parameters import are_bounds, stated_parameters
from embedding.studies.quantities import Quantity, stated_quantities

Count = Annotated[int, BeforeValidator(Number(whole=True, at_least=1, at_most=1024))]
Seconds = Annotated[float, BeforeValidator(Number("time", "s", "10 min", above=0.0))]

MOST_CASES = 100_000
"""Of a study: the scene of each is checked before the first is solved, which takes minutes for so many."""

RESERVED = ("case", "status", "reason", "start", "iterations", "seconds", "estimated_error")
"""Columns that every table has."""


class BaseScene:
    """Validator of the base scene; of a study file it has become a scene or its tables before."""

    allowed = 'must be the name of a scene file, such as "balloon.toml", or the tables of a scene'

    def __call__(self, value: Any) -> Any:
        if not isinstance(value, (Scene, Mapping)):
            raise refusal(self.allowed)
        return value


class Grid(Part):
    """Every combination of the parameters' values; the last parameter varies fastest.

    The paths of a list in ``together`` are one parameter: they take their first values together, then the second ones.
    ``along`` names the parameter of a continuation: cases that differ in it alone are a chain, each starting from the
    state of the one before.
    """

    kind: Literal["grid"] = "grid"
    together: tuple[tuple[str, ...], ...] = ()
    along: str | None = None


class Rows(Part):
    """The first values of all parameters, the second ones, and so on: lists of equal length."""

    kind: Literal["rows"] = "rows"


class LatinHypercube(Part):
    """``samples`` cases between the parameters' bounds: each parameter has one value in each of as many equal parts.

    The same ``seed`` gives the same cases (scipy.stats.qmc.LatinHypercube).
    """

    kind: Literal["latin-hypercube"] = "latin-hypercube"
    samples: Annotated[int, BeforeValidator(Number(whole=True, at_least=1, at_most=MOST_CASES))]
    seed: Annotated[int, BeforeValidator(Number(whole=True, at_least=0, at_most=2**31))] = 0


Design = Annotated[
    Annotated[Grid, Tag("grid")] | Annotated[Rows, Tag("rows")] | Annotated[LatinHypercube, Tag("latin-hypercube")],
    Discriminator(kind_under("kind")),
]


class Limits(Part):
    """What a case may take: ``seconds`` of wall time (None: any), and ``threads``.

    ``workers`` cases are solved at once, by default as many as there are processors for.
    """

    seconds: Seconds | None = None
    workers: Count | None = None
    threads: Count = 1


class Study(Part):
    """Cases that differ from ``scene`` in ``parameters``, combined by ``design``, and the ``quantities`` asked of each.

    ``parameters`` holds a list of values, or bounds ``{low, high}``, for each dotted path into the scene;
    ``quantities`` a text such as ``"voltage at limit"`` for each name.

    Raises:
        SceneError: on construction, listing every problem with the path of its field.
    """

    name: Name = "study"
    scene: Annotated[Scene, BeforeValidator(BaseScene())]
    parameters: Annotated[dict[str, Any], BeforeValidator(stated_parameters), AfterValidator(Fixed)]
    design: Design = Grid()
    quantities: Annotated[dict[str, str], BeforeValidator(stated_quantities), AfterValidator(Fixed)]
    limits: Limits = Limits()

    @property
    def wanted(self) -> dict[str, Quantity]:
        """The quantities by name."""
        return {name: Quantity.parse(text) for name, text in self.quantities.items()}

    @model_validator(mode="after")
    def _fits_together(self) -> Self:
        for name in self.quantities:
            if name in RESERVED or name in self.parameters:
                raise refusal(f"every table has a column {name} already", field=f"quantities.{name}", value=name)
        sampled = isinstance(self.design, LatinHypercube)
        first = next(iter(self.parameters.values()))
        for path, values in self.parameters.items():
            field = f"parameters.{path}"
            if are_bounds(values) and not sampled:
                reason = f'bounds are for a design of kind "latin-hypercube"; a "{self.design.kind}" needs a list'
                raise refusal(reason, field=field, value=values)
            if sampled and not are_bounds(values):
                raise refusal("a latin hypercube needs bounds { low = ..., high = ... }", field=field, value=values)
            if isinstance(self.design, Rows) and len(values) != len(first):
                reason = f"there are {len(values)} values, and {len(first)} of the first parameter; rows need as many"
                raise refusal(reason, field=field, value=values)
        if isinstance(self.design, Grid):
            self._together(self.design)
            self._along(self.design)
            count = math.prod(len(self.parameters[axis[0]]) for axis in self.axes)
            if count > MOST_CASES:
                reason = f"every combination makes {count:.0e} cases, and a study has at most {MOST_CASES}"
                raise refusal(reason, field="parameters", value=self.parameters)
        return self

    def _along(self, design: Grid) -> None:
        """Refuse a continuation along nothing, and what a case that has no path cannot tell."""
        if design.along is None:
            return
        if design.along not in self.parameters:
            reason = f"{printable(design.along)} is no parameter of the study"
            raise refusal(reason, field="design.along", value=design.along)
        for name, quantity in self.wanted.items():
            if quantity.place not in ("end", "last"):
                reason = 'a case that starts from its neighbour has an end and no path: ask for it "at end"'
                raise refusal(reason, field=f"quantities.{name}", value=self.quantities[name])

    def _together(self, design: Grid) -> None:
        """Refuse groups of parameters that cannot go together."""
        met: set[str] = set()
        for group in design.together:
            for path in group:
                if path not in self.parameters:
                    reason = f"{printable(path)} is no parameter of the study"
                    raise refusal(reason, field="design.together", value=group)
                if path in met:
                    raise refusal(f"{printable(path)} is named twice", field="design.together", value=group)
                met.add(path)
                if len(self.parameters[path]) != len(self.parameters[group[0]]):
                    first = len(self.parameters[group[0]])
                    counts = f"{len(self.parameters[path])} values, and {first} of {printable(group[0])}"
                    reason = f"there are {counts}; what goes together needs as many"
                    raise refusal(reason, field=f"parameters.{path}", value=self.parameters[path])

    @property
    def axes(self) -> tuple[tuple[str, ...], ...]:
        """The parameters of a grid by axis: those that go together are one, at the place of the first of them."""
        groups = self.design.together if isinstance(self.design, Grid) else ()
        home = {path: group for group in groups for path in group}
        return tuple(dict.fromkeys(home.get(path, (path,)) for path in self.parameters))

