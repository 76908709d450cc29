"""Outlines of vessels on slices, against the section that VTK's cutter makes of the surface that ramus writes. RAMUS_SLICES sets the
number of planes for each tree.
"""

import math
import os
import random
import unittest

try:
    from vtkmodules.vtkCommonDataModel import vtkPlane, vtkStaticCellLocator
    from vtkmodules.vtkFiltersCore import vtkCutter
    from vtkmodules.vtkIOPLY import vtkPLYReader
    from vtkmodules.vtkCommonCore import reference
    MISSING = None
except ImportError as problem:
    MISSING = problem

from nifti import nifti
from ramus import CommandLineTest

PLANES = int(os.environ.get("RAMUS_SLICES", "4"))


class OutlinesBesideVtk(CommandLineTest):
    def surface(self, tree):
        self.expect_done("mesh", tree, "-o", "surface.ply")
        reader = vtkPLYReader()
        reader.SetFileName(str(self.folder / "surface.ply"))
        reader.Update()
        return reader.GetOutput()

    def volume_around(self, bounds):
        """A coarse scan around the surface, with a voxel to spare."""
        size = (8, 8, 8)
        rows = []
        for axis in range(3):
            low, high = bounds[2 * axis], bounds[2 * axis + 1]
            row = [0.0] * 4
            row[axis] = (high - low) / 4 + 1
            row[3] = (low + high) / 2 - 3.5 * row[axis]
            rows.append(tuple(row))
        self.write("scan.nii", nifti(size, [n % 200 for n in range(512)], rows=rows))

    def check_tree(self, tree, branches):
        surface = self.surface(tree)
        bounds = surface.GetBounds()
        self.volume_around(bounds)
        dice = random.Random(11)
        loops = points = 0
        worst = 0.0
        for _ in range(PLANES):
            at = [dice.uniform(bounds[2 * axis], bounds[2 * axis + 1]) for axis in range(3)]
            normal = [dice.gauss(0, 1) for _ in range(3)]
            length = math.sqrt(sum(n * n for n in normal))
            normal = [n / length for n in normal]
            words = ",".join(f"{n:.17g}" for n in normal)
            report = self.json("slice", "scan.nii", "--tree", tree, "--plane", "oblique", "--normal", words,
                               "--at", ",".join(f"{n:.17g}" for n in at), "--size", "64x64", "--json")
            plane = vtkPlane()
            plane.SetOrigin(*at)
            plane.SetNormal(*normal)
            cutter = vtkCutter()
            cutter.SetCutFunction(plane)
            cutter.SetInputData(surface)
            cutter.Update()
            section = cutter.GetOutput()
            self.assertEqual(section.GetNumberOfCells() > 0, len(report["outlines"]) > 0)
            if not report["outlines"]:
                continue
            locator = vtkStaticCellLocator()
            locator.SetDataSet(section)
            locator.BuildLocator()
            closest, cell, part, squared = [0.0] * 3, reference(0), reference(0), reference(0.0)
            lengths = 0.0
            for outline in report["outlines"]:
                loops += 1
                self.assertTrue(outline["closed"])
                self.assertTrue(set(outline["branches"]) <= branches)
                corners = outline["points"]
                for n, corner in enumerate(corners):
                    locator.FindClosestPoint(corner, closest, cell, part, squared)
                    worst = max(worst, math.sqrt(float(squared)))
                    lengths += math.dist(corner, corners[(n + 1) % len(corners)])
                points += len(corners)
            whole = sum(
                math.dist(section.GetPoint(section.GetCell(n).GetPointId(0)), section.GetPoint(section.GetCell(n).GetPointId(1)))
                for n in range(section.GetNumberOfCells()))
            self.assertAlmostEqual(lengths / whole, 1.0, delta=1e-4)
        self.assertLess(worst, 0.01)
        print(f"{tree}: {loops} loops, {points} points, {worst:.5f} mm at most")

    def test_grown_trees(self):
        for seed, count in ((1, 40), (2, 150)):
            self.expect_done("grow", "--branches", count, "--seed", seed, "-o", f"grown{seed}.swc")
            ids = set(range(self.json("info", f"grown{seed}.swc", "--json")["branches"]))
            self.check_tree(f"grown{seed}.swc", ids)

    def test_real_trees(self):
        folder = os.environ.get("RAMUS_SHARED_DATA", "")
        if not os.path.isdir(folder):
            self.skipTest("without the real trees")
        names = os.environ.get("RAMUS_SLICE_TREES", "trees/airways_from_mask.swc").split(",")
        for name in names:
            path = os.path.join(folder, name)
            if os.path.exists(path):
                ids = set(range(self.json("info", path, "--json")["branches"]))
                self.check_tree(path, ids)


if __name__ == "__main__":
    if MISSING is not None:
        print(f"SKIPPED: no VTK to compare with ({MISSING}); Debian has it as python3-vtk9")
    else:
        unittest.main()
