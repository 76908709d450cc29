"""The same distances by VTK's locator, in VTK's own loop (vtkDistancePolyDataFilter): one line of JSON.

    distance_vtk.py A.ply B.ply
"""

import json
import sys
import time

from vtkmodules.vtkFiltersGeneral import vtkDistancePolyDataFilter
from vtkmodules.vtkIOPLY import vtkPLYReader


def read(path):
    reader = vtkPLYReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


surface, other = read(sys.argv[1]), read(sys.argv[2])
both = vtkDistancePolyDataFilter()
both.SetInputData(0, surface)
both.SetInputData(1, other)
both.SignedDistanceOff()
both.ComputeSecondDistanceOff()
if hasattr(both, "ComputeCellCenterDistanceOff"):
    both.ComputeCellCenterDistanceOff()
begin, begin_cpu = time.perf_counter(), time.process_time()
both.Update()
seconds, cpu = time.perf_counter() - begin, time.process_time() - begin_cpu
found = both.GetOutput().GetPointData().GetArray("Distance")
count = found.GetNumberOfTuples()
print(json.dumps({"vertices": count, "triangles": other.GetNumberOfCells(), "seconds": seconds, "cpu_seconds": cpu,
                  "mean_mm": sum(found.GetValue(n) for n in range(count)) / count}))
