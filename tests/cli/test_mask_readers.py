"""What readers of masks make of NaN, of two forms that differ, of values in several files, and of Amira's other files."""

import gzip
import math
import struct
import unittest

from nifti import nifti
from ramus import CommandLineTest

SIZE = (12, 10, 30)


def tube(i, j, k):
    return int((i - 6) ** 2 + (j - 5) ** 2 <= 9 and 2 <= k < 28)


def values(of=tube):
    return [of(i, j, k) for k in range(SIZE[2]) for j in range(SIZE[1]) for i in range(SIZE[0])]


NRRD = "NRRD0004\ntype: uint8\ndimension: 3\nspace: RAS\nsizes: 12 10 30\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
META = "ObjectType = Image\nNDims = 3\nDimSize = 12 10 30\nElementType = MET_UCHAR\nTransformMatrix = 1 0 0 0 1 0 0 0 1\n"


class MaskReaders(CommandLineTest):
    def voxels_inside(self, name):
        return self.json("info", name, "--json")["labels"][0]["voxels"]

    def test_nan_is_outside(self):
        inside = sum(values())
        mask = [float(v) if v else math.nan if n % 3 == 0 else 0.0 for n, v in enumerate(values())]
        lost = sum(math.isnan(v) for v in mask)
        for kind in "fd":
            self.write("mask.nii", nifti(SIZE, mask, kind))
            info = self.json("info", "mask.nii", "--json")
            self.assertIn(f"{lost} voxels are NaN: taken as outside", info["notes"])
            report = self.json("skeletonize", "mask.nii", "-o", "tree.json", "--json")
            self.assertEqual((report["mask"]["voxels"], report["roots"]), (inside, 1))
            self.assertTrue(any("NaN" in note["text"] for note in report["notes"]))
        # Of a scan below 0 what is outside is not brighter than the threshold.
        scan = [-100.0 + v if v else math.nan if n % 2 else -900.5 for n, v in enumerate(values())]
        self.write("scan.nii", nifti(SIZE, scan, "f"))
        report = self.json("skeletonize", "scan.nii", "-o", "tree.json", "--isovalue", "-500", "--json")
        self.assertEqual(report["mask"]["voxels"], inside)

    def test_contradicting_transforms_are_noted(self):
        mask = bytearray(nifti(SIZE, values()))
        struct.pack_into("<h", mask, 252, 1)
        self.write("same.nii", bytes(mask))
        self.assertFalse(any("qform" in note for note in self.json("info", "same.nii", "--json")["notes"]))
        struct.pack_into("<3f", mask, 268, 3.0, 0.0, 4.0)  # qoffset
        self.write("apart.nii", bytes(mask))
        self.assertIn("the sform and the qform of the file differ, by up to 5 mm within the volume: the sform was taken",
                      self.json("info", "apart.nii", "--json")["notes"])

    def test_large_labels(self):
        def pair(first, second):  # two tubes side by side
            return values(lambda i, j, k: first if tube(i + 3, j, k) else second if tube(i - 3, j, k) and i > 6 else 0)

        for kind, labels in (("i", (70000, 2 ** 31 - 1)), ("I", (1, 70000))):
            self.write("mask.nii", nifti(SIZE, pair(*labels), kind))
            found = self.json("info", "mask.nii", "--json")["labels"]
            self.assertEqual([label["label"] for label in found], sorted(labels))
            self.json("skeletonize", "mask.nii", "-o", "tree.json", "--label", f"{labels[0]},{labels[1]}", "--json")
            self.expect_done("mesh", "mask.nii", "-o", "a.stl", "--method", "iso", "--label", str(labels[1]))
        # Of 18 digits, as those of neurons: chosen by the file's number.
        neurons = (720575940621039145, 720575940627218563)
        for name, header, code in (("i", "int64", "q"), ("u", "uint64", "Q")):
            raw = struct.pack(f"<{len(values())}{code}", *pair(*neurons))
            self.write(name + ".nrrd", (NRRD.replace("uint8", header) + "encoding: raw\nendian: little\n\n").encode() + raw)
            info = self.json("info", name + ".nrrd", "--json")
            self.assertEqual([label["name"] for label in info["labels"]], [str(n) for n in neurons])
            self.assertTrue(any("more than 32 bits" in note for note in info["notes"]))
            self.expect_done("mesh", name + ".nrrd", "-o", "a.stl", "--method", "iso", "--label", str(neurons[1]))
            self.json("skeletonize", name + ".nrrd", "-o", "tree.json", "--json")
            systems = self.json("info", "tree.json", "--json")["systems"]
            self.assertEqual(systems, [str(n) for n in neurons])
        many = [2 ** 40 + n for n in range(len(values()))]
        raw = struct.pack(f"<{len(many)}q", *many)
        self.write("one.nrrd", (NRRD.replace("uint8", "int64") + "encoding: raw\nendian: little\n\n").encode() + raw)
        self.expect_done("info", "one.nrrd")
        mixed = [2 ** 40, 1] + [0] * (len(many) - 2)  # the large one gets the number of the small one
        raw = struct.pack(f"<{len(many)}q", *mixed)
        self.write("mixed.nrrd", (NRRD.replace("uint8", "int64") + "encoding: raw\nendian: little\n\n").encode() + raw)
        self.expect_failure("info", "mixed.nrrd", says=("mixed.nrrd", "number the labels anew"))

    def slices(self, name="s{:03}.raw", first=1):
        raw = bytes(values())
        each = len(raw) // SIZE[2]
        names = [name.format(first + n) for n in range(SIZE[2])]
        for n, file in enumerate(names):
            self.write(file, raw[n * each:(n + 1) * each])
        return names

    def test_values_in_several_files(self):
        names = self.slices()
        listed = "\n".join(names) + "\n"
        cases = {"list.nhdr": NRRD + "encoding: raw\ndata file: LIST\n" + listed,
                 "subdim.nhdr": NRRD + "encoding: raw\ndata file: LIST 2\n" + listed,
                 "pattern.nhdr": NRRD + "encoding: raw\ndata file: s%03d.raw 1 30 1\n",
                 "list.mhd": META + "ElementDataFile = LIST\n" + listed,
                 "pattern.mhd": META + "ElementDataFile = s%03d.raw 1 30 1\n"}
        for name, header in cases.items():
            with self.subTest(name):
                self.write(name, header)
                self.assertEqual(self.voxels_inside(name), sum(values()))
                self.assertEqual(self.json("skeletonize", name, "-o", "tree.json", "--json")["branches"], 1)
        for name in names:  # compressed one by one
            self.write(name + ".gz", gzip.compress((self.folder / name).read_bytes()))
        self.write("gzip.nhdr", NRRD + "encoding: gzip\ndata file: s%03d.raw.gz 1 30 1\n")
        self.assertEqual(self.voxels_inside("gzip.nhdr"), sum(values()))

    def test_errors_of_values_in_several_files(self):
        self.slices()
        (self.folder / "below").mkdir()
        cases = {"LIST\n": "lists no file", "LIST\ns001.raw\n": "s001.raw should have 3600 bytes, and has 120",
                 "LIST\n" + "s001.raw\n" * 7: "cannot be parted", "s%03d.raw 1 31 1": "cannot be parted",
                 "s%03d.raw 2 31 1": "no such file", "s%s.raw 1 30 1": "make no sense", "s%n%03d.raw 1 30 1": "make no sense",
                 "s%03d.raw 1 30 0": "make no sense", "s%03d.raw 1 900000000 1": "more than 65,536 files",
                 "LIST\n" + "../outside.raw\n" * 30: "no such file", "LIST\n" + "/dev/zero\n" * 30: "no regular file",
                 "LIST\n" + "below\n" * 30: "no regular file", "LIST\n" + "/etc/passwd\n" * 30: "outside of the header's folder"}
        for names, says in cases.items():
            for header, field in ((NRRD + "encoding: raw\n", "data file: "), (META, "ElementDataFile = ")):
                with self.subTest(names=names[:20], field=field):
                    name = "bad.nhdr" if header.startswith("NRRD") else "bad.mhd"
                    self.write(name, header + field + names)
                    self.expect_failure("info", name, says=(name, says))
        self.write("s007.raw", b"\0" * 119)
        self.write("short.mhd", META + "ElementDataFile = s%03d.raw 1 30 1\n")
        self.expect_failure("info", "short.mhd", says=("s007.raw should have 120 bytes, and has 119",))
        for n in range(1, 31):
            self.write(f"s{n:03}.raw.gz", gzip.compress(b"\0" * (121 if n == 9 else 120)))
        self.write("long.nhdr", NRRD + "encoding: gzip\ndata file: s%03d.raw.gz 1 30 1\n")
        self.expect_failure("info", "long.nhdr", says=("s009.raw.gz", "holds more than 120 bytes"))

    def test_amira(self):
        graph = """# AmiraMesh 3D ASCII 2.0
define VERTEX 2
define EDGE 1
define POINT 3
Parameters { ContentType "HxSpatialGraph" }
VERTEX { float[3] VertexCoordinates } @1
EDGE { int[2] EdgeConnectivity } @2
EDGE { int NumEdgePoints } @3
POINT { float[3] EdgePointCoordinates } @4
POINT { float thickness } @5

@1 # the vertices
0 0 0
0 0 10
@2 # the edges
0 1
@3
3
@4 # points
0 0 0
0 0 5
0 0 10
@5
1
1
1
"""
        self.write("graph.am", graph)
        self.assertEqual(self.json("info", "graph.am", "--json")["branches"], 1)
        lattice = ("# AmiraMesh BINARY-LITTLE-ENDIAN 2.1\ndefine Lattice 4 4 2\nParameters { Content \"4x4x2 byte, uniform "
                   "coordinates\" }\nLattice { byte Labels } @1\n\n@1\n")
        self.write("labels.am", lattice.encode() + bytes(32))
        self.write("tetra.am", "# AmiraMesh ASCII 1.0\nnNodes 4\ndefine Nodes 4\ndefine Tetrahedra 1\nNodes { float[3] "
                               "Coordinates } @1\nTetrahedra { int[4] Nodes } @2\n@1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n@2\n1 2 3 4\n")
        self.write("surface.am", "# HyperSurface 0.1 ASCII\nVertices 1\n0 0 0\n")
        for name, says in (("labels.am", "a lattice of voxels"), ("tetra.am", "a tetrahedral grid"),
                           ("surface.am", "a surface of triangles")):
            with self.subTest(name):
                self.expect_failure("info", name, says=(name, says, "HxSpatialGraph"))


if __name__ == "__main__":
    unittest.main()
