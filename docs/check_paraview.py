"""What this machine's ParaView reads of files: ``pvpython docs/check_paraview.py FILE ...`` (.vtkhdf views, .pvd).

Needs nothing but ParaView's own Python (Debian: ``apt-get install paraview python3-paraview``).
"""

import sys
from pathlib import Path

import vtk
from paraview import servermanager
from paraview.simple import PVDReader, VTKHDFReader

READERS = {".vtkhdf": lambda file: VTKHDFReader(FileName=[file]), ".pvd": lambda file: PVDReader(FileName=file)}


def report(file: str) -> None:
    """Steps, size and ranges of all point fields at the first and the last step that ParaView offers."""
    reader = READERS[Path(file).suffix](file)
    reader.UpdatePipelineInformation()
    times = list(reader.TimestepValues or [])
    print(f"{file}: {len(times)} time steps")
    for time in times[:1] + times[1:][-1:] or [None]:
        reader.UpdatePipeline(*([] if time is None else [time]))
        grid = servermanager.Fetch(reader)
        where = "no time" if time is None else f"time {time:g}"
        points, cells = grid.GetNumberOfPoints(), grid.GetNumberOfCells()
        print(f"  {where}: {points} points, {cells} cells of type {grid.GetCellType(0)}")
        data = grid.GetPointData()
        for array in map(data.GetArray, range(data.GetNumberOfArrays())):
            low, high = array.GetRange(-1 if array.GetNumberOfComponents() > 1 else 0)
            print(f"    {array.GetName()} ({array.GetNumberOfComponents()}): {low:.6g} to {high:.6g}")
        print(f"    {grid.GetFieldData().GetNumberOfArrays()} field data")


if __name__ == "__main__":
    print(f"{servermanager.vtkSMProxyManager.GetParaViewSourceVersion()}, VTK {vtk.vtkVersion.GetVTKVersion()}")
    for name in sys.argv[1:]:
        report(name)
