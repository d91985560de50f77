"""STEP and BREP files that are spoilt: ``python -m tests.doors.surfaces FOLDER FIRST COUNT`` loads scenes of them.

In a process of its own, which must not die of what the geometry kernel makes of them.
"""

from __future__ import annotations

import random
import re
import sys
from pathlib import Path
from typing import Any

from embedding import plan as planning
from embedding.errors import SceneError
from embedding.scene import Scene
from embedding.scene.shapes import trial
from tests.doors.watch import in_time
from tests.scene.samples import shell

NUMBERS = (
    b"1e300",
    b"-1e300",
    b"nan",
    b"inf",
    b"1e-300",
    b"0",
    b"-1",
    b"1e999",
    b"99999999999999999999",
    b"#1",
    b"$",
    b"*",
    b"''",
    b"",
    b"((((",
)


def written(folder: Path) -> list[Path]:
    """A box's open side, a bent sheet and a ball, as STEP and as BREP."""
    from netgen.occ import Axis, Box, Glue, OCCGeometry, Pnt, Segment, Sphere

    box = Box(Pnt(0, 0, 0), Pnt(20, 10, 5))
    shapes: dict[str, Any] = {
        "can": Glue(list(box.faces)[:5]),
        "sheet": Segment(Pnt(20, 0, 0), Pnt(20, 0, 30)).Revolve(Axis((0, 0, 0), (0, 0, 1)), 70),
        "ball": Sphere(Pnt(0, 0, 0), 10).faces[0],
    }
    files = []
    for name, shape in shapes.items():
        files += [folder / f"{name}.step", folder / f"{name}.brep"]
        shape.WriteStep(str(files[-2]))
        OCCGeometry(shape)
        shape.WriteBrep(str(files[-1]))
    return files


def spoilt(chance: random.Random, data: bytes) -> bytes:
    """Cut, flipped, with other numbers, with lines lost, doubled and swapped, or something else altogether."""
    kind = chance.randrange(9)
    if kind == 0:
        return data[: chance.randrange(len(data))]
    if kind == 1:
        changed = bytearray(data)
        for _ in range(chance.choice((1, 5, 50))):
            changed[chance.randrange(len(changed))] ^= 1 << chance.randrange(8)
        return bytes(changed)
    if kind in (2, 3, 4):
        numbers = list(re.finditer(rb"-?\d+(\.\d*)?(E[+-]?\d+)?", data))
        for found in sorted(chance.sample(numbers, chance.choice((1, 3, 20))), key=lambda one: -one.start()):
            data = data[: found.start()] + chance.choice(NUMBERS) + data[found.end() :]
        return data
    if kind in (5, 6):
        lines = data.splitlines(keepends=True)
        for _ in range(chance.choice((1, 2, 10))):
            a, b = chance.randrange(len(lines)), chance.randrange(len(lines))
            if kind == 5:
                lines[a], lines[b] = lines[b], lines[a]
            else:
                lines[a] = chance.choice((b"", lines[a] * 2, lines[b]))
        return b"".join(lines)
    if kind == 7:
        return data.replace(
            *chance.choice(
                (
                    (b"10.", b"1E12"),
                    (b"20", b"0"),
                    (b"MILLI", b"KILO"),
                    (b"PLANE", b"CONICAL_SURFACE"),
                    (b"#", b"##"),
                    (b"(", b"((("),
                    (b"\n", b""),
                )
            )
        )
    return chance.choice(
        (
            b"",
            b"\x00" * 5000,
            bytes(chance.randrange(256) for _ in range(3000)),
            b"ISO-10303-21;\n",
            b"DBRep_DrawableShape\n",
            b"\x89HDF\r\n\x1a\n" + b"\x00" * 100,
        )
    )


def main() -> None:
    """Spoil files in many ways and print what came of each."""
    folder, first, count = Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])
    trial.PATIENCE = 5.0
    files = written(folder)
    contents = [file.read_bytes() for file in files]
    for number in range(first, first + count):
        chance = random.Random(number)
        which = chance.randrange(len(files))
        path = folder / f"spoilt {number}, größer{files[which].suffix}"
        path.write_bytes(spoilt(chance, contents[which]))
        print(f"{number}: {files[which].name}: ", end="", flush=True)
        try:
            with in_time():
                scene = Scene(shell=shell(shape={"kind": "file", "path": str(path)}, thickness=1e-5))
                print("planned" if planning.explain(scene).text() else "nothing", flush=True)
        except SceneError as error:
            print(f"refused: {' '.join(str(error).split())}", flush=True)
        path.unlink()


if __name__ == "__main__":
    main()
