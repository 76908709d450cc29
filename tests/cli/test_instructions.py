"""What is the same on machines with other instruction sets, and within how much: each set that this processor has is forced."""

import json
import os
import re
import unittest

from ply import read_ply
from ramus import GOOD, CommandLineTest

CELL_MM = 0.4


class Instructions(CommandLineTest):
    def with_set(self, name, *arguments, **options):
        return self.expect_done(*arguments, env=os.environ | {"RAMUS_INSTRUCTIONS": name}, **options)

    def sets(self):
        """The names of those that the program and this processor have, the best first."""
        refused = self.expect_failure("info", "tree.swc", env=os.environ | {"RAMUS_INSTRUCTIONS": "MMX"},
                                      says=["RAMUS_INSTRUCTIONS: MMX is not an instruction set"])
        return re.search(r"it has (.+)\n", refused.stderr)[1].split(", ")

    def setUp(self):
        super().setUp()
        self.write("tree.swc", GOOD)
        self.expect_done("grow", "-o", "grown.swc", "--branches", "20")

    def test_surfaces_have_the_same_triangles_and_almost_the_same_positions(self):
        best, *others = self.sets()
        self.assertTrue(others)
        for tree in ("tree.swc", "grown.swc"):
            for name in (best, *others):
                self.with_set(name, "mesh", tree, "-o", name + ".ply", "--cell", CELL_MM)
            _, vertices, faces = read_ply(self.folder / (best + ".ply"))
            for name in others:
                with self.subTest(tree=tree, instructions=name):
                    _, other_vertices, other_faces = read_ply(self.folder / (name + ".ply"))
                    self.assertEqual((len(other_vertices), len(other_faces)), (len(vertices), len(faces)))
                    compared = json.loads(self.expect_done("compare", best + ".ply", name + ".ply", "--json").stdout)
                    self.assertLess(compared["hausdorff"], CELL_MM)
                    self.assertLess(compared["hausdorff_95"], 0.001)

    def test_the_same_instruction_set_gives_the_same_bytes(self):
        for name in self.sets():
            for threads in (1, 2):
                self.with_set(name, "mesh", "grown.swc", "-o", f"{threads}.ply", "--threads", threads)
            self.assertEqual((self.folder / "1.ply").read_bytes(), (self.folder / "2.ply").read_bytes(), name)

    def test_pictures_look_alike(self):
        best, *others = self.sets()
        words = ("render", "grown.swc", "--size", "400x300")
        self.with_set(best, *words, "-o", "best.png")
        for name in others:  # refused beyond one pixel in a thousand
            self.with_set(name, *words, "-o", name + ".png", "--reference", "best.png")


if __name__ == "__main__":
    unittest.main()
