"""The paper's figures and tables on the command line."""

import csv
import json
import struct
import unittest
import xml.dom.minidom

from nifti import compressed, nifti, voxels
from ramus import GOOD, CommandLineTest

ALL = {
    "1": ["figure_01.png"], "2": ["figure_02.png"], "3": ["figure_03.png", "figure_03_merging.svg"],
    "4": ["figure_04.png", "figure_04_fade.svg", "figure_04_cells.csv"], "5": ["figure_05.png"], "6": ["figure_06.png"],
    "7": ["figure_07.png"], "8": ["figure_08.png", "figure_08_histogram.svg"],
    "9": ["figure_09.png", "figure_09_histogram.svg"], "10": ["figure_10_to_cones.svg", "figure_10_to_isosurface.svg"],
    "11": ["figure_11.png"], "12": ["figure_12.png"], "13": ["figure_13.png"],
    "I": ["table_1_to_cones.csv", "table_1_to_isosurface.csv"], "II": ["table_2_criteria.csv"], "III": ["table_3.csv"]}
ALWAYS = ["index.html", "measurements.csv"]


class Paper(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("tree.swc", GOOD)

    def files(self, folder="out"):
        return sorted(path.name for path in (self.folder / folder).iterdir())

    def paper(self, *options, folder="out"):
        return self.json("paper", "-o", folder, *options, "--json")

    def test_all_figures_and_tables_of_a_tree(self):
        report = self.paper("--tree", "tree.swc")
        self.assertEqual({figure["number"]: figure["files"] for figure in report["figures"]}, ALL)
        self.assertEqual(self.files(), sorted(sum(ALL.values(), ALWAYS)))
        page = (self.folder / "out/index.html").read_text()
        for name in self.files():
            content = (self.folder / "out" / name).read_bytes()
            if name.endswith(".png"):
                self.assertEqual(content[:8], b"\x89PNG\r\n\x1a\n")
                self.assertGreater(min(struct.unpack(">II", content[16:24])), 300)
            elif name.endswith(".svg"):
                self.assertEqual(xml.dom.minidom.parseString(content).documentElement.tagName, "svg")
        self.assertEqual(page.count('src="data:image/png'), sum(name.endswith(".png") for name in self.files()))
        self.assertIn("tree.swc", page)
        for figure in report["figures"]:
            self.assertIn(figure["title"], page)
            for measured in figure["measured"]:
                if "formula" in measured:  # what is measured is what the closed form says
                    with self.subTest(figure["number"], what=measured["what"]):
                        self.assertAlmostEqual(measured["value"] / measured["formula"], 1.0, delta=0.05)
        with open(self.folder / "out/measurements.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), sum(len(figure["measured"]) for figure in report["figures"]))

    def test_numbers_of_the_paper(self):
        measured = {one["what"]: one for figure in self.paper("--figures", "3")["figures"] for one in figure["measured"]}
        for width, radius, gap in (("1", 1.06066, 29.289), ("5", 1.36931, 8.713)):
            self.assertAlmostEqual(measured[f"radius at which they merge, width {width}"]["value"], radius, delta=0.005)
            found = measured[f"gap at this moment, share of the distance, width {width}"]
            self.assertAlmostEqual(found["value"], gap, delta=0.5)
            self.assertEqual(found["paper"], f"{round(gap)} %")

    def test_chosen_figures_are_the_same_in_every_run(self):
        for folder in ("a", "b"):
            report = self.paper("--figures", "II,4,7", folder=folder)
            self.assertEqual([figure["number"] for figure in report["figures"]], ["4", "7", "II"])
        self.assertEqual(self.files("a"), sorted(ALL["4"] + ALL["7"] + ALL["II"] + ALWAYS))
        for name in self.files("a"):
            if name != "index.html":  # it says when it was made
                self.assertEqual((self.folder / "a" / name).read_bytes(), (self.folder / "b" / name).read_bytes(), name)

    def test_several_trees_with_their_masks(self):
        size = (9, 5, 16)
        inside = [1 if 3 <= x <= 5 and 1 <= y <= 3 and 1 <= z <= 14 else 0 for x, y, z in voxels(size)]
        mask = compressed(nifti(size, inside, rows=((1, 0, 0, -4), (0, 1, 0, -2), (0, 0, 1, 0))))
        for name in ("mask.nii.gz", "other.nii.gz"):
            self.write(name, mask)
        self.write("other.swc", GOOD)
        pairs = ("--tree", "tree.swc", "--mask", "mask.nii.gz", "--tree", "other.swc", "--mask", "other.nii.gz")
        self.paper("--figures", "9,10,I,III", *pairs)
        with open(self.folder / "out/table_1_to_isosurface.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["tree"] for row in rows], ["tree.swc", "other.swc", "average", "standard deviation"])
        self.assertAlmostEqual(float(rows[0]["half_voxel"]), 0.75 ** 0.5, places=6)
        self.assertIn("mask.nii.gz", (self.folder / "out/index.html").read_text())

    def test_wrong_usage(self):
        self.write("mask.nii", nifti((4, 4, 4), [1] * 64))
        for words, says in ((["-o", "out", "--figures", "14"], "14 is no list of 1-13, I-III"), ([], "--output"),
                            (["-o", "out", "--mask", "mask.nii"], "--tree"),
                            (["-o", "out", "--tree", "tree.swc", "--tree", "tree.swc", "--mask", "mask.nii"], "once|1 time")):
            with self.subTest(words):
                result = self.run_ramus("paper", *words)
                self.assertEqual(result.returncode, 2)
                self.assertRegex(result.stderr, says)
                self.assertFalse((self.folder / "out").exists())

    def test_failures_leave_nothing(self):
        self.write("loose.swc", "1 2 0 0 0 1 -1\n")
        self.expect_failure("paper", "-o", "deep/out", "--tree", "loose.swc", says=["loose.swc"])
        self.expect_failure("paper", "-o", "deep/out", "--tree", "tree.swc", "--mask", "tree.swc", says=["tree.swc"])
        self.assertEqual(self.names(), ["loose.swc", "tree.swc"])
        (self.folder / "out/figure_04_cells.csv").mkdir(parents=True)
        self.expect_failure("paper", "-o", "out", "--figures", "4", says=["figure_04_cells.csv"])
        self.assertEqual(self.files(), ["figure_04_cells.csv"])
        self.write("file", "not a folder")
        self.expect_failure("paper", "-o", "file", says=["file", "folder"])


if __name__ == "__main__":
    unittest.main()
