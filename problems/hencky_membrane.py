"""Hencky's membrane: a flat, unstressed, clamped sheet under a small pressure, against his constants.

Physics: w0 / a = C(nu) (p a / (E h))^(1/3), for any Poisson ratio.

Reference: `problems.exact.hencky` (Hencky 1915, corrected): C = 0.653443 at nu = 0.3.

Run: about a second.
"""

from __future__ import annotations

from pathlib import Path

from embedding import StVenantKirchhoff, load_scene
from problems.common import LoadPath, Reading, follow, print_files
from problems.exact.hencky import hencky

SCENE = Path(__file__).with_suffix(".toml")
READINGS = {"apex": Reading((0.0, 0.0, 0.0), "z")}


def run(*changes: str, archive: Path | None = None) -> LoadPath:
    """Solve the scene with overrides."""
    return follow(load_scene(SCENE, changes), READINGS, archive)


def material(path: LoadPath) -> StVenantKirchhoff:
    """The material of the scene."""
    stated = path.solution.scene.shell.material
    if not isinstance(stated, StVenantKirchhoff):
        raise ValueError("Hencky's membrane follows Hooke's law")
    return stated


def load(path: LoadPath) -> float:
    """q = p a / (E h)."""
    scene = path.solution.scene
    pressure = scene.loads.pressure_bottom
    if not isinstance(pressure, float):
        raise ValueError("the pressure is a number in this scene")
    return pressure * scene.shell.shape.size / (material(path).youngs_modulus * scene.shell.thickest)


def constant(path: LoadPath) -> float:
    """C, from the height of the apex."""
    return float(path.end("apex") / path.solution.scene.shell.shape.size / load(path) ** (1 / 3))


def reference(path: LoadPath) -> float:
    """The exact constant."""
    return hencky(material(path).poisson_ratio).deflection


if __name__ == "__main__":
    path = run(archive=Path("hencky_membrane.vtkhdf"))
    found, known = constant(path), reference(path)
    print(f"C = {found:.6f} (exact {known:.6f}, error {abs(found / known - 1):.1e})")
    print_files(path.solution)
