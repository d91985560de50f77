"""A dielectric elastomer film, free to widen, against its exact pull-in and the branch beyond.

Physics: opposite charges on the faces squeeze the film; it thins and widens, which raises the field in it. At a held
voltage there is a largest one, at the stretch 2^(1/3); arc length finds it as a limit point and goes on. At a held
charge the uniform film has one state for each charge. Beyond the pull-in that state is unstable at either control:
charge can gather where the film is thinner.

Reference: `problems.exact.dielectric_film` (X. Zhao, Z. Suo, Appl. Phys. Lett. 91 (2007) 061921), met to rounding.

Run: about four seconds.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from embedding import Listener, Scene, Solution, load_scene, solve
from embedding.scene.scales import EPSILON_0
from embedding.scene.shapes import Plate
from problems.common import Array, law_of, print_files, print_steps
from problems.exact.dielectric_film import DielectricFilm
from problems.exact.sphere import LimitPoint

SCENE = Path(__file__).with_suffix(".toml")


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"shell.relative_permittivity=5"``."""
    return load_scene(SCENE, changes)


def run(*changes: str, archive: Path | None = None, listeners: Sequence[Listener] = ()) -> Solution:
    """Solve the scene with overrides."""
    return solve(scene(*changes), archive=archive, listeners=listeners)


def by_charge(stretch: float) -> tuple[str, ...]:
    """Overrides that give the bottom face the charge of the uniform film at ``stretch``, and no voltage."""
    stated = scene()
    charge = exact(stated).charge(stretch) * area(stated)
    return f"faces.bottom={{charge={charge!r}}}", "path=[{name='charging', steps=10}]"


def area(scene: Scene) -> float:
    """Of the undeformed film, in m^2; ValueError for another shape."""
    shape = scene.shell.shape
    if not isinstance(shape, Plate):
        raise ValueError("the reference is a plate")
    return shape.length * shape.width


def exact(scene: Scene, width: float | None = None) -> DielectricFilm:
    """The exact film of ``scene``, in SI units; ValueError for a film that conducts."""
    if scene.shell.relative_permittivity is None:
        raise ValueError("the reference is a dielectric")
    permittivity = scene.shell.relative_permittivity * EPSILON_0
    return DielectricFilm(scene.shell.thickest, law_of(scene), permittivity, width=width)


def known_voltage(solution: Solution) -> Array:
    """Exact voltage between the faces at the mean stretch of every step, in V."""
    film = exact(solution.scene)
    return np.array([film.voltage(stretch) for stretch in solution["stretch"]])


def error(solution: Solution) -> float:
    """Largest error of the voltage over the steps, relative to the largest voltage."""
    known = known_voltage(solution)
    return float(np.abs(np.abs(solution["voltage_jump"]) - known).max() / known.max())


def pull_in(solution: Solution) -> LimitPoint:
    """Stretch and voltage of the first limit point; ValueError if there is none."""
    for point in solution.critical_points:
        if point.kind == "limit":
            return LimitPoint(point.scalars["stretch"], abs(point.scalars["voltage_jump"]))
    raise ValueError("the path has no limit point")


if __name__ == "__main__":
    solution = run(archive=Path("dielectric_film.vtkhdf"))
    found = {"stretch": solution["stretch"], "voltage / kV": np.abs(solution["voltage_jump"]) / 1e3}
    print_steps(found | {"exact": known_voltage(solution) / 1e3})
    print(f"largest error of the voltage: {error(solution):.1e}")
    limit, known = pull_in(solution), exact(solution.scene).pull_in()
    assert known is not None
    errors = abs(limit.stretch - known.stretch), abs(limit.load / known.load - 1.0)
    print(f"pull-in at {limit.load / 1e3:.6f} kV, stretch {limit.stretch:.8f}: errors {errors[1]:.1e}, {errors[0]:.1e}")
    charged = run(*by_charge(1.4))
    print(f"at its charge: stretch {charged['stretch'][-1]:.8f}, largest error of the voltage {error(charged):.1e}")
    print_files(solution)
