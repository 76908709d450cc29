"""Bad trees: exit status 1, one line that names file, line and remedy, nothing left behind."""

import os
import random
import subprocess
import unittest

from ramus import GOOD, RAMUS, CommandLineTest

# name: (content, what the message says beside the file's name; ':N' is the line)
BAD_TREES = {
    "empty": ("", ["is empty", "choose another file"]),
    "comments only": ("# nothing\n\n   # here\n", ["no points", "choose another file"]),
    "binary": (bytes(range(256)) * 8, ["binary", "check the file's format"]),
    "text": ("This is not a tree at all, is it? No.\n", [":1:", "id type x y z radius parent"]),
    "missing parent": (GOOD + "6 2 9 9 9 1 77\n", [":6:", "parent 77 does not exist", "-1 for a root"]),
    "cycle of parents": ("1 2 0 0 0 1 3\n2 2 0 0 1 1 1\n3 2 0 0 2 1 2\n", [":", "leads back", "break the cycle"]),
    "its own parent": ("1 2 0 0 0 1 -1\n2 2 0 0 1 1 2\n", [":2:", "leads back", "break the cycle"]),
    "duplicate id": (GOOD + "4 2 9 9 9 1 3\n", [":6:", "id 4", "line 4", "its own id"]),
    "NaN": (GOOD.replace("-3 0 15", "nan 0 15"), [":5:", "not finite", "correct"]),
    "infinite": (GOOD.replace("-3 0 15", "-inf 0 15"), [":5:", "not finite", "correct"]),
    "NaN radius": (GOOD.replace("0.7", "NaN"), [":5:", "the radius was not measured", "--repair all or --repair unmeasured-radii"]),
    "number overflows": (GOOD.replace("-3 0 15", "1e999 0 15"), [":5:", "not finite", "correct"]),
    "id overflows": (GOOD + "99999999999999999999 2 1 1 1 1 1\n", [":6:", "id", "whole number"]),
    "negative radius": (GOOD.replace("0.7", "-0.7"), [":5:", "radius -0.7 is negative", "edit the file"]),
    "no positive radius": ("1 2 0 0 0 0 -1\n2 2 0 0 5 0 1\n", ["no point has a positive radius", "radius column"]),
    "single point": ("1 2 0 0 0 1 -1\n", [":1:", "single point", "two points"]),
    "one-node tree": ("1 2 0 0 0 1 -1\n2 2 0 0 0 1 1\n", ["no segment", "connected"]),
    "unconnected points": ("1 2 0 0 0 1 -1\n2 2 5 5 5 1 -1\n", ["no segment", "connected"]),
    "far away": (GOOD.replace("-3 0 15", "1e9 0 15"), [":5:", "1e+09 mm", "check the unit"]),
    "huge radius": (GOOD.replace("0.7", "1e9"), [":5:", "1e+09 mm", "check the unit"]),
    "too few columns": (GOOD + "6 2 9 9 9 1\n", [":6:", "7 columns, found 6", "id type x y z radius parent"]),
    "word for a number": (GOOD.replace("0.7", "thick"), [":5:", "'thick' is not a number"]),
    "decimal comma": (GOOD.replace("0.7", "0,7"), [":5:", "found 8 columns", "decimal point"]),
}


class BadTrees(CommandLineTest):
    def test_every_command_refuses_bad_trees(self):
        for name, (content, says) in BAD_TREES.items():
            tree = self.write("bad.swc", content)
            for command in (["info", tree], ["info", tree, "--json"], ["mesh", tree, "-o", "out.ply"],
                            ["mesh", tree, "-o", "out.stl", "--method", "cones"], ["convert", tree, "-o", "out.json"],
                            ["render", tree, "-o", "out.png"]):
                with self.subTest(name, command=command[0]):
                    self.expect_failure(*command, says=["bad.swc", *says])
                    self.assertEqual(self.names(), ["bad.swc"])

    def test_line_numbers_count_every_line_ending(self):
        for ending in ("\n", "\r\n", "\r"):
            tree = self.write("bad.swc", "# head\n\n1 2 0 0 0 1 -1\n2 2 0 0 bad 1 1\n".replace("\n", ending))
            self.expect_failure("info", tree, says=["bad.swc:4:"])

    def test_missing_files_and_folders(self):
        for command in (["info"], ["mesh", "-o", "out.ply"], ["convert", "-o", "out.json"]):
            with self.subTest(command=command[0]):
                self.expect_failure(*command, "missing.swc", says=["missing.swc", "no such file", "check the path"])
                self.expect_failure(*command, self.folder, says=[str(self.folder), "folder", "name a file in it"])
        (self.folder / "folder.swc").mkdir()
        self.expect_failure("info", "folder.swc", says=["folder.swc", "folder"])

    def test_unknown_extension(self):
        self.expect_done("info", self.write("tree.xyz", GOOD))  # its content tells
        tree = self.write("tree.xyz", "A letter.\n")
        self.expect_failure("info", tree, says=["tree.xyz", "'.xyz' cannot be read", "use .swc"])

    def test_unreadable_file(self):
        tree = self.write("secret.swc", GOOD)
        tree.chmod(0)
        options = {}
        if os.geteuid() == 0:  # root reads everything, so the program runs as nobody
            self.folder.chmod(0o755)
            options["user"] = 65534
            try:
                subprocess.run([RAMUS, "--version"], check=True, capture_output=True, cwd=self.folder, user=65534)
            except (OSError, subprocess.CalledProcessError):
                self.skipTest("nobody may not run the program from where it lies")
        self.expect_failure("info", tree, says=["secret.swc", "Permission denied", "check its permissions"], **options)

    def test_damaged_json(self):
        good = self.write("good.swc", GOOD)
        self.expect_done("convert", good, "-o", "good.json")
        text = (self.folder / "good.json").read_text()
        cases = {
            "": "is empty",
            "{}": "not a ramus tree",
            "[[[[[": "not valid JSON",
            text[: len(text) // 2]: "not valid JSON",
            text.replace('"version": 2', '"version": 99'): "newer ramus",
            text.replace("[0, 1, 2]", "[0, 1, 999999999]"): "branches[0][2]",
            text.replace('"points"', '"dots"'): "points: is missing",
        }
        for content, words in cases.items():
            with self.subTest(words):
                bad = self.write("bad.json", content)
                self.expect_failure("info", bad, says=["bad.json", words])

    def test_random_damage_never_crashes(self):
        chance = random.Random(1)
        for _ in range(60):
            content = bytearray(GOOD.encode())
            for _ in range(chance.randint(1, 6)):
                content[chance.randrange(len(content))] = chance.randrange(256)
            tree = self.write("bad.swc", bytes(content))
            result = self.run_ramus("info", tree)
            self.assertIn(result.returncode, (0, 1), (bytes(content), result.stderr))


class Repairs(CommandLineTest):
    def test_a_zero_radius_is_repaired_and_reported(self):
        tree = self.write("tree.swc", "1 2 0 0 0 1 -1\n2 2 0 0 5 0 1\n3 2 0 0 10 2 2\n")
        info = self.json("info", tree, "--json")
        self.assertEqual(len(info["repairs"]), 1)
        self.assertIn("tree.swc:2", info["repairs"][0])
        self.assertEqual(info["radius_mm"], {"min": 1.0, "mean": 1.5, "max": 2.0})
        result = self.expect_done("mesh", tree, "-o", "out.ply")
        self.assertIn("tree.swc:2", result.stderr)

    def test_repair_none_refuses(self):
        tree = self.write("tree.swc", "1 2 0 0 0 1 -1\n2 2 0 0 5 0 1\n3 2 0 0 10 2 2\n")
        for command in (["info", tree], ["mesh", tree, "-o", "out.ply"], ["convert", tree, "-o", "out.json"]):
            self.expect_failure(*command, "--repair", "none", says=["tree.swc:2", "--repair usual"])
        self.assertEqual(self.names(), ["tree.swc"])

    def test_a_list_allows_some_repairs(self):
        # A radius of 0 in line 2, a point twice in line 4, a point by itself in line 5.
        tree = self.write("tree.swc", "1 2 0 0 0 1 -1\n2 2 0 0 5 0 1\n3 2 0 0 10 2 2\n4 2 0 0 10 2 3\n5 2 9 9 9 1 -1\n")
        self.assertEqual(len(self.json("info", tree, "--json")["repairs"]), 3)
        kinds = {"zero-radii": "tree.swc:2", "repeated-points": "tree.swc:4", "lonely-points": "tree.swc:5"}
        for kind, place in kinds.items():
            others = ",".join(other for other in kinds if other != kind)
            with self.subTest(kind):
                self.expect_failure("info", tree, "--repair", others, says=[place, "--repair " + kind])
        self.expect_done("info", tree, "--repair", ",".join(kinds))
        self.expect_failure("info", tree, "--repair", "zero-radii,magic", says=["--repair", "magic"], status=2)
        self.expect_failure("info", tree, "--repair", "", says=["--repair"], status=2)


if __name__ == "__main__":
    unittest.main()
