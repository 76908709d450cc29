"""The nearest point of a tree for each voxel by scipy and by VTK, in one run with ramus (scripts/bench-territories).

    territory_peers.py FOLDER     with voxels.f64 and points.f64 of `ramus_bench_territories --speed FOLDER`

Both find the nearest of the tree's points, which is less than ramus does: it compares distances to segments. VTK searches
in its own threads (vtkPointInterpolator with a Voronoi kernel), not in a loop of Python.
"""

import pathlib
import sys
import time

import numpy
from scipy.spatial import cKDTree
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStaticPointLocator
from vtkmodules.vtkFiltersPoints import vtkPointInterpolator, vtkVoronoiKernel

folder = pathlib.Path(sys.argv[1])
voxels, points = (numpy.fromfile(folder / name).reshape(-1, 3) for name in ("voxels.f64", "points.f64"))

best = 1e9
for _ in range(3):
    begin = time.perf_counter()
    distances, nearest = cKDTree(points).query(voxels, workers=-1)
    best = min(best, time.perf_counter() - begin)
print(f"scipy cKDTree, all cores: {best:.3f} s")


def cloud(places):
    data, held = vtkPolyData(), vtkPoints()
    held.SetData(numpy_to_vtk(places))
    data.SetPoints(held)
    return data


source, target = cloud(points), cloud(voxels)
ids = numpy_to_vtk(numpy.arange(len(points), dtype=numpy.int32))
ids.SetName("id")
source.GetPointData().AddArray(ids)
best = 1e9
for _ in range(3):
    interpolator = vtkPointInterpolator()
    interpolator.SetInputData(target)
    interpolator.SetSourceData(source)
    interpolator.SetKernel(vtkVoronoiKernel())
    interpolator.SetLocator(vtkStaticPointLocator())
    begin = time.perf_counter()
    interpolator.Update()
    best = min(best, time.perf_counter() - begin)
found = vtk_to_numpy(interpolator.GetOutput().GetPointData().GetArray("id")).astype(int)
away = numpy.linalg.norm(points[found] - voxels, axis=1)
print(f"VTK static point locator, all cores: {best:.3f} s; farther than scipy's at {int((away > distances + 1e-3).sum())} voxels")
