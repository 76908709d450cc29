"""Comparison with VTK (Debian's python3-vtk9): it reads every mesh format that ramus writes, with the same vertices and triangles,
the same arrays, and a GLB in metres.
"""

import json
import unittest

try:
    from vtkmodules.vtkCommonDataModel import vtkPolyData
    from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkMassProperties, vtkTriangleFilter
    from vtkmodules.vtkFiltersGeometry import vtkCompositeDataGeometryFilter
    from vtkmodules.vtkIOGeometry import vtkGLTFReader, vtkOBJReader, vtkSTLReader
    from vtkmodules.vtkIOPLY import vtkPLYReader
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
    MISSING = None
except ImportError as problem:
    MISSING = problem

from ply import read_ply, volume_of
from ramus import CommandLineTest
from test_meshes import SYSTEMS


class MeshesBesideVtk(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("tree.json", json.dumps(SYSTEMS))

    def read(self, reader, name):
        reader.SetFileName(str(self.folder / name))
        reader.Update()
        self.assertEqual(reader.GetErrorCode(), 0)
        return reader.GetOutput()

    def written(self, name, *words):
        return self.json("mesh", "tree.json", "-o", name, "--json", *words)

    def volume(self, data):
        triangles = vtkTriangleFilter()
        triangles.SetInputData(data)
        properties = vtkMassProperties()
        properties.SetInputConnection(triangles.GetOutputPort())
        return properties.GetVolume()

    def open_edges(self, data):
        edges = vtkFeatureEdges()
        edges.SetInputData(data)
        edges.FeatureEdgesOff()
        edges.ManifoldEdgesOff()
        edges.BoundaryEdgesOn()
        edges.NonManifoldEdgesOn()
        edges.Update()
        return edges.GetOutput().GetNumberOfCells()

    def expected_volume(self):
        self.written("volume.ply")
        _, vertices, faces = read_ply(self.folder / "volume.ply")
        return volume_of(vertices, faces)

    def test_the_same_counts_and_volume_in_every_format(self):
        volume = self.expected_volume()
        for name, reader in (("m.ply", vtkPLYReader()), ("m.stl", vtkSTLReader()), ("m.obj", vtkOBJReader()),
                             ("m.vtp", vtkXMLPolyDataReader())):
            with self.subTest(name=name):
                figures = self.written(name)
                data = self.read(reader, name)
                self.assertEqual(data.GetNumberOfPoints(), figures["vertices"])
                self.assertEqual(data.GetNumberOfCells(), figures["triangles"])
                self.assertEqual({data.GetCellType(n) for n in range(data.GetNumberOfCells())}, {5})  # triangles
                self.assertEqual(self.open_edges(data), 0)
                self.assertAlmostEqual(self.volume(data) / volume, 1.0, delta=1e-5)

    def test_the_arrays_of_vtp(self):
        self.written("m.vtp")
        self.written("m.ply")
        _, vertices, faces = read_ply(self.folder / "m.ply")
        data = self.read(vtkXMLPolyDataReader(), "m.vtp")
        points, cells, fields = data.GetPointData(), data.GetCellData(), data.GetFieldData()
        self.assertIsNotNone(points.GetNormals())
        for n in range(0, len(vertices), 7):
            self.assertEqual(data.GetPoint(n), vertices[n][:3])
            self.assertEqual(points.GetNormals().GetTuple(n), vertices[n][3:6])
            self.assertEqual(points.GetArray("Radius").GetValue(n), vertices[n][6])
        branches = [points.GetArray("GroupIds").GetValue(n) for n in range(len(vertices))]
        self.assertEqual(set(branches), {0, 1, 2, 3})
        for n, face in enumerate(faces):
            corners = [branches[v] for v in face]
            branch = cells.GetArray("GroupIds").GetValue(n)
            self.assertGreaterEqual(corners.count(branch), 2 if len(set(corners)) < 3 else 1)
            self.assertEqual(cells.GetArray("SystemId").GetValue(n), SYSTEMS["branch_systems"][branch])
        for name, words in (("SystemNames", ["portal vein", "artery"]), ("RamusUnits", ["mm", "RAS"]), ("SPACE", ["RAS"])):
            array = fields.GetAbstractArray(name)
            self.assertEqual([array.GetValue(n) for n in range(array.GetNumberOfValues())], words)
        colours = fields.GetArray("SystemColours")
        self.assertEqual([colours.GetTuple(n) for n in range(2)], [(0, 0, 255), (255, 0, 0)])

    def test_glb_in_metres(self):
        volume = self.expected_volume()
        for parts, blocks in (("none", 1), ("system", 2), ("branch", 4)):
            with self.subTest(parts=parts):
                figures = self.written("m.glb", "--parts", parts)
                reader = vtkGLTFReader()
                reader.ApplyDeformationsToGeometryOn()
                self.read(reader, "m.glb")
                flat = vtkCompositeDataGeometryFilter()
                flat.SetInputConnection(reader.GetOutputPort())
                flat.Update()
                data = flat.GetOutput()
                self.assertEqual(data.GetNumberOfCells(), figures["triangles"])
                self.assertGreaterEqual(data.GetNumberOfPoints(), figures["vertices"])
                self.assertEqual(reader.GetNumberOfAnimations(), 0)
                leaves = reader.GetOutput().NewIterator()
                count = 0
                leaves.InitTraversal()
                while not leaves.IsDoneWithTraversal():
                    count += isinstance(leaves.GetCurrentDataObject(), vtkPolyData)
                    leaves.GoToNextItem()
                self.assertEqual(count, blocks)
                # The portal vein from 0 to 20 mm and the artery, 40 mm to the right, which is -X; up is +Y.
                least_x, most_x, least_y, most_y, least_z, most_z = data.GetBounds()
                self.assertAlmostEqual(least_x, -0.042, delta=1e-4)
                self.assertGreater(most_x, 0.005)
                self.assertGreater(most_y, 0.020)
                self.assertLess(max(most_z, -least_z), 0.0021)
                self.assertAlmostEqual(self.volume(data) * 1e9 / volume, 1.0, delta=1e-4)


if __name__ == "__main__":
    if MISSING is not None:
        print(f"SKIPPED: no VTK to compare with ({MISSING}); Debian has it as python3-vtk9")
    else:
        unittest.main()
