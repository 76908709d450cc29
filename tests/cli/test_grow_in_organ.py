"""ramus grow --organ: a tree that fills the organ of a mask."""

import unittest

from nifti import nifti, voxels
from ramus import CommandLineTest

SIZE = (40, 34, 30)
ROWS = ((0, -2.0, 0, 70), (1.5, 0, 0, -20), (0, 0, 2.5, 5))  # turned by a quarter, other spacings along each axis


def in_organ(x, y, z):
    return (x - 20) ** 2 / 300 + (y - 16) ** 2 / 220 + (z - 15) ** 2 / 170 <= 1


class GrowInOrgan(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.values = [3 * int(in_organ(*v)) or 5 * int(v[0] < 2 and v[1] < 3) for v in voxels(SIZE)]
        self.write("organ.nii", nifti(SIZE, self.values, rows=ROWS))

    def voxel_of(self, point):
        # The inverse of ROWS.
        x, y, z = point
        return round((y + 20) / 1.5), round((70 - x) / 2), round((z - 5) / 2.5)

    def label_at(self, point):
        i, j, k = self.voxel_of(point)
        inside = 0 <= i < SIZE[0] and 0 <= j < SIZE[1] and 0 <= k < SIZE[2]
        return self.values[i + SIZE[0] * (j + SIZE[1] * k)] if inside else 0

    def points(self, name):
        lines = [line.split() for line in (self.folder / name).read_text().splitlines() if not line.startswith("#")]
        return {line[0]: (tuple(map(float, line[2:5])), line[6]) for line in lines}

    def test_every_point_but_those_of_the_stem_is_in_the_organ(self):
        self.expect_done("grow", "--organ", "organ.nii", "--organ-label", "3", "--branches", "801", "--seed", "4", "-o", "a.swc")
        info = self.json("info", "a.swc", "--json")
        self.assertEqual((info["branches"], info["roots"], info["loops"], info["repairs"]), (801, 1, 0, []))
        points = self.points("a.swc")
        children = {}
        for number, (_, parent) in points.items():
            children.setdefault(parent, []).append(number)
        at, stem = children["-1"][0], set()
        while len(children.get(at, [])) == 1:
            stem.add(at)
            at = children[at][0]
        outside = {number for number, (place, _) in points.items() if self.label_at(place) != 3}
        self.assertTrue(outside)
        self.assertLessEqual(outside, stem)
        # Leaves reach all eighths of the organ.
        ends = [self.voxel_of(place) for number, (place, _) in points.items() if number not in children]
        self.assertEqual(len(ends), 401)
        eighths = [sum((e[0] > 20, e[1] > 16, e[2] > 15) == (bool(n & 1), bool(n & 2), bool(n & 4)) for e in ends) for n in range(8)]
        self.assertGreater(min(eighths), 25)

        # The file says how it was grown, without the folder of the mask.
        head = (self.folder / "a.swc").read_text().splitlines()[0]
        self.assertIn("--organ organ.nii --organ-label 3", head)
        self.expect_done(*head.split()[2:], "-o", "b.swc")
        self.assertEqual((self.folder / "a.swc").read_bytes(), (self.folder / "b.swc").read_bytes())

    def test_the_smaller_part_stays_empty_and_that_is_said(self):
        result = self.expect_done("grow", "--organ", "organ.nii", "--branches", "101", "-o", "a.swc")
        self.assertIn("the organ has 2 parts that do not touch; the tree grows in the largest", result.stderr)
        self.assertNotIn(5, {self.label_at(place) for place, _ in self.points("a.swc").values()})

    def test_the_defaults_are_in_proportion_to_the_organ(self):
        self.expect_done("grow", "--organ", "organ.nii", "--organ-label", "3", "--branches", "51", "-o", "a.swc")
        litres = self.values.count(3) * 1.5 * 2 * 2.5 * 1e-6
        lines = (self.folder / "a.swc").read_text().splitlines()
        radius = float(next(line for line in lines if not line.startswith("#")).split()[5]) # of the stem
        self.assertAlmostEqual(radius, 6 * (litres / 1.5) ** (1 / 3), places=5)

    def test_bad_requests_are_refused(self):
        self.write("few.nii", nifti((10, 10, 10), [int(n < 300) for n in range(1000)]))
        self.write("none.nii", nifti((10, 10, 10), [0] * 1000))
        self.write("flat.nii", nifti((60, 60, 3), [int(n // 3600 == 1) for n in range(10800)]))
        command = ("grow", "-o", "x.swc", "--branches", "51", "--organ")
        self.expect_failure(*command, "few.nii", says=("few.nii", "300 voxels"))
        self.expect_failure(*command, "none.nii", says=("none.nii",))
        self.expect_failure(*command, "flat.nii", says=("flat.nii", "too thin", "radius smaller"))
        self.expect_failure(*command, "organ.nii", "--organ-label", "9", says=("organ.nii",))
        self.expect_failure(*command, "organ.nii", "--organ-label", "3", "--root-radius", "50", says=("root's radius",))
        self.expect_failure(*command, "missing.nii", says=("missing.nii",))
        self.expect_failure(*command, "organ.nii", "--root-radius", "0", says=("radius",), status=2)
        self.expect_failure(*command, "organ.nii", "--organ-size", "200", says=("--organ-size",), status=2)
        self.expect_failure("grow", "-o", "x.swc", "--organ-label", "3", says=("--organ",), status=2)
        self.assertFalse((self.folder / "x.swc").exists())


if __name__ == "__main__":
    unittest.main()
