"""Outputs appear whole or not at all, whatever happens."""

import os
import pty
import signal
import subprocess
import time
import unittest

from ramus import GOOD, RAMUS, TUBE, CommandLineTest


class Outputs(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.tree = self.write("tree.swc", GOOD)

    def commands(self, *names):
        for extension in names:
            yield ["convert" if extension in ("json", "swc") else "mesh", self.tree, "-o"], "out." + extension

    def test_missing_folder(self):
        for command, output in self.commands("ply", "stl", "obj", "json", "swc"):
            with self.subTest(output):
                self.expect_failure(*command, "missing/" + output, says=["missing/" + output, "does not exist", "create"])
                self.assertEqual(self.names(), ["tree.swc"])

    def test_folder_in_the_place_of_the_file(self):
        for command, output in self.commands("ply", "json"):
            with self.subTest(output):
                (self.folder / output).mkdir()
                self.expect_failure(*command, output, says=[output, "is a folder", "name of a file"])
                self.assertEqual(list((self.folder / output).iterdir()), [])

    def test_file_in_the_place_of_the_folder(self):
        for command, output in self.commands("ply", "json"):
            with self.subTest(output):
                self.expect_failure(*command, "tree.swc/" + output, says=["does not exist"])

    def test_unknown_extension_is_refused_before_the_work(self):
        for command in ("mesh", "convert"):
            for output in ("out.xyz", "out"):
                with self.subTest(command, output=output):
                    # Were the input looked at first, its absence would be told.
                    self.expect_failure(command, "absent.swc", "-o", output, says=[output, "use ."])

    def test_full_disk(self):
        for command, output in self.commands("ply", "stl", "obj"):
            with self.subTest(output):
                before = self.write(output, "what was there before")
                self.expect_failure(*command, output, largest_file=4096, says=[output, "ulimit -f"])
                self.assertEqual(before.read_text(), "what was there before")
                self.assertEqual(self.names(), sorted(["tree.swc", output]))
                before.unlink()

    def test_more_surface_than_graphics_memory(self):
        self.expect_failure("render", self.tree, "-o", "out.png", "--graphics-memory", "100K",
                            says=["MB of graphics memory", "--detail", "--graphics-memory"])
        self.assertEqual(self.names(), ["tree.swc"])

    def test_full_disk_for_trees(self):
        long_tree = "".join(f"{i} 2 0 0 {i / 10} 1 {i - 1 or -1}\n" for i in range(1, 3001))
        self.write("tree.swc", long_tree)
        for command, output in self.commands("json", "swc"):
            with self.subTest(output):
                self.expect_failure(*command, output, largest_file=4096, says=[output, "ulimit -f"])
                self.assertEqual(self.names(), ["tree.swc"])

    def test_standard_output_on_a_full_disk(self):
        with open("/dev/full", "w", encoding="ascii") as full:
            result = self.run_ramus("info", self.tree, stdout=full)
        self.assertEqual(result.returncode, 1)
        self.assertIn("standard output cannot be written", result.stderr)

    def test_interrupt_leaves_the_old_file_or_the_new_one(self):
        self.write("tree.swc", TUBE)
        command = ["mesh", "tree.swc", "-o", "out.ply", "--detail", "400"]
        self.expect_done(*command)
        new = (self.folder / "out.ply").read_bytes()
        for number in (signal.SIGINT, signal.SIGTERM):
            for wait in (0.02, 0.1, 0.3, 0.6, 1.0, 1.5):
                with self.subTest(number=number, wait=wait):
                    old = self.write("out.ply", "old")
                    process = subprocess.Popen(
                        [RAMUS, *command], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                    time.sleep(wait)
                    process.send_signal(number)
                    _, errors = process.communicate(timeout=60)
                    self.assertIn(process.returncode, (0, 1, -number), errors)
                    if process.returncode == 1:
                        self.assertIn(b"cancelled", errors)
                    # Killed by the signal it may have been done already, but for cleaning up.
                    allowed = {0: [new], 1: [b"old"], -number: [b"old", new]}[process.returncode]
                    self.assertTrue(old.read_bytes() in allowed, (process.returncode, old.stat().st_size))
                    self.assertEqual(self.names(), ["out.ply", "tree.swc"])


class Progress(CommandLineTest):
    def test_a_pipe_sees_no_progress(self):
        tree = self.write("tree.swc", TUBE)
        result = self.expect_done("mesh", tree, "-o", "out.ply", "--detail", "256", "--json")
        self.assertEqual(result.stderr, "")

    def test_a_terminal_does(self):
        tree = self.write("tree.swc", TUBE)
        try:
            leader, follower = pty.openpty()
        except OSError as problem:  # a container may have no /dev/pts
            self.skipTest(f"no terminal to be had: {problem}")
        process = subprocess.Popen([RAMUS, "mesh", tree, "-o", "out.ply", "--detail", "512"], cwd=self.folder,
                                   stdout=subprocess.PIPE, stderr=follower)
        os.close(follower)
        shown = b""
        try:
            while piece := os.read(leader, 4096):
                shown += piece
        except OSError:  # how Linux says that nobody holds the terminal any more
            pass
        os.close(leader)
        process.communicate(timeout=300)
        self.assertEqual(process.returncode, 0)
        self.assertIn(b"surface [", shown)
        self.assertIn(b" %", shown)
        self.assertTrue(shown.endswith(b"\r\x1b[K"), shown)


if __name__ == "__main__":
    unittest.main()
