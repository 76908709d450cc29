"""Limits of memory and of stacks (ulimit): a word where they do not suffice, never a crash."""

import resource
import subprocess
import unittest

from ramus import GOOD, RAMUS, SANITIZER_MEMORY, CommandLineTest

SIZE = ("--size", "300x200")


class Limits(CommandLineTest):
    def setUp(self):
        super().setUp()
        if SANITIZER_MEMORY:
            self.skipTest("sanitizers reserve terabytes, and their stacks are larger")
        self.write("tree.swc", GOOD)

    def limited(self, what, most, *arguments):
        return subprocess.run([RAMUS, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=120,
                              preexec_fn=lambda: resource.setrlimit(what, (most, most)))

    def test_lack_of_memory_is_reported_wherever_it_occurs(self):
        """From where nothing fits to where all does, through the loading of Mesa and its compiler."""
        done = 0
        for megabytes in (150, 300, 400, 500, 550, *range(580, 900, 20), 1200, 1600, 4000):
            with self.subTest(megabytes=megabytes):
                result = self.limited(resource.RLIMIT_AS, megabytes << 20, "render", "tree.swc", "-o", "a.png", *SIZE)
                self.assertIn(result.returncode, (0, 1), result.stderr)
                if result.returncode == 1:
                    self.assertRegex(result.stderr, r"(\A|\n)ramus: .*(memory|cannot be loaded|thread)[^\n]*\n\Z")
                    self.assertEqual(self.names(), ["tree.swc"])
                else:
                    done += 1
                    (self.folder / "a.png").unlink()
        self.assertGreater(done, 0)

    def test_small_stacks_suffice(self):
        for kilobytes in (64, 1024):
            for command in (["info", "tree.swc", "--contacts"], ["mesh", "tree.swc", "-o", "a.stl"],
                            ["render", "tree.swc", "-o", "a.png", *SIZE], ["validate", "tree.swc"],
                            ["paper", "-o", "p", "--figures", "4,10,II", "--tree", "tree.swc"], ["compare", "a.stl", "a.stl"]):
                with self.subTest(command, kilobytes=kilobytes):
                    result = self.limited(resource.RLIMIT_STACK, kilobytes << 10, *command)
                    self.assertEqual(result.returncode, 0, result.stderr)


if __name__ == "__main__":
    unittest.main()
