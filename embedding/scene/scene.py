"""The scene: everything a user states about one computation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Self

from pydantic import BeforeValidator, ValidationInfo, model_validator

from embedding.errors import Problem, SceneError
from embedding.scene.accuracy import Accuracy, from_number
from embedding.scene.ambient import Ambient, Faces
from embedding.scene.checks import cross_problems
from embedding.scene.loads import Loads
from embedding.scene.messages import refusal
from embedding.scene.options import Discretisation, Model, Solver
from embedding.scene.output import Output
from embedding.scene.part import TOLERANT, Part, tolerant
from embedding.scene.path import Stage
from embedding.scene.shell import Shell
from embedding.scene.supports import Support
from embedding.scene.texts import Name


def _not_empty(value: Any) -> Any:
    if isinstance(value, (list, tuple)) and not value:
        raise refusal("must hold at least one stage")
    return value


class Scene(Part):
    """A shell, what acts on it, the space around it, and how the answer is computed.

    Raises:
        SceneError: on construction, listing every problem of every part and between the parts.
    """

    name: Name = "scene"
    shell: Shell
    supports: tuple[Support, ...] = ()
    loads: Loads = Loads()
    ambient: Ambient | None = None
    faces: Faces = Faces()
    path: Annotated[tuple[Stage, ...], BeforeValidator(_not_empty)] = (Stage(),)
    model: Model = Model()
    discretisation: Discretisation = Discretisation()
    solver: Solver = Solver()
    output: Output = Output()
    accuracy: Annotated[Accuracy | None, BeforeValidator(from_number)] = None

    @property
    def ramped(self) -> tuple[str, ...]:
        """The factors of the path that scale something here: "mechanical", "field" or both."""
        mechanical = self.loads.any or any(any(support.displacement) for support in self.supports)
        return ("mechanical",) * mechanical + ("field",) * (self.ambient is not None)

    @classmethod
    def from_toml(cls, text: str, source: str | None = None) -> Scene:
        """Read a scene from TOML text; ``source`` names it in errors.

        Raises:
            SceneError: not TOML, or not a scene.
        """
        from embedding.scene.toml_io import read_table

        return cls.from_table(read_table(text, source), source)

    @classmethod
    def from_table(cls, table: Mapping[str, Any], source: str | None = None) -> Scene:
        """Build a scene from nested tables; ``source`` names them in errors.

        Raises:
            SceneError: not a scene.
        """
        names = ", ".join(cls.model_fields)
        if not any(key in cls.model_fields for key in table):
            found = f"has none of the keys {names}" if table else "is empty"
            raise SceneError([Problem("", f"not a scene: it {found}")], source)
        try:
            return cls(**{str(key): value for key, value in table.items()})
        except SceneError as error:
            raise SceneError(error.problems, source) from None

    def to_toml(self) -> str:
        """The whole scene as TOML, defaults included; reading it back gives an equal scene."""
        from embedding.scene.toml_io import write_table

        return write_table(self._table())

    def with_overrides(self, overrides: Sequence[str]) -> Scene:
        """A copy with changes such as ``"shell.thickness=0.1 mm"``.

        Raises:
            SceneError: unknown key, or a value that does not fit.
        """
        from embedding.scene.overrides import apply_overrides

        return Scene.from_table(apply_overrides(self._table(), overrides))

    def _table(self) -> dict[str, Any]:
        return self.model_dump(mode="json", exclude_none=True)

    @classmethod
    def _further_problems(cls, data: Mapping[str, Any]) -> tuple[Problem, ...]:
        return cross_problems(cls.model_validate(dict(data), context=TOLERANT))

    @model_validator(mode="after")
    def _fits_together(self, info: ValidationInfo) -> Self:
        if tolerant(info):
            return self
        problems = cross_problems(self)
        if problems:
            raise SceneError(problems)
        return self
