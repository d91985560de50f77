"""Damages to an archive, and what must come of every one of them: ``python damage.py FILE SEED COUNT``."""

from __future__ import annotations

import hashlib
import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from embedding.archive import Archive, open_archive, salvage, verify
from embedding.errors import ArchiveError


def damages(content: bytes, seed: int, count: int) -> Iterator[tuple[str, bytes]]:
    """Truncations, flipped bits, bytes, and zeroed pages of ``content``, in turn."""
    chance = np.random.default_rng(seed)
    for number in range(count):
        spoilt, place = bytearray(content), int(chance.integers(len(content)))
        kind = ("cut", "bit", "byte", "zeros")[number % 4]
        if kind == "cut":
            del spoilt[place:]
        elif kind == "bit":
            spoilt[place] ^= 1 << int(chance.integers(8))
        elif kind == "byte":
            spoilt[place] ^= int(chance.integers(1, 256))
        else:
            spoilt[place : place + 512] = bytes(len(spoilt[place : place + 512]))
        yield f"{kind} at {place}", bytes(spoilt)


def everything(archive: Archive) -> str:
    """All that an archive tells, as one text."""
    told: dict[str, Any] = {
        "scene": archive.scene, "plan": archive.plan.text(), "run": archive.run, "versions": archive.versions,
        "scales": vars(archive.scales), "units": archive.scalar_units, "result": vars(archive.result),
        "steps": [repr(step) for step in archive.steps], "error": repr(archive.error), "cost": repr(archive.cost),
        "critical": repr(archive.critical_points), "cuts": archive.cuts,
        "scalars": plain(archive.scalars), "checkpoint": plain(archive.checkpoint()),
        "origins": plain(archive.origins()), "blocks": {},
    }  # fmt: skip
    for name in archive.blocks:
        for step in range(len(archive)):
            block = archive.block(name, step)
            fields = {field: (block.units[field], block.field(field)) for field in block.fields}
            mesh = block.points, block.cells, block.cell_type, block.order
            told["blocks"][f"{name} {step}"] = plain([mesh, fields])
    return json.dumps(told)


def plain(value: Any) -> Any:
    """Tables and lists with digests in place of arrays."""
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, np.ndarray):
        return f"{value.dtype} {value.shape} {hashlib.sha256(value.tobytes()).hexdigest()}"
    return value


def check(path: Path, whole: str, saved: Path) -> str:
    """What comes of the damaged file at ``path``, of which ``whole`` was everything: "refused", "damaged" or "sound".

    Nothing but ArchiveError is raised, what is read is what was written, what ``verify`` calls sound is, and what it
    says can be saved can be.
    """
    try:
        read = everything(open_archive(path))
    except ArchiveError:
        read = ""
    assert read in ("", whole), "wrong data were read"
    try:
        found = verify(path)
    except ArchiveError as error:
        assert str(path) in str(error) and not read
        return "refused"
    if found.sound:
        assert read == whole, "a damage was not found"
        return "sound"
    assert str(path) in found.message
    if found.saveable:
        saved.unlink(missing_ok=True)
        assert salvage(path, saved) == found.saveable
        again = verify(saved)
        assert again.sound and again.steps == found.saveable, again.message
        parts, these = json.loads(whole), json.loads(everything_but_the_end(open_archive(saved)))
        assert these["steps"] == parts["steps"][: found.saveable]
        assert all(parts["blocks"][name] == block for name, block in these["blocks"].items())
    return "damaged"


def everything_but_the_end(archive: Archive) -> str:
    """Like :func:`everything` of an archive that may be without a checkpoint."""
    archive.checkpoint = lambda step=-1: {}  # type: ignore[method-assign]
    return everything(archive)


def main() -> None:
    """Damage an archive in many ways, and print what came of each."""
    path, seed, count = Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])
    whole = everything(open_archive(path))
    spoilt, saved = path.with_name("spoilt.vtkhdf"), path.with_name("saved.vtkhdf")
    for what, content in damages(path.read_bytes(), seed, count):
        print(what, end=": ", flush=True)
        spoilt.write_bytes(content)
        print(check(spoilt, whole, saved), flush=True)


if __name__ == "__main__":
    main()
