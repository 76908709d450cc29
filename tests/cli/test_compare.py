"""Surfaces of the same vessels in one picture, on the command line."""

import json
import struct
import unittest

from nifti import compressed, nifti, voxels
from ramus import GOOD, CommandLineTest


class Compare(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("tree.swc", GOOD)
        size = (9, 5, 16)
        inside = [2 if 3 <= x <= 5 and 1 <= y <= 3 and 1 <= z <= 14 else 0 for x, y, z in voxels(size)]
        rows = ((1, 0, 0, -4), (0, 1, 0, -2), (0, 0, 1, 0))
        self.write("mask.nii.gz", compressed(nifti(size, inside, rows=rows)))

    def picture(self, name, *arguments):
        self.expect_done("render", "tree.swc", "-o", name, "--size", "300x160", *arguments)
        content = (self.folder / name).read_bytes()
        self.assertEqual(struct.unpack(">II", content[16:24]), (300, 160))
        return content

    def test_every_way_of_comparing_is_another_picture(self):
        all_three = ("--methods", "iso,cones,cs", "--mask", "mask.nii.gz")
        pictures = [self.picture("plain.png"), self.picture("s.png", "--skeleton")]
        for mode in ("side-by-side", "blend", "superimposed"):
            pictures.append(self.picture(mode + ".png", "--compare", mode, *all_three))
            pictures.append(self.picture(mode + "2.png", "--compare", mode))
        self.assertEqual(len(set(pictures)), len(pictures))
        self.assertEqual(self.picture("off.png", "--compare", "off"), pictures[0])

    def test_a_blend_is_exact_at_its_ends(self):
        first = self.picture("a.png", "--compare", "blend", "--methods", "cs,iso", "--blend", "0")
        self.assertEqual(first, self.picture("b.png", "--compare", "blend", "--methods", "cones,cs", "--blend", "1"))
        self.assertNotEqual(first, self.picture("c.png", "--compare", "blend", "--methods", "cs,cones", "--blend", "1"))

    def test_commands_and_sessions_do_the_same(self):
        flags = self.picture("flags.png", "--compare", "side-by-side", "--methods", "iso,cs", "--mask", "mask.nii.gz",
                             "--label", "2", "--skeleton")
        self.write("c.txt", "compare-mask mask.nii.gz 2\ncompare side-by-side iso,cs\nskeleton on\nfit\nsave s.json\nshot shot.png\n")
        self.assertEqual(self.picture("commands.png", "--commands", "c.txt"), flags)
        self.assertEqual((self.folder / "shot.png").read_bytes(), flags)
        session = json.loads((self.folder / "s.json").read_text())
        self.assertEqual(session["comparison"], {"mode": "side-by-side", "surfaces": ["iso", "cs"], "blend": 0.5,
                                                 "mask": "mask.nii.gz", "labels": [2]})
        self.expect_done("render", "--session", "s.json", "-o", "again.png", "--size", "300x160")
        self.assertEqual((self.folder / "again.png").read_bytes(), flags)

    def test_with_the_window_around_it(self):
        self.write("c.txt", "compare blend cs,iso\ncompare-blend 0.3\n")
        self.picture("ui.png", "--ui", "--commands", "c.txt")

    def test_what_cannot_be_compared(self):
        for wrong in (["--compare", "magic"], ["--compare", "blend", "--methods", "cs"],
                      ["--compare", "blend", "--methods", "cs,cs"], ["--compare", "blend", "--blend", "2"],
                      ["--blend", "0.5"], ["--methods", "cs,iso"], ["--mask", "mask.nii.gz"],
                      ["--compare", "side-by-side", "--blend", "0.5"], ["--compare", "blend", "--label", "1"],
                      ["--compare", "blend", "--mask", "mask.nii.gz", "--label", "0"],
                      ["--compare", "blend", "--sheet"], ["--compare", "blend", "--turntable", "4"]):
            with self.subTest(wrong):
                self.expect_failure("render", "tree.swc", "-o", "out.png", *wrong, status=2)
        common = ("render", "tree.swc", "-o", "out.png", "--compare", "blend", "--methods", "cs,iso", "--mask")
        self.expect_failure(*common, "absent.nii", says=("absent.nii",))
        self.expect_failure(*common, "tree.swc", says=("tree.swc",))
        self.expect_failure(*common, "mask.nii.gz", "--label", "7", says=("mask.nii.gz", "7"))
        self.write("far.nii", nifti((2, 2, 2), [1] * 8, rows=((1, 0, 0, 900), (0, 1, 0, 0), (0, 0, 1, 0))))
        self.expect_failure(*common, "far.nii", says=("far.nii", "elsewhere"))
        self.assertNotIn("out.png", self.names())


if __name__ == "__main__":
    unittest.main()
