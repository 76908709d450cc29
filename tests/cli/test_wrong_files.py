"""A file of another kind than a command takes: the message says what the file is, and its advice fits the command."""

import re
import subprocess
import unittest

from nifti import nifti, voxels
from ramus import GOOD, RAMUS, CommandLineTest

SIZE = ("--size", "64x64")


class WrongFiles(CommandLineTest):
    def setUp(self):
        super().setUp()
        size = (9, 9, 20)
        self.write("tree.swc", GOOD)
        self.write("scan.nii", nifti(size, [(x * 7 + y * 13 + z * 29) % 200 for x, y, z in voxels(size)]))
        self.write("empty", "")
        self.write("empty.nii", "")
        self.write("notes.txt", "hello\nworld\n")
        self.write("script", "save s.ramus.json\n")
        (self.folder / "folder").mkdir()
        self.write("folder/notes.txt", "hello\n")
        self.expect_done("mesh", "tree.swc", "-o", "m.stl")
        self.expect_done("render", "tree.swc", "-o", "p.png", "--commands", "script", *SIZE)

    # Commands that read a tree, or the tree of a mask.
    OF_TREES = (["info"], ["mesh", "-o", "o.stl"], ["convert", "-o", "o.swc"], ["render", "-o", "o.png", *SIZE],
                ["validate"], ["study", "-o", "s"], ["paper", "-o", "p", "--tree"])

    def of_tree(self, command, file):
        return [*command, file] if command[-1] == "--tree" else [command[0], file, *command[1:]]

    def test_a_mask_where_a_surface_is_validated(self):
        self.expect_failure("validate", "tree.swc", "--surface", "scan.nii", says=["scan.nii: this is a mask", "--mask"])

    def test_where_a_tree_is_needed(self):
        for command in self.OF_TREES:
            with self.subTest(command):
                for file, words in (("s.ramus.json", "s.ramus.json: this is a session"), ("missing", "no such file"),
                                    ("folder", "this folder holds no DICOM image"), ("empty", "the file is empty"),
                                    ("empty.nii", "the file is empty"), ("p.png", "files of type '.png' cannot be read"),
                                    ("notes.txt", "files of type '.txt' cannot be read")):
                    self.expect_failure(*self.of_tree(command, file), says=[file + ": ", words])
        self.write("noname", "hello\nworld\n")
        self.expect_failure("info", "noname", says=["its format is not recognised"])

    def test_where_a_mask_is_needed(self):
        for command in (["skeletonize", "FILE", "-o", "o.swc"], ["mesh", "FILE", "-o", "o.stl", "--method", "iso"],
                        ["validate", "tree.swc", "--mask", "FILE"],
                        ["paper", "-o", "p", "--figures", "9", "--tree", "tree.swc", "--mask", "FILE"]):
            with self.subTest(command):
                for file, words in (("missing", "no such file"), ("folder", "this folder holds no DICOM image"),
                                    ("empty", "the file is empty"), ("empty.nii", "the file is empty"),
                                    ("m.stl", "is a surface mesh, where a segmentation mask is needed"),
                                    ("p.png", "this is no volume")):
                    self.expect_failure(*[file if word == "FILE" else word for word in command], says=[file + ": ", words])
        for command in (["skeletonize", "tree.swc", "-o", "o.swc"], ["mesh", "tree.swc", "-o", "o.stl", "--method", "iso"]):
            self.expect_failure(*command, says=["this is a vessel tree, where a segmentation mask is needed"])

    def test_where_context_or_a_surface_is_needed(self):
        for option in ("--context", "--deviation-from"):
            for file, words in (("missing", "no such file"), ("tree.swc", "neither a mask nor a mesh"),
                                ("folder", "neither a mask nor a mesh")):
                self.expect_failure("render", "tree.swc", "-o", "o.png", option, file, *SIZE, says=[file + ": ", words])

    def test_where_a_session_is_needed(self):
        for file, words in (("missing", "no such file"), ("tree.swc", "not valid JSON"), ("folder", "a directory"),
                            ("empty", "the file is empty")):
            self.expect_failure("mesh", "--session", file, "-o", "o.stl", says=[file, words])

    def test_advice_about_a_scan_names_options_that_the_command_has(self):
        """Options that a message advises are options of the command that was given, and following the advice works."""
        for command, label in ((["skeletonize", "scan.nii", "-o", "o.swc"], "--labels"),
                               (["mesh", "scan.nii", "-o", "o.stl"], "--labels"),
                               (["convert", "scan.nii", "-o", "o.swc"], "--labels"),
                               (["render", "scan.nii", "-o", "o.png", *SIZE], "--labels")):
            with self.subTest(command):
                said = self.expect_failure(*command, says=["looks like a scan", "--isovalue X", label + " N,M"]).stderr
                self.assertTrue(re.search(r"--labels N,M", said))
                options = subprocess.run([RAMUS, command[0], "--help"], capture_output=True, text=True, check=True).stdout
                for option in ("--isovalue", label):
                    self.assertIn(option + " ", options)
                self.expect_done(*command, "--isovalue", "150")
                self.expect_done(*command, label, "7,14")


if __name__ == "__main__":
    unittest.main()
