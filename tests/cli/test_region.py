"""ramus region: the same voxels as scipy's labels of a range, in volumes of every orientation; cuts; masks that become trees; refusals."""

import itertools
import json
import os
import random
import unittest

try:
    import nibabel
    import numpy as np
    from scipy import ndimage
    MISSING = None
except ImportError as problem:
    MISSING = problem

from nifti import nifti, voxels
from ramus import CommandLineTest

SHARED = os.environ.get("RAMUS_SHARED_DATA", "")


def word(place):
    return ",".join(f"{number:.9g}" for number in place)


class Regions(CommandLineTest):
    def noise(self, name, order=(0, 1, 2), sign=1.0):
        """Smoothed noise from -300 to 300 on a grid that is oblique and anisotropic; its values and affine."""
        dice = np.random.default_rng(7)
        values = ndimage.gaussian_filter(dice.normal(size=(23, 19, 17)), 1.5)
        values = np.rint(300.0 * values / np.abs(values).max()).astype(np.int16)
        turn = np.array([[0.8, -0.6, 0.0], [0.6, 0.8, 0.0], [0.0, 0.0, sign]])[:, order]
        affine = np.eye(4)
        affine[:3, :3] = turn * np.array([0.7, 1.1, 2.3])
        affine[:3, 3] = (-12.0, 30.0, 210.0)
        self.write(name, nifti(values.shape, [int(v) for v in values.ravel(order="F")], "h",
                               rows=[tuple(row) for row in affine[:3]]))
        return values, nibabel.load(self.folder / name).affine

    def region(self, *words):
        report = self.json("region", *words, "-o", "mask.nii.gz", "--json")
        image = nibabel.load(self.folder / "mask.nii.gz")
        return report, np.asarray(image.dataobj), image.affine

    def test_regions_are_the_labels_that_scipy_finds(self):
        dice = random.Random(3)
        compared = 0
        for order, sign in itertools.product(((0, 1, 2), (2, 0, 1), (1, 0, 2)), (1.0, -1.0)):
            values, affine = self.noise("n.nii", order, sign)
            for _ in range(4):
                seed = tuple(dice.randrange(n) for n in values.shape)
                low, high = int(values[seed]) - dice.randrange(5, 90), int(values[seed]) + dice.randrange(5, 90)
                labels, _ = ndimage.label((values >= low) & (values <= high))
                wanted = labels == labels[seed]
                place = (affine @ np.array([*seed, 1.0]))[:3]
                report, found, where = self.region("n.nii", f"--seed={word(place)}", f"--range={low},{high}")
                self.assertTrue(np.array_equal(found != 0, wanted))
                self.assertTrue(np.allclose(where, affine, atol=1e-5))
                self.assertEqual(report["voxels"], int(wanted.sum()))
                self.assertAlmostEqual(report["volume_mm3"], wanted.sum() * abs(np.linalg.det(affine[:3, :3])), delta=1e-2)
                border = wanted.copy()
                border[1:-1, 1:-1, 1:-1] = False
                self.assertEqual(report["touches_border"], bool(border.any()))
                self.assertEqual(report["seeds"], [list(seed)])
                self.assertEqual(report["range"], {"low": low, "high": high, "origin": "given"})
                compared += int(wanted.sum())
        self.assertGreater(compared, 2000)

    def test_several_seeds_give_the_union_and_those_out_of_range_are_named(self):
        values, affine = self.noise("n.nii")
        inside = (values >= 60) & (values <= 300)
        labels, count = ndimage.label(inside)
        self.assertGreater(count, 2)
        seeds = [tuple(np.argwhere(labels == n)[0]) for n in (1, 2)]
        out = tuple(np.argwhere(~inside)[0])
        places = [f"--seed={word((affine @ np.array([*seed, 1.0]))[:3])}" for seed in (*seeds, out)]
        report, found, _ = self.region("n.nii", *places, "--range", "60,300")
        self.assertTrue(np.array_equal(found != 0, (labels == 1) | (labels == 2)))
        self.assertEqual(report["seeds_not_used"], [[int(n) for n in out]])

    def tube(self):
        """A straight vessel of radius 4 mm along z, 100 to 300 in value, with a thin bridge to a second one."""
        size = (40, 24, 40)

        def value(voxel):
            x, y, z = voxel
            if (x - 10) ** 2 + (y - 12) ** 2 <= 16 or (x - 30) ** 2 + (y - 12) ** 2 <= 16:
                return 300
            return 300 if y == 12 and z == 20 and 10 <= x <= 30 else -100

        self.write("t.nii", nifti(size, [value(v) for v in voxels(size)], "h"))
        return np.array([value(v) for v in voxels(size)]).reshape(size, order="F")

    def test_balls_and_discs_cut(self):
        values = self.tube()
        both = values == 300
        one = both.copy()
        one[15:] = False
        _, found, _ = self.region("t.nii", "--seed=10,12,5", "--range=200,400")
        self.assertTrue(np.array_equal(found != 0, both))
        _, found, _ = self.region("t.nii", "--seed=10,12,5", "--range=200,400", "--disc=14.5,12,20,1,0,0,2")
        self.assertTrue(np.array_equal(found != 0, one))
        _, found, _ = self.region("t.nii", "--seed=10,12,5", "--range=200,400", "--ball=16,12,20,1.2")
        self.assertTrue(np.array_equal(found != 0, one))
        half = one.copy()
        half[:, :, 11:] = False
        _, found, _ = self.region("t.nii", "--seed=10,12,5", "--disc=10,12,10.5,0,0,-3,6", "--range=200,400")
        self.assertTrue(np.array_equal(found != 0, half))

    def test_a_range_is_suggested_and_the_text_says_what_a_region_is(self):
        self.tube()
        result = self.expect_done("region", "t.nii", "--seed=10,12,5")
        self.assertIn("no segmentation", result.stdout)
        self.assertIn("suggested", result.stdout)
        self.assertIn("touches the border", result.stdout)
        report = json.loads(self.expect_done("region", "t.nii", "--seed", "10,12,5", "--json").stdout)
        self.assertEqual(report["range"]["origin"], "suggested")
        self.assertIn("no segmentation", report["note"])

    def test_masks_become_trees_in_every_format(self):
        self.tube()
        for name in ("m.nii.gz", "m.nii", "m.nrrd", "m.seg.nrrd"):
            self.expect_done("region", "t.nii", "--seed=10,12,5", "--disc=14.5,12,20,1,0,0,2", "-o", name)
            self.expect_done("skeletonize", name, "-o", "t.swc")
            points = [line.split() for line in (self.folder / "t.swc").read_text().splitlines() if not line.startswith("#")]
            self.assertGreater(len(points), 5)
            for point in points:
                self.assertLess(abs(float(point[2]) - 10) + abs(float(point[3]) - 12), 2.0)

    def test_bad_input_is_refused(self):
        self.tube()
        self.write("labels.nii", nifti((4, 4, 4), [n % 3 for n in range(64)]))
        seed = "--seed=10,12,5"
        self.expect_failure("region", "t.nii", "--seed=10,12,500", says=("outside of the scan", "t.nii"))
        self.expect_failure("region", "t.nii", seed, "--range=310,320", says=("no seed has a value in the range",))
        self.expect_failure("region", "labels.nii", "--seed=1,1,1", says=("labels", "--grey"))
        self.expect_done("region", "labels.nii", "--seed=1,1,1", "--grey")
        self.expect_failure("region", "none.nii", seed, says=("none.nii",))
        self.expect_failure("region", "t.nii", seed, "-o", "m.stl", says=("m.stl",))
        self.expect_failure("region", "t.nii", seed, "-o", "t.nii", says=("t.nii",))
        for words in ((), ("--seed=1,2",), ("--seed=1,2,nan",), (seed, "--range=5,1"), (seed, "--range=5"),
                      (seed, "--ball=1,2,3"), (seed, "--ball=1,2,3,0"), (seed, "--disc=1,2,3,0,0,0,4")):
            self.expect_failure("region", "t.nii", *words, status=2)
        self.assertEqual(self.names(), ["labels.nii", "t.nii"])

    def test_the_lumen_of_a_real_aorta(self):
        scan = os.path.join(SHARED, "volumes", "aorta_dissection_ct.nii.gz")
        truth = os.path.join(SHARED, "volumes", "aorta_dissection_lumens.nii.gz")
        if not os.path.exists(scan):
            self.skipTest("without the real volumes")
        image = nibabel.load(scan)
        lumens = np.asarray(nibabel.load(truth).dataobj) != 0
        core = ndimage.binary_erosion(lumens, iterations=3)
        at = np.argwhere(core)[len(np.argwhere(core)) // 2]
        report, found, _ = self.region(scan, f"--seed={word((image.affine @ np.array([*at, 1.0]))[:3])}")
        values = np.asarray(image.dataobj)
        labels, _ = ndimage.label((values >= report["range"]["low"]) & (values <= report["range"]["high"]))
        self.assertTrue(np.array_equal(found != 0, labels == labels[tuple(at)]))


if __name__ == "__main__":
    if MISSING is not None:
        print(f"SKIPPED: nothing to compare with ({MISSING}); Debian has python3-nibabel and python3-scipy")
    else:
        unittest.main()
