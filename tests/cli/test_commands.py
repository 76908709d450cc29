"""What the commands print and write when all is well, and what wrong usage is."""

import csv
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
                          ["info", tree, "--nonsense"], ["--nonsense"],
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
        names = {"smooth": 1, "prune": 0.0, "width": 5.0, "detail": 16, "method": "cs", "centerline": "smooth",
                 **options}
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
        self.assertLess(apart["triangles"], 0.9 * whole["triangles"])
        cones = self.json("mesh", "--session", self.session(1, 2), "--method", "cones", "-o", "cones.ply", "--json")
        self.assertEqual(cones["components"], 2)  # one for each segment of the stem

    def test_the_command_line_takes_precedence_over_the_session(self):
        session = self.session(detail=8)
        coarse = self.json("mesh", self.tree, "--session", session, "-o", "a.ply", "--json")
        self.assertEqual(coarse["triangles"], self.json("mesh", self.tree, "--detail", 8, "-o", "b.ply", "--json")["triangles"])
        fine = self.json("mesh", self.tree, "--session", session, "--detail", 16, "-o", "c.ply", "--json")
        self.assertEqual(fine["triangles"], self.json("mesh", self.tree, "-o", "d.ply", "--json")["triangles"])

    def test_invalid_sessions_are_refused(self):
        self.expect_failure("mesh", "--session", self.session(0, 1, 2), "-o", "out.ply", says=["every branch is hidden"])
        self.expect_failure("mesh", "--session", self.session(3), "-o", "out.ply", says=["session.json", "3"])
        self.expect_failure("mesh", "--session", "absent.json", "-o", "out.ply", says=["absent.json"])
        self.assertEqual(self.names(), ["session.json", "tree.swc"])


class Planning(CommandLineTest):
    """Lesions, cuts, measurements and reports through `ramus render --commands`."""

    def plan(self, lines, tree=None, **options):
        self.write("plan.txt", lines)
        return self.expect_done("render", tree or self.write("tree.swc", GOOD), "--size", "200x150", "--units", "mm",
                                "--commands", "plan.txt", "--overwrite", "--verbose", **options).stderr

    def rows(self, name):
        with open(self.folder / name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_cuts_and_their_report(self):
        said = self.plan('name 1 "upper, \\"left\\""\ncut 0 0.5\ncut 1\nreconstruct 1.5\nreport cuts.csv\nsave s.json\n')
        self.assertIn("lost: 3 branches", said)
        rows = self.rows("cuts.csv")
        self.assertEqual([row["cut"] for row in rows], ["1", "2", "all"])
        self.assertEqual([row["over_limit"] for row in rows], ["yes", "no", ""])
        self.assertEqual(rows[1]["name"], 'upper, "left"')
        side = math.sqrt(9 + 25)
        self.assertAlmostEqual(float(rows[0]["lost_length"]), 5 + 2 * side, places=5)
        self.assertAlmostEqual(float(rows[1]["lost_length"]), side / 2, places=5)
        self.assertEqual(rows[2]["lost_length"], rows[0]["lost_length"])  # nothing twice
        self.assertEqual(json.loads((self.folder / "s.json").read_text())["cuts"], [[0, 0.5], [1, 0.5]])

    def test_lesions_as_spheres_and_meshes_have_margins(self):
        corners = [(x, y, z) for x in (12, 16) for y in (-2, 2) for z in (-2, 2)]
        quads = "1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4"
        self.write("tumour.obj", "".join("v %d %d %d\n" % corner for corner in corners) +
                   "".join("f %s\n" % quad for quad in quads))
        self.plan("lesion-mesh tumour.obj\nbands 8 10 12\nreport mesh.csv bands\nselect-within 11.05\n"
                  "lesion-clear\nlesion 0,0,-5,1\nreport sphere.csv bands\nsave s.json\n")
        near = {row["branch"]: row for row in self.rows("mesh.csv")}
        self.assertAlmostEqual(float(near["0"]["lesion_distance"]), 12 - 1, places=1)
        self.assertEqual((near["0"]["from"], near["0"]["to"]), ("10", "12"))
        self.assertAlmostEqual(float(self.rows("sphere.csv")[0]["lesion_distance"]), 5 - 1 - 1, places=5)
        self.assertIn(0, json.loads((self.folder / "s.json").read_text())["selection"])

    def test_selections_filters_and_measurements_report_results(self):
        said = self.plan("select-generation 1\nfilter-diameter 1.7 hide\nmeasure path 1 2\nmeasure diameter 0 0\n"
                         "measure distance 0,0,0 0,3,4\nmeasure angle 1\nreport all.csv measurements\n")
        self.assertIn("Selected 2 branches", said)
        self.assertIn("Hidden: 2 of 3 branches", said)
        values = [float(row["value"]) for row in self.rows("all.csv")]
        self.assertAlmostEqual(values[0], math.sqrt(34), places=5)  # half of each
        self.assertAlmostEqual(values[1], 2.0)
        self.assertAlmostEqual(values[2], 5.0)
        self.assertAlmostEqual(values[3], math.degrees(math.atan2(3, 5)), places=4)

    def test_in_a_network_only_branches_without_another_path_are_dependents(self):
        ring = self.write("ring.json", json.dumps({
            "format": "ramus-tree", "version": 1, "units": "mm", "orientation": "RAS",
            "points": [[0, 0, 0, 1], [5, 0, 0, 1], [8, 4, 0, 1], [8, -4, 0, 1], [11, 0, 0, 1], [15, 0, 0, 1]],
            "branches": [[0, 1], [1, 2, 4], [1, 3, 4], [4, 5]], "roots": [0]}))
        for branch, expected in ((0, [0, 1, 2, 3]), (1, [1]), (2, [2]), (3, [3])):
            self.plan("select %d\nselect-dependents\nsave s.json\n" % branch, tree=ring)
            self.assertEqual(json.loads((self.folder / "s.json").read_text())["selection"], expected)

    def test_a_page_holds_its_pictures_and_escapes_names(self):
        self.plan('name 0 "<b>&"\nselect 0\ncut 0\nreport page.html\n')
        page = (self.folder / "page.html").read_text(encoding="utf-8")
        self.assertEqual(page.count("data:image/png;base64,"), 3)
        self.assertIn("&lt;b&gt;&amp;", page)
        self.assertNotIn("<b>", page)
        self.assertNotIn("://", page)

    def test_failing_commands_are_reported_and_leave_no_file(self):
        tree = self.write("tree.swc", GOOD)
        self.write("open.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                               "endloop\nendfacet\nendsolid x\n")
        for line, says in (("lesion-mesh open.stl", "not closed"), ("lesion-mesh gone.ply", "gone.ply"),
                           ("report r.csv", "nothing to report"), ("report r.odt", ".html"), ("cut 7", "no branch 7"),
                           ("select-within 3", "lesion"), ("bands 3 2", "ascend")):
            with self.subTest(line):
                self.write("plan.txt", "# first\n" + line + "\n")
                self.expect_failure("render", tree, "--size", "200x150", "--commands", "plan.txt", says=["plan.txt:2", says])
        self.assertEqual(self.names(), ["open.stl", "plan.txt", "tree.swc"])


class Info(CommandLineTest):
    def test_json_of_a_fork(self):
        tree = self.write("tree.swc", GOOD)
        info = self.json("info", tree, "--json")
        self.assertEqual(list(info), ["branches", "segments", "roots", "loops", "length_mm", "length", "volume_mm3",
                                      "volume", "radius_mm", "radius", "units", "unit", "units_said_by", "orientation", "orientation_said_by", "generations",
                                      "dependency_known", "repairs", "assumptions", "suspicions", "notes", "systems",
                                      "smoothing", "data"])
        self.assertEqual((info["branches"], info["segments"], info["roots"], info["loops"]), (3, 4, 1, 0))
        self.assertEqual((info["generations"], info["repairs"]), (2, []))
        side = math.hypot(3, 5)
        self.assertAlmostEqual(info["length_mm"], 10 + 2 * side)
        frustum = lambda length, a, b: math.pi / 3 * length * (a * a + a * b + b * b)
        self.assertAlmostEqual(info["volume_mm3"], frustum(5, 1, 1) + frustum(5, 1, 0.9) + frustum(side, 0.9, 0.6) +
                               frustum(side, 0.9, 0.7))
        self.assertEqual((info["radius_mm"]["min"], info["radius_mm"]["max"]), (0.6, 1.0))
        self.assertAlmostEqual(info["radius_mm"]["mean"], (5 * 1 + 5 * 0.95 + side * 0.75 + side * 0.8) / (10 + 2 * side))

    def test_notes_have_kind_topic_and_place(self):
        tree = self.write("tree.swc", "1 0 0 0 0 0.5 -1\n2 0 0 0 5 0 1\n3 0 0 0 9 0.5 2\n")
        notes = self.json("info", tree, "--json")["notes"]
        self.assertEqual([(note["kind"], note["topic"]) for note in notes],
                         [("suspect", "invented-radii"), ("assumed", "units"), ("suspect", "units"), ("assumed", "axes"),
                          ("repaired", "zero-radii")])
        self.assertEqual(notes[4]["at"], [0, 0, 5])
        self.assertNotIn("at", notes[0])
        self.assertIn("tree.swc:2", notes[4]["text"])
        self.assertEqual(self.json("info", tree, "--json", "--units", "cm")["notes"][-1]["at"], [0, 0, 50])
        self.assertIn("1 (1 zero-radii)", self.expect_done("info", tree).stdout)

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

    def test_text_output(self):
        tree = self.write("tree.swc", GOOD)
        text = self.expect_done("info", tree, "--branches").stdout
        self.assertRegex(text, r"branches +3 \(2 leaves\)")
        self.assertRegex(text, r"length +21.7 units")


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

    def test_json_and_mesh_file_agree(self):
        tree = self.write("tree.swc", GOOD)
        for method in ("cs", "cones"):
            with self.subTest(method):
                figures = self.json("mesh", tree, "-o", "out.ply", "--method", method, "--json")
                shape = ["loops", "tree"] if method == "cs" else []  # of a closed surface
                self.assertEqual(list(figures), ["vertices", "triangles", "components", *shape, "streamed", "cut_loops",
                                                 "opened_loops", "intersections", "evaluations", "smoothing", "units",
                                                 "unit", "orientation", "load_s", "mesh_s", "write_s"])
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


def without_notes(info):
    """What a tree is, without what reading its file assumed and found: converted files say more."""
    return {key: value for key, value in info.items() if key not in ("repairs", "assumptions", "suspicions", "notes")}


class Convert(CommandLineTest):
    def test_conversion_and_back_keeps_the_tree(self):
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
        self.assertEqual([note["topic"] for note in a.pop("notes") if note["kind"] == "assumed"], ["units", "axes"])
        # The files on the way say that both are unknown still.
        self.assertEqual([note["topic"] for note in c.pop("notes") if note["kind"] == "assumed"], ["units", "axes"])
        self.assertEqual(a, c)
        self.assertEqual(a["points"][0], [0.1, 1e-17, 0.30000000000000004, 1.25])
        self.assertEqual(a["labels"], [3, 5, -4, 900, 0, 0])
        same = [self.json("info", name, "--json", "--branches") for name in ("tree.swc", "a.json", "b.swc")]
        self.assertEqual(same[0], same[1])
        self.assertEqual(without_notes(same[0]), without_notes(same[2]))

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
