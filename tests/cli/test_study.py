"""The pictures that surfaces are compared by, on the command line."""

import json
import struct
import unittest

from nifti import compressed, nifti, voxels
from ramus import GOOD, CommandLineTest

NAMES = ["context.png"] + [f"place_{place}_{surface}.png" for place in (1, 2, 3)
                           for surface in ("cones", "convolution", "isosurface")]


class Study(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("tree.swc", GOOD)

    def test_ten_pictures_of_one_size_and_no_two_alike(self):
        report = self.json("study", "tree.swc", "-o", "made/pictures", "--size", "160x120", "--json")
        folder = self.folder / "made" / "pictures"
        self.assertEqual(sorted(path.name for path in folder.iterdir()), sorted(NAMES + ["key.json", "sheets"]))
        self.assertEqual(len(report["pictures"]), 10)
        self.assertEqual(len(report["places"]), 3)
        self.assertEqual(report["mask"], "made of the tree")
        self.assertGreater(report["voxel_mm"], 0)
        contents = [(folder / name).read_bytes() for name in NAMES]
        for content in contents:
            self.assertEqual(struct.unpack(">II", content[16:24]), (160, 120))
        self.assertEqual(len(set(contents)), 10)

    def test_a_mask_of_the_same_vessels(self):
        size = (9, 5, 16)
        inside = [1 if 3 <= x <= 5 and 1 <= y <= 3 and 1 <= z <= 14 else 0 for x, y, z in voxels(size)]
        rows = ((1, 0, 0, -4), (0, 1, 0, -2), (0, 0, 1, 0))
        self.write("mask.nii.gz", compressed(nifti(size, inside, rows=rows)))
        report = self.json("study", "tree.swc", "--mask", "mask.nii.gz", "-o", "out", "--size", "80x60", "--json")
        self.assertEqual(report["mask"], "mask.nii.gz")
        self.assertNotIn("voxel_mm", report)

    def test_one_system_alone(self):
        tree = {"format": "ramus-tree", "version": 2, "units": "mm", "orientation": "RAS",
                "points": [[-10, 0, 0, 2], [10, 0, 0, 2], [-10, 0, 30, 2], [10, 0, 30, 2]], "branches": [[0, 1], [2, 3]],
                "roots": [0, 2], "systems": [{"name": "vein", "colour": [60, 110, 180]},
                                             {"name": "artery", "colour": [200, 80, 60]}], "branch_systems": [0, 1]}
        self.write("two.json", json.dumps(tree))
        both = self.json("study", "two.json", "-o", "both", "--size", "80x60", "--json")
        one = self.json("study", "two.json", "--system", "artery", "-o", "one", "--size", "80x60", "--json")
        self.assertEqual((len(both["places"]), len(one["places"])), (2, 1))
        self.expect_failure("study", "two.json", "--system", "nerve", "-o", "x", says=("nerve", "artery"))

    def study(self, folder, *options):
        self.expect_done("study", "tree.swc", "-o", folder, "--size", "64x48", *options)
        pages = {path.name: path.read_text() for path in (self.folder / folder / "sheets").iterdir()}
        return json.loads((self.folder / folder / "key.json").read_text()), pages

    def test_a_page_for_each_rater_that_does_not_change_when_there_are_more(self):
        key, pages = self.study("one")
        self.assertEqual(sorted(pages), ["rater_001.html"])
        more, more_pages = self.study("more", "--raters", "7")
        self.assertEqual(len(more_pages), 7)
        self.assertEqual(more_pages["rater_001.html"], pages["rater_001.html"])
        self.assertEqual(more["study"], key["study"])
        self.assertEqual(more["orders"][0], key["orders"][0])
        # Six raters see the six orders of a scene's pictures once each: every method is twice at each place.
        self.assertEqual(len(more["scenes"]), 4)
        for scene in more["scenes"]:
            self.assertEqual(sorted(scene["pictures"].values()), ["cones", "convolution", "isosurface"])
            orders = [tuple(shown) for rater in more["orders"][:6] for shown in rater if shown[0] in scene["pictures"]]
            self.assertEqual(len(set(orders)), 6)
        other, _ = self.study("other", "--raters", "7", "--seed", "2")
        self.assertEqual(other["study"], key["study"])
        self.assertNotEqual(other["orders"], more["orders"])

    def test_a_page_hides_the_methods_and_has_the_pictures_in_the_order_of_its_rater(self):
        key, pages = self.study("out", "--raters", "2")
        for number, page in ((1, pages["rater_001.html"]), (2, pages["rater_002.html"])):
            data = json.loads(page.split('<script id="page" type="application/json">')[1].split("</script>")[0])
            self.assertEqual(data["rater"], number)
            self.assertEqual(data["study"], key["study"])
            self.assertEqual([[picture["code"] for picture in scene["pictures"]] for scene in data["scenes"]],
                             key["orders"][number - 1])
            for scene in data["scenes"]:
                self.assertEqual(len({picture["source"] for picture in scene["pictures"]}), 3)
                for picture in scene["pictures"]:
                    picture["source"] = ""
            for words in (json.dumps(data).lower(), page.split("<script")[0].lower()):
                for word in ("isosurface", "cone", "convolution"):
                    self.assertNotIn(word, words)

    def test_failures_are_reported_before_anything_is_drawn(self):
        self.write("file", "not a folder")
        self.expect_failure("study", "tree.swc", "-o", "file", says=("file", "folder"))
        (self.folder / "full").mkdir()
        self.write("full/sheets", "not a folder")
        self.expect_failure("study", "tree.swc", "-o", "full", says=("full/sheets", "folder"))
        self.assertEqual([path.name for path in (self.folder / "full").iterdir()], ["sheets"])
        self.expect_failure("study", "tree.swc", "-o", "out", "--mask", "tree.swc", says=("tree.swc",))
        self.expect_failure("study", "tree.swc", "-o", "out", "--voxel", "1e-7", says=("too fine",))
        self.assertEqual(self.run_ramus("study", "tree.swc", "-o", "out", "--voxel", "0").returncode, 2)
        self.assertEqual(self.run_ramus("study", "tree.swc").returncode, 2)
        for raters in ("0", "501", "many"):
            self.assertEqual(self.run_ramus("study", "tree.swc", "-o", "out", "--raters", raters).returncode, 2)


if __name__ == "__main__":
    unittest.main()
