"""Whether surfaces are true to their trees: `ramus validate`."""

import csv
import hashlib
import html.parser
import io
import json
import math
import signal
import statistics
import subprocess
import time
import unittest
import xml.etree.ElementTree

from nifti import nifti, voxels
from ramus import RAMUS, TUBE, CommandLineTest


def swc(*rows):
    return "".join("{} 2 {} {} {} {} {}\n".format(n + 1, *row) for n, row in enumerate(rows))


def line(points, parent, begin, end, steps, radius):
    """Rows from the point `parent` on: x, y, z, radius, parent."""
    for i in range(1, steps + 1):
        place = [begin[k] + (end[k] - begin[k]) * i / steps for k in range(3)]
        points.append((*place, radius, parent if i == 1 else len(points)))
    return len(points)


def fork(with_leaf):
    points = [(0, 0, 0, 1.0, -1)]
    joint = line(points, 1, (0, 0, 0), (0, 0, 20), 20, 1.0)
    line(points, joint, (0, 0, 20), (0, 12, 36), 20, 1.0)
    if with_leaf:
        line(points, joint, (0, 0, 20), (0, -12, 36), 20, 1.0)
    return swc(*points)


CROSSING = swc((0, -10, 0, 1, -1), (0, 10, 0, 1, 1), (-10, 0, 1.8, 1, -1), (10, 0, 1.8, 1, 3))


TEXT_FILES = ["distances.csv", "fidelity.csv", "files.csv", "places.csv", "questions.csv", "radii.csv", "shapes.csv", "validation.json"]


class Page(html.parser.HTMLParser):
    """A page's words and elements; fails on tags that are not closed in order, and on anything from elsewhere."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.open, self.count, self.cells, self.words, self.pictures = [], {}, [], [], []
        self.feed(text)
        self.close()
        assert not self.open, self.open

    def handle_starttag(self, tag, attributes):
        self.count[tag] = self.count.get(tag, 0) + 1
        for name, value in attributes:
            assert name not in ("href", "srcset", "onload", "onclick"), name
            if name == "src":
                assert value.startswith("data:image/png;base64,"), value[:50]
                self.pictures.append(value)
        if tag not in ("meta", "img"):
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.count[tag] = self.count.get(tag, 0) + 1

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, (tag, self.open)
        self.open.pop()

    def handle_data(self, data):
        assert "script" not in self.open
        if self.open and self.open[-1] == "td":
            self.cells.append(data)
        if self.open and self.open[-1] != "style":
            self.words.append(data)


def rows_of(path):
    return list(csv.DictReader(io.StringIO(path.read_bytes().decode())))


class Validate(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("fork.swc", fork(True))

    def counts(self, found):
        return [len(found["questions"][name]) for name in ("lost", "false", "merged", "constrictions")]

    def test_its_own_surface(self):
        found = self.json("validate", "fork.swc", "--blend", "tree", "--json")
        self.assertEqual(self.counts(found), [0, 0, 0, 0])
        self.assertLess(found["radius_error"]["median"], 0.005)
        self.assertLess(found["distances"]["to_cones"]["mean"], 0.09)
        self.assertIsNone(found["distances"]["to_mask"])
        text = self.expect_done("validate", "fork.swc", "--blend", "tree").stdout
        for words in ("lost branches: none", "false branches: none", "merged branches: none", "radius away from joints"):
            self.assertIn(words, text)

    def test_free_ends_are_told_apart(self):
        # A tube of radius 2 goes on half a ball beyond its ends as cones, 0.7075 radii as a convolution surface. Fine
        # triangles: chords of the half balls are nearer.
        self.write("tube.swc", swc((0, 0, 0, 2, -1), (0, 0, 30, 2, 1)))
        cones = self.json("validate", "tube.swc", "--detail", "64", "--json")["distances"]["to_cones"]
        self.assertAlmostEqual(cones["max"], 2 * (1 - 0.7075), delta=0.03)
        others = cones["but_for_free_ends"]
        self.assertLess(others["max"], 0.3)
        self.assertLess(others["count"], cones["count"])
        self.expect_done("mesh", "tube.swc", "-o", "tube.stl")
        given = self.json("validate", "tube.swc", "--surface", "tube.stl", "--json")["distances"]["to_cones"]
        self.assertNotIn("but_for_free_ends", given)

    def test_the_surface_of_another_program(self):
        self.write("less.swc", fork(False))
        self.expect_done("mesh", "less.swc", "-o", "less.stl")
        self.expect_done("mesh", "fork.swc", "-o", "fork.stl")
        lost = self.json("validate", "fork.swc", "--surface", "less.stl", "--json")
        self.assertEqual(self.counts(lost), [1, 0, 0, 0])
        place = lost["questions"]["lost"][0]
        self.assertAlmostEqual(place["at"][1], -6, delta=2)
        self.assertAlmostEqual(place["at"][2], 28, delta=2)
        false = self.json("validate", "less.swc", "--surface", "fork.stl", "--json")
        self.assertEqual(self.counts(false), [0, 1, 0, 0])
        self.assertEqual(self.counts(self.json("validate", "fork.swc", "--surface", "fork.stl", "--json")), [0, 0, 0, 0])

    def test_a_branch_of_another_width_or_elsewhere(self):
        def bent(scale, shift):
            points = [(0, 0, 0, 1.0, -1)]
            joint = line(points, 1, (0, 0, 0), (0, 0, 20), 20, 1.0)
            line(points, joint, (0, 0, 20), (0, 12, 36), 20, 1.0)
            first = line(points, joint, (0, 0, 20), (shift, -6, 28), 10, scale)
            line(points, first, (shift, -6, 28), (shift, -24, 52), 30, scale)
            return swc(*points)

        self.write("bent.swc", bent(1.0, 0.0))
        for scale in (2.0, 1.3, 0.7):
            self.write("other.swc", bent(scale, 0.0))
            self.expect_done("mesh", "other.swc", "-o", "other.stl")
            found = self.json("validate", "bent.swc", "--surface", "other.stl", "--json")
            self.assertEqual(self.counts(found), [0, 0, 0, 0])
            self.assertEqual(found["questions"]["position"], [])
            [one] = found["questions"]["width"]
            self.assertEqual(one["branch"], 2)
            self.assertAlmostEqual(one["expected_radius_mm"], 1.0, delta=0.01)
            self.assertAlmostEqual(one["radius_mm"], scale, delta=0.04)
        for shift in (0.5, 0.9, 1.3):
            self.write("other.swc", bent(1.0, shift))
            self.expect_done("mesh", "other.swc", "-o", "other.stl")
            found = self.json("validate", "bent.swc", "--surface", "other.stl", "--json")
            self.assertEqual(self.counts(found), [0, 0, 0, 0])
            self.assertEqual(found["questions"]["width"], [])
            [one] = found["questions"]["position"]
            self.assertEqual(one["branch"], 2)
            self.assertAlmostEqual(one["offset_mm"], shift, delta=0.05)
            outside = found["fidelity"]["points_outside_percent"]
            if shift != 0.9:  # there the walls are so near that corners tell
                self.assertEqual(outside > 0, shift > 1)
            self.assertIn("moved branches: 1",
                          self.expect_done("validate", "bent.swc", "--surface", "other.stl").stdout)

    def test_smoothing_does_not_move_the_reference(self):
        # From voxel to voxel around a circle: smoothed, the surface still counts against the steps as they are.
        points, at = [(40, 0, 0, 3.0, -1)], (40, 0)
        while len(points) < 60:
            x, y = at
            at = min(((x - 1, y), (x, y + 1), (x - 1, y + 1)), key=lambda p: abs(math.hypot(*p) - 40))
            points.append((*at, 0, 3.0, len(points)))
        self.write("stairs.swc", swc(*points))
        fidelity = {passes: self.json("validate", "stairs.swc", "--smooth", passes, "--json")["fidelity"]
                    for passes in ("0", "1", "100")}
        for passes, least in (("0", 0.0), ("1", 0.05), ("100", 0.05)):
            self.assertEqual(fidelity[passes]["points_outside"], 0)
            self.assertGreater(fidelity[passes]["axis_offset_mm"]["max"], least)
            self.assertLess(fidelity[passes]["axis_offset_mm"]["max"], 0.75)
        found = self.json("info", "stairs.swc", "--json")["smoothing"]
        self.assertEqual((found["voxel_mm"], found["voxel_from"]), ([1, 1, 1], "points"))
        self.assertLessEqual(self.json("info", "stairs.swc", "--smooth", "100", "--json")["smoothing"]["displacement_mm"]["max"], 0.5 + 1e-9)
        self.assertIn("voxels of 1.00 units (estimated)", self.expect_done("info", "stairs.swc").stdout)

    def test_vessels_that_touch(self):
        self.write("crossing.swc", CROSSING)
        self.assertEqual(self.counts(self.json("validate", "crossing.swc", "--blend", "tree", "--json")), [0, 0, 0, 0])
        apart = self.json("validate", "crossing.swc", "--blend", "tree", "--json")["shape"]
        self.assertEqual(apart, {"components": 2, "loops": 0, "tree": {"components": 2, "loops": 0}})
        grown = self.json("validate", "crossing.swc", "--blend", "paper", "--json")
        self.assertEqual(grown["shape"], {"components": 1, "loops": 0, "tree": {"components": 2, "loops": 0}})
        self.assertIn("hangs together: 1 piece, 0 loops; the tree has 2 pieces, 0 loops",
                      self.run_ramus("validate", "crossing.swc", "--blend", "paper").stdout)
        self.write("open.obj", "v 0 -1 -1\nv 1 -1 1\nv 2 1 1\nf 1 2 3\n")  # has a hole, and with it no loops to count
        self.assertIsNone(self.json("validate", "crossing.swc", "--surface", "open.obj", "--json")["shape"])
        merged = grown["questions"]["merged"]
        self.assertEqual([one["branches"] for one in merged], [[0, 1]])
        self.assertAlmostEqual(merged[0]["gap_mm"], -0.2)
        self.assertAlmostEqual(merged[0]["at"][2], 0.9)

    def test_pruned_branches_are_lost(self):
        self.write("twig.swc", swc((0, 0, 0, 1, -1), (0, 0, 20, 1, 1), (0, 0, 40, 1, 2), (0, 6, 20, 1, 2)))
        found = self.json("validate", "twig.swc", "--prune", "0.5", "--blend", "tree", "--json")
        self.assertEqual([one["branch"] for one in found["questions"]["lost"]], [2])

    def test_a_mask_and_a_report(self):
        size = (9, 9, 14)
        inside = [1 if 3 <= x <= 5 and 3 <= y <= 5 and 2 <= z <= 11 else 0 for x, y, z in voxels(size)]
        self.write("mask.nii", nifti(size, inside, rows=((1, 0, 0, -4), (0, 1, 0, -4), (0, 0, 2, 0))))
        self.write("tree.swc", "1 2 0 0 4 1.5 -1\n2 2 0 0 22 1.5 1\n")
        found = self.json("validate", "tree.swc", "--mask", "mask.nii", "--report", "made/report", "--json")
        self.assertLess(found["distances"]["to_mask"]["mean"], 0.6)
        self.assertAlmostEqual(found["distances"]["to_mask"]["threshold_mm"], 0.5 * 6 ** 0.5)
        report = self.folder / "made" / "report"
        self.assertEqual(sorted(path.name for path in report.iterdir()),
                         sorted([*TEXT_FILES, "volumes.csv", "boxes_from_mask.svg", "boxes_to_cones.svg",
                                 "boxes_to_mask.svg", "index.html"]))
        self.assertEqual(json.loads((report / "validation.json").read_text()), found)
        self.assertLess(found["distances"]["from_mask"]["mean"], 0.6)
        # All 90 voxels of the mask are within the tube, but for the corners of the two slices at its end points: there
        # half of the field is left, and the surface is at sqrt(1 - 1 / 5) = 0.894 radii. Voxels are 2 mm3.
        self.assertAlmostEqual(found["volumes"]["mask_mm3"], 180)
        self.assertAlmostEqual(found["volumes"]["dice"], 2 * 82 / (90 + 82))
        # A tube, and two domes that hold as much as 0.277 radii of it; triangles are chords.
        tube = math.pi * 1.5 ** 2 * (18 + 2 * 0.277 * 1.5)
        self.assertAlmostEqual(found["volumes"]["surface_mm3"] / tube, 0.99, delta=0.015)
        # What scripts know of one tree.
        self.assertEqual(list(found), ["tree", "units", "unit", "surface", "distances", "volumes", "fidelity", "radius_error",
                                       "questions", "shape"])
        self.assertIsNone(found["distances"]["to_cones"]["above_percent"])
        self.assertNotIn("threshold_mm", found["distances"]["to_cones"])
        text = (report / "radii.csv").read_text()
        self.assertTrue(text.startswith("branch,along,x,y,z,input_radius,"))
        rows = rows_of(report / "radii.csv")
        self.assertGreater(len(rows), 20)
        middle = next(row for row in rows if row["alone"] == "yes")
        # A tube of radius 1.5; its mask has 3 x 3 voxels across, cut at half of their height.
        for name in ("input_radius", "surface_radius", "cones_radius"):
            self.assertAlmostEqual(float(middle[name]), 1.5, delta=0.03)
        self.assertAlmostEqual(float(middle["mask_radius"]), 1.6, delta=0.2)
        page = Page((report / "index.html").read_text())
        # From three sides, and coloured by how far it is from cones and from the mask.
        self.assertEqual(len(page.pictures), 5)
        # Box plots and histograms to cones, to the mask and from it, and one branch.
        self.assertEqual(page.count["svg"], 7)
        self.assertIn("mask", page.words)
        # Nobody says that the tree's lengths are mm.
        self.assertIn("Mean, units", page.words)
        self.assertNotIn("Mean, mm", page.words)

    def test_a_mask_that_lies_elsewhere_is_told(self):
        size = (9, 9, 14)
        inside = [1 if 3 <= x <= 5 and 3 <= y <= 5 and 2 <= z <= 11 else 0 for x, y, z in voxels(size)]
        self.write("mask.nii", nifti(size, inside, rows=((1, 0, 0, -4), (0, 1, 0, -4), (0, 0, 2, 0))))
        for name, x, told in (("here.swc", 0, False), ("beside.swc", 4, True), ("far.swc", 400, True)):
            with self.subTest(name):
                self.write(name, f"1 2 {x} 0 4 1.5 -1\n2 2 {x} 0 22 1.5 1\n")
                errors = self.expect_done("validate", name, "--mask", "mask.nii", "--json").stderr
                self.assertEqual("mask.nii: the mask does not lie where the vessels do" in errors, told)

    def test_kernels_compared(self):
        self.write("crossing.swc", CROSSING)
        found = self.json("validate", "crossing.swc", "--kernels", "--detail", "8", "--json")
        self.assertEqual(found["graph"], {"pieces": 2, "loops": 0})
        kinds = {(one["kernel"], one["width"]) for one in found["kernels"]}
        self.assertEqual(len(kinds), len(found["kernels"]))
        self.assertEqual({kind for kind, _ in kinds}, {"gaussian", "inverse-square", "inverse-cubic", "cauchy", "polynomial"})
        for one in found["kernels"]:
            self.assertLess(one["joints"]["straight_percent"], 0.1)
            self.assertEqual(one["width"] is None, one["kernel"].startswith("inverse"))
            self.assertEqual((one["pieces"], one["merged"]), (1, 1))  # their tubes overlap
        text = self.expect_done("validate", "crossing.swc", "--kernels", "--detail", "8").stdout
        self.assertIn("inverse-cubic", text)
        self.assertIn("The tree has 2 pieces and 0 loops", text)
        for words in (("--kernel", "cauchy"), ("--width", "3"), ("--report", "folder"), ("--blend", "tree")):
            self.assertEqual(self.run_ramus("validate", "crossing.swc", "--kernels", *words).returncode, 2)

    def test_another_kernel(self):
        gaussian, cubic = (self.json("validate", "fork.swc", "--json", "--kernel", kernel)
                           for kernel in ("gaussian", "inverse-cubic"))
        self.assertGreater(cubic["distances"]["to_cones"]["mean"], gaussian["distances"]["to_cones"]["mean"])
        self.expect_failure("validate", "fork.swc", "--kernel", "inverse-square", says=["inverse-square", "--blend paper"])
        self.expect_done("validate", "fork.swc", "--kernel", "inverse-square", "--blend", "paper")
        for words in (("cubic",), ("inverse-cubic", "--width", "2"), ("polynomial", "--width", "20")):
            self.assertEqual(self.run_ramus("validate", "fork.swc", "--kernel", *words).returncode, 2)

    def test_what_cannot_be(self):
        self.expect_failure("validate", "fork.swc", "--surface", "missing.ply", says=["missing.ply"])
        self.expect_failure("validate", "fork.swc", "--mask", "fork.swc", says=["fork.swc"])
        self.write("file", "not a folder")
        self.expect_failure("validate", "fork.swc", "--report", "file", says=["file", "folder"])
        self.assertEqual(self.names(), ["file", "fork.swc"])
        for words in ((), ("fork.swc", "--label", "1"), ("fork.swc", "--mask-units", "cm")):
            self.assertEqual(self.run_ramus("validate", *words).returncode, 2)

    def test_several_trees(self):
        self.write("line.swc", swc((0, 0, 0, 2, -1), (0, 0, 30, 2, 1)))
        found = self.json("validate", "fork.swc", "line.swc", "fork.swc", "--json")
        self.assertEqual(list(found), ["data_sets", "units", "unit", "averages", "standard_deviations"])
        sets, averages = found["data_sets"], found["averages"]
        self.assertEqual([one["tree"] for one in sets], ["fork.swc", "line.swc", "fork.swc"])
        self.assertEqual(averages["data_sets"], 3)
        # Each is what it is alone.
        alone = self.json("validate", "line.swc", "--json")
        self.assertEqual(sets[1].pop("mask"), None)
        self.assertEqual(sets[1], alone)
        # The mean of the means: the fork counts twice because it is there twice.
        for name in ("mean", "sigma", "rms", "min", "max", "median", "percentile_95"):
            each = [one["distances"]["to_cones"][name] for one in sets]
            self.assertAlmostEqual(averages["distances"]["to_cones"][name], sum(each) / 3)
        self.assertIsNone(averages["distances"]["to_mask"])
        self.assertAlmostEqual(averages["radius_error"]["median"],
                               sum(one["radius_error"]["median"] for one in sets) / 3)
        self.assertEqual(averages["questions"], dict.fromkeys(
            ("lost", "false", "merged", "constrictions", "width", "position"), 0))
        # Of a sample: divided by one less than there are.
        means = [one["distances"]["to_cones"]["mean"] for one in sets]
        self.assertAlmostEqual(found["standard_deviations"]["distances"]["to_cones"]["mean"], statistics.stdev(means))
        text = self.expect_done("validate", "fork.swc", "line.swc").stdout
        for words in ("Surface to truncated cones", "average", "Mean, units"):  # nobody says that they are mm
            self.assertIn(words, text)

    def test_averages_never_mix_units(self):
        self.write("mm.swc", "# id type x y z radius parent (mm, RAS)\n" + fork(True))
        self.write("other.swc", fork(False))
        names = ("mm.swc", "fork.swc", "other.swc")
        found = self.json("validate", *names, "--json", "--report", "out")
        self.assertEqual([one["unit"] for one in found["data_sets"]], ["mm", "unknown", "unknown"])
        for name in ("unit", "units", "averages", "standard_deviations"):
            self.assertIsNone(found[name])
        means = [one["distances"]["to_cones"]["mean"] for one in found["data_sets"]]
        averages = {unit: group["averages"] for unit, group in found["by_unit"].items()}
        self.assertEqual({unit: one["data_sets"] for unit, one in averages.items()}, {"mm": 1, "unknown": 2})
        self.assertAlmostEqual(averages["mm"]["distances"]["to_cones"]["mean"], means[0])
        self.assertAlmostEqual(averages["unknown"]["distances"]["to_cones"]["mean"], (means[1] + means[2]) / 2)
        for table in ("distances.csv", "fidelity.csv"):
            rows = rows_of(self.folder / "out" / table)
            self.assertEqual([row["unit"] for row in rows], ["mm", "unknown", "unknown", "mm", "mm", "unknown", "unknown"])
            self.assertEqual(rows[3]["tree"], "average, mm")
        self.assertEqual({row["unit"] for row in rows_of(self.folder / "out" / "radii.csv")}, {"mm", "unknown"})
        self.assertIn("average, unknown", Page((self.folder / "out" / "index.html").read_text()).cells)
        self.assertIn("average, unknown", self.expect_done("validate", *names).stdout)
        same = self.json("validate", "fork.swc", "other.swc", "--json")
        self.assertEqual(same["unit"], "unknown")
        self.assertEqual(same["averages"]["data_sets"], 2)
        self.assertNotIn("by_unit", same)

    def test_masks_and_surfaces_of_several_trees(self):
        size = (9, 9, 14)
        inside = [1 if 3 <= x <= 5 and 3 <= y <= 5 and 2 <= z <= 11 else 0 for x, y, z in voxels(size)]
        for scale in (1, 2):
            rows = ((scale, 0, 0, -4 * scale), (0, scale, 0, -4 * scale), (0, 0, 2 * scale, 0))
            self.write("mask{}.nii".format(scale), nifti(size, inside, rows=rows))
            self.write("tree{}.swc".format(scale),
                       swc((0, 0, 4 * scale, 1.5 * scale, -1), (0, 0, 22 * scale, 1.5 * scale, 1)))
            self.expect_done("mesh", "tree{}.swc".format(scale), "-o", "tree{}.stl".format(scale))
        words = ["validate", "tree1.swc", "tree2.swc", "--mask", "mask1.nii", "--mask", "mask2.nii"]
        found = self.json(*words, "--json")
        sets, averages = found["data_sets"], found["averages"]
        self.assertEqual([one["mask"] for one in sets], ["mask1.nii", "mask2.nii"])
        # Everything is twice as large in the second one.
        for other in ("to_cones", "to_mask"):
            first, second = (one["distances"][other] for one in sets)
            self.assertAlmostEqual(first["threshold_mm"], 0.5 * 6 ** 0.5)
            self.assertAlmostEqual(second["threshold_mm"], 6 ** 0.5)
            self.assertAlmostEqual(second["mean"], 2 * first["mean"], delta=1e-4)
            self.assertAlmostEqual(averages["distances"][other]["mean"], 0.5 * (first["mean"] + second["mean"]))
            self.assertAlmostEqual(averages["distances"][other]["above_percent"],
                                   0.5 * (first["above_percent"] + second["above_percent"]))
        crossed = self.json("validate", "tree1.swc", "tree2.swc", "--surface", "tree2.stl", "--surface", "tree1.stl",
                            "--json")["data_sets"]
        self.assertEqual([one["surface"] for one in crossed], ["tree2.stl", "tree1.stl"])
        self.assertGreater(crossed[0]["distances"]["to_cones"]["mean"], 1)

    def test_wrong_counts_are_wrong_usage(self):
        self.write("mask.nii", "never read")
        for words, says in (
            (("fork.swc", "fork.swc", "--mask", "mask.nii"), ("--mask", "1 time", "2 trees", "same order")),
            (("fork.swc", "--mask", "mask.nii", "--mask", "mask.nii"), ("--mask", "2 times", "1 tree")),
            (("fork.swc", "--surface", "a.ply", "--surface", "b.ply"), ("--surface", "2 times", "1 tree")),
        ):
            with self.subTest(words):
                self.expect_failure("validate", *words, "--report", "report", says=says, status=2)
                self.assertEqual(self.names(), ["fork.swc", "mask.nii"])

    def test_a_bad_file_is_named_before_the_work(self):
        self.write("broken.swc", "1 0 0 0 x 1 -1\n")
        self.write("mask.nii", "no mask")
        self.write("broken.stl", "no mesh")
        before = self.names()
        for words, says in (
            (("fork.swc", "broken.swc"), ["broken.swc"]),
            (("missing.swc", "fork.swc"), ["missing.swc"]),
            (("fork.swc", "fork.swc", "--mask", "fork.swc", "--mask", "mask.nii"), ["fork.swc"]),
            (("fork.swc", "fork.swc", "--surface", "broken.stl", "--surface", "broken.stl"), ["broken.stl"]),
        ):
            with self.subTest(words):
                self.expect_failure("validate", *words, "--report", "a/b", "--json", says=says)
                self.assertEqual(self.names(), before)  # no empty folder stays

    def test_the_report_of_several_trees(self):
        # Names that need care, in pages, drawings and tables.
        name = "<b>&\"x\" 'y', z.swc"
        self.write("less.swc", fork(False))
        self.write(name, fork(True))
        self.expect_done("mesh", "less.swc", "-o", "less.stl")
        self.expect_done("mesh", name, "-o", "all.stl")
        self.expect_done("validate", name, "less.swc", "--surface", "less.stl", "--surface", "all.stl", "--report", "out")
        report = self.folder / "out"
        self.assertEqual(sorted(path.name for path in report.iterdir()),
                         ["boxes_to_cones.svg", *sorted([*TEXT_FILES, "index.html"])])
        text = (report / "index.html").read_text()
        self.assertNotIn("<b>", text)
        page = Page(text)
        self.assertIn("1. " + name, page.words)
        self.assertIn("Validation of 2 data sets", page.words)
        self.assertIn("average", page.cells)
        # Of each data set three of it all, one in colours, and what is found: one is lost, the other one false.
        found = sum(code in page.cells for code in ("L1", "L2", "F1", "F2", "M1", "C1"))
        self.assertEqual(found, 2)
        self.assertEqual(len(page.pictures), 2 * 4 + found)
        # Boxes; for each data set a histogram and up to four branches, here those of the two trees.
        self.assertEqual(page.count["svg"], 1 + 2 + 3 + 1)
        for code in ("L1", "F1", "D1"):  # lost, false, far
            self.assertIn(code, page.cells)
        for file in (name, "less.swc", "less.stl", "all.stl"):
            self.assertIn(hashlib.sha256((self.folder / file).read_bytes()).hexdigest(), page.cells)
        svg = xml.etree.ElementTree.parse(report / "boxes_to_cones.svg").getroot()
        self.assertEqual(svg.tag, "{http://www.w3.org/2000/svg}svg")
        self.assertIn(name, [element.text for element in svg.iter("{http://www.w3.org/2000/svg}text")])
        found = json.loads((report / "validation.json").read_text())
        distances = rows_of(report / "distances.csv")
        self.assertEqual([row["tree"] for row in distances], [name, "less.swc", "average", "standard deviation"])
        self.assertAlmostEqual(float(distances[2]["mean"]), found["averages"]["distances"]["to_cones"]["mean"],
                               delta=1e-6)
        places = rows_of(report / "places.csv")
        self.assertEqual([(row["data_set"], row["question"]) for row in places], [("1", "lost"), ("2", "false")])
        lost = [float(row["lost"]) for row in rows_of(report / "questions.csv")]
        self.assertEqual(lost[:3], [1, 0, 0.5])
        self.assertAlmostEqual(lost[3], 0.5 ** 0.5)
        shapes = rows_of(report / "shapes.csv")
        self.assertEqual([(row["pieces"], row["pieces_of_tree"], row["loops"]) for row in shapes], [("1", "1", "0")] * 2)
        self.assertEqual({row["data_set"] for row in rows_of(report / "radii.csv")}, {"1", "2"})
        self.assertEqual([row["role"] for row in rows_of(report / "files.csv")], ["tree", "surface"] * 2)

    def test_the_report_takes_no_place_of_what_is_read(self):
        (self.folder / "report").mkdir()
        for name in ("index.html", "radii.csv"):
            target = self.folder / "report" / name
            target.symlink_to(self.folder / "fork.swc")
            self.expect_failure("validate", "fork.swc", "--report", "report", says=[name, "this run reads it"])
            self.assertTrue(target.is_symlink())
            target.unlink()
        self.assertEqual((self.folder / "fork.swc").read_text(), fork(True))

    def test_a_full_disk_leaves_the_old_report(self):
        (self.folder / "report").mkdir()
        for name in ("index.html", "validation.json"):
            self.write("report/" + name, "old")
        # Small tables fit, the page does not.
        self.expect_failure("validate", "fork.swc", "--report", "report", largest_file=30000, says=["report/", "ulimit -f"])
        self.assertEqual(sorted(path.name for path in (self.folder / "report").iterdir()),
                         ["index.html", "validation.json"])
        self.assertEqual((self.folder / "report" / "validation.json").read_text(), "old")

    def test_a_report_that_cannot_be_written(self):
        (self.folder / "report" / "index.html").mkdir(parents=True)
        self.expect_failure("validate", "fork.swc", "--report", "report", says=["index.html", "is a folder"])
        self.expect_failure("validate", "fork.swc", "--report", "/proc/report", says=["/proc/report", "cannot be made"])

    def test_an_interrupt_leaves_nothing(self):
        self.write("tube.swc", TUBE)
        before = self.names()
        process = subprocess.Popen(
            [RAMUS, "validate", "tube.swc", "tube.swc", "tube.swc", "--detail", "256", "--report", "a/report"],
            cwd=self.folder, stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        while not (self.folder / "a" / "report").exists() and process.poll() is None:
            time.sleep(0.01)
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        out, errors = process.communicate(timeout=120)
        self.assertEqual(out, "")
        self.assertEqual(process.returncode, 1, errors)
        self.assertIn("cancelled", errors)
        self.assertEqual(self.names(), before)


if __name__ == "__main__":
    unittest.main()
