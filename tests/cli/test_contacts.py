"""Vessels that press on each other without being connected: kept apart or merged."""

import json
import unittest

from ramus import CommandLineTest

# Two straight tubes of radius 1 whose axes cross at right angles, 1.8 apart: they overlap by 0.2 at (0, 0, 0.9).
CROSSING = """1 2 0 -10 0 1 -1
2 2 0 10 0 1 1
3 2 -10 0 1.8 1 -1
4 2 10 0 1.8 1 3
"""


class Blend(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("crossing.swc", CROSSING)

    def components(self, *arguments):
        return self.json("mesh", "-o", "out.ply", "--json", *arguments)["components"]

    def test_vessels_that_touch_merge_or_stay_apart(self):
        self.assertEqual(self.components("crossing.swc"), 1)
        self.assertEqual(self.components("crossing.swc", "--blend", "paper"), 1)
        self.assertEqual(self.components("crossing.swc", "--blend", "tree"), 2)

    def test_commands_and_sessions_keep_what_was_chosen(self):
        self.write("c.txt", "blend tree\nsave tree.json\nblend\nsave paper.json\nsurface blend tree\nundo\nsave undone.json\n")
        self.expect_done("render", "crossing.swc", "-o", "out.png", "--size", "64x64", "--commands", "c.txt")
        blends = {name: json.loads((self.folder / name).read_text())["options"]["blend"]
                  for name in ("tree.json", "paper.json", "undone.json")}
        self.assertEqual(blends, {"tree.json": "tree", "paper.json": "paper", "undone.json": "paper"})
        self.assertEqual(self.components("--session", "tree.json"), 2)
        self.assertEqual(self.components("--session", "tree.json", "--blend", "paper"), 1)
        self.assertEqual(self.components("--session", "paper.json"), 1)
        self.assertEqual(self.components("--session", "paper.json", "--blend", "tree"), 2)

    def test_pictures_show_it(self):
        pictures = []
        for blend in ("paper", "tree"):
            self.expect_done("render", "crossing.swc", "-o", "out.png", "--size", "200x200", "--view", "superior",
                             "--blend", blend)
            pictures.append((self.folder / "out.png").read_bytes())
        self.assertNotEqual(*pictures)

    def test_other_words_are_wrong_usage(self):
        for command in (("mesh", "crossing.swc", "-o", "out.ply"), ("render", "crossing.swc", "-o", "out.png"),
                        ("study", "crossing.swc", "-o", "study")):
            self.expect_failure(*command, "--blend", "0.5", says=["--blend", "paper", "tree"], status=2)
        self.write("c.txt", "blend apart\n")
        self.expect_failure("render", "crossing.swc", "-o", "out.png", "--commands", "c.txt", says=["c.txt:1", "paper", "tree"])


if __name__ == "__main__":
    unittest.main()
