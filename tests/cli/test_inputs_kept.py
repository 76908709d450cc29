"""Nothing that a run writes replaces a file that it reads, whatever that file is called."""

import json
import os
import unittest

from nifti import nifti, voxels
from ramus import GOOD, CommandLineTest

SIZE = ("--size", "160x120")
SAYS = ("would be lost", "another name")


class InputsKept(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("tree.swc", GOOD)
        size = (8, 8, 14)
        block = [1 if 2 <= x < 6 and 2 <= y < 6 and 1 <= z < 13 else 0 for x, y, z in voxels(size)]
        self.write("mask.nii", nifti(size, block, rows=((1, 0, 0, -4), (0, 1, 0, -4), (0, 0, 1, 0))))
        self.expect_done("mesh", "tree.swc", "-o", "mesh.stl")

    def expect_kept(self, name, *arguments, commands=None):
        """Refused, and the file and all others are as they were."""
        if commands is not None:
            self.write("c.txt", commands)
            arguments = (*arguments, "--commands", "c.txt")
        before = {path.name: path.read_bytes() for path in self.folder.iterdir() if path.is_file()}
        self.expect_failure(*arguments, says=[name, *SAYS])
        after = {path.name: path.read_bytes() for path in self.folder.iterdir() if path.is_file()}
        self.assertEqual(before, after)

    def test_a_picture_does_not_replace_its_inputs(self):
        for other in (["-o", "tree.swc"], ["-o", "mask.nii", "--compare", "side-by-side", "--mask", "mask.nii"],
                      ["-o", "mesh.stl", "--context", "mesh.stl"]):
            with self.subTest(other):
                self.expect_kept(other[1], "render", "tree.swc", *SIZE, *other)

    def test_a_picture_does_not_replace_its_reference(self):
        self.expect_done("render", "tree.swc", *SIZE, "-o", "reference.png")
        self.expect_kept("reference.png", "render", "tree.swc", *SIZE, "-o", "reference.png", "--reference",
                         "reference.png")

    def test_links_to_inputs_are_not_replaced(self):
        os.symlink("tree.swc", self.folder / "link.png")
        os.link(self.folder / "tree.swc", self.folder / "second.png")
        (self.folder / "sub").mkdir()
        for name in ("link.png", "second.png", "sub/../tree.swc"):
            with self.subTest(name):
                self.expect_kept(name, "render", "tree.swc", *SIZE, "-o", name)

    def test_commands_do_not_replace_inputs(self):
        for line, name in (("shot tree.swc", "tree.swc"), ("shot c.txt", "c.txt"), ("save tree.swc", "tree.swc"),
                           ("context mesh.stl\nexport surface mesh.stl", "mesh.stl"),
                           ("lesion-mesh mesh.stl\nshot mesh.stl", "mesh.stl"),
                           ("context mask.nii\nsave mask.nii", "mask.nii")):
            with self.subTest(line):
                self.expect_kept(name, "render", "tree.swc", *SIZE, commands=line + "\n")

    def test_surfaces_trees_and_reports_do_not_replace_inputs(self):
        self.expect_kept("tree.swc", "convert", "tree.swc", "-o", "tree.swc")
        os.link(self.folder / "mask.nii", self.folder / "mask.swc")
        self.expect_kept("mask.swc", "skeletonize", "mask.nii", "-o", "mask.swc")
        os.link(self.folder / "tree.swc", self.folder / "out.stl")
        self.expect_kept("out.stl", "mesh", "tree.swc", "-o", "out.stl")
        (self.folder / "report").mkdir()
        for name in ("validation.json", "radii.csv"):
            os.link(self.folder / "tree.swc", self.folder / "report" / name)
            self.expect_kept(name, "validate", "tree.swc", "--report", "report")
            (self.folder / "report" / name).unlink()
        (self.folder / "study").mkdir()
        os.link(self.folder / "tree.swc", self.folder / "study" / "context.png")
        self.expect_kept("context.png", "study", "tree.swc", "-o", "study", *SIZE)
        (self.folder / "paper").mkdir()
        os.link(self.folder / "tree.swc", self.folder / "paper" / "figure_08.png")
        self.expect_kept("figure_08.png", "paper", "--tree", "tree.swc", "-o", "paper")

    def test_files_that_a_session_names_are_not_replaced(self):
        self.write("c.txt", "compare-mask mask.nii\ncontext mesh.stl\nsave s.ramus.json\n")
        self.expect_done("render", "tree.swc", *SIZE, "--commands", "c.txt")
        for name in ("mask.nii", "mesh.stl", "tree.swc", "s.ramus.json"):
            with self.subTest(name):
                self.expect_kept(name, "render", "--session", "s.ramus.json", *SIZE, commands=f"shot {name}\n")

    def test_a_session_may_be_saved_over_itself(self):
        self.write("c.txt", "save s.ramus.json\n")
        self.expect_done("render", "tree.swc", *SIZE, "--commands", "c.txt")
        self.write("c.txt", "select 1\nsave s.ramus.json\nselect 2\nsave s.ramus.json\n")
        self.expect_done("render", "--session", "s.ramus.json", *SIZE, "--commands", "c.txt", "--overwrite")
        self.assertEqual(json.loads((self.folder / "s.ramus.json").read_text())["selection"], [2])

    def test_earlier_outputs_may_be_replaced(self):
        self.write("c.txt", "shot a.png\nselect 1\nshot a.png\nreport r.csv selection\nreport r.csv selection\n")
        self.expect_done("render", "tree.swc", *SIZE, "--commands", "c.txt")


if __name__ == "__main__":
    unittest.main()
