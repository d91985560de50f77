"""Small files beside an archive, one a block, that viewers open.

Viewers handle a single time-dependent grid best (readers of VTK 9.7 return wrong steps of a collection, and
pyvista refuses collections), so each block gets a file of its own: ``run.vtkhdf`` has ``run.shell.vtkhdf``
beside it, which holds nothing but a link into the archive. Move them together.
"""

from __future__ import annotations

import glob
import os
from collections.abc import Sequence
from pathlib import Path

import h5py


def view_path(archive: Path, block: str) -> Path:
    """Where the view file of ``block`` is."""
    return archive.with_stem(f"{archive.stem}.{block}")


def viewed_archive(path: Path) -> str | None:
    """Name of the archive that ``path`` is a view file of, or None if it is none."""
    try:
        with h5py.File(path, "r", locking=False) as file:
            link = file.get("VTKHDF", getlink=True)
    except OSError:
        return None
    return str(link.filename) if isinstance(link, h5py.ExternalLink) else None


def write_views(archive: Path, blocks: Sequence[str]) -> None:
    """Write the view files of ``blocks``, and remove those that an earlier archive of this name left
    behind."""
    wanted = [view_path(archive, block) for block in blocks]
    for name in archive.parent.glob(f"{glob.escape(archive.stem)}.*{glob.escape(archive.suffix)}"):
        if name not in wanted and viewed_archive(name) == archive.name:
            name.unlink()
    for block, path in zip(blocks, wanted, strict=True):
        temporary = path.with_name(f"{path.name}.partial")
        with h5py.File(temporary, "w", locking=False) as file:
            file["VTKHDF"] = h5py.ExternalLink(archive.name, f"/VTKHDF/{block}")
        os.replace(temporary, path)
