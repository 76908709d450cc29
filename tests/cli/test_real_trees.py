"""Real trees next to the checkout (RAMUS_SHARED_DATA): their counts are known from an independent program."""

import json
import os
import pathlib
import unittest

from ramus import CommandLineTest

TREES = pathlib.Path(os.environ.get("RAMUS_SHARED_DATA", "")) / "trees"

# name: segments, branches, roots, loops, largest radius, length in mm
COUNTS = {
    "brain_BG001": (2809, 197, 1, 0, 2.629, 6058.6),
    "brain_BG0002": (3513, 211, 1, 0, 2.17, 7498.6),
    "brain_BG0003": (3469, 219, 1, 0, 3.1, 7909.4),
    "brain_BG04": (3307, 191, 1, 0, 2.809, 7394.3),
    "brain_BG05": (3195, 195, 1, 0, 3.1, 7363.7),
    "brain_unjoined_7001": (2309, 86, 86, 0, 6.858, 7099.4),
    "mouse_airways_m01": (1849, 1849, 1, 0, 0.9326, 678.9),
    "mouse_airways_m04": (994, 994, 1, 0, 0.9121, 464.4),
    "mouse_airways_m10": (1339, 1339, 1, 0, 0.653, 539.1),
    "mouse_airways_m19": (2285, 2285, 1, 0, 0.8817, 730.5),
    "airways_from_mask": (4474, 490, 1, 0, 9.639, 4543.5),
    "kidney_77922_segments": (77922, 5861, 1, 0, 0.9354, 2363.7),
}


class RealTrees(CommandLineTest):
    def test_counts(self):
        for name, (segments, branches, roots, loops, thickest, length) in COUNTS.items():
            with self.subTest(name):
                as_it_is = "zero-radii,repeated-points,lonely-points,repeated-trunks"  # no ends joined
                info = self.json("info", TREES / (name + ".swc"), "--json", "--repair", as_it_is)
                found = (info["segments"], info["branches"], info["roots"], info["loops"])
                self.assertEqual(found, (segments, branches, roots, loops))
                self.assertAlmostEqual(info["length_mm"], length, delta=0.06)
                self.assertAlmostEqual(info["radius_mm"]["max"], thickest, delta=5e-4)
                self.assertEqual(len(info["repairs"]), 1 if name == "brain_BG0002" else 0)

    def test_open_ends(self):
        info = self.json("info", TREES / "brain_unjoined_7001.swc", "--json")
        self.assertEqual((info["roots"], info["loops"], len(info["repairs"])), (4, 0, 82))

    # One tree with a repair, one with ends that are joined, one with a branch for each segment. All trees, the largest
    # too, go through both formats in tests/core/io/tree_json_test.cpp.
    def test_conversion_and_back_keeps_the_tree(self):
        for name in ("brain_BG0002", "brain_unjoined_7001", "mouse_airways_m01"):
            with self.subTest(name):
                self.expect_done("convert", TREES / (name + ".swc"), "-o", "a.json")
                self.expect_done("convert", "a.json", "-o", "b.swc")
                first = self.json("info", TREES / (name + ".swc"), "--json", "--branches")
                again = self.json("info", "b.swc", "--json", "--branches")
                for key in ("repairs", "assumptions", "suspicions", "notes"):  # of what one file leaves open
                    del first[key], again[key]
                self.assertEqual(first, again)

    # Thick vessels of voxel-short segments: cones alone would have shells and rims, and the picture would leap when the
    # view comes to rest (1.86 of 255, 0.2 % of the pixels apart).
    def test_the_kidney_looks_the_same_while_it_moves(self):
        kidney = TREES / "kidney_77922_segments.swc"
        middle = [7.306, 5.729, 10.069]
        for distance, most, most_apart in ((39.84, 2.0, 0.0005), (9.96, 0.95, 0.0008)):
            camera = {"position": [middle[0], middle[1] + distance, middle[2]], "focal_point": middle,
                      "view_up": [0, 0, 1], "view_angle": 30, "orthographic": False, "scale": 0.268 * distance}
            turned = self.json("render", kidney, "--size", "1280x800", "--samples", "4", "--camera", json.dumps(camera),
                               "--benchmark", "1", "--json")
            print("moving, from %.0f mm: %.2f of 255, %.4f apart" % (distance, turned["difference"], turned["apart"]))
            self.assertEqual(turned["quality"], "interactive")
            self.assertLess(turned["difference"], most)
            self.assertLess(turned["apart"], most_apart)


if __name__ == "__main__":
    if not TREES.is_dir():
        print(f"SKIPPED: {TREES} is not here")
    else:
        unittest.main()
