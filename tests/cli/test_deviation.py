"""Colours by how far the surface lies from another one, on the command line."""

import json
import unittest

from nifti import compressed, nifti, voxels
from png import Picture
from ramus import GOOD, CommandLineTest

SIZE = ("--size", "300x200")


class Deviation(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("tree.swc", GOOD)

    def picture(self, name, *arguments):
        self.expect_done("render", "tree.swc", "-o", name, *SIZE, "--transparent", *arguments)
        return Picture((self.folder / name).read_bytes())

    def vessel(self, picture, left=90):
        """Colours of the pixels that show vessels, right of the legend and left of the cube."""
        return [picture.rows[y][4 * x:4 * x + 3] for y in range(picture.height) for x in range(left, picture.width - 60)
                if picture.rows[y][4 * x + 3] == 255]

    def test_no_deviation_has_the_low_end_of_the_scale_and_large_ones_the_high_end(self):
        self.expect_done("mesh", "tree.swc", "-o", "same.ply")
        low = self.vessel(self.picture("low.png", "--deviation-from", "same.ply", "--scale-mm", "1"))
        high = self.vessel(self.picture("high.png", "--deviation-from", "cones", "--scale-mm", "0.000001"))
        self.assertGreater(len(low), 300)
        self.assertGreater(len(high), 300)
        # viridis: from violet, blue above green, to yellow, green above blue.
        self.assertGreater(sum(b > g for _, g, b in low) / len(low), 0.97)
        self.assertGreater(sum(g > b + 40 for _, g, b in high) / len(high), 0.9)

    def test_options_commands_and_sessions_give_the_same_picture(self):
        flags = ("--colour-by", "deviation", "--deviation-from", "cones", "--scale-mm", "0.25")
        self.picture("flags.png", *flags)
        self.write("c.txt", "deviation-from cones\ndeviation-scale 0.25\nsave s.json\n")
        self.picture("commands.png", "--commands", "c.txt")
        self.expect_done("render", "--session", "s.json", "-o", "session.png", *SIZE, "--transparent")
        pictures = {(self.folder / name).read_bytes() for name in ("flags.png", "commands.png", "session.png")}
        self.assertEqual(len(pictures), 1)
        session = json.loads((self.folder / "s.json").read_text())
        self.assertEqual(session["deviation"], {"from": "cones", "most": 0.25})
        self.assertEqual(session["options"]["colour_by"], "deviation")
        other = self.picture("other.png", "--colour-by", "deviation", "--scale-mm", "0.05")
        self.assertNotIn((self.folder / "other.png").read_bytes(), pictures)
        self.assertEqual(other.width, 300)

    def test_scale_in_voxels_of_a_mask_and_centerlines_over_colours(self):
        inside = [1 if 3 <= x <= 5 and 1 <= y <= 3 and 1 <= z <= 14 else 0 for x, y, z in voxels((9, 5, 16))]
        rows = ((1, 0, 0, -4), (0, 1, 0, -2), (0, 0, 1, 0))
        self.write("mask.nii.gz", compressed(nifti((9, 5, 16), inside, rows=rows)))
        self.picture("iso.png", "--deviation-from", "iso", "--mask", "mask.nii.gz", "--scale-voxels", "1")
        self.picture("file.png", "--deviation-from", "mask.nii.gz", "--scale-voxels", "1")
        # A voxel's diagonal is the square root of 3 mm.
        self.picture("mm.png", "--deviation-from", "mask.nii.gz", "--scale-mm", "1.7320508075688772")
        pictures = [(self.folder / name).read_bytes() for name in ("iso.png", "file.png", "mm.png")]
        self.assertEqual(pictures[0], pictures[1])
        self.assertNotEqual(pictures[0], pictures[2])  # the legend's words
        seen = [self.vessel(Picture(picture), 160) for picture in (pictures[0], pictures[2])]
        self.assertGreater(len(seen[0]), 300)
        self.assertEqual(seen[0], seen[1])
        self.picture("lines.png", "--deviation-from", "mask.nii.gz", "--compare", "superimposed", "--methods", "cs,iso")
        done = self.expect_done("render", "tree.swc", "-o", "said.png", *SIZE, "--deviation-from", "iso", "--verbose")
        self.assertIn("deviation from isosurface of the tree's voxels, mm: mean", done.stderr)

    def test_invalid_options_are_refused(self):
        def wrong(*arguments):
            return self.run_ramus("render", "tree.swc", "-o", "p.png", *SIZE, *arguments)
        self.assertEqual(wrong("--scale-mm", "0").returncode, 2)
        self.assertEqual(wrong("--scale-mm", "1", "--scale-voxels", "1").returncode, 2)
        self.assertEqual(wrong("--mask", "m.nii").returncode, 2)
        for arguments, words in ((("--deviation-from", "nowhere.ply"), "cannot be read"),
                                 (("--deviation-from", "tree.swc"), "neither a mask nor a mesh"),
                                 (("--deviation-from", "cones", "--scale-voxels", "1"), "only a mask has voxels")):
            done = wrong(*arguments)
            self.assertEqual(done.returncode, 1)
            self.assertIn(words, done.stderr)
        self.assertEqual(self.names(), ["tree.swc"])


if __name__ == "__main__":
    unittest.main()
