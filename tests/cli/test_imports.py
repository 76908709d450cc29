"""Dialects of tree files: SWC of large reconstructions and of pandas, radii that nobody measured, VTK's compressors."""

import json
import lzma
import os
import pathlib
import struct
import unittest
import zlib

from ramus import CommandLineTest

SHARED = pathlib.Path(os.environ.get("RAMUS_SHARED_DATA", ""))


def swc(points, head=""):
    return head + "".join(" ".join(map(str, point)) + "\n" for point in points)


def chain(radii):
    """A straight vessel: a point each mm."""
    return [(n + 1, 2, 0, 0, n, radius, n or -1) for n, radius in enumerate(radii)]


class Imports(CommandLineTest):
    def radii(self, path, *options):
        self.expect_done("convert", path, "-o", self.folder / "radii.json", *options)
        points = json.loads((self.folder / "radii.json").read_text())["points"]
        (self.folder / "radii.json").unlink()
        return [point[3] for point in points]

    def check_shape(self, path, branches, segments, *options):
        report = self.json("info", path, "--json", *options)
        self.assertEqual((report["branches"], report["segments"]), (branches, segments))
        return report


class Swc(Imports):
    def test_ids_of_18_digits(self):
        first = 720575940661139073
        points = [(first + n, 2, 0, 0, n, 1, first + n - 1 if n else -1) for n in range(4)]
        points.append((first + 4, 2, 3, 0, 3, 1, first + 1))  # neighbours that a double does not tell apart
        self.check_shape(self.write("flywire.swc", swc(points)), 3, 4)
        far = 2 ** 63 - 1
        self.check_shape(self.write("far.swc", f"{far} 2 0 0 0 1 -1\n7 2 0 0 1 1 {far}\n"), 1, 1)
        self.expect_failure("info", self.write("beyond.swc", f"{2 ** 63} 2 0 0 0 1 -1\n7 2 0 0 1 1 {2 ** 63}\n"),
                            says=["beyond.swc:1: the id", "not a whole number"])

    def test_a_header_line_with_column_names(self):
        points = chain([3, 2.5, 2])
        order = (5, 0, 1, 2, 3, 4, 6)  # the radius first
        lines = {
            "pandas": swc(points, "id type x y z radius parent\n"),
            "tabs": swc(points, "ID Type X Y Z Radius Parent\n").replace(" ", "\t"),
            "commas": swc(points, "id type x y z radius parent\n").replace(" ", ","),
            "the number of the row": "".join(
                f"{n},{','.join(map(str, row))}\n" if n else "," + ",".join(row) + "\n" for n, row in
                enumerate([("id", "type", "x", "y", "z", "radius", "parent"), *points])),
            "navis": swc(points, "node_id label x y z radius parent_id\n"),
            "in quotes": swc(points, '"id" "type" "x" "y" "z" "radius" "parent"\n'),
            "behind a comment": swc(points, "# made by hand\n\nn T x y z R P\n".replace(" R P", " r pid")),
            "in another order": swc([[point[n] for n in order] for point in points], "radius id type x y z parent\n"),
            "with more": swc([(*point, 7) for point in points], "id type x y z radius parent confidence\n"),
            "without a type": swc([(*point[:1], *point[2:]) for point in points], "id x y z radius parent\n"),
        }
        for name, content in lines.items():
            with self.subTest(name):
                path = self.write("named.swc", content)
                self.check_shape(path, 1, 2)
                self.assertEqual(self.radii(path), [3, 2.5, 2])
                path.rename(self.folder / "bare")
                self.check_shape(self.folder / "bare", 1, 2)
        for wrong in ("id type x y z\n", "one two three four five six seven\n"):
            self.expect_failure("info", self.write("wrong.swc", swc(points, wrong)),
                                says=["wrong.swc:1:", "id type x y z radius parent"])
        self.expect_failure("info", self.write("wrong.swc", swc(points, "id type x y z radius parent\n") + "9 1 2\n"),
                            says=["wrong.swc:5: expected 7 columns, found 3"])

    def test_the_reported_files(self):
        if not SHARED.is_dir():
            self.skipTest("SKIPPED: no shared/data")
        reports = SHARED / "reports"
        self.check_shape(reports / "huge_ids.swc", 3, 30)
        self.check_shape(reports / "header_line.swc", 3, 30)
        self.check_shape(reports / "tube.tre", 3, 33)
        self.check_shape(reports / "lz4.vtp", 3, 117)
        self.expect_failure("info", reports / "radius_minus_one.swc", says=["not measured", "--repair all"])
        report = self.check_shape(reports / "radius_minus_one.swc", 3, 30, "--repair", "all")
        self.assertGreater(report["radius_mm"]["min"], 0)
        self.assertEqual(self.json("info", reports / "preamble_348.dcm", "--json")["labels"][0]["voxels"], 322)


class Radii(Imports):
    def test_missing_radii_are_interpolated_on_request(self):
        for missing in ("-1", "-1.0", "nan", "NaN"):
            with self.subTest(missing):
                path = self.write("gap.swc", swc(chain([3, missing, missing, 1.5] + [1.5] * 30)))
                self.expect_failure("info", path, says=[
                    "gap.swc:2: the radius was not measured", "--repair all or --repair unmeasured-radii"])
                self.assertEqual(self.radii(path, "--repair", "unmeasured-radii")[:4], [3, 2.5, 2, 1.5])
                report = self.json("info", path, "--json", "--repair", "all")
                self.assertEqual([note["topic"] for note in report["notes"] if note["kind"] == "repaired"],
                                 ["unmeasured-radii"] * 2)
                self.assertEqual([note for note in report["notes"] if note["topic"] == "invented-radii"], [])
        # Along the vessel: 1 mm from a radius of 3, 9 mm from one of 1. Beyond the last measured radius nothing changes.
        path = self.write("uneven.swc", swc([(1, 2, 0, 0, 0, 3, -1), (2, 2, 0, 0, 1, -1, 1), (3, 2, 0, 0, 10, 1, 2),
                                             (4, 2, 0, 0, 12, -1, 3), (5, 2, 0, 0, 15, -1, 4)]))
        self.assertEqual([round(radius, 9) for radius in self.radii(path, "--repair", "all")], [3, 2.8, 1, 1, 1])
        # Where vessels fork, all measured radii around count, the near ones more.
        path = self.write("fork.swc", swc([(1, 2, 0, 0, 0, 4, -1), (2, 2, 0, 0, 2, -1, 1), (3, 2, 2, 0, 2, 2, 2),
                                           (4, 2, -4, 0, 2, 1, 2)]))
        expected = (4 / 2 + 2 / 2 + 1 / 4) / (1 / 2 + 1 / 2 + 1 / 4)
        self.assertAlmostEqual(self.radii(path, "--repair", "all")[1], expected)
        self.expect_failure("info", self.write("negative.swc", swc(chain([3, -0.7, 2]))),
                            "--repair", "all", says=["negative.swc:2", "radius -0.7 is negative"])
        self.expect_failure("info", self.write("infinite.swc", swc(chain([3, "inf", 2]))), "--repair", "all",
                            says=["infinite.swc:2", "not finite"])

    def test_minus_one_means_missing_with_units_and_diameters_too(self):
        path = self.write("gap.swc", swc(chain([3, -1, 1])))
        self.assertEqual(self.radii(path, "--repair", "all", "--units", "cm", "--radius-is", "diameter"), [15, 10, 5])

    def test_one_radius_for_a_file_without_any(self):
        for radius in ("0", "-1", "nan"):
            with self.subTest(radius):
                path = self.write("bare.swc", swc(chain([radius] * 4)))
                self.expect_failure("info", path, says=["no point has a positive radius", "--radius MM"])
                self.assertEqual(self.radii(path, "--radius", "1.5"), [1.5] * 4)
                self.assertEqual(self.radii(path, "--radius", "1.5", "--units", "cm"), [1.5] * 4)
                self.expect_done("mesh", path, "-o", "a.stl", "--radius", "1.5")
                self.expect_done("render", path, "-o", "a.png", "--size", "80x60", "--radius", "1.5")
        report = self.json("info", path, "--json", "--radius", "1.5")
        self.assertIn("the file has no radii: every point has a radius of 1.5 units as asked for", report["assumptions"])
        self.assertIn("4 of 4 radii are invented", report["suspicions"][0])
        measured = self.write("measured.swc", swc(chain([3, 2, 1])))
        self.assertEqual(self.radii(measured, "--radius", "1.5"), [3, 2, 1])
        self.assertTrue(any("is not used" in note for note in
                            self.json("info", measured, "--json", "--radius", "1.5")["assumptions"]))
        some = self.write("some.swc", swc(chain([3, -1, "nan", 1])))
        self.assertEqual(self.radii(some, "--radius", "0.5"), [3, 0.5, 0.5, 1])
        notes = self.json("info", some, "--json", "--radius", "0.5")
        self.assertTrue(any("2 radii that were not measured are taken as 0.5" in note for note in notes["assumptions"]))
        self.assertTrue(any("2 of 4 radii are invented" in note for note in notes["suspicions"]))
        for wrong in ("0", "-1", "nan", "inf", "wide", "auto", "1e30"):
            self.expect_failure("info", path, "--radius", wrong, says=["--radius", "not a number of mm"], status=2)

    def test_named_columns_without_a_radius(self):
        points = [(n, 2, 0, 0, 5 * n, n - 1 if n > 1 else -1) for n in range(1, 5)]
        for separator in (" ", ",", "\t"):
            for names, rows in ((("id", "type", "x", "y", "z", "parent"), points),
                                (("parent_id", "z", "y", "x", "node_id"), [(p[5], p[4], p[3], p[2], p[0]) for p in points])):
                text = "".join(separator.join(map(str, row)) + "\n" for row in (names, *rows))
                for name in ("six.swc", "six"):
                    path = self.write(name, text)
                    self.expect_failure("info", path, says=["no point has a positive radius", "--radius MM"])
                    self.assertEqual(self.radii(path, "--radius", "0.7"), [0.7] * 4)
                self.expect_done("mesh", path, "-o", "a.stl", "--radius", "0.7")
        self.expect_failure("info", self.write("bare.swc", "".join(" ".join(map(str, p)) + "\n" for p in points)),
                            "--radius", "0.7", says=["bare.swc:1", "expected 7 columns, found 6"])

    def test_formats_that_name_no_radius(self):
        files = {
            "a.vtk": "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 0 0 5 0 3 9\n"
                     "LINES 1 4\n3 0 1 2\n",
            "a.graphml": '<graphml><key id="x" for="node" attr.name="X"/><key id="y" for="node" attr.name="Y"/>'
                         '<key id="z" for="node" attr.name="Z"/><graph><node id="0"><data key="x">0</data>'
                         '<data key="y">0</data><data key="z">0</data></node><node id="1"><data key="x">0</data>'
                         '<data key="y">0</data><data key="z">5</data></node><edge source="0" target="1"/></graph>'
                         '</graphml>',
            "a.mrk.json": json.dumps({"markups": [{"type": "Curve", "controlPoints": [
                {"position": [0, 0, z], "positionStatus": "defined"} for z in (0, 5, 9)]}]}),
            "a.tre": "ObjectType = Scene\nNDims = 3\nNObjects = 1\nObjectType = Tube\nNDims = 3\nID = 1\n"
                     "PointDim = x y z\nNPoints = 3\nPoints = \n0 0 0\n0 0 5\n0 0 9\n",
            "a.am": "# AmiraMesh 3D ASCII 2.0\ndefine VERTEX 2\ndefine EDGE 1\ndefine POINT 3\n"
                    "VERTEX { float[3] VertexCoordinates } @1\nEDGE { int[2] EdgeConnectivity } @2\n"
                    "EDGE { int NumEdgePoints } @3\nPOINT { float[3] EdgePointCoordinates } @4\n\n"
                    "@1\n0 0 0\n0 0 9\n\n@2\n0 1\n\n@3\n3\n\n@4\n0 0 0\n0 0 5\n0 0 9\n",
            "t_nodes.csv": "id;pos_x;pos_y;pos_z\n1;0;0;0\n2;0;0;5\n",
        }
        self.write("t_edges.csv", "id;node1id;node2id\n1;1;2\n")
        for name, content in files.items():
            with self.subTest(name):
                path = self.write(name, content)
                self.expect_failure("info", path, says=["radius", "--radius MM"])
                self.assertEqual(set(self.radii(path, "--radius", "0.5")), {0.5})

    def test_many_invented_radii_are_the_first_suspicion(self):
        # Far apart and huge: other suspicions there are.
        few, many = [50] * 20, [50] * 20
        few[3:5], many[3:6] = ["-1"] * 2, ["-1"] * 3
        for radii, invented in ((few, False), (many, True)):
            path = self.write("some.swc", swc(chain(radii)))
            report = self.json("info", path, "--json", "--repair", "all")
            self.assertGreater(len(report["suspicions"]), 1 if invented else 0)
            self.assertEqual("radii are invented" in report["suspicions"][0], invented)
        self.assertEqual(report["notes"][0]["topic"], "invented-radii")
        self.assertIn("3 of 20", report["suspicions"][0])
        # The suspicion stays with the tree.
        self.expect_done("convert", path, "-o", "kept.json", "--repair", "all")
        self.assertIn("3 of 20 radii are invented", self.json("info", "kept.json", "--json")["suspicions"][0])
        zeros = self.write("zeros.swc", swc(chain([2] * 10 + [0] * 5)))
        self.assertIn("5 of 15 radii are invented", self.json("info", zeros, "--json")["suspicions"][0])

    def test_a_session_keeps_the_radius(self):
        self.write("bare.swc", swc(chain([0] * 4)))
        self.write("bare.ramus.json", json.dumps(
            {"version": 1, "tree": {"path": "bare.swc"}, "reading": {"radius_mm": 0.7}}))
        self.expect_done("render", "--session", "bare.ramus.json", "-o", "a.png", "--size", "80x60")
        self.write("bad.ramus.json", json.dumps(
            {"version": 1, "tree": {"path": "bare.swc"}, "reading": {"radius_mm": -2}}))
        self.expect_failure("render", "--session", "bad.ramus.json", "-o", "a.png", says=["radius_mm"])


def lz4_block(plain):
    """A block of LZ4 in which nothing repeats: a token, the count of literals beyond 15 in bytes of 255, the literals."""
    if len(plain) < 15:
        return bytes([len(plain) << 4]) + plain
    rest = len(plain) - 15
    return b"\xf0" + b"\xff" * (rest // 255) + bytes([rest % 255]) + plain


def lz4_zeros(count):
    """`count` zeros as LZ4 writes them: one literal, a long match with the byte before, and five literals at the end."""
    match = count - 6
    more = match - 19
    return b"\x1f\0\1\0" + b"\xff" * (more // 255) + bytes([more % 255]) + b"\x50" + bytes(5)


class Vtk(Imports):
    PACKERS = {
        "vtkZLibDataCompressor": zlib.compress,
        "vtkLZ4DataCompressor": lz4_block,
        "vtkLZMADataCompressor": lambda plain: lzma.compress(plain, lzma.FORMAT_XZ, lzma.CHECK_CRC32),
    }

    def vtp(self, compressor, arrays, points=3, claimed=None):
        """Appended raw; `arrays`: (where, attributes, bytes) in blocks of 32 bytes."""
        body, appended = "", b""
        for place, attributes, plain in arrays:
            blocks = [plain[at:at + 32] for at in range(0, len(plain), 32)]
            packed = [self.PACKERS[compressor](block) for block in blocks]
            if claimed is not None:
                blocks, packed, size, last = claimed
            else:
                size, last = 32, len(plain) % 32
            header = struct.pack(f"<{3 + len(packed)}I", len(blocks), size, last, *map(len, packed))
            body += f'<{place}><DataArray {attributes} format="appended" offset="{len(appended)}"/>' \
                    f'</{place}>'
            appended += header + b"".join(packed)
        body = body.replace("</Lines><Lines>", "")
        return (f'<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian" header_type="UInt32" '
                f'compressor="{compressor}"><PolyData><Piece NumberOfPoints="{points}" NumberOfLines="1">{body}'
                f'</Piece></PolyData><AppendedData encoding="raw">_').encode() + appended + b"</AppendedData></VTKFile>"

    def arrays(self):
        return [("PointData", 'type="Float64" Name="Radius"', struct.pack("<3d", 1, 2, 3)),
                ("Points", 'type="Float32" NumberOfComponents="3"', struct.pack("<9f", 0, 0, 0, 0, 0, 5, 0, 3, 9)),
                ("Lines", 'type="Int64" Name="connectivity"', struct.pack("<3q", 0, 1, 2)),
                ("Lines", 'type="Int64" Name="offsets"', struct.pack("<q", 3))]

    def test_every_compressor(self):
        for compressor in self.PACKERS:
            with self.subTest(compressor):
                path = self.write("packed.vtp", self.vtp(compressor, self.arrays()))
                self.check_shape(path, 1, 2)
                self.assertEqual(self.radii(path), [1, 2, 3])
                self.expect_done("mesh", path, "-o", "a.stl")
                whole = path.read_bytes()
                self.write("packed.vtp", whole.replace(b'"raw">_', b'"raw">_\x7f\x7f\x7f\x7f'))
                self.expect_failure("info", path, says=["packed.vtp:1", "array"])
        self.write("packed.vtp", self.vtp("vtkLZ4DataCompressor", self.arrays()).replace(b"vtkLZ4Data", b"vtkBZ2Data"))
        self.expect_failure("info", path, says=["vtkBZ2DataCompressor", "LZ4"])

    def test_sizes_in_files_are_not_trusted(self):
        """A damaged block, one that claims more or less than it holds, and one that would fill the memory."""
        for compressor in self.PACKERS:
            packed = self.PACKERS[compressor](bytes(24))
            bomb = self.PACKERS["vtkLZMADataCompressor"](bytes(1 << 20)) if "LZMA" in compressor else \
                lz4_zeros(1 << 20) if "LZ4" in compressor else zlib.compress(bytes(1 << 20))
            for name, claim in {
                "damaged": ([0], [packed[:-3]], 32, 24), "more": ([0], [packed], 32, 25), "less": ([0], [packed], 32, 23),
                "negative": ([0], [packed], 32, 0xFFFFFFFF), "bomb": ([0] * 400, [bomb] * 400, 1 << 20, 0),
                "huge": ([0], [packed], 0xFFFFFFFF, 0xFFFFFFF0),
            }.items():
                with self.subTest(compressor=compressor, claim=name):
                    path = self.write("claim.vtp", self.vtp(compressor, self.arrays(), claimed=claim))
                    self.expect_failure("info", path, says=["claim.vtp"])


if __name__ == "__main__":
    unittest.main()
