"""Axes of meshes (RAS, LPS as 3D Slicer writes it), and VTK's files and GLB as surfaces that are read."""

import base64
import json
import os
import pathlib
import struct
import unittest
import zlib

from nifti import nifti
from ramus import CommandLineTest

REPORTS = pathlib.Path(os.environ.get("RAMUS_SHARED_DATA", "")) / "reports"

# A vessel along z, well apart from its place after half a turn about z; the file states its axes.
TREE = "# id type x y z radius parent (mm, RAS)\n1 0 10 20 10 1 -1\n2 0 10 20 30 1 1\n3 0 10 20 50 1 2\n"
# Around its middle: an octahedron.
RAS = [(13, 20, 30), (10, 23, 30), (10, 20, 33), (7, 20, 30), (10, 17, 30), (10, 20, 27)]
LPS = [(-x, -y, z) for x, y, z in RAS]
FACES = [(0, 1, 2), (1, 3, 2), (3, 4, 2), (4, 0, 2), (1, 0, 5), (3, 1, 5), (4, 3, 5), (0, 4, 5)]
FORMATS = ("stl", "ply", "obj", "vtp", "glb")


def stl(points, header):
    body = b"".join(struct.pack("<12fH", *[0.0] * 3, *[c for v in face for c in points[v]], 0) for face in FACES)
    return header.encode().ljust(80) + struct.pack("<I", len(FACES)) + body


def stl_text(points, header):
    facets = ("facet normal 0 0 0\nouter loop\n%sendloop\nendfacet\n" % "".join("vertex %g %g %g\n" % points[v] for v in face)
              for face in FACES)
    return ("solid %s\n" % header + "".join(facets) + "endsolid\n").encode()


def ply(points, comment):
    return ("ply\nformat ascii 1.0\ncomment %s\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 8\nproperty list uchar int vertex_indices\nend_header\n" % comment +
            "".join("%g %g %g\n" % p for p in points) + "".join("3 %d %d %d\n" % f for f in FACES)).encode()


def obj(points, comment):
    return ("# %s\n" % comment + "".join("v %g %g %g\n" % p for p in points) +
            "".join("f %d %d %d\n" % tuple(v + 1 for v in f) for f in FACES)).encode()


def legacy(points, title, faces="POLYGONS 8 32\n" + "".join("3 %d %d %d\n" % f for f in FACES)):
    return ("# vtk DataFile Version 3.0\n%s\nASCII\nDATASET POLYDATA\nPOINTS 6 float\n" % title +
            "".join("%g %g %g\n" % p for p in points) + faces).encode()


def data_array(kind, name, values, letter, how, components=1):
    head = f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}"'
    raw = struct.pack(f"<{len(values)}{letter}", *values)
    if how == "text":
        return f'{head} format="ascii">{" ".join(f"{v:g}" for v in values)}</DataArray>'
    if how == "base64":
        return f'{head} format="binary">{base64.b64encode(struct.pack("<I", len(raw)) + raw).decode()}</DataArray>'
    packed = zlib.compress(raw)
    sizes = base64.b64encode(struct.pack("<4I", 1, len(raw), len(raw), len(packed))).decode()
    return f'{head} format="binary">{sizes}{base64.b64encode(packed).decode()}</DataArray>'


def vtp(points, space, how="text"):
    field = "" if not space else ('<FieldData><Array type="String" Name="SPACE" NumberOfTuples="1" format="ascii">%s 0</Array>'
                                  "</FieldData>" % " ".join(str(ord(c)) for c in space))
    compressor = ' compressor="vtkZLibDataCompressor"' if how == "zlib" else ""
    return (f'<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt32"{compressor}><PolyData>{field}'
            '<Piece NumberOfPoints="6" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="8"><Points>' +
            data_array("Float32", "Points", [c for p in points for c in p], "f", how, 3) + "</Points><Polys>" +
            data_array("Int64", "connectivity", [v for f in FACES for v in f], "q", how) +
            data_array("Int64", "offsets", range(3, 25, 3), "q", how) + "</Polys></Piece></PolyData></VTKFile>").encode()


def vtu(points, cells):
    corners = [v for _, cell in cells for v in cell]
    ends = [sum(len(cell) for _, cell in cells[:n + 1]) for n in range(len(cells))]
    return (f'<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid><Piece '
            f'NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}"><Points>' +
            data_array("Float32", "Points", [c for p in points for c in p], "f", "text", 3) + "</Points><Cells>" +
            data_array("Int64", "connectivity", corners, "q", "text") + data_array("Int64", "offsets", ends, "q", "text") +
            data_array("UInt8", "types", [kind for kind, _ in cells], "B", "text") +
            "</Cells></Piece></UnstructuredGrid></VTKFile>").encode()


def gltf(description, binary=b""):
    text = json.dumps(description).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    return (struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(binary)) + struct.pack("<II", len(text), 0x4E4F534A) + text +
            struct.pack("<II", len(binary), 0x004E4942) + binary)


def glb(points, index="H", **primitive):
    """In metres with +Y up, moved by its node, as programs that know nothing of patients write it."""
    shift = (0.5, 0.25, -0.125)
    places = [(-x / 1000 - shift[0], z / 1000 - shift[1], y / 1000 - shift[2]) for x, y, z in points]
    binary = struct.pack("<18f", *[c for p in places for c in p])
    corners = [v for f in FACES for v in f]
    return gltf({
        "asset": {"version": "2.0", "generator": "another"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"children": [1]}, {"mesh": 0, "translation": shift}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, **primitive}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3"},
                      {"bufferView": 1, "componentType": {"B": 5121, "H": 5123, "I": 5125}[index], "count": 24, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(binary)},
                        {"buffer": 0, "byteOffset": len(binary), "byteLength": struct.calcsize(f"<24{index}")}],
        "buffers": [{"byteLength": len(binary) + struct.calcsize(f"<24{index}")}]}, binary + struct.pack(f"<24{index}", *corners))


class MeshAxes(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("tree.swc", TREE)
        self.write("right.stl", stl(RAS, "SPACE=RAS"))

    def apart(self, a, b, *arguments):
        """How far two surfaces are from each other, and what was said on standard error."""
        done = self.expect_done("compare", a, b, "--json", *arguments)
        return json.loads(done.stdout)["hausdorff"], done.stderr


class StatedAxes(MeshAxes):
    def test_headers_and_comments_of_slicer(self):
        for name, make in (("a.stl", stl), ("t.stl", stl_text), ("a.ply", ply), ("a.obj", obj), ("a.vtk", legacy)):
            for points, axes in ((LPS, "LPS"), (RAS, "RAS")):
                with self.subTest(name=name, axes=axes):
                    self.write(name, make(points, "3D Slicer output. SPACE=" + axes))
                    distance, told = self.apart(name, "right.stl")
                    self.assertEqual((distance, told), (0.0, ""))
        for how in ("text", "base64", "zlib"):
            self.write("a.vtp", vtp(LPS, "LPS", how))
            self.assertEqual(self.apart("a.vtp", "right.stl"), (0.0, ""))

    def test_meshes_without_stated_axes_are_ras_unless_the_option_says_lps(self):
        for name, content in (("a.stl", stl(LPS, "SPACE=FOO")), ("a.ply", ply(LPS, "SPACE = LPS")), ("a.vtp", vtp(LPS, "")),
                              ("a.obj", obj(LPS, "none") + b"# SPACE=LPS\n"), ("a.vtk", legacy(LPS, "none")), ("a.glb", glb(LPS))):
            with self.subTest(name=name):
                self.write(name, content)
                distance, told = self.apart(name, "tree.swc")
                self.assertGreater(distance, 40.0)
                self.assertIn("180 degrees", told)
                self.assertIn("--mesh-orientation LPS", told)
                distance, told = self.apart(name, "right.stl", "--mesh-orientation", "LPS")
                self.assertLess(distance, 1e-4)
                self.assertEqual(told, "")

    def test_the_option_does_not_replace_stated_axes(self):
        self.write("a.stl", stl(LPS, "SPACE=LPS"))
        distance, told = self.apart("a.stl", "right.stl", "--mesh-orientation", "RAS")
        self.assertEqual(distance, 0.0)
        self.assertIn("a.stl: the file states that its axes are LPS", told)
        self.expect_failure("compare", "a.stl", "right.stl", "--mesh-orientation", "LAS", status=2, says=("LAS", "LPS"))

    def test_two_meshes_without_stated_axes(self):
        self.write("a.obj", obj(LPS, "")), self.write("b.obj", obj(RAS, ""))
        distance, told = self.apart("a.obj", "b.obj")
        self.assertGreater(distance, 40.0)
        self.assertIn("--mesh-orientation LPS,RAS", told)
        self.assertEqual(self.apart("a.obj", "b.obj", "--mesh-orientation", "LPS,RAS"), (0.0, ""))

    def test_a_tree_without_stated_axes_may_be_rotated(self):
        self.write("bare.swc", "".join(f"{n} 0 -10 -20 {10 + 20 * n} 1 {n - 1 or -1}\n" for n in (1, 2)))
        _, told = self.apart("right.stl", "bare.swc")
        self.assertIn("--orientation LPS", told)
        self.assertNotIn("--mesh-orientation", told)
        self.assertEqual(self.apart("right.stl", "bare.swc", "--orientation", "LPS")[1], "")

    def test_a_distant_mesh_gives_no_advice(self):
        self.write("far.stl", stl([(x + 500, y, z) for x, y, z in RAS], ""))
        self.assertEqual(self.apart("far.stl", "tree.swc")[1], "")

    def test_validate(self):
        self.write("a.stl", stl(LPS, ""))
        told = self.expect_done("validate", "tree.swc", "--surface", "a.stl", "--json").stderr
        self.assertIn("--mesh-orientation LPS", told)
        done = self.expect_done("validate", "tree.swc", "--surface", "a.stl", "--json", "--mesh-orientation", "LPS")
        self.assertEqual(done.stderr, "")

    def test_context_lesions_and_deviation(self):
        size = ("--size", "200x150")
        for name, points, header in (("silent", LPS, ""), ("says", LPS, "SPACE=LPS"), ("right", RAS, "SPACE=RAS")):
            (self.folder / name).mkdir()
            self.write(name + "/m.stl", stl(points, header))
        for command, *more in (("context",), ("lesion-mesh",), ("deviation-from",)):
            with self.subTest(command=command):
                asked = " --mesh-orientation LPS"
                for name, line in (("right", "right/m.stl"), ("says", "says/m.stl"), ("silent", "silent/m.stl" + asked)):
                    self.write("c.txt", f"{command} {line}\nsave {name}.ramus.json\n")
                    told = self.expect_done("render", "tree.swc", "-o", name + ".png", *size, "--commands", "c.txt", "--overwrite").stderr
                    self.assertEqual(told, "")
                    self.expect_done("render", "--session", name + ".ramus.json", "-o", name + "2.png", *size)
                pictures = {(self.folder / name).read_bytes() for name in ("right.png", "says.png", "silent.png", "silent2.png")}
                self.assertEqual(len(pictures), 1)
        self.write("c.txt", "lesion-mesh silent/m.stl\n")
        told = self.expect_done("render", "tree.swc", "-o", "x.png", *size, "--commands", "c.txt", "--context", "silent/m.stl").stderr
        self.assertEqual(told.count("read it with --mesh-orientation LPS"), 2)
        self.expect_failure("render", "tree.swc", "-o", "y.png", *size, "--deviation-from", "silent/m.stl",
                            says=("180 degrees", "--mesh-orientation LPS"))
        self.expect_done("render", "tree.swc", "-o", "y.png", *size, "--deviation-from", "silent/m.stl", "--mesh-orientation", "LPS")
        self.write("mask.nii", nifti((4, 4, 4), bytes(64)))
        self.write("c.txt", "context mask.nii --mesh-orientation LPS\n")
        self.expect_failure("render", "tree.swc", "-o", "z.png", *size, "--commands", "c.txt", says=("a mask states its axes",))


class WrittenAxes(MeshAxes):
    def test_every_format_states_its_axes(self):
        for extension in FORMATS:
            self.expect_done("mesh", "tree.swc", "-o", "plain." + extension)
            for axes in ("LPS", "RAS"):
                with self.subTest(extension=extension, axes=axes):
                    name = f"{axes}.{extension}"
                    figures = self.json("mesh", "tree.swc", "-o", name, "--axes", axes, "--json")
                    self.assertEqual(figures["orientation"], axes)
                    distance, told = self.apart(name, "plain." + extension)
                    self.assertEqual(told, "")
                    self.assertLessEqual(distance, 1e-5 if extension == "glb" else 0.0)  # its nodes turn in single precision
                    self.assertLess(self.apart(name, "plain.stl")[0], 1e-5)  # numbers of text may round
                    found = self.json("validate", "tree.swc", "--surface", name, "--json")
                    self.assertEqual(found["questions"]["lost"], [])
        self.assertIn(b"SPACE=LPS", (self.folder / "LPS.stl").read_bytes()[:80])
        for name in ("LPS.ply", "LPS.obj"):
            head = (self.folder / name).read_bytes()[:300].decode(errors="replace").splitlines()
            self.assertTrue(any(line.lstrip("#").startswith(("comment", " ")) and "SPACE=LPS" in line for line in head), head)
        # The numbers are turned, not only their name.
        self.assertIn(b"\nv -", (self.folder / "LPS.obj").read_bytes())
        self.assertNotIn(b"\nv -", (self.folder / "RAS.obj").read_bytes())
        self.assertNotIn(b" -0 ", (self.folder / "LPS.obj").read_bytes())

    def test_unknown_axes_are_not_stated(self):
        self.write("bare.swc", "".join(line for line in TREE.splitlines(True) if not line.startswith("#")))
        for extension in FORMATS:
            with self.subTest(extension=extension):
                self.expect_done("mesh", "bare.swc", "-o", "m." + extension)
                self.assertNotIn(b"SPACE", (self.folder / ("m." + extension)).read_bytes())
                self.expect_failure("mesh", "bare.swc", "-o", "l." + extension, "--axes", "LPS",
                                    says=("bare.swc", "axes of the tree are unknown", "--orientation"))
                self.expect_done("mesh", "bare.swc", "-o", "l." + extension, "--axes", "LPS", "--orientation", "RAS")
                distance, told = self.apart("l." + extension, "m." + extension)
                self.assertEqual(told, "")
                self.assertLessEqual(distance, 1e-5 if extension == "glb" else 0.0)
        self.expect_failure("mesh", "tree.swc", "-o", "m.stl", "--axes", "PIR", status=2, says=("PIR", "LPS"))

    def test_a_mask(self):
        block = bytes(1 if 2 <= x < 6 and 2 <= y < 6 and 2 <= z < 6 else 0 for z in range(8) for y in range(8) for x in range(8))
        self.write("mask.nii", nifti((8, 8, 8), block, rows=((1, 0, 0, 40), (0, 1, 0, 40), (0, 0, 1, 0))))
        self.expect_done("mesh", "mask.nii", "-o", "l.stl", "--method", "iso", "--axes", "LPS")
        self.assertEqual(self.apart("l.stl", "mask.nii"), (0.0, ""))

    def test_trees(self):
        expected = self.json("info", "tree.swc", "--json", "--branches")["branch_list"]
        for name in ("t.vtp", "t.mrk.json"):
            content = {}
            for axes in ("LPS", "RAS"):
                with self.subTest(name=name, axes=axes):
                    self.expect_done("convert", "tree.swc", "-o", name, "--axes", axes)
                    content[axes] = (self.folder / name).read_bytes()
                    found = self.json("info", name, "--json", "--branches")
                    self.assertEqual((found["orientation"], found["branch_list"]), ("RAS", expected))
            self.assertNotEqual(content["LPS"], content["RAS"])
        self.assertEqual(json.loads(content["RAS"])["markups"][0]["coordinateSystem"], "RAS")
        self.expect_failure("convert", "tree.swc", "-o", "t.graphml", "--axes", "LPS", says=("t.graphml", ".vtp or .mrk.json"))
        self.expect_done("convert", "tree.swc", "-o", "t.graphml", "--axes", "RAS")
        self.write("bare.swc", "1 0 1 2 3 1 -1\n2 0 1 2 9 1 1\n")
        self.expect_failure("convert", "bare.swc", "-o", "b.vtp", "--axes", "LPS", says=("axes of the tree are unknown", "--orientation"))


class SurfacesThatAreRead(MeshAxes):
    def test_all_kinds_of_vtk_files(self):
        strips = "TRIANGLE_STRIPS 2 14\n6 0 1 2 3 4 0\n6 5 0 1 3 4 5\n"
        grid = [(5, f) for f in FACES[:6]] + [(7, f) for f in FACES[6:]]
        files = {"polygons.vtk": legacy(RAS, "x"), "text.vtp": vtp(RAS, ""), "base64.vtp": vtp(RAS, "", "base64"),
                 "zlib.vtp": vtp(RAS, "", "zlib"), "cells.vtu": vtu(RAS, grid),
                 "mixed.vtu": vtu(RAS, grid + [(3, (0, 1)), (10, (0, 1, 2, 3))])}
        for name, content in files.items():
            with self.subTest(name=name):
                self.write(name, content)
                if name != "mixed.vtu":
                    self.assertEqual(self.apart(name, "right.stl"), (0.0, ""))
                self.expect_done("render", "tree.swc", "-o", "p.png", "--size", "64x64", "--context", name)
                found = self.json("validate", "tree.swc", "--surface", name, "--json")
                self.assertIn("lost", found["questions"])
        self.write("strips.vtk", legacy(RAS, "x", strips))
        self.expect_done("render", "tree.swc", "-o", "p.png", "--size", "64x64", "--context", "strips.vtk")

    def test_faces_of_every_kind(self):
        # A cube of pixels, quads and strips, and of curved quads: their corners count.
        corners = [(x, y, z) for z in (0, 2) for y in (0, 2) for x in (0, 2)]
        pixels = [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 4, 5), (2, 3, 6, 7), (0, 2, 4, 6), (1, 3, 5, 7)]
        quads = [(a, b, d, c) for a, b, c, d in pixels]
        for kind, cells in ((8, pixels), (6, pixels), (9, quads), (7, quads), (23, [q + q for q in quads]), (36, [q + q for q in quads])):
            with self.subTest(kind=kind):
                self.write("cube.vtu", vtu(corners, [(kind, cell) for cell in cells]))
                figures = self.json("compare", "cube.vtu", "cube.vtu", "--json")
                self.assertAlmostEqual(figures["volume_mm3"], 8.0, places=5)

    def test_glb_of_other_programs(self):
        for index in "BHI":
            self.write("a.glb", glb(RAS, index))
            self.assertLess(self.apart("a.glb", "right.stl")[0], 1e-4)
        self.write("c.txt", "lesion-mesh a.glb\n")
        self.expect_done("render", "tree.swc", "-o", "p.png", "--size", "64x64", "--commands", "c.txt", "--context", "a.glb")

    def test_damaged_and_unusual_glb(self):
        good = glb(RAS)
        bad = {"cut": good[:-40], "short": good[:16], "text": good[:20] + b"x" + good[21:], "version": good[:4] + b"\1" + good[5:],
               "points": glb(RAS, mode=0), "index": good[:-4] + b"\xff\xff\xff\xff"}
        for name, content in bad.items():
            with self.subTest(name=name):
                self.write("bad.glb", content)
                self.expect_failure("compare", "bad.glb", "right.stl", says=("bad.glb",))
        loop = {"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"children": [0, 0, 1]}, {"children": [0]}]}
        far = {"asset": {"version": "2.0"}, "nodes": [{"mesh": 9}]}
        away = {"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 2 ** 60, "type": "VEC3"}],
                "bufferViews": [{"buffer": 0, "byteLength": 2 ** 62}], "buffers": [{"byteLength": 8, "uri": "/etc/passwd"}]}
        packed = {"asset": {"version": "2.0"}, "extensionsRequired": ["KHR_draco_mesh_compression"]}
        for name, description, words in (("loop", loop, "damaged"), ("far", far, "damaged"), ("away", away, "damaged"),
                                         ("packed", packed, "compressed")):
            with self.subTest(name=name):
                self.write("bad.glb", gltf(description))
                self.expect_failure("compare", "bad.glb", "right.stl", says=("bad.glb", words))
        away["buffers"] = [{"byteLength": 8}]
        self.write("bad.glb", gltf(away))
        self.expect_failure("compare", "bad.glb", "right.stl", says=("bad.glb", "damaged"))

    def test_messages_fit_the_command(self):
        self.write("surface.vtp", vtp(RAS, ""))
        said = self.expect_failure("info", "surface.vtp", says=("surface.vtp", "8 faces, not a tree")).stderr
        self.assertNotIn("compare", said)
        self.expect_failure("info", "right.stl", says=("right.stl", "a surface mesh, not a tree"))
        self.expect_done("convert", "tree.swc", "-o", "tree.vtp")
        for command in (("validate", "tree.swc", "--surface", "tree.vtp"),
                        ("render", "tree.swc", "-o", "p.png", "--context", "tree.vtp"),
                        ("render", "tree.swc", "-o", "p.png", "--deviation-from", "tree.vtp")):
            self.expect_failure(*command, says=("tree.vtp", "a tree, not a surface"))
        self.assertEqual(self.apart("tree.vtp", "tree.swc")[0], 0.0)  # a tree, whose surface is made
        self.write("solid.vtu", vtu(RAS, [(10, (0, 1, 2, 3))]))
        self.expect_failure("compare", "solid.vtu", "right.stl", says=("a volume mesh of 1 cell, not a surface",))
        self.write("odd.xyz", "what?")
        self.expect_failure("compare", "odd.xyz", "right.stl", says=("odd.xyz", ".stl", ".swc", ".nii"))


@unittest.skipUnless(REPORTS.is_dir(), "the files of the reports are not here")
class Reports(MeshAxes):
    def test_meshes_of_slicer_lie_on_their_vessel(self):
        line = REPORTS / "slicer_line_lps.vtp"
        for name in ("slicer_lps.stl", "slicer_lps.ply"):
            done = self.expect_done("compare", REPORTS / name, line, "--json")
            self.assertLess(json.loads(done.stdout)["max"], 2.1)  # of radius 3 around one of radius 1
            self.assertNotIn("180", done.stderr)
            self.expect_done("render", line, "-o", "p.png", "--size", "64x64", "--context", REPORTS / name)

    def test_a_surface_of_vtk(self):
        self.assertEqual(self.apart(REPORTS / "surface.vtp", REPORTS / "surface.vtp")[0], 0.0)
        self.expect_done("render", REPORTS / "slicer_line_lps.vtp", "-o", "p.png", "--size", "64x64",
                         "--context", REPORTS / "surface.vtp")


if __name__ == "__main__":
    unittest.main()
