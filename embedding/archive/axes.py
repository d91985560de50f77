"""Names of the axes of every array in an archive, and HDF5's dimension scales along steps and Newton iterations.

With them a reader without this package, h5py or any viewer of HDF5, sees what the rows of a table are.
"""

from __future__ import annotations

from typing import Any

import h5py
from h5py import h5ds

AXES = ("CLASS", "NAME", "DIMENSION_LABELS", "DIMENSION_LIST", "REFERENCE_LIST")
"""Attributes that HDF5 makes for that."""
STEP, ITERATION = "step", "Newton iteration"
SCALES = {"steps/number": STEP, "newton/number": ITERATION}
TABLES = {"steps": STEP, "scalars": STEP, "vtk": STEP, "newton": ITERATION}
"""Groups in /embedding whose arrays have one row for each of these."""
OF_MESHES = {
    "Points": ("node", "coordinate"), "Connectivity": ("node of a cell",), "Offsets": ("cell",), "Types": ("cell",),
}  # fmt: skip
OF_FIELDS = ("node, step after step", "component")


def label_axes(file: Any) -> None:
    """Name the axes of all arrays of an archive that are not named yet."""
    own = file["embedding"]
    for name, label in SCALES.items():
        if not own[name].is_scale:
            own[name].make_scale(label)
    scales = {label: own[name] for name, label in SCALES.items()}
    for group, label in TABLES.items():
        for dataset in own[group].values():
            if not h5ds.get_label(dataset.id, 0):
                _label(dataset, (label, "component"))
                if not h5ds.is_scale(dataset.id):
                    h5ds.attach_scale(dataset.id, scales[label].id, 0)
    for block in file["VTKHDF/Assembly/Scene"]:
        group = file["VTKHDF"][block]
        for name, axes in OF_MESHES.items():
            _label(group[name], axes)
        for dataset in group["PointData"].values():
            _label(dataset, OF_FIELDS)


def _label(dataset: h5py.Dataset, axes: tuple[str, ...]) -> None:
    for axis, label in enumerate(axes[: dataset.ndim]):
        if not h5ds.get_label(dataset.id, axis):
            h5ds.set_label(dataset.id, axis, label.encode())
