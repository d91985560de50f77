"""The flux through a flat disc anywhere in the space around the shell."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from embedding.post.integrals import Medium, closed
from embedding.post.patches import Patch, side_named
from embedding.post.probe import Source, opened, probe
from embedding.post.table import PostError, Table

RINGS, AROUND = 24, 32
CUT = "cut by the shell"


def flux(
    archive: Source,
    centre: Sequence[float],
    normal: Sequence[float],
    radius: float,
    *,
    steps: Sequence[int] | None = None,
) -> Table:
    """Flux of the flux density through a disc that stands still, along ``normal``, one row a step: ``flux`` in C
    (electric) or Wb (magnetic).

    Gauss points along the radius, evenly spaced ones around. Where a point of the disc has no value (it lies in the
    shell, in a body, or beyond the meshed space) the flux is nan and ``where`` says why.

    Raises:
        PostError: no step, nothing meshed around the shell, a normal of no length or a radius that is not positive.
        ArchiveError: the archive cannot be read, or it has no such step.
    """
    run = opened(archive)
    side_named(run, "outside")
    along = np.asarray(normal, float)
    if not np.linalg.norm(along) > 0 or not radius > 0:
        raise PostError("a disc has a normal that is not zero and a positive radius")
    along = along / np.linalg.norm(along)
    across = np.cross(along, np.eye(3)[np.abs(along).argmin()])
    across /= np.linalg.norm(across)
    gauss, weight = np.polynomial.legendre.leggauss(RINGS)
    rho, angle = radius * (gauss + 1) / 2, 2 * np.pi * (np.arange(AROUND) + 0.5) / AROUND
    ring = np.cos(angle)[:, None] * across + np.sin(angle)[:, None] * np.cross(along, across)
    points = np.asarray(centre, float) + (rho[:, None, None] * ring).reshape(-1, 3)
    areas = np.repeat(weight / 2 * radius * rho * 2 * np.pi / AROUND, AROUND)
    medium = Medium.of(run)
    table = probe(run, points, fields=[medium.strength], steps=steps)
    through = sum(table[f"{medium.strength}_{axis}"] * along[column] for column, axis in enumerate("xyz"))
    constants = np.array([medium.constants.get(word, np.nan) for word in table["where"]])
    density = (constants * through).reshape(-1, len(points))
    words = table["where"].reshape(-1, len(points))
    first = slice(None, None, len(points))
    reasons = ["; ".join(sorted(set(row) - medium.constants.keys())) for row in words]
    if closed(Patch.of(run, "shell", 0, deformed=False)):
        reasons = [reason or (CUT if len(set(row)) > 1 else "") for reason, row in zip(reasons, words, strict=True)]
        density[[reason == CUT for reason in reasons]] = np.nan
    columns = {name: table[name][first] for name in ("step", "factor_mechanical", "factor_field")}
    columns |= {"flux": density @ areas, "where": np.array(reasons, dtype=object)}
    return Table(columns, {"flux": "C" if medium.electric else "Wb"})
