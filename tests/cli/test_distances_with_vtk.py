"""Comparison with VTK (Debian's python3-vtk9): distances between surfaces of real trees, vertex by vertex in the mean and at the
most.
"""

import math
import os
import pathlib
import unittest

try:
    from vtkmodules.vtkCommonCore import reference
    from vtkmodules.vtkCommonDataModel import vtkGenericCell, vtkStaticCellLocator
    from vtkmodules.vtkIOPLY import vtkPLYReader
    MISSING = None
except ImportError as problem:
    MISSING = problem

from ramus import CommandLineTest

TREES = pathlib.Path(os.environ.get("RAMUS_SHARED_DATA", "")) / "trees"
NAMES = ("brain_BG0003.swc", "mouse_airways_m10.swc", "airways_from_mask.swc")


class DistancesBesideVtk(CommandLineTest):
    def read(self, name):
        reader = vtkPLYReader()
        reader.SetFileName(str(self.folder / name))
        reader.Update()
        return reader.GetOutput()

    def vtk_distances(self, surface, other):
        locator = vtkStaticCellLocator()
        locator.SetDataSet(other)
        locator.BuildLocator()
        nearest, cell, number, part, squared = [0.0] * 3, vtkGenericCell(), reference(0), reference(0), reference(0.0)
        distances = []
        for n in range(surface.GetNumberOfPoints()):
            locator.FindClosestPoint(surface.GetPoint(n), nearest, cell, number, part, squared)
            distances.append(math.sqrt(squared.get()))
        return distances

    def test_on_real_trees(self):
        for name in NAMES:
            with self.subTest(name=name):
                self.expect_done("mesh", TREES / name, "-o", "a.ply", "--detail", "6", "--blend", "paper")
                self.expect_done("mesh", TREES / name, "-o", "b.ply", "--detail", "9", "--smooth", "3")
                found = self.json("compare", "a.ply", "b.ply", "--json", "--threshold", "0.1")
                distances = sorted(self.vtk_distances(self.read("a.ply"), self.read("b.ply")))
                self.assertEqual(found["count"], len(distances))
                self.assertAlmostEqual(found["mean"], sum(distances) / len(distances), delta=1e-4)
                self.assertAlmostEqual(found["rms"], math.sqrt(sum(d * d for d in distances) / len(distances)), delta=1e-4)
                self.assertAlmostEqual(found["max"], distances[-1], delta=1e-4)
                self.assertAlmostEqual(found["min"], distances[0], delta=1e-4)
                self.assertAlmostEqual(found["median"], distances[len(distances) // 2], delta=1e-4)
                above = 100.0 * sum(d > 0.1 for d in distances) / len(distances)
                self.assertAlmostEqual(found["above_percent"], above, delta=0.01)


if __name__ == "__main__":
    if MISSING is not None:
        print(f"SKIPPED: no VTK to compare with ({MISSING}); Debian has it as python3-vtk9")
    elif not TREES.is_dir():
        print(f"SKIPPED: no real trees in {TREES}")
    else:
        unittest.main()
