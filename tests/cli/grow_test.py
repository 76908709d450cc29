"""What `ramus grow` promises on the command line. Usage: grow_test.py RAMUS"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

RAMUS = sys.argv.pop(1)


def ramus(*arguments):
    return subprocess.run([RAMUS, *arguments], capture_output=True, text=True, timeout=300)


class Grow(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def info(self, name):
        shown = ramus("info", self.path(name), "--json")
        self.assertEqual(shown.returncode, 0, shown.stderr)
        return json.loads(shown.stdout)

    def grow(self, name, *options):
        grown = ramus("grow", "-o", self.path(name), *options)
        self.assertEqual((grown.returncode, grown.stdout), (0, ""), grown.stderr)

    def test_info_counts_the_requested_number_of_branches(self):
        for branches in (1, 3, 4, 63, 64, 1504):
            for name in ("tree.swc", "tree.json"):
                self.grow(name, "--branches", str(branches), "--seed", "5")
                info = self.info(name)
                self.assertEqual(info["branches"], branches)
                self.assertEqual((info["roots"], info["loops"], info["repairs"]), (1, 0, []))

    def test_the_same_options_give_the_same_bytes(self):
        for name in ("a.swc", "b.swc"):
            self.grow(name, "--branches", "200", "--seed", "7")
        self.grow("c.swc", "--branches", "200", "--seed", "8")
        self.assertEqual(self.read("a.swc"), self.read("b.swc"))
        self.assertNotEqual(self.read("a.swc"), self.read("c.swc"))

    def test_the_file_says_how_it_was_grown(self):
        self.grow("a.swc", "--branches", "21", "--seed", "2", "--root-radius", "4.5", "--spacing", "0.7",
                  "--organ-size", "150", "--tortuosity", "0.5")
        head = self.read("a.swc").decode().splitlines()[0]
        self.assertTrue(head.startswith("# ramus grow "), head)
        self.grow("b.swc", *head.split()[3:])
        self.assertEqual(self.read("a.swc"), self.read("b.swc"))

    def test_radii_follow_murrays_law(self):
        self.grow("a.swc", "--branches", "300")
        points, children = {}, {}
        for line in self.read("a.swc").decode().splitlines():
            if not line.startswith("#"):
                number, _, _, _, _, radius, parent = line.split()
                points[number] = float(radius)
                children.setdefault(parent, []).append(number)
        forks = {node: below for node, below in children.items() if node != "-1" and len(below) > 1}
        self.assertEqual(len(forks), 149)  # 151 leaves need 150 twofold forks; one threefold stands for two
        for node, below in forks.items():
            flow = sum(points[child] ** 3 for child in below)
            self.assertAlmostEqual(flow / points[node] ** 3, 1.0, delta=1e-9)

    def test_wrong_usage_and_failure_have_different_statuses_and_leave_no_file(self):
        wrong = [["--branches", "2"], ["--branches", "0"], ["--branches", "many"], ["--root-radius", "nan"],
                 ["--root-radius", "-1"], ["--spacing", "0"], ["--seed", "x"], ["--organ-size", "inf"]]
        for options in wrong:
            refused = ramus("grow", "-o", self.path("x.swc"), *options)
            self.assertEqual(refused.returncode, 2, options)
            self.assertTrue(refused.stderr)
        self.assertEqual(ramus("grow", "--branches", "5").returncode, 2)  # no output named
        failing = [["-o", self.path("x.png")], ["-o", self.path("no/such/folder.swc")], ["-o", self.folder.name],
                   ["-o", self.path("x.swc"), "--root-radius", "10"]]  # no room for so thick a tree
        for options in failing:
            refused = ramus("grow", "--branches", "20000", *options)
            self.assertEqual(refused.returncode, 1, options)
            self.assertIn("; ", refused.stderr, "a remedy")
        self.assertEqual(os.listdir(self.folder.name), [])


if __name__ == "__main__":
    unittest.main()
