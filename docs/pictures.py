"""Solves the scenes of docs/pictures.md and draws its pictures: ``python docs/pictures.py``."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from embedding import Scene, load_scene, solve, view  # noqa: E402  (works in a checkout that is not installed, too)
from embedding.post import line  # noqa: E402

IMAGES = HERE / "images"
PROBLEMS = HERE.parent / "problems"
PAST_THE_LIMIT = """
name = "balloon past its limit"
[shell]
thickness = "0.2 mm"
shape = { kind = "sphere", radius = "20 mm" }
material = { law = "neo-hookean", shear_modulus = "100 kPa" }
[loads]
pressure_bottom = "1 kPa"
[[path]]
steps = 24
until = { where = ["20 mm", "0 mm", "0 mm"], axis = "x", value = "30 mm" }
"""


def main() -> None:
    """Write docs/images/view_*.png and view_balloon.gif."""
    with tempfile.TemporaryDirectory() as folder:
        runs = {
            name: Path(folder) / f"{name}.vtkhdf" for name in ("limit", "charged_balloon", "permeable_sphere")
        }
        solve(Scene.from_toml(PAST_THE_LIMIT), archive=runs["limit"])
        for name, changes in (("charged_balloon", ["path.0.steps=10"]), ("permeable_sphere", [])):
            solve(load_scene(PROBLEMS / f"{name}.toml", changes), archive=runs[name])
        view.response_plot(runs["limit"], IMAGES / "view_response.png")
        view.slice_plot(runs["permeable_sphere"], IMAGES / "view_slice.png")
        view.faces_plot(runs["permeable_sphere"], IMAGES / "view_faces.png")
        view.animation(runs["charged_balloon"], IMAGES / "view_balloon.gif")
        table = line(runs["charged_balloon"], (0.0, 0.0, 0.0), (0.07, 0.0, 0.0), count=281, fields=["phi", "E"])
        view.probe_plot(table, IMAGES / "view_line.png", title="charged balloon")


if __name__ == "__main__":
    main()
