"""Whether surfaces are true to their trees: `ramus validate`."""

import unittest

from nifti import nifti, voxels
from ramus import CommandLineTest


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

    def test_vessels_that_touch(self):
        self.write("crossing.swc", CROSSING)
        self.assertEqual(self.counts(self.json("validate", "crossing.swc", "--blend", "tree", "--json")), [0, 0, 0, 0])
        merged = self.json("validate", "crossing.swc", "--blend", "paper", "--json")["questions"]["merged"]
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
        self.assertEqual(sorted(path.name for path in report.iterdir()), ["radii.csv", "validation.json"])
        rows = (report / "radii.csv").read_text().splitlines()
        self.assertTrue(rows[0].startswith("branch,along_mm,x,y,z,input_radius_mm"))
        self.assertGreater(len(rows), 20)

    def test_what_cannot_be(self):
        self.expect_failure("validate", "fork.swc", "--surface", "missing.ply", says=["missing.ply"])
        self.expect_failure("validate", "fork.swc", "--mask", "fork.swc", says=["fork.swc"])
        self.write("file", "not a folder")
        self.expect_failure("validate", "fork.swc", "--report", "file", says=["file", "folder"])
        for words in ((), ("fork.swc", "--label", "1"), ("fork.swc", "--mask-units", "cm")):
            self.assertEqual(self.run_ramus("validate", *words).returncode, 2)


if __name__ == "__main__":
    unittest.main()
