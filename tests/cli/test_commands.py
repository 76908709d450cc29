"""What the commands print and write when all is well, and what wrong usage is."""

import json
import math
import struct
import unittest

from ramus import GOOD, CommandLineTest


class Usage(CommandLineTest):
    def test_help_and_version_everywhere(self):
        for command in ([], ["mesh"], ["info"], ["convert"], ["render"], ["grow"]):
            with self.subTest(command):
                self.assertIn("Usage: ramus", self.expect_done(*command, "--help").stdout)
                self.assertRegex(self.expect_done(*command, "--version").stdout, r"^ramus \d+\.\d+\.\d+\n$")

    def test_wrong_usage_is_status_2(self):
        tree = self.write("tree.swc", GOOD)
        for arguments in (["mesh"], ["mesh", tree], ["mesh", "-o", "out.ply"], ["info"], ["convert", tree], ["nonsense"],
                          ["info", tree, "--nonsense"], ["info", tree, "one too many"], ["--nonsense"],
                          ["mesh", tree, "-o", "out.ply", "--method", "magic"]):
            with self.subTest(arguments):
                self.expect_failure(*arguments, status=2)
        for option, values in {"--width": ("0", "-1", "nan", "wide"), "--detail": ("3", "513", "8.5", "-16"),
                               "--cell": ("0", "-1", "nan", "inf"), "--smooth": ("-1", "101", "1.5"),
                               "--prune": ("-0.1", "nan"), "--threads": ("-1", "many"), "--repair": ("some",)}.items():
            for value in values:
                with self.subTest(option, value=value):
                    self.expect_failure("mesh", tree, "-o", "out.ply", option + "=" + value, status=2, says=[option])
        self.expect_failure("mesh", tree, "-o", "out.ply", "--cell", "1", "--detail", "8", status=2)
        self.assertEqual(self.names(), ["tree.swc"])


class Sessions(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.tree = self.write("tree.swc", GOOD)

    def session(self, *hidden, **options):
        names = {"smooth": 1, "prune": 0.0, "width": 5.0, "detail": 16, "method": "cs", **options}
        return self.write("session.json", json.dumps({"version": 1, "tree": {"path": "tree.swc"},
                                                      "states": {"hidden": list(hidden)}, "options": names}))

    def test_hidden_branches_are_left_out_and_the_surface_closes(self):
        whole = self.json("mesh", self.tree, "-o", "whole.ply", "--json")
        part = self.json("mesh", "--session", self.session(1), "-o", "part.ply", "--json")
        self.assertEqual((whole["components"], part["components"]), (1, 1))
        self.assertLess(part["triangles"], 0.9 * whole["triangles"])
        # Euler: a closed surface without handles.
        self.assertEqual(part["triangles"], 2 * (part["vertices"] - 2))
        apart = self.json("mesh", "--session", self.session(0), "-o", "apart.ply", "--json")
        self.assertLess(apart["triangles"], part["triangles"])
        cones = self.json("mesh", "--session", self.session(1, 2), "--method", "cones", "-o", "cones.ply", "--json")
        self.assertEqual(cones["components"], 2)  # one for each segment of the stem

    def test_the_command_line_wins_over_the_session(self):
        session = self.session(detail=8)
        coarse = self.json("mesh", self.tree, "--session", session, "-o", "a.ply", "--json")
        self.assertEqual(coarse["triangles"], self.json("mesh", self.tree, "--detail", 8, "-o", "b.ply", "--json")["triangles"])
        fine = self.json("mesh", self.tree, "--session", session, "--detail", 16, "-o", "c.ply", "--json")
        self.assertEqual(fine["triangles"], self.json("mesh", self.tree, "-o", "d.ply", "--json")["triangles"])

    def test_what_a_session_can_get_wrong(self):
        self.expect_failure("mesh", "--session", self.session(0, 1, 2), "-o", "out.ply", says=["every branch is hidden"])
        self.expect_failure("mesh", "--session", self.session(3), "-o", "out.ply", says=["session.json", "3"])
        self.expect_failure("mesh", "--session", "absent.json", "-o", "out.ply", says=["absent.json"])
        self.assertEqual(self.names(), ["session.json", "tree.swc"])


class Info(CommandLineTest):
    def test_figures_of_a_fork(self):
        tree = self.write("tree.swc", GOOD)
        info = self.json("info", tree, "--json")
        self.assertEqual(list(info), ["branches", "segments", "roots", "loops", "length_mm", "volume_mm3", "radius_mm",
                                      "generations", "repairs"])
        self.assertEqual((info["branches"], info["segments"], info["roots"], info["loops"]), (3, 4, 1, 0))
        self.assertEqual((info["generations"], info["repairs"]), (2, []))
        side = math.hypot(3, 5)
        self.assertAlmostEqual(info["length_mm"], 10 + 2 * side)
        frustum = lambda length, a, b: math.pi / 3 * length * (a * a + a * b + b * b)
        self.assertAlmostEqual(info["volume_mm3"], frustum(5, 1, 1) + frustum(5, 1, 0.9) + frustum(side, 0.9, 0.6) +
                               frustum(side, 0.9, 0.7))
        self.assertEqual((info["radius_mm"]["min"], info["radius_mm"]["max"]), (0.6, 1.0))
        self.assertAlmostEqual(info["radius_mm"]["mean"], (5 * 1 + 5 * 0.95 + side * 0.75 + side * 0.8) / (10 + 2 * side))

    def test_branch_list(self):
        tree = self.write("tree.swc", GOOD)
        branches = self.json("info", tree, "--json", "--branches")["branch_list"]
        self.assertEqual([branch["id"] for branch in branches], [0, 1, 2])
        self.assertEqual([branch["parent"] for branch in branches], [None, 0, 0])
        self.assertEqual([branch["children"] for branch in branches], [[1, 2], [], []])
        self.assertEqual([branch["generation"] for branch in branches], [0, 1, 1])
        self.assertEqual([branch["strahler"] for branch in branches], [2, 1, 1])
        self.assertEqual((branches[0]["first"], branches[0]["last"]), ([0, 0, 0], [0, 0, 10]))
        self.assertEqual((branches[1]["first"], branches[1]["last"]), ([0, 0, 10], [3, 0, 15]))
        self.assertAlmostEqual(branches[1]["length_mm"], math.hypot(3, 5))
        self.assertEqual((branches[1]["diameter_mm"]["min"], branches[1]["diameter_mm"]["max"]), (1.2, 1.8))
        self.assertAlmostEqual(branches[1]["diameter_mm"]["mean"], 1.5)

    def test_text_for_people(self):
        tree = self.write("tree.swc", GOOD)
        text = self.expect_done("info", tree, "--branches").stdout
        self.assertRegex(text, r"branches +3 \(2 ends\)")
        self.assertRegex(text, r"length +21.66 mm")


class Mesh(CommandLineTest):
    def check_closed(self, path, figures):
        """Every edge of the PLY's triangles is walked once in each direction."""
        content = path.read_bytes()
        at = content.index(b"end_header\n") + len(b"end_header\n")
        vertices, triangles = figures["vertices"], figures["triangles"]
        self.assertEqual(len(content), at + 32 * vertices + 13 * triangles)
        edges = set()
        for offset in range(at + 32 * vertices, len(content), 13):
            count, a, b, c = struct.unpack_from("<Biii", content, offset)
            self.assertEqual(count, 3)
            for edge in ((a, b), (b, c), (c, a)):
                self.assertNotIn(edge, edges)
                edges.add(edge)
        self.assertTrue(all((b, a) in edges for a, b in edges))

    def test_figures_and_file_agree(self):
        tree = self.write("tree.swc", GOOD)
        for method in ("cs", "cones"):
            with self.subTest(method):
                figures = self.json("mesh", tree, "-o", "out.ply", "--method", method, "--json")
                self.assertEqual(list(figures), ["vertices", "triangles", "components", "evaluations", "load_s",
                                                 "mesh_s", "write_s"])
                self.assertGreater(figures["triangles"], 100)
                self.check_closed(self.folder / "out.ply", figures)
                if method == "cs":
                    self.assertEqual(figures["components"], 1)
                    self.assertEqual(figures["vertices"] - figures["triangles"] // 2, 2)  # Euler number of a sphere
                    self.assertGreater(figures["evaluations"], 0)

    def test_every_format_holds_the_same_triangles(self):
        tree = self.write("tree.swc", GOOD)
        counts = {self.json("mesh", tree, "-o", "out." + e, "--json")["triangles"] for e in ("ply", "stl", "obj", "PLY")}
        self.assertEqual(len(counts), 1)
        count = counts.pop()
        stl = (self.folder / "out.stl").read_bytes()
        self.assertEqual(len(stl), 84 + 50 * count)
        self.assertEqual(struct.unpack_from("<I", stl, 80), (count,))
        obj = (self.folder / "out.obj").read_text().splitlines()
        self.assertEqual(sum(line.startswith("f ") for line in obj), count)

    def test_the_same_bytes_from_every_run_and_thread_count(self):
        tree = self.write("tree.swc", GOOD)
        meshes = set()
        for threads in ("1", "2", "2", "0"):
            self.expect_done("mesh", tree, "-o", "out.ply", "--threads", threads)
            meshes.add((self.folder / "out.ply").read_bytes())
        self.assertEqual(len(meshes), 1)

    def test_one_cell_size_everywhere(self):
        tree = self.write("tree.swc", GOOD)
        coarse = self.json("mesh", tree, "-o", "out.ply", "--cell", "0.4", "--json")
        fine = self.json("mesh", tree, "-o", "out.ply", "--cell", "0.1", "--json")
        self.assertGreater(fine["triangles"], 4 * coarse["triangles"])

    def test_pruning_keeps_the_branch_ids_of_the_file(self):
        # The twig (branch 2) goes; what is left is one run, but its two halves keep their ids.
        tree = self.write("twig.swc", "1 0 0 0 0 2 -1\n2 0 0 0 20 2 1\n3 0 0 0 40 2 2\n4 0 3 0 20 1 2\n")
        for ratio, kept in (("0", {0, 1, 2}), ("0.5", {0, 1})):
            figures = self.json("mesh", tree, "-o", "out.ply", "--prune", ratio, "--json")
            content = (self.folder / "out.ply").read_bytes()
            at = content.index(b"end_header\n") + len(b"end_header\n")
            vertices = struct.iter_unpack("<7fi", content[at:at + 32 * figures["vertices"]])
            self.assertEqual({vertex[7] for vertex in vertices}, kept)

    def test_two_components(self):
        tree = self.write("tree.swc", GOOD + "11 2 50 0 0 1 -1\n12 2 50 0 9 1 11\n")
        figures = self.json("mesh", tree, "-o", "out.ply", "--json")
        self.assertEqual(figures["components"], 2)


class Convert(CommandLineTest):
    def test_there_and_back_again(self):
        # Ids with gaps, comments, labels and numbers that rounding would change.
        tree = self.write("tree.swc", "\ufeff# head\r\n7 3 0.1 1e-17 0.30000000000000004 1.25 -1 # root\r\n"
                          "9\t5 0 0 5 0.3333333333333333 7\r\n12 -4 1 0 10 1 9\r\n13 900 -1 0 10 1 9\r\n"
                          "20 0 40 0 0 2 -1\r\n21 0 40 0 7 2 20\r\n")
        self.expect_done("convert", tree, "-o", "a.json")
        self.expect_done("convert", "a.json", "-o", "b.swc")
        self.expect_done("convert", "b.swc", "-o", "c.json")
        data = lambda name: json.loads((self.folder / name).read_text())
        a, c = data("a.json"), data("c.json")
        self.assertEqual(a.pop("source"), "tree.swc")
        self.assertEqual(c.pop("source"), "b.swc")
        self.assertEqual(a, c)
        self.assertEqual(a["points"][0], [0.1, 1e-17, 0.30000000000000004, 1.25])
        self.assertEqual(a["labels"], [3, 5, -4, 900, 0, 0])
        same = [self.json("info", name, "--json", "--branches") for name in ("tree.swc", "a.json", "b.swc")]
        self.assertEqual(same[0], same[1])
        self.assertEqual(same[0], same[2])

    def test_in_place(self):
        tree = self.write("tree.swc", GOOD)
        before = self.json("info", tree, "--json", "--branches")
        self.expect_done("convert", tree, "-o", tree)
        self.assertEqual(self.json("info", tree, "--json", "--branches"), before)

    def test_loops_stay_in_json_and_are_refused_as_swc(self):
        ring = self.write("ring.json", json.dumps({
            "format": "ramus-tree", "version": 1, "units": "mm", "orientation": "RAS",
            "points": [[0, 0, 0, 1], [5, 0, 0, 1], [8, 4, 0, 1], [8, -4, 0, 1], [11, 0, 0, 1], [15, 0, 0, 1]],
            "branches": [[0, 1], [1, 2, 4], [1, 3, 4], [4, 5]], "roots": [0]}))
        info = self.json("info", ring, "--json")
        self.assertEqual((info["branches"], info["loops"]), (4, 1))
        self.expect_failure("convert", ring, "-o", "ring.swc", says=["ring.swc", "1 loop", ".json"])
        self.expect_done("convert", ring, "-o", "again.json")
        self.assertEqual(self.json("info", "again.json", "--json"), info)
        figures = self.json("mesh", ring, "-o", "ring.ply", "--json")
        self.assertEqual(figures["vertices"] - figures["triangles"] // 2, 0)  # a torus


if __name__ == "__main__":
    unittest.main()
