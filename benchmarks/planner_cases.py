"""Scenes with and without need of a term, by one parameter each; what the term is worth there, truly and estimated."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from embedding import Scene, load_scene, solve
from embedding.plan.decisions import Plan
from embedding.plan.effects import Effects
from embedding.plan.far_field import reach_of
from embedding.scene.scales import EPSILON_0, MU_0
from problems import (
    charged_balloon,
    dielectric_balloon,
    grounded_balloon,
    membrane_pull_in,
    permeable_sphere,
    varying_pressure_sphere,
)
from problems.exact import cylinder, sphere
from problems.exact.roots import bracketed_root

MU, RADIUS = 1e5, 0.02
RUBBER = {"law": "neo-hookean", "shear_modulus": MU}
SPHERE, TUBE = {"kind": "sphere", "radius": RADIUS}, {"kind": "infinite-cylinder", "radius": RADIUS}
INFLATED = 1.1
"""Stretch of what is inflated."""


@dataclass(frozen=True)
class Case:
    """One ``term`` in one kind of scene: ``build`` makes it for each of ``values`` of a ``parameter``.

    ``of`` is the answer; ``cheap`` and ``dear`` are the overrides that leave the term out and bring it in, ``exact`` is
    the answer itself, where it is known, in place of a dear solve. ``number`` is the planner's estimate of what the
    term is worth, ``leaves_out`` says whether a plan is without it; None where it costs nothing, and always stays.
    """

    term: str
    name: str
    parameter: str
    values: tuple[float, ...]
    build: Callable[[float], Scene]
    of: str
    cheap: tuple[str, ...]
    dear: tuple[str, ...]
    number: Callable[[Effects], float | None]
    leaves_out: Callable[[Plan], bool] | None
    exact: Callable[[float], float] | None = None

    def scene(self, value: float, accuracy: float | None = None) -> Scene:
        """The scene at a ``value`` of the parameter, with ``of`` as its answer."""
        stated = f"accuracy={{ relative = {accuracy or 1e-2!r}, of = '{self.of}' }}"
        return self.build(value).with_overrides([stated])

    def estimated(self, value: float) -> float | None:
        """What the planner thinks the term is worth."""
        return self.number(Effects(self.scene(value)))

    def true(self, value: float) -> float:
        """What it is worth: relative difference of the answer without it, all else as it is without a stated
        accuracy."""
        scene = self.build(value)
        left_out = self._answer(scene, self.cheap)
        kept = self.exact(value) if self.exact is not None else self._answer(scene, self.dear)
        return abs(left_out / kept - 1)

    def _answer(self, scene: Scene, changes: tuple[str, ...]) -> float:
        return float(solve(scene.with_overrides(changes))[self.of][-1])


def _scene(shape: dict[str, Any], thickness: float, **rest: Any) -> Scene:
    shell = {"shape": shape, "thickness": thickness, "material": RUBBER, **rest.pop("shell", {})}
    return Scene.from_table({"shell": shell, **rest})


def _inflated(
    shape: dict[str, Any], pressure: Callable[..., float], stretch: float = INFLATED
) -> Callable[[float], Scene]:
    """A balloon or tube of some T/R under the pressure of membrane theory at a ``stretch``."""

    def build(ratio: float) -> Scene:
        loads = {"pressure_bottom": MU * pressure(stretch, ratio)}
        return _scene(shape, ratio * RADIUS, loads=loads, path=[{"steps": 3}])

    return build


def _far_inflated(ratio: float) -> Scene:
    """A tube whose bending is no longer what its thick wall has beyond the membrane."""
    return _inflated(TUBE, cylinder.membrane_pressure, 1.5)(ratio)


def _strip(ratio: float) -> Scene:
    """A strip stretched by a tenth, its ends free to turn, under a pressure that hardly lifts it."""
    length, stretch = 0.1, 1.1
    thickness = ratio * length
    pull = MU * thickness * (stretch - stretch**-3)
    return _scene(
        {"kind": "strip", "length": length},
        thickness,
        supports=[{"where": "x0", "kind": "pinned"}, {"where": "x1", "fix": ["y"]}],
        loads={
            "edge_tractions": [{"edge": "x1", "traction": [pull, 0.0, 0.0]}],
            "pressure_bottom": 1e-3 * pull / length,
            "variant": "net",
        },
        path=[{"steps": 3}],
        output={"points": {"middle": [length / 2, 0.0, 0.0]}},
    )


def _pinned_tube(ratio: float) -> Scene:
    """A short tube with its ends held but free to turn, inflated."""
    return _scene(
        {"kind": "cylinder", "radius": RADIUS, "length": 2 * RADIUS},
        ratio * RADIUS,
        supports=[{"where": end, "kind": "pinned"} for end in ("end0", "end1")],
        loads={"pressure_bottom": 0.5 * MU * ratio},
        path=[{"steps": 3}],
        discretisation={"shell_size": 0.1 * RADIUS},
    )


def _charged_and_inflated(share: float) -> Scene:
    """A charged balloon of T/R = 0.05 whose field has a ``share`` of the load."""
    ratio = 0.05
    pressure = MU * sphere.membrane_pressure(INFLATED, ratio)
    voltage = math.sqrt(2 * share / (1 - share) * pressure / EPSILON_0) * RADIUS
    return _scene(
        SPHERE,
        ratio * RADIUS,
        loads={"pressure_bottom": pressure},
        ambient={"field": "electric"},
        faces={"both": {"voltage": voltage}},
        path=[{"steps": 3}],
    )


def _hard_magnetic(strength: float) -> Scene:
    """A clamped strip with a remanence along it, bent to 0.6 of its length by a field across it of ``strength``
    remanences over mu0; the stiffness goes with the field."""
    length, remanence = 0.02, 0.1
    return _scene(
        {"kind": "strip", "length": length},
        0.05 * length,
        shell={"material": {"law": "neo-hookean", "shear_modulus": 3e6 * strength}, "remanence": [remanence, 0.0, 0.0]},
        supports=[{"where": "x0", "kind": "clamped"}],
        ambient={"field": "magnetic", "applied_field": [0.0, strength * remanence / MU_0, 0.0]},
        path=[{"steps": 5}],
        output={"points": {"tip": [length, 0.0, 0.0]}},
    )


def _permeable(chi: float) -> Scene:
    path = "path=[{steps=2, field=0.0}, {steps=3}]"
    return permeable_sphere.scene(f"shell.relative_permeability={1 + chi!r}", path)


def _dielectric(ratio: float) -> Scene:
    """The outer electrode at the voltage, so that there is a field around it too."""
    wall = ratio * 20
    volts = 17e3 * wall
    faces = f"faces={{ top = {{ voltage = {volts!r} }}, bottom = {{ voltage = 0 }} }}"
    inside = f"loads.pressure_bottom={600 * wall!r}"
    return load_scene(dielectric_balloon.SCENE, (f"shell.thickness='{wall!r} mm'", faces, inside))


def _over_an_electrode(kilovolts: float) -> Scene:
    """A stretched strip over a rigid electrode, far from pull-in at 1.26 kV or near."""
    path = "path=[{steps=2, field=0.0}, {steps=4}]"
    middle = "output.points={middle=[0.05, 0.0, 0.0]}"
    return membrane_pull_in.scene("membrane_pull_in", f"faces.both.voltage={1e3 * kilovolts!r}", path, middle)


def _held_lens(radii: float) -> Scene:
    """A charged flat ellipsoid that is held, in a meshed space of so many of its sizes."""
    return _scene(
        {"kind": "ellipsoid", "semi_axes": [RADIUS, RADIUS, 0.4 * RADIUS]},
        0.01 * RADIUS,
        supports=[{"where": "surface", "fix": ["x", "y", "z"]}],
        ambient={"field": "electric", "radius": radii * RADIUS},
        faces={"both": {"voltage": 1e3}},
        path=[{"steps": 1}],
        model={"interface": "closed"},
        discretisation={"shell_size": 0.15 * RADIUS, "ambient_size": 0.5 * RADIUS},
    )


def _grounded(kilovolts: float) -> Scene:
    return load_scene(grounded_balloon.SCENE, (*grounded_balloon.at_voltage(1e3 * kilovolts), "path=[{steps=4}]"))


def _charged(ratio: float) -> Scene:
    return charged_balloon.scene(*charged_balloon.at(ratio, 1.2), "path=[{steps=3}]")


def _robin(effects: Effects) -> float:
    ambient, size = effects.scene.ambient, effects.shape.size
    if ambient is None or ambient.radius is None:
        raise ValueError("the radius is the parameter of this case")
    return effects.far_field(reach_of(effects.scene, ambient) * size / ambient.radius)


def _with_a_charge(stretch: float) -> Scene:
    """A balloon that a charge blows up to about a ``stretch``: the pull falls as it grows."""
    ratio = 0.05
    pull = 2 * MU * ratio * (stretch**-1 - stretch**-7)
    charge = 4 * math.pi * (RADIUS * stretch) ** 2 * math.sqrt(2 * EPSILON_0 * pull)
    return _scene(
        SPHERE,
        ratio * RADIUS,
        ambient={"field": "electric"},
        faces={"both": {"charge": charge}},
        path=[{"steps": 3}],
    )


def _pressed_disc(ratio: float) -> Scene:
    """A disc with its rim held but free to turn, under a pressure that stretches it by some per cent."""
    return _scene(
        {"kind": "disc", "radius": RADIUS},
        ratio * RADIUS,
        supports=[{"where": "rim", "kind": "pinned"}],
        loads={"pressure_bottom": 0.1 * MU * ratio, "variant": "net"},
        path=[{"steps": 3}],
        output={"points": {"middle": [0.0, 0.0, 0.0]}},
    )


def _uneven(kilopascals: float) -> Scene:
    """A sphere in fluids whose pressure varies along it by so much, the difference being 5 kPa."""
    top, bottom = (f"{kilopascals!r}*(z/0.02)**2 {sign} 2.5" for sign in "-+")
    on_faces = {"top": top, "bottom": bottom}
    pressures = [f"loads.pressure_{name}={{ expression='{p}', unit='kPa' }}" for name, p in on_faces.items()]
    return varying_pressure_sphere.scene(*pressures, "path=[{steps=3}]")


def _squeezed(pressure: float) -> Scene:
    """A disc pulled outwards along its free rim, between two fluids of the same pressure, over the shear modulus."""
    thickness = 0.02 * RADIUS
    pull = {"edge": "rim", "traction": [0.1 * MU * thickness, 0.0, 0.0], "frame": "edge"}
    loads = {"edge_tractions": [pull], "pressure_top": pressure * MU, "pressure_bottom": pressure * MU}
    return _scene({"kind": "disc", "radius": RADIUS}, thickness, loads=loads, path=[{"steps": 2}])


def _mean(name: str, parameter: str, values: tuple[float, ...], build: Callable[[float], Scene], of: str) -> Case:
    cheap, dear = ("loads.variant=net",), ("loads.variant=embedding-aware",)
    return Case("mean pressure", name, parameter, values, build, of, cheap, dear, lambda e: e.mean_pressure, None)


def _thin(
    name: str, shape: dict[str, Any], module: Any, stretch: float = INFLATED, *, bending: bool = False
) -> Case:
    """A shell against the exact thick wall, at the stretch that its pressure has there."""
    theory = "bending" if bending else "membrane"

    def exact(ratio: float) -> float:
        pressure = module.membrane_pressure(stretch, ratio)
        return bracketed_root(lambda found: module.thick_pressure(found, ratio) - pressure, 1.0, 1.2 * stretch)

    def build(ratio: float) -> Scene:
        return _inflated(shape, module.membrane_pressure, stretch)(ratio).with_overrides([f"model.theory={theory}"])

    def thin(plan: Plan) -> bool:
        return any((d.topic, d.choice) == ("thin shell", "thin") for d in plan.decisions)

    return Case(
        "thin shell", name, "T/R", (0.2, 0.05, 0.0125), build, "stretch", (), (),
        lambda e: e.thin_shell(bending=bending), thin, exact,
    )  # fmt: skip


def _bending(name: str, parameter: str, values: tuple[float, ...], build: Callable[[float], Scene], of: str) -> Case:
    cheap, dear = ("model.theory=membrane",), ("model.theory=bending",)
    return Case(
        "bending", name, parameter, values, build, of, cheap, dear, lambda e: e.bending, lambda plan: not plan.bending
    )


def _closed(name: str, parameter: str, values: tuple[float, ...], build: Callable[[float], Scene], of: str) -> Case:
    cheap, dear = ("model.interface=closed",), ("model.interface=opened",)
    return Case(
        "faces", name, parameter, values, build, of, cheap, dear, lambda e: e.closed_faces, lambda plan: not plan.opened
    )


def _coupling(name: str, parameter: str, values: tuple[float, ...], build: Callable[[float], Scene], of: str) -> Case:
    cheap, dear = ("model.coupling=once",), ("model.coupling=joint",)
    return Case(
        "coupling", name, parameter, values, build, of, cheap, dear,
        lambda e: e.coupling, lambda plan: plan.coupling == "once",
    )  # fmt: skip


CASES = (
    _thin("inflated sphere", SPHERE, sphere),
    _thin("inflated tube", TUBE, cylinder),
    _thin("tube at a stretch of 1.5", TUBE, cylinder, 1.5),
    _thin("tube that bends", TUBE, cylinder, bending=True),
    _thin("bending tube at a stretch of 1.5", TUBE, cylinder, 1.5, bending=True),
    _bending("inflated sphere", "T/R", (0.2, 0.05, 0.0125), _inflated(SPHERE, sphere.membrane_pressure), "stretch"),
    _bending("inflated tube", "T/R", (0.2, 0.05, 0.0125), _inflated(TUBE, cylinder.membrane_pressure), "stretch"),
    _bending("tube at a stretch of 1.5", "T/R", (0.2, 0.05, 0.0125), _far_inflated, "stretch"),
    _bending("stretched strip", "T/L", (0.05, 0.02, 0.005), _strip, "u_middle_y"),
    _bending("pressed disc", "T/R", (0.1, 0.02, 0.004), _pressed_disc, "u_middle_z"),
    _bending("tube with pinned ends", "T/R", (0.1, 0.02, 0.004), _pinned_tube, "stretch"),
    _mean("in uneven fluids", "kPa", (30.0, 3.0, 0.3), _uneven, "stretch_max"),
    _mean("disc with a free rim", "p/mu", (0.03, 0.003, 0.0003), _squeezed, "stretch"),
    _closed("charged sphere", "T/R", (0.1, 0.025, 0.00625), _charged, "stretch"),
    _closed("charge that moves a sphere", "T/R", (0.1, 0.025, 0.00625), _charged, "displacement"),
    _closed("permeable sphere", "chi", (1.0, 3.0, 9.0), _permeable, "stretch_max"),
    Case(
        "field", "charged, inflated sphere", "share", (0.1, 0.02, 0.004), _charged_and_inflated, "stretch",
        ("faces.both.voltage=0",), (), lambda e: e.field_felt, lambda plan: plan.extent == "none",
    ),
    Case(
        "surroundings", "dielectric sphere", "T/R", (0.2, 0.05, 0.0125), _dielectric, "stretch",
        ("model.surroundings=none",), ("model.surroundings=meshed",), lambda e: e.surroundings,
        lambda plan: plan.extent == "inside",
    ),
    Case(
        "perturbation", "magnetic strip", "H/M", (1.0, 10.0, 100.0), _hard_magnetic, "u_tip_y",
        ("model.coupling=unperturbed",), ("model.coupling=joint",), lambda e: e.perturbation,
        lambda plan: plan.extent == "given",
    ),
    _coupling("charged sphere", "T/R", (0.1, 0.025, 0.00625), _charged, "stretch"),
    _coupling("sphere with a charge", "stretch", (1.2, 1.05, 1.01), _with_a_charge, "stretch"),
    _coupling("in a grounded sphere", "kV", (300.0, 100.0, 30.0), _grounded, "stretch"),
    _coupling("strip over an electrode", "kV", (1.0, 0.5, 0.2), _over_an_electrode, "u_middle_y"),
    Case(
        "far field", "flat ellipsoid", "radius/size", (1.3, 2.0, 4.0), _held_lens, "charge",
        ("model.far_field=robin",), ("model.far_field=infinite",), _robin,
        lambda plan: not plan.sizes.beyond,
    ),
)  # fmt: skip
