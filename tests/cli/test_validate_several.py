"""Several trees in one run of `ramus validate`: their averages, and the report of all."""

import hashlib
import json
import statistics
import unittest
import xml.etree.ElementTree

from nifti import nifti, voxels
from ramus import CommandLineTest
from validated import TEXT_FILES, Page, fork, rows_of, swc


class ValidateSeveral(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("fork.swc", fork(True))

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

    def test_a_bad_file_is_reported_before_computing(self):
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


if __name__ == "__main__":
    unittest.main()
