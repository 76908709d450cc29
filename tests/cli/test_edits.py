"""Trees that people have edited: by commands without a window, in sessions, written out again."""

import json
import unittest

from ramus import GOOD, CommandLineTest


class Edits(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.tree = self.write("tree.swc", GOOD)

    def session(self, edits):
        value = {"version": 1, "tree": {"path": "tree.swc"}, "edits": edits}
        return self.write("tree.ramus.json", json.dumps(value))

    def lines(self, name):
        return [line.split() for line in (self.folder / name).read_text().splitlines() if not line.startswith("#")]

    def test_convert_writes_the_edits_of_a_session(self):
        self.session([{"edit": "delete", "branches": [2]}, {"edit": "scale", "branches": [0], "value": 2}])
        self.expect_done("convert", "--session", "tree.ramus.json", "-o", "out.swc")
        lines = self.lines("out.swc")
        self.assertEqual(len(lines), 4)
        self.assertEqual([float(line[5]) for line in lines], [2.0, 2.0, 1.8, 1.2])
        self.assertIn("edited: branch 2 was deleted", (self.folder / "out.swc").read_text())
        # The same where the tree is named too, and in other commands.
        self.expect_done("convert", "tree.swc", "--session", "tree.ramus.json", "-o", "again.swc")
        self.assertEqual(self.lines("again.swc"), lines)
        self.assertEqual(self.json("info", "out.swc", "--json")["branches"], 1)

    def test_a_cut(self):
        self.session([{"edit": "cut", "branches": [1], "at": [0.6], "value": 1.0}])
        self.expect_done("convert", "--session", "tree.ramus.json", "-o", "cut.json")
        self.assertEqual(self.json("info", "cut.json", "--json")["roots"], 2)

    def test_invalid_edits_are_refused(self):
        for edits, words in (([{"edit": "delete", "branches": [0, 1, 2]}], "nothing would be left"),
                             ([{"edit": "flip", "branches": [7]}], "no branch 7"),
                             ([{"edit": "bend", "branches": [1]}], "unknown edit"),
                             ([{"edit": "cut", "branches": [1]}], "places")):
            with self.subTest(words):
                self.session(edits)
                self.expect_failure("convert", "--session", "tree.ramus.json", "-o", "out.swc",
                                    says=["tree.ramus.json", words])
                self.assertNotIn("out.swc", self.names())
        self.expect_failure("convert", "-o", "out.swc", says=["no tree to convert", "--session"])


if __name__ == "__main__":
    unittest.main()
