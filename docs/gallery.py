"""Draws the gallery: ``python docs/gallery.py [NAME ...]`` solves problems, writes docs/gallery.md and its pictures.

What a problem shows is the first paragraph of its scene file, what it is compared with that of its script.
"""

from __future__ import annotations

import importlib
import inspect
import re
import sys
import tempfile
from pathlib import Path

from PIL import Image

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from embedding import load_scene, solve, view  # noqa: E402  (works in a checkout that is not installed, too)

PROBLEMS = HERE.parent / "problems"
IMAGES = HERE / "images" / "gallery"
WIDTH, COLOURS = 640, 128
PARTS: dict[str, tuple[str, ...]] = {
    "Charged and dielectric shells": (
        "charged_balloon", "grounded_balloon", "charged_disc", "dielectric_balloon", "dielectric_tube",
        "sphere_in_field",
    ),
    "Magnetic shells": (
        "permeable_sphere", "permeable_disc", "magnetised_sphere", "magnetised_disc", "hard_magnetic_ring",
        "hard_magnetic_cantilever", "inflated_in_a_field", "turned_in_a_field",
    ),
    "Membranes and shells that bend": (
        "torus_inflation", "circular_membrane", "hemisphere_with_hole", "slit_annulus", "pulled_cylinder",
        "hinged_roof", "cap_snap_through", "t_cantilever",
    ),
}  # fmt: skip
RESPONSES = ("hinged_roof", "cap_snap_through")
"""Shown by their path instead of their last state."""
HEAD = """# Gallery

Every picture is a problem of the repository: a scene file, a script that solves it and compares it with a reference,
and a test that asserts how near it comes. `python -m problems.NAME` solves one and prints its numbers. The page and
its pictures are made by `python docs/gallery.py`.
"""


def draw(name: str) -> None:
    """Solve a problem with its default scene and draw its last step, or its path."""
    scene = load_scene(PROBLEMS / f"{name}.toml")
    with tempfile.TemporaryDirectory() as folder:
        archive = Path(folder) / f"{name}.vtkhdf"
        solve(scene, archive=archive)
        drawn = view.response_plot if name in RESPONSES else view.picture
        picture = drawn(archive, archive.with_suffix(".png"))
        with Image.open(picture) as image:
            size = WIDTH, round(WIDTH * image.height / image.width)
            small = image.convert("RGB").resize(size, Image.Resampling.LANCZOS)
    IMAGES.mkdir(exist_ok=True)
    small.quantize(COLOURS).save(IMAGES / f"{name}.png", optimize=True)


def entry(name: str) -> str:
    """The problem's part of the page."""
    lines = (PROBLEMS / f"{name}.toml").read_text().splitlines()
    comment = "\n".join(line.removeprefix("#").strip() for line in lines[: lines.index("")])
    told = inspect.getdoc(importlib.import_module(f"problems.{name}")) or ""
    reference = re.search(r"^Reference: (.*?)\n\n", told, re.DOTALL | re.MULTILINE)
    shown = " ".join(comment.split("\n\n")[0].split())
    compared = " ".join(reference[1].split()) if reference else told.split("\n")[0]
    return f"""### {name.replace("_", " ").capitalize()}

```{{image}} images/gallery/{name}.png
:alt: {name.replace("_", " ")}
:width: 480px
```

{shown} Reference: {compared}
"""


def page() -> str:
    """The whole page, from the pictures that are there."""
    parts = [HEAD]
    for title, names in PARTS.items():
        parts += [f"## {title}\n", *(entry(name) for name in names)]
    return "\n".join(parts)


if __name__ == "__main__":
    for chosen in sys.argv[1:] or [name for names in PARTS.values() for name in names]:
        print(chosen, flush=True)
        draw(chosen)
    (HERE / "gallery.md").write_text(page())
