"""An archive as the XML files that every version of ParaView reads: a series over the steps for each block.

Only the newest viewers read time steps from VTKHDF. Cells stay those of high order, values are the archive's own.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np

from embedding.archive.reader import Archive, ArchivedBlock
from embedding.errors import ArchiveError
from embedding.view.rendering import require_packages

COLLECTION = """<?xml version="1.0"?>
<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">
  <Collection>
{}
  </Collection>
</VTKFile>
"""


def export(archive: Archive, folder: str | os.PathLike[str]) -> tuple[Path, ...]:
    """Write ``folder`` with ``<block>.pvd`` and its ``<block>_<step>.vtu`` for every block; returns the former.

    Times of the series are step numbers; scalars of a step are field data of its files. A folder that is there already
    must be empty.

    Raises:
        ArchiveError: no step was accepted, the folder is in use or cannot be written.
        RenderError: pyvista is not installed.
    """
    require_packages()
    place = Path(folder)
    if not len(archive):
        raise ArchiveError(f"{archive.path}: no step was accepted, so there is nothing to export")
    try:
        place.mkdir(parents=True, exist_ok=True)
        if any(place.iterdir()):
            raise ArchiveError(f"{place}: holds files already; name a new folder")
        return tuple(_series(archive, name, place) for name in archive.blocks)
    except OSError as error:
        raise ArchiveError(f"{place}: cannot be written: {error}") from error


def _series(archive: Archive, name: str, place: Path) -> Path:
    entries, digits = [], len(str(len(archive)))
    for step, record in enumerate(archive.steps):
        file = place / f"{name}_{record.number:0{digits}}.vtu"
        _grid(archive, archive.block(name, step), step).save(file)
        entries.append(f'    <DataSet timestep="{record.number}" part="0" file={quoteattr(file.name)}/>')
    collection = place / f"{name}.pvd"
    collection.write_text(COLLECTION.format("\n".join(entries)), encoding="utf-8")
    return collection


def _grid(archive: Archive, block: ArchivedBlock, step: int) -> Any:
    """The block at ``step`` as pyvista's grid."""
    from pyvista import UnstructuredGrid

    count, nodes = block.cells.shape
    cells = np.hstack([np.full((count, 1), nodes), block.cells]).ravel()
    grid = UnstructuredGrid(cells, np.full(count, block.cell_type, np.uint8), block.points)
    for field in block.fields:
        grid.point_data[field] = block.field(field)
    for scalar, values in archive.scalars.items():
        grid.field_data[scalar] = values[step : step + 1]
    return grid
