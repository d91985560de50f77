"""Random valid scenes: shapes, laws, thicknesses, sizes, moduli, loads and fields, in plain numbers.

Loads are drawn as parts of what the wall carries, so that every scene has an answer: pressures below the limit point,
fields whose stress is below it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, Literal

from hypothesis import strategies as st

from embedding import (
    Ambient,
    Disc,
    Discretisation,
    Electrode,
    Faces,
    Gent,
    InfiniteCylinder,
    Loads,
    Model,
    MooneyRivlin,
    NeoHookean,
    Scene,
    Shell,
    Solver,
    Sphere,
    Stage,
    Support,
)
from embedding.scene import EPSILON_0

Kind = Literal["sphere", "tube", "disc"]
Field = Literal["none", "voltage", "charge", "applied"]


@dataclass(frozen=True)
class Drawn:
    """A scene in numbers: lengths in m, ``modulus`` in Pa, ``thinness`` the thickness over the size.

    ``pressure`` is over that at which a wall of that thinness would be strained by its own modulus; ``strength`` is the
    field's stress over that pressure.
    """

    kind: Kind
    field: Field
    law: Literal["neo-hookean", "mooney-rivlin", "gent"]
    size: float
    modulus: float
    thinness: float
    pressure: float
    strength: float
    permittivity: float = 4.0
    order: int = 2
    shell_size: float = 0.25
    reduction: str = "auto"
    sign: float = 1.0
    swapped: bool = False
    direction: tuple[float, float, float] = (0.0, 0.0, 1.0)
    tolerance: float = 1e-11

    def but(self, **changes: Any) -> Drawn:
        """With some numbers replaced."""
        return replace(self, **changes)

    @property
    def stress(self) -> float:
        """Pressure in Pa that strains the wall by about one."""
        return self.modulus * self.thinness

    @property
    def applied(self) -> float:
        """Field whose Maxwell stress is ``strength`` of that pressure, in V/m."""
        return self.sign * math.sqrt(2.0 * self.strength * self.stress / EPSILON_0)

    @property
    def voltage(self) -> float:
        """Voltage of a shell with that field at its face, in V."""
        return self.applied * self.size

    def material(self) -> Any:
        """The law of the wall."""
        if self.law == "neo-hookean":
            return NeoHookean(shear_modulus=self.modulus)
        if self.law == "mooney-rivlin":
            return MooneyRivlin(c1=0.4 * self.modulus, c2=0.1 * self.modulus)
        return Gent(shear_modulus=self.modulus, limit=30.0)

    def scene(self) -> Scene:
        """As the software takes it."""
        shape: Any = {"sphere": Sphere, "tube": InfiniteCylinder, "disc": Disc}[self.kind](radius=self.size)
        pressure = {"pressure_top" if self.swapped else "pressure_bottom": self.pressure * self.stress}
        extra: dict[str, Any] = {}
        dielectric: dict[str, Any] = {}
        still: dict[str, Any] = {} if self.field == "none" else {"field": 0.0}
        if self.kind == "disc":
            extra["supports"] = (Support(where="rim", fix=("x", "y", "z")),)
        if self.field in ("voltage", "charge"):
            given = (
                {"voltage": self.voltage}
                if self.field == "voltage"
                else {"charge": 4.0 * math.pi * EPSILON_0 * self.voltage * self.size}
            )
            extra["faces"] = Faces(both=Electrode(**given))
            extra["ambient"] = Ambient(field="electric")
        elif self.field == "applied":
            extra["ambient"] = Ambient(
                field="electric", applied_field=tuple(self.applied * part for part in self.direction)
            )
            dielectric = {"relative_permittivity": self.permittivity}
        return Scene(
            shell=Shell(shape=shape, thickness=self.thinness * self.size, material=self.material(), **dielectric),
            loads=Loads(**pressure),
            model=Model(reduction=self.reduction),
            path=(Stage(name="inflate", steps=2, **still), Stage(name="field", steps=2))[: 2 if still else 1],
            discretisation=Discretisation(order=self.order, shell_size=self.shell_size * self.size),
            solver=Solver(tolerance=self.tolerance),
            **extra,
        )


def decades(low: int, high: int) -> st.SearchStrategy[float]:
    """Numbers of all sizes between powers of ten."""
    return st.floats(low, high).map(lambda power: round(10.0**power, 12 - math.floor(power)))


FIELDS: dict[Kind, tuple[Field, ...]] = {
    "sphere": ("none", "voltage", "charge", "applied"),
    "tube": ("none", "applied"),
    "disc": ("none",),
}


@st.composite
def scenes(draw: Any, kinds: tuple[Kind, ...] = ("sphere", "tube", "disc"), fields: tuple[Field, ...] = ()) -> Drawn:
    """Scenes of those ``kinds`` with one of those ``fields``, all they can have if none are given."""
    kind = draw(st.sampled_from(kinds))
    field = draw(st.sampled_from([field for field in FIELDS[kind] if not fields or field in fields]))
    return Drawn(
        kind=kind,
        direction=(1.0, 0.0, 0.0) if kind == "tube" else (0.0, 0.0, 1.0),
        field=field,
        law=draw(st.sampled_from(["neo-hookean", "mooney-rivlin", "gent"])),
        size=draw(decades(-5, 1)),
        modulus=draw(decades(2, 9)),
        thinness=draw(decades(-4, -1)),
        pressure=draw(st.floats(0.3, 0.7)) * (0.6 if kind == "tube" else 1.0),
        strength=draw(st.floats(0.01, 0.1)) * (0.3 if field == "applied" else 1.0),
        permittivity=draw(st.floats(1.5, 20.0)),
    )
