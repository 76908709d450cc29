"""Comparison with VTK (Debian's python3-vtk9): its NIfTI reader and its flying edges see the same surfaces, vertex for vertex.

The two differ where a surface may run either way: in how a polygon is cut into triangles, and in what is joined where
voxels meet at an edge or a corner. So vertices agree, and areas and volumes nearly. Vertices stay 1/256 of a voxel away
from its centre, which VTK's do not.
"""

import math
import os
import pathlib
import unittest

try:
    from vtkmodules.vtkCommonDataModel import VTK_TRIANGLE  # noqa: F401
    from vtkmodules.vtkCommonTransforms import vtkMatrixToLinearTransform
    from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D, vtkMassProperties
    from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
    from vtkmodules.vtkImagingCore import vtkImageConstantPad, vtkImageThreshold
    from vtkmodules.vtkIOImage import vtkNIFTIImageReader
    MISSING = None
except ImportError as problem:
    MISSING = problem

from nifti import compressed, nifti, voxels
from ply import read_ply, volume_of
from ramus import CommandLineTest

VOLUMES = pathlib.Path(os.environ.get("RAMUS_SHARED_DATA", "")) / "volumes"


def vtk_surface(path, isovalue, label=None):
    """The surface in patient coordinates: points, area and volume."""
    reader = vtkNIFTIImageReader()
    reader.SetFileName(str(path))
    reader.Update()
    source = reader
    if label is not None:
        source = vtkImageThreshold()
        source.SetInputConnection(reader.GetOutputPort())
        source.ThresholdBetween(label, label)
        source.SetInValue(1)
        source.SetOutValue(0)
        source.Update()
    pad = vtkImageConstantPad()
    pad.SetInputConnection(source.GetOutputPort())
    extent = source.GetOutput().GetExtent()
    pad.SetOutputWholeExtent(*(extent[n] + (1 if n % 2 else -1) for n in range(6)))
    pad.SetConstant(0)
    edges = vtkFlyingEdges3D()
    edges.SetInputConnection(pad.GetOutputPort())
    edges.SetValue(0, isovalue)
    edges.ComputeNormalsOff()
    edges.ComputeScalarsOff()
    transform = vtkMatrixToLinearTransform()
    transform.SetInput(reader.GetSFormMatrix())
    moved = vtkTransformPolyDataFilter()
    moved.SetInputConnection(edges.GetOutputPort())
    moved.SetTransform(transform)
    moved.Update()
    mass = vtkMassProperties()
    mass.SetInputConnection(moved.GetOutputPort())
    mass.Update()
    output = moved.GetOutput()
    points = [output.GetPoint(n) for n in range(output.GetNumberOfPoints())]
    return points, mass.GetSurfaceArea(), mass.GetVolume()


def area_of(vertices, faces):
    total = 0.0
    for face in faces:
        a, b, c = (vertices[n] for n in face)
        u = [b[k] - a[k] for k in range(3)]
        v = [c[k] - a[k] for k in range(3)]
        total += math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2
    return total


class BesideVtk(CommandLineTest):
    def compare(self, path, *arguments, isovalue=0.5, label=None, tolerance=0.02, at_border=lambda v: False):
        """Same vertices to 4 microns; area and volume within `tolerance` of VTK's."""
        self.expect_done("mesh", path, "-o", "out.ply", "--method", "iso", *arguments)
        _, vertices, faces = read_ply(self.folder / "out.ply")
        vertices = [v[:3] for v in vertices]
        points, area, volume = vtk_surface(path, isovalue, label)
        self.assertEqual(len(vertices), len(points))
        near = {}  # VTK's points by cubes of 4 microns
        for p in points:
            near.setdefault(tuple(round(250 * x) for x in p), []).append(p)
        lost = 0
        for v in vertices:
            cube = [round(250 * x) for x in v[:3]]
            found = any(
                math.dist(v, p) < 4e-3
                for dx in (-1, 0, 1) for dy in (-1, 0, 1) for dz in (-1, 0, 1)
                for p in near.get((cube[0] + dx, cube[1] + dy, cube[2] + dz), ()))
            lost += not found and not at_border(v)
        self.assertEqual(lost, 0)
        self.assertAlmostEqual(area_of(vertices, faces) / area, 1.0, delta=tolerance)
        self.assertAlmostEqual(volume_of(vertices, faces) / volume, 1.0, delta=tolerance)

    def test_a_synthetic_field_on_oblique_axes(self):
        size = (30, 28, 20)
        # A torus about z, as a field that falls outward, on axes that are turned and mirrored.
        rows = ((-0.48, 0.14, 0.0, 12.0), (0.14, 0.48, 0.0, -40.0), (0.0, 0.0, 0.8, 5.0))
        values = [6.0 - math.hypot(math.hypot(x - 14.5, y - 13.7) - 8.0, 1.6 * (z - 9.3)) for x, y, z in voxels(size)]
        path = self.write("torus.nii.gz", compressed(nifti(size, values, "f", rows)))
        self.compare(path, "--isovalue", "2.5", isovalue=2.5, tolerance=0.002)

    def test_a_synthetic_mask(self):
        size = (24, 24, 24)
        values = [1 if (x - 11) ** 2 + (y - 12) ** 2 + (z - 11) ** 2 < 81 else 0 for x, y, z in voxels(size)]
        self.compare(self.write("ball.nii", nifti(size, values)), tolerance=0.01)

    @unittest.skipUnless(VOLUMES.is_dir(), "the real masks are not here")
    def test_real_masks(self):
        self.compare(VOLUMES / "liver_002_vessels.nii.gz", "--label", "1", label=1)
        self.compare(VOLUMES / "liver_002_vessels.nii.gz", "--label", "2", label=2)
        self.compare(VOLUMES / "circle_of_willis_mr_003.nii.gz", "--label", "4", label=4)
        # The trachea leaves through the last slice, where fractions end: half a voxel on here, toward 0 in VTK's padding.
        self.compare(VOLUMES / "airways_lumen.nii.gz", at_border=lambda v: abs(v[2] / 0.7000120 - 424.5) < 1e-3)


if __name__ == "__main__":
    if MISSING is not None:
        print(f"SKIPPED: no VTK to compare with ({MISSING}); Debian has it as python3-vtk9")
    else:
        unittest.main()
