"""Masks and meshes next to the tree: through --context, commands and sessions they come into the same picture."""

import json
import unittest

from nifti import compressed, nifti, voxels
from ramus import GOOD, CommandLineTest

SIZE = ("--size", "240x180")


class Context(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.tree = self.write("tree.swc", GOOD)
        size = (10, 6, 12)
        block = [1 if 2 <= x < 8 and z < 6 else 2 if 2 <= x < 8 else 0 for x, y, z in voxels(size)]
        self.write("mask.nii.gz", compressed(nifti(size, block, rows=((1, 0, 0, -4.5), (0, 1, 0, -2.5), (0, 0, 1, 0)))))
        corners = [(x, y, z) for x in (-2, 2) for y in (-2, 2) for z in (4, 8)]
        faces = "1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4"
        self.write("bone.obj", "".join("v %d %d %d\n" % corner for corner in corners) +
                   "".join("f %s\n" % face for face in faces))

    def render(self, output, *arguments, commands=None):
        if commands is not None:
            self.write("commands.txt", commands)
            arguments = (*arguments, "--commands", "commands.txt")
        return self.expect_done("render", self.tree, *SIZE, "-o", output, *arguments)

    def differ(self, *arguments, commands, reference):
        self.write("commands.txt", commands)
        result = self.run_ramus("render", *arguments, *SIZE, "-o", "now.png", "--commands", "commands.txt",
                                "--reference", reference, "--tolerance", 0)
        self.assertIn(result.returncode, (0, 3), result.stderr)
        return result.returncode == 3

    def test_masks_and_meshes_are_shown_hidden_undone_and_removed(self):
        self.render("plain.png")
        for line in ("context mask.nii.gz", "context mask.nii.gz --label 2 --opacity 1", "context bone.obj --wireframe",
                     "context bone.obj --colour 20a0ff --opacity 0.5"):
            with self.subTest(line):
                self.assertTrue(self.differ(self.tree, commands=line + "\n", reference="plain.png"))
                for after in ("undo", "context-hide 1", "context-remove 1", "context-opacity 1 0"):
                    self.assertFalse(self.differ(self.tree, commands=line + "\n" + after + "\n", reference="plain.png"))

    def test_option_command_and_session_give_the_same_picture(self):
        self.render("flag.png", "--context", "mask.nii.gz", "--context", "bone.obj")
        commands = "context mask.nii.gz\ncontext bone.obj\n"
        self.assertFalse(self.differ(self.tree, commands=commands + "save s.json\n", reference="flag.png"))
        saved = json.loads((self.folder / "s.json").read_text())["context"]
        self.assertEqual([item["path"] for item in saved], ["mask.nii.gz", "bone.obj"])
        self.assertRegex(saved[0]["colour"], "^#[0-9a-f]{6}$")
        self.assertFalse(self.differ("--session", "s.json", commands="", reference="flag.png"))

    def test_colours_and_opacities_change_the_picture(self):
        self.render("one.png", "--context", "mask.nii.gz")
        for line in ("context-colour 1 \"#20a0ff\"", "context-opacity 1 0.6", "context-style 1 wireframe"):
            with self.subTest(line):
                self.assertTrue(self.differ(self.tree, "--context", "mask.nii.gz", commands=line + "\n",
                                            reference="one.png"))

    def test_unreadable_context_is_reported_and_leaves_no_picture(self):
        before = self.names()
        self.expect_failure("render", self.tree, *SIZE, "-o", "x.png", "--context", "gone.nii", says=["gone.nii"])
        self.expect_failure("render", self.tree, *SIZE, "-o", "x.png", "--context", self.tree, says=["tree.swc"])
        self.assertEqual(self.names(), before)
        session = {"version": 1, "tree": {"path": "tree.swc"}, "context": [{"path": "gone.stl"}]}
        self.write("s.json", json.dumps(session))
        self.expect_failure("render", "--session", "s.json", *SIZE, "-o", "x.png", says=["gone.stl"])
        self.assertNotIn("x.png", self.names())


if __name__ == "__main__":
    unittest.main()
