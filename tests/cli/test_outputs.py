"""Outputs appear whole or not at all, whatever happens."""

import os
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

    def test_output_is_a_folder(self):
        for command, output in self.commands("ply", "json"):
            with self.subTest(output):
                (self.folder / output).mkdir()
                self.expect_failure(*command, output, says=[output, "is a folder", "name of a file"])
                self.assertEqual(list((self.folder / output).iterdir()), [])

    def test_output_folder_is_a_file(self):
        for command, output in self.commands("ply", "json"):
            with self.subTest(output):
                self.expect_failure(*command, "tree.swc/" + output, says=["does not exist"])

    def test_unknown_extension_is_refused_before_computing(self):
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
        command = ["mesh", "tree.swc", "-o", "out.ply", "--detail", "200"]
        self.expect_done(*command)
        new = (self.folder / "out.ply").read_bytes()
        for number in (signal.SIGINT, signal.SIGTERM):
            for wait in (0.02, 0.1, 0.2, 0.3, 0.5):
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


    def test_a_replaced_file_keeps_no_special_bits(self):
        for bits, kept in ((0o7777, 0o777), (0o4755, 0o755), (0o2750, 0o750), (0o1640, 0o640), (0o600, 0o600)):
            for command, output in self.commands("ply", "json", "swc"):
                with self.subTest(bits=oct(bits), output=output):
                    path = self.write(output, "old")
                    path.chmod(bits)
                    self.expect_done(*command, output)
                    self.assertEqual(oct(path.stat().st_mode & 0o7777), oct(kept))

    def test_links_stay_links(self):
        (self.folder / "deep").mkdir()
        for command, output in self.commands("ply", "json"):
            for target in ("new." + output, "deep/new." + output, str(self.folder / ("whole." + output))):
                with self.subTest(output, target=target):
                    link = self.folder / ("link-" + output)
                    link.unlink(missing_ok=True)
                    link.symlink_to(target)
                    self.expect_done(*command, link.name)
                    self.assertTrue(link.is_symlink())
                    self.assertGreater((self.folder / target).stat().st_size, 10)
            (self.folder / ("a." + output)).symlink_to("b." + output)
            (self.folder / ("b." + output)).symlink_to("chain." + output)
            self.expect_done(*command, "a." + output)
            self.assertTrue((self.folder / ("b." + output)).is_symlink())
            self.assertFalse((self.folder / ("chain." + output)).is_symlink())
            nowhere = self.folder / ("nowhere." + output)
            nowhere.symlink_to("missing/x." + output)
            self.expect_failure(*command, nowhere.name, says=["missing", "does not exist"])
            circle = self.folder / ("circle." + output)
            circle.symlink_to(circle.name)
            self.expect_failure(*command, circle.name, says=[circle.name])
            self.assertTrue(nowhere.is_symlink() and circle.is_symlink())


class Series(CommandLineTest):
    """Several files that belong together come together."""

    def setUp(self):
        super().setUp()
        self.write("tree.swc", GOOD)

    def stopped(self, *arguments, after, number=signal.SIGINT):
        process = subprocess.Popen([RAMUS, *arguments], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(after)
        process.send_signal(number)
        _, errors = process.communicate(timeout=120)
        return process.returncode, errors

    def test_a_stopped_turntable_leaves_no_picture(self):
        self.write("t_0001.png", "mine")
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            for after in (0.5, 1.5, 3):
                with self.subTest(number=number, after=after):
                    status, errors = self.stopped("render", "tree.swc", "-o", "t.png", "--turntable", "9999", "--size", "64x48",
                                                  after=after, number=number)
                    self.assertNotEqual(status, 0, errors)
                    self.assertEqual(self.names(), ["t_0001.png", "tree.swc"])
                    self.assertEqual((self.folder / "t_0001.png").read_text(), "mine")
        self.expect_done("render", "tree.swc", "-o", "t.png", "--turntable", "3", "--size", "64x48")
        self.assertEqual(self.names(), ["t_0001.png", "t_001.png", "t_002.png", "t_003.png", "tree.swc"])

    def test_a_stopped_turntable_of_a_commands_file_leaves_no_picture(self):
        self.write("c", "export turntable t.png --pictures 9999 --size 64x48\n")
        self.stopped("render", "tree.swc", "--commands", "c", "--size", "64x48", after=2)
        self.assertEqual(self.names(), ["c", "tree.swc"])

    def test_a_failed_turntable_leaves_no_picture(self):
        (self.folder / "t_003.png").mkdir()
        self.expect_failure("render", "tree.swc", "-o", "t.png", "--turntable", "4", "--size", "64x48", says=["t_003.png", "folder"])
        self.assertEqual(self.names(), ["t_003.png", "tree.swc"])

    def test_a_failed_study_leaves_nothing(self):
        self.write("loose.swc", "1 2 0 0 0 1 -1\n")
        self.expect_failure("study", "loose.swc", "-o", "deep/s", "--size", "64x48")
        self.assertEqual(self.names(), ["loose.swc", "tree.swc"])
        (self.folder / "s/place_2_cones.png").mkdir(parents=True)
        self.expect_failure("study", "tree.swc", "-o", "s", "--size", "64x48", says=["place_2_cones.png"])
        self.assertEqual([path.name for path in (self.folder / "s").iterdir()], ["place_2_cones.png"])


class Progress(CommandLineTest):
    def test_a_pipe_sees_no_progress(self):
        tree = self.write("tree.swc", TUBE)
        result = self.expect_done("mesh", tree, "-o", "out.ply", "--detail", "256", "--json")
        self.assertEqual(result.stderr, "")

    def test_a_terminal_sees_progress(self):
        tree = self.write("tree.swc", TUBE)
        leader, follower = self.terminal()
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
