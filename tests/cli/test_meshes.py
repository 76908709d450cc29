"""ramus mesh: formats with parts, and what it says about surfaces that are to be printed."""

import ctypes
import ctypes.util
import json
import math
import struct
import unittest

import glb
from nifti import nifti
from ply import read_ply
from ramus import GOOD, TUBE, CommandLineTest

# Two systems in ramus' own format.
SYSTEMS = {
    "format": "ramus-tree", "version": 2, "units": "mm", "orientation": "RAS",
    "points": [[0, 0, 0, 1], [0, 0, 10, 1], [5, 0, 20, 1], [-5, 0, 20, 1], [40, 0, 0, 2], [40, 0, 20, 2]],
    "branches": [[0, 1], [1, 2], [1, 3], [4, 5]], "roots": [0, 4],
    "systems": [{"name": "portal vein", "colour": [0, 0, 255]}, {"name": "artery", "colour": [255, 0, 0]}],
    "branch_systems": [0, 0, 0, 1],
}


class GlbTest(CommandLineTest):
    def test_a_node_for_each_branch(self):
        self.write("tree.swc", GOOD)
        self.expect_done("mesh", "tree.swc", "-o", "m.glb")
        self.expect_done("mesh", "tree.swc", "-o", "m.ply")
        gltf, parts = glb.check(self.folder / "m.glb")
        self.assertEqual([name for name, _, _ in parts], ["branch 0", "branch 1", "branch 2"])
        root = gltf["nodes"][gltf["scenes"][0]["nodes"][0]]
        self.assertEqual(root["name"], "tree")
        self.assertEqual(root["scale"], [0.001] * 3)
        self.assertEqual([round(part * part, 9) for part in root["rotation"]], [0, 0.5, 0.5, 0])
        # The same triangles as PLY, at the same places to the bit.
        _, vertices, faces = read_ply(self.folder / "m.ply")
        places = [struct.pack("<3f", *vertex[:3]) for vertex in vertices]
        expected = sorted(tuple(places[n] for n in face) for face in faces)
        found = sorted(tuple(struct.pack("<3f", *positions[n]) for n in triangle)
                       for _, positions, triangles in parts for triangle in triangles)
        self.assertEqual(found, expected)

    def test_parts(self):
        self.write("tree.json", json.dumps(SYSTEMS))
        for words, expected in (((), ["portal vein", "artery"]), (("--parts", "system"), ["portal vein", "artery"]),
                                (("--parts", "branch"), ["branch 0", "branch 1", "branch 2", "branch 3"]),
                                (("--parts", "none"), ["tree"])):
            self.expect_done("mesh", "tree.json", "-o", "m.glb", *words)
            gltf, parts = glb.check(self.folder / "m.glb")
            self.assertEqual([name for name, _, _ in parts], expected)
        self.expect_done("mesh", "tree.json", "-o", "m.glb", "--parts", "branch")
        gltf, _ = glb.check(self.folder / "m.glb")
        nodes = {node["name"]: node for node in gltf["nodes"]}
        children = {gltf["nodes"][child]["name"] for child in nodes["portal vein"]["children"]}
        self.assertEqual(children, {"branch 0", "branch 1", "branch 2"})
        colours = {material["name"]: material["pbrMetallicRoughness"]["baseColorFactor"] for material in gltf["materials"]}
        self.assertEqual(colours, {"portal vein": [0, 0, 1, 1], "artery": [1, 0, 0, 1]})

    def test_branches_are_described(self):
        self.write("tree.json", json.dumps(SYSTEMS))
        known = self.json("info", "tree.json", "--json", "--branches")["branch_list"]
        self.expect_done("mesh", "tree.json", "-o", "m.glb", "--parts", "branch")
        gltf, binary = glb.chunks(self.folder / "m.glb")
        self.assertEqual(gltf["extensionsUsed"], ["EXT_mesh_features"])
        nodes = [node for node in gltf["nodes"] if "mesh" in node]
        self.assertEqual(len(nodes), len(known))
        for node, branch in zip(nodes, known):
            extras = node["extras"]
            self.assertEqual((extras["branch"], extras["parent"], extras["children"]),
                             (branch["id"], branch["parent"], branch["children"]))
            self.assertEqual((extras["generation"], extras["strahler"]), (branch["generation"], branch["strahler"]))
            self.assertAlmostEqual(extras["length"], branch["length_mm"], delta=1e-4)
            self.assertAlmostEqual(2 * extras["radius"], branch["diameter_mm"]["mean"], delta=1e-4)
            self.assertEqual(extras["system"], "artery" if branch["id"] == 3 else "portal vein")
            primitive, = gltf["meshes"][node["mesh"]]["primitives"]
            features, = primitive["extensions"]["EXT_mesh_features"]["featureIds"]
            self.assertEqual((features["attribute"], features["featureCount"]), (0, len(known)))
            self.assertEqual({value for value, in glb.values(gltf, binary, primitive["attributes"]["_FEATURE_ID_0"])},
                             {float(branch["id"])})
        # Of the whole as one part each vertex has its own branch.
        self.expect_done("mesh", "tree.json", "-o", "n.glb", "--parts", "none")
        gltf, binary = glb.chunks(self.folder / "n.glb")
        primitive, = gltf["meshes"][0]["primitives"]
        self.assertEqual({value for value, in glb.values(gltf, binary, primitive["attributes"]["_FEATURE_ID_0"])},
                         {0.0, 1.0, 2.0, 3.0})

    def test_compressed_files_hold_the_same(self):
        """Unpacked by meshoptimizer itself."""
        name = ctypes.util.find_library("meshoptimizer")
        if not name:
            self.skipTest("meshoptimizer is not installed")
        library = ctypes.CDLL(name)
        self.write("tree.swc", GOOD)
        for parts in ("none", "branch"):
            self.expect_done("mesh", "tree.swc", "-o", "m.glb", "--parts", parts)
            self.expect_done("mesh", "tree.swc", "-o", "c.glb", "--parts", parts, "--compress")
            self.assertLess((self.folder / "c.glb").stat().st_size, 0.4 * (self.folder / "m.glb").stat().st_size)
            plain, binary = glb.chunks(self.folder / "m.glb")
            packed, bytes_of = glb.chunks(self.folder / "c.glb")
            self.assertEqual(packed["extensionsRequired"], ["EXT_meshopt_compression", "KHR_mesh_quantization"])
            self.assertLessEqual(packed["buffers"][0]["byteLength"], len(bytes_of))
            unpacked = b"".join(glb.unpacked(view, bytes_of, library) for view in packed["bufferViews"])
            self.assertEqual(len(unpacked), packed["buffers"][1]["byteLength"])
            for before, after in zip(plain["meshes"], packed["meshes"]):
                first, second = before["primitives"][0], after["primitives"][0]

                def both(name):
                    return (glb.values(plain, binary, first["attributes"][name]),
                            glb.values(packed, unpacked, second["attributes"][name]))
                for old, new in zip(*both("POSITION")):
                    self.assertLess(math.dist(old, new), 1e-4)
                box = packed["accessors"][second["attributes"]["POSITION"]]
                seen = both("POSITION")[1]
                self.assertEqual(box["min"], [min(p[k] for p in seen) for k in range(3)])
                self.assertEqual(box["max"], [max(p[k] for p in seen) for k in range(3)])
                for old, new in zip(*both("NORMAL")):
                    length = math.hypot(*new)
                    self.assertGreater(sum(x * y for x, y in zip(old, new)) / length, math.cos(math.radians(1.0)))
                for (old,), (new,) in zip(*both("_RADIUS")):
                    self.assertAlmostEqual(old, new, delta=1e-4 * old)
                self.assertEqual(*both("_FEATURE_ID_0"))
                corners = [[value for value, in glb.values(gltf, data, primitive["indices"])]
                           for gltf, data, primitive in ((plain, binary, first), (packed, unpacked, second))]
                turned = [{tuple(triangle[k:] + triangle[:k]) for k in range(3)}
                          for triangle in (corners[0][n:n + 3] for n in range(0, len(corners[0]), 3))]
                for n, turns in enumerate(turned):
                    self.assertIn(tuple(corners[1][3 * n:3 * n + 3]), turns)
        self.expect_failure("mesh", "tree.swc", "-o", "m.ply", "--compress", says=("not compressed", ".glb"))

    def test_names_and_colours_of_a_session(self):
        self.write("tree.swc", GOOD)
        self.write("c.txt", 'name 0 "Stem \\"of\\" all"\ncolour-by branch\nselect 2\nhide\nsave s.ramus.json\n'.replace('\\"', "'"))
        self.expect_done("render", "tree.swc", "-o", "p.png", "--size", "64x64", "--commands", "c.txt")
        self.expect_done("mesh", "--session", "s.ramus.json", "-o", "m.glb")
        gltf, parts = glb.check(self.folder / "m.glb")
        self.assertEqual([name for name, _, _ in parts], ["Stem 'of' all", "branch 1"])
        self.assertEqual(len({tuple(m["pbrMetallicRoughness"]["baseColorFactor"]) for m in gltf["materials"]}), 2)

    def test_a_mask_has_one_part(self):
        self.write("ball.nii", nifti((9, 9, 9), bytes(1 if (x - 4) ** 2 + (y - 4) ** 2 + (z - 4) ** 2 < 12 else 0
                                                      for z in range(9) for y in range(9) for x in range(9))))
        self.expect_done("mesh", "ball.nii", "-o", "m.glb", "--method", "iso")
        _, parts = glb.check(self.folder / "m.glb")
        self.assertEqual([name for name, _, _ in parts], ["ball"])
        self.expect_failure("mesh", "ball.nii", "-o", "m.glb", "--method", "iso", "--parts", "branch", status=2,
                            says=("--parts", "--method iso"))

    def test_refused_commands_leave_no_file(self):
        self.write("tree.swc", GOOD)
        self.expect_failure("mesh", "tree.swc", "-o", "m.stl", "--parts", "branch", says=("m.stl", "no parts", ".glb"))
        self.expect_failure("mesh", "tree.swc", "-o", "m.glb", "--parts", "system", says=("no systems", "--parts branch"))
        self.expect_failure("mesh", "tree.swc", "-o", "m.glb", "--parts", "leaf", status=2, says=("leaf",))
        self.expect_failure("mesh", "tree.swc", "-o", "m.glb", "--for-printing", says=("metres", ".stl"))
        self.assertEqual(self.names(), ["tree.swc"])


class PrintingTest(CommandLineTest):
    # A stem of 4 mm that forks into a branch of 2 mm and one of 0.5 mm.
    FORK = "# id type x y z radius parent (mm, RAS)\n1 0 0 0 0 2 -1\n2 0 0 0 30 2 1\n3 0 20 0 60 1 2\n4 0 -10 0 40 0.25 2\n5 0 -40 0 70 0.25 4\n"

    def test_thin_places_are_reported(self):
        self.write("fork.swc", self.FORK)
        result = self.expect_done("mesh", "fork.swc", "-o", "m.stl", "--for-printing", "--smooth", "0")
        self.assertIn("closed, in mm; thinnest place 0.49", result.stdout)
        self.assertIn("1 branch is thinner than 0.800 mm", result.stderr)
        figures = self.json("mesh", "fork.swc", "-o", "m.stl", "--for-printing", "--smooth", "0", "--json")["printing"]
        self.assertEqual((figures["closed"], figures["units"], figures["thin_below_mm"]), (True, "mm", 0.8))
        thin = self.json("info", "fork.swc", "--json", "--branches")["branch_list"]
        thinnest = min(thin, key=lambda branch: branch["diameter_mm"]["mean"])["id"]
        self.assertEqual([each["branch"] for each in figures["thin"]], [thinnest])
        # 16 triangles around: a chord is at least (1 + cos(pi / 16)) r = 1.981 r.
        self.assertGreater(figures["thinnest"]["mm"], 1.97 * 0.25)
        self.assertLess(figures["thinnest"]["mm"], 2.01 * 0.25)

    def test_the_threshold(self):
        self.write("fork.swc", self.FORK)
        fine = self.expect_done("mesh", "fork.swc", "-o", "m.ply", "--for-printing", "--thinnest", "0.4")
        self.assertNotIn("thinner", fine.stderr)
        two = self.expect_done("mesh", "fork.swc", "-o", "m.ply", "--for-printing", "--thinnest", "3")
        self.assertIn("2 branches are thinner than 3.00 mm", two.stderr)
        for wrong in ("0", "-1", "nan", "thin"):
            self.expect_failure("mesh", "fork.swc", "-o", "x.ply", "--for-printing", "--thinnest", wrong, status=2)
        self.expect_failure("mesh", "fork.swc", "-o", "x.ply", "--thinnest", "1", status=2, says=("--for-printing",))
        self.expect_failure("mesh", "fork.swc", "-o", "x.ply", "--for-printing", "--method", "cones", says=("cones",))

    def test_several_pieces_are_reported(self):
        self.write("two.swc", "1 0 0 0 0 2 -1\n2 0 0 0 9 2 1\n3 0 30 0 0 2 -1\n4 0 30 0 9 2 3\n")
        result = self.expect_done("mesh", "two.swc", "-o", "m.stl", "--for-printing")
        self.assertIn("2 pieces come out of the printer", result.stderr)

    def test_printing_the_surface_of_a_mask(self):
        # A plate of 2 voxels of 3 mm: 6 mm thick.
        voxels = bytes(1 if 2 <= z < 4 and 2 <= y < 18 and 2 <= x < 18 else 0
                       for z in range(6) for y in range(20) for x in range(20))
        self.write("plate.nii", nifti((20, 20, 6), voxels, rows=((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 3, 0))))
        figures = self.json("mesh", "plate.nii", "-o", "m.stl", "--method", "iso", "--for-printing", "--json")["printing"]
        self.assertAlmostEqual(figures["thinnest"]["mm"], 6.0, places=4)
        self.assertNotIn("branch", figures["thinnest"])
        self.assertEqual(figures["thin"], [])


class IntersectionsTest(CommandLineTest):
    def test_no_triangle_goes_through_another_one(self):
        self.expect_done("grow", "-o", "tree.swc", "--branches", "100")
        figures = self.json("mesh", "tree.swc", "-o", "m.stl", "--detail", "6", "--json")
        self.assertGreater(figures["intersections"]["found"], 0)
        self.assertEqual(figures["intersections"]["left"], 0)
        done = self.expect_done("mesh", "tree.swc", "-o", "m.stl", "--detail", "6", "--verbose")
        self.assertIn("went through each other", done.stderr)
        self.write("tube.swc", TUBE)
        tube = ("mesh", "tube.swc", "-o", "m.stl", "--json")
        none = {"found": 0, "left": 0}
        self.assertEqual((self.json(*tube)["cut_loops"], self.json(*tube)["intersections"]), (0, none))
        # What is not looked for is not told to be none.
        paper, cones = self.json(*tube, "--blend", "paper"), self.json(*tube, "--method", "cones")
        self.assertEqual((paper["cut_loops"], paper["intersections"]), (None, none))
        self.assertEqual((cones["cut_loops"], cones["intersections"]), (None, None))


if __name__ == "__main__":
    unittest.main()
