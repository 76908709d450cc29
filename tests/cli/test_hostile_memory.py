"""Small files do not fill the memory: JSON of many small values, and bytes that decompress to many."""

import base64
import gzip
import lzma
import struct
import subprocess
import sys
import unittest
import zlib

from ramus import RAMUS, SANITIZER_MEMORY
from test_hostile import SHARED, SIZE, Hostile


class Bounded(Hostile):
    def peak(self, *arguments):
        """Status, standard error, and the most memory in MiB of a run."""
        # A process that is forked begins with its parent's memory, so the parent is a small one.
        wait = "import os, sys; pid = os.spawnv(os.P_NOWAIT, sys.argv[1], sys.argv[1:]); _, status, usage = os.wait4(pid, 0); " \
               "print(os.waitstatus_to_exitcode(status), usage.ru_maxrss >> 10)"
        result = subprocess.run([sys.executable, "-c", wait, RAMUS, *map(str, arguments)], cwd=self.folder, text=True,
                                capture_output=True, timeout=120, check=True)
        status, most = result.stdout.split()[-2:]
        return int(status), result.stderr, 0 if SANITIZER_MEMORY else int(most)  # a sanitizer keeps what was freed


class Values(Bounded):
    def test_values_of_json_do_not_fill_the_memory(self):
        head = '{"format": "ramus-tree", "version": 2, "units": "mm", "orientation": "RAS", "points": [[0,0,0,1],[9,0,0,1]], ' \
               '"branches": [[0,1]], "roots": [0], '
        count = 2_000_000
        for name, element in (("lists", "[]"), ("objects", "{}"), ("texts", '""'), ("numbers", "1"), ("nested", "[[[]]]"),
                              ("members", '{"a":{}}')):
            many = "[" + ",".join([element] * count) + "]"
            files = {"points.json": head.replace("[[0,0,0,1],[9,0,0,1]]", many) + '"notes": []}',
                     "branches.json": head.replace("[[0,1]]", many) + '"notes": []}',
                     "notes.json": head + '"notes": %s}' % many,
                     "systems.json": head + '"systems": %s}' % many,
                     "more.json": head + '"more": [%s]}' % many,
                     "a.mrk.json": '{"@schema": "markups-schema", "markups": %s}' % many,
                     "b.mrk.json": '{"@schema": "markups-schema", "markups": [{"type": "Curve", "controlPoints": %s}]}' % many,
                     "c.mrk.json": '{"@schema": "markups-schema", "markups": [], "ramus": {"curves": [%s]}}' % many,
                     "a.vvg": '{"graph": {"nodes": %s, "edges": []}}' % many,
                     "b.vvg": '{"graph": {"nodes": [{"id": 1, "pos": [0,0,0], "voxels_": %s}], "edges": %s}}' % (many, many)}
            for file, text in files.items():
                if element != "[]" and file not in ("points.json", "b.mrk.json"):
                    continue
                with self.subTest(name, file=file):
                    self.write(file, text)
                    status, error, most = self.peak("info", file)
                    self.assertIn(status, (0, 1), error)
                    # What an idle run has, the text twice, and the values that are kept at once.
                    self.assertLess(most, 60 + 2 * (len(text) >> 20) + 170, (status, error))
            for member in ("tree", "selection", "context", "options", "cuts") if element == "[]" else ("context",):
                with self.subTest(name, member=member):
                    self.write("s.ramus.json", '{"version": 1, "tree": {"path": "tree.swc"}, "%s": %s}' % (member, many))
                    status, error, most = self.peak("mesh", "tree.swc", "--session", "s.ramus.json", "-o", "a.stl")
                    self.assertEqual(status, 1, error)
                    self.assertLess(most, 60 + 2 * (len(many) >> 20) + 170, error)

    def test_elements_of_xml_do_not_fill_the_memory(self):
        count = 6_000_000
        for name, element in (("elements", "<a/>"), ("attributes", '<a b=""/>'), ("words", "<a>1</a>"), ("lines", "\n" * 4)):
            for file, text in (("a.graphml", "<graphml><graph>%s</graph></graphml>"), ("a.gxl", "<gxl><graph>%s</graph></gxl>"),
                               ("a.vtp", '<VTKFile type="PolyData" version="0.1"><PolyData>%s</PolyData></VTKFile>')):
                if element != "<a/>" and file != "a.vtp":
                    continue
                with self.subTest(name, file=file):
                    whole = text % (element * count)
                    self.write(file, whole)
                    status, error, most = self.peak("info", file)
                    self.assertEqual(status, 1, error)
                    self.assertEqual("ten times its text" in error, name != "lines", error)
                    self.assertLess(most, 60 + 3 * (len(whole) >> 20), error)  # pugixml copies what it parses

    def test_a_small_file_stays_small(self):
        bomb = self.write("bomb.json.gz", gzip.compress(b'{"format":"ramus-tree","points":[' + b"[]," * 20_000_000))
        found = SHARED / "json_memory_58kB.json.gz"
        for file in (bomb, found) if found.exists() else (bomb,):
            status, error, most = self.peak("info", file)
            self.assertEqual(status, 1, error)
            self.assertIn("grow to more than 16 MiB", error)
            self.assertLess(most, 100, error)


class Decompressed(Bounded):
    def test_arrays_of_vtk_grow_to_what_the_file_needs(self):
        def packed(data, kind):
            block = zlib.compress(data, 9) if kind == "ZLib" else lzma.compress(data, check=lzma.CHECK_CRC32)
            header = struct.pack("<4I", 1, len(data), 0, len(block))
            return (base64.b64encode(header) + base64.b64encode(block)).decode()

        def vtp(kind, points, connectivity, offsets, radius):
            array = lambda kind, name, data, more="": (  # noqa: E731
                f'<DataArray type="{kind}" Name="{name}" format="binary"{more}>{data}</DataArray>')
            return (f'<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian" header_type="UInt32" '
                    f'compressor="vtk{kind}DataCompressor"><PolyData><Piece NumberOfPoints="2" NumberOfLines="1"><Points>'
                    + array("Float32", "Points", packed(points, kind), ' NumberOfComponents="3"') + "</Points><Lines>"
                    + array("Int8", "connectivity", packed(connectivity, kind)) + array("Int8", "offsets", packed(offsets, kind))
                    + "</Lines><PointData>" + array("Int8", "Radius", packed(radius, kind))
                    + "</PointData></Piece></PolyData></VTKFile>")

        good = {"points": struct.pack("<6f", 0, 0, 0, 9, 0, 0), "connectivity": b"\0\1", "offsets": b"\2", "radius": b"\1\1"}
        for kind in ("ZLib", "LZMA"):
            self.write("good.vtp", vtp(kind, **good))
            self.expect_done("info", "good.vtp")
            for member, value in good.items():
                with self.subTest(kind, member=member):
                    self.write("bad.vtp", vtp(kind, **(good | {member: value + bytes(15 << 20)})))
                    status, error, most = self.peak("info", "bad.vtp")
                    self.assertEqual(status, 1, error)
                    self.assertIn("more values than the file declares", error)
                    self.assertLess(most, 70, error)

    def test_a_picture_has_the_pixels_that_its_bytes_can_hold(self):
        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

        self.write("r.png", b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", 32768, 32768, 1, 0, 0, 0, 0))
                   + chunk(b"IDAT", zlib.compress(bytes(100))) + chunk(b"IEND", b""))
        status, error, most = self.peak("render", "tree.swc", "-o", "a.png", "--reference", "r.png", *SIZE)
        self.assertEqual(status, 1, error)
        self.assertIn("more pixels than the file can hold", error)
        self.assertLess(most, 150, error)


if __name__ == "__main__":
    unittest.main()
