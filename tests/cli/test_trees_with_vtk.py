"""Comparison with VTK (Debian's python3-vtk9): what its writers write, in all their encodings, ramus reads to the bit, and what
ramus writes, its readers read with the same points, lines and arrays.
"""

import itertools
import json
import os
import pathlib
import unittest

try:
    from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkFloatArray, vtkIdList, vtkIntArray, vtkPoints, vtkStringArray
    from vtkmodules.vtkCommonDataModel import VTK_LINE, VTK_POLY_LINE, vtkCellArray, vtkPolyData, vtkUnstructuredGrid
    from vtkmodules.vtkIOLegacy import vtkPolyDataReader, vtkPolyDataWriter, vtkUnstructuredGridWriter
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter
    MISSING = None
except ImportError as problem:
    MISSING = problem

from ramus import CommandLineTest

FORMATS = pathlib.Path(os.environ.get("RAMUS_SHARED_DATA", "")) / "formats"

# A stem that forks twice, with numbers that no short decimal gives.
POINTS = [(0, 0, 0), (0.1, 1 / 3, 7), (0, 0, 10), (3, 0, 15), (3.5, 0, 19), (-3, 0, 15), (-4, 2, 21), (-5, -2.2, 22)]
RADII = [2, 1.9, 1.7, 1.2, 1.0, 1.3, 0.7, 2 / 3]
LINES = [(0, 1, 2), (2, 3, 4), (2, 5), (5, 6), (5, 7)]


def lines():
    cells = vtkCellArray()
    for line in LINES:
        cells.InsertNextCell(len(line))
        for point in line:
            cells.InsertCellPoint(point)
    return cells


def add_points_and_arrays(data):
    points = vtkPoints()
    points.SetDataTypeToDouble()
    for point in POINTS:
        points.InsertNextPoint(point)
    data.SetPoints(points)
    radii, other, words, flow = vtkDoubleArray(), vtkFloatArray(), vtkStringArray(), vtkIntArray()
    for array, name in ((radii, "MaximumInscribedSphereRadius"), (other, "Other vectors"), (words, "Words"), (flow, "Flow")):
        array.SetName(name)
    other.SetNumberOfComponents(3)
    for number, radius in enumerate(RADII):
        radii.InsertNextValue(radius)
        other.InsertNextTuple((number, 2 * number, 0.5))
        words.InsertNextValue("point %d" % number * number)
    for number in range(len(LINES)):
        flow.InsertNextValue(number)
    data.GetPointData().AddArray(other)
    data.GetPointData().AddArray(words)
    data.GetPointData().AddArray(radii)
    data.GetPointData().SetScalars(radii)
    data.GetCellData().AddArray(flow)
    return data


def poly_data():
    data = vtkPolyData()
    data.SetLines(lines())
    return add_points_and_arrays(data)


def grid():
    data = add_points_and_arrays(vtkUnstructuredGrid())
    for line in LINES:
        ids = vtkIdList()
        for point in line:
            ids.InsertNextId(point)
        data.InsertNextCell(VTK_POLY_LINE if len(line) > 2 else VTK_LINE, ids)
    return data


class TreesBesideVtk(CommandLineTest):
    def check_read(self, name):
        self.expect_done("convert", name, "-o", "read.json")
        tree = json.loads((self.folder / "read.json").read_text())
        self.assertEqual(tree["points"], [[*point, radius] for point, radius in zip(POINTS, RADII)], name)
        self.assertEqual(len(tree["branches"]), len(LINES), name)

    def written(self, writer, data, name):
        writer.SetInputData(data)
        writer.SetFileName(str(self.folder / name))
        self.assertEqual(writer.Write(), 1)
        return name

    def test_every_encoding_of_xml(self):
        for modes in itertools.product(("Ascii", "Binary", "Appended"), (False, True), ("UInt32", "UInt64"),
                                       ("LittleEndian", "BigEndian"), (False, True)):
            mode, compressed, header, order, base64 = modes
            for writer, data, name in ((vtkXMLPolyDataWriter(), poly_data(), "y.vtp"),
                                       (vtkXMLUnstructuredGridWriter(), grid(), "y.vtu")):
                getattr(writer, "SetDataModeTo" + mode)()
                if compressed:
                    writer.SetCompressorTypeToZLib()
                    writer.SetBlockSize(64)  # several blocks of each array
                else:
                    writer.SetCompressorTypeToNone()
                getattr(writer, "SetHeaderTypeTo" + header)()
                getattr(writer, "SetByteOrderTo" + order)()
                writer.SetEncodeAppendedData(base64)
                with self.subTest(modes=modes, name=name):
                    self.check_read(self.written(writer, data, name))

    def test_other_compressors(self):
        for compressor in ("LZ4", "LZMA"):
            writer = vtkXMLPolyDataWriter()
            getattr(writer, "SetCompressorTypeTo" + compressor)()
            with self.subTest(compressor=compressor):
                self.check_read(self.written(writer, poly_data(), "z.vtp"))

    def test_axes_of_slicer(self):
        for mode, compressed in itertools.product(("Ascii", "Binary", "Appended"), (False, True)):
            data = poly_data()
            space = vtkStringArray()
            space.SetName("SPACE")
            space.InsertNextValue("LPS")
            data.GetFieldData().AddArray(space)
            writer = vtkXMLPolyDataWriter()
            getattr(writer, "SetDataModeTo" + mode)()
            (writer.SetCompressorTypeToZLib if compressed else writer.SetCompressorTypeToNone)()
            self.written(writer, data, "lps.vtp")
            self.expect_done("convert", "lps.vtp", "-o", "read.json")
            tree = json.loads((self.folder / "read.json").read_text())
            self.assertEqual([p[:3] for p in tree["points"]], [[-x, -y, z] for x, y, z in POINTS], (mode, compressed))

    def test_legacy_files(self):
        for binary, version in itertools.product((False, True), (42, 51)):
            for writer, data, name in ((vtkPolyDataWriter(), poly_data(), "p.vtk"),
                                       (vtkUnstructuredGridWriter(), grid(), "u.vtk")):
                (writer.SetFileTypeToBinary if binary else writer.SetFileTypeToASCII)()
                writer.SetFileVersion(version)
                with self.subTest(binary=binary, version=version, name=name):
                    self.written(writer, data, name)
                    if binary:
                        self.check_read(name)
                    else:  # with as many digits as VTK writes
                        self.assertEqual(self.json("info", name, "--json")["branches"], len(LINES))

    def test_vtk_reads_what_ramus_writes(self):
        self.expect_done("grow", "-o", "grown.swc", "--branches", "200", "--seed", "3")
        self.expect_done("convert", "grown.swc", "-o", "grown.vtp")
        self.expect_done("convert", "grown.swc", "-o", "grown.json")
        tree = json.loads((self.folder / "grown.json").read_text())
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(self.folder / "grown.vtp"))
        reader.Update()
        data = reader.GetOutput()
        self.assertEqual(reader.GetErrorCode(), 0)
        radii = data.GetPointData().GetArray("MaximumInscribedSphereRadius")
        self.assertEqual(tree["points"], [[*data.GetPoint(n), radii.GetValue(n)] for n in range(data.GetNumberOfPoints())])
        ids = vtkIdList()
        branches = []
        for cell in range(data.GetNumberOfCells()):
            data.GetCellPoints(cell, ids)
            branches.append([ids.GetId(n) for n in range(ids.GetNumberOfIds())])
        self.assertEqual(tree["branches"], branches)
        cells = data.GetCellData()
        self.assertEqual([cells.GetArray("GroupIds").GetValue(n) for n in range(len(branches))], list(range(len(branches))))
        self.assertEqual({cells.GetArray("Blanking").GetValue(n) for n in range(len(branches))}, {0})
        tracts, ways = cells.GetArray("TractIds"), cells.GetArray("CenterlineIds")
        starts = {branch[0] for branch in branches}
        self.assertEqual(len({ways.GetValue(n) for n in range(len(branches))}),
                         sum(branch[-1] not in starts for branch in branches))  # a centerline for every leaf
        self.assertEqual(min(tracts.GetValue(n) for n in range(len(branches))), 0)
        units = data.GetFieldData().GetAbstractArray("RamusUnits")
        self.assertEqual([units.GetValue(n) for n in range(2)], ["mm", "RAS"])
        self.assertEqual(data.GetFieldData().GetAbstractArray("SPACE").GetValue(0), "RAS")  # what Slicer looks for

    @unittest.skipUnless(FORMATS.is_dir(), "the real files are not here")
    def test_real_files_have_the_same_length(self):
        for name, radii in (("carotid_centerline.vtp", "Radius"), ("coronary_227A.vtk", "radii")):
            reader = (vtkXMLPolyDataReader if name.endswith("p") else vtkPolyDataReader)()
            reader.SetFileName(str(FORMATS / name))
            reader.Update()
            data = reader.GetOutput()
            segments = set()  # by their ends, so that what is traced twice counts once
            for cell in range(data.GetNumberOfCells()):
                points = [data.GetCell(cell).GetPoints().GetPoint(n) for n in range(data.GetCell(cell).GetNumberOfPoints())]
                segments.update(frozenset(pair) for pair in zip(points, points[1:]))
            length = sum(sum((a - b) ** 2 for a, b in zip(*segment)) ** 0.5 for segment in map(tuple, segments))
            info = self.json("info", FORMATS / name, "--json")
            self.assertAlmostEqual(info["length_mm"] / length, 1.0, delta=1e-7)  # VTK keeps single precision
            self.assertEqual(info["segments"], len(segments))
            self.assertAlmostEqual(info["radius_mm"]["max"], data.GetPointData().GetArray(radii).GetRange()[1], places=6)


if __name__ == "__main__":
    if MISSING is not None:
        print(f"SKIPPED: no VTK to compare with ({MISSING}); Debian has it as python3-vtk9")
    else:
        unittest.main()
