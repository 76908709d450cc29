"""Surfaces larger than the memory they may take."""

import filecmp
import json
import os
import subprocess
import unittest

from nifti import nifti
from ramus import RAMUS, SANITIZER_MEMORY, TUBE, CommandLineTest


class Streaming(CommandLineTest):
    MEMORY = (256 << 20) + SANITIZER_MEMORY
    LARGE = ["mesh", "tube.swc", "--detail", "400", "--memory", f"{MEMORY >> 20}M", "-o"]
    # A quarter of the triangles, and the least memory that streams them. Only the peak of memory needs more.
    COMMAND = ["mesh", "tube.swc", "--detail", "200", "--memory", f"{170 + (SANITIZER_MEMORY >> 20)}M", "-o"]

    def setUp(self):
        super().setUp()
        self.write("tube.swc", TUBE)

    def test_streaming_stays_within_its_memory_and_gives_the_same_file(self):
        # What a process had at its peak counts what its parent had when it began: this one stays small.
        with subprocess.Popen([RAMUS, *self.LARGE, "streamed.ply", "--json", "--verbose"], cwd=self.folder,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            report = json.loads(process.stdout.read())
            said = process.stderr.read()
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(process.returncode, 0)
        self.assertIn("on the disk", said)
        self.assertEqual((report["streamed"], report["cut_loops"]), (True, 0))
        self.assertEqual(report["intersections"], {"found": 0, "left": 0})
        self.assertEqual((report["components"], report["loops"]), (1, 0))
        self.assertEqual(report["tree"], {"components": 1, "loops": 0})
        self.assertLess(usage.ru_maxrss * 1024, self.MEMORY)
        whole = json.loads(self.expect_done("mesh", "tube.swc", "--detail", "400", "-o", "whole.ply", "--json").stdout)
        self.assertEqual((whole["triangles"], whole["components"]), (report["triangles"], report["components"]))
        # Less than the mesh alone: 32 bytes a vertex, 12 a triangle.
        self.assertLess(usage.ru_maxrss * 1024 - SANITIZER_MEMORY, 28 * whole["triangles"])
        self.assertTrue(filecmp.cmp(self.folder / "streamed.ply", self.folder / "whole.ply", shallow=False))

    def test_surfaces_of_masks(self):
        """Half a million voxels that touch no other: 120 MB as a mesh."""
        rows = [(b"\0\1" * 80 if j % 2 and k % 2 else bytes(160)) for k in range(160) for j in range(160)]
        self.write("mask.nii", nifti((160, 160, 160), []) + b"".join(rows))
        command = ["mesh", "mask.nii", "--method", "iso", "--json", "-o"]
        whole = json.loads(self.expect_done(*command, "whole.ply").stdout)
        self.assertEqual((whole["triangles"], whole["components"], whole["streamed"]), (8 * 80**3, 80**3, False))
        most = (120 << 20) + SANITIZER_MEMORY
        with subprocess.Popen([RAMUS, *command, "streamed.ply", "--memory", f"{most >> 20}M"], cwd=self.folder,
                              stdout=subprocess.PIPE, text=True) as process:
            report = json.loads(process.stdout.read())
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual((process.returncode, report["streamed"]), (0, True))
        self.assertLess(usage.ru_maxrss * 1024, most)
        self.assertTrue(filecmp.cmp(self.folder / "streamed.ply", self.folder / "whole.ply", shallow=False))
        self.expect_failure(*command, "out.ply", "--memory", f"{most >> 20}M", largest_file=10 << 20, says=["out.ply", "ulimit -f"])

    def test_printing_and_formats_of_the_whole_mesh(self):
        for output, more in (("solid.stl", ["--for-printing", "--units", "mm"]), ("surface.vtp", [])):
            with self.subTest(output):
                streamed = json.loads(self.expect_done(*self.COMMAND, output, "--json", *more).stdout)
                whole = json.loads(self.expect_done("mesh", "tube.swc", "--detail", "200", "-o", "whole" + output,
                                                    "--json", *more).stdout)
                self.assertEqual((streamed["streamed"], whole["streamed"]), (True, False))
                self.assertEqual(streamed.get("printing"), whole.get("printing"))
                self.assertTrue(filecmp.cmp(self.folder / output, self.folder / ("whole" + output), shallow=False))

    def test_streaming_to_a_full_disk(self):
        for output in ("out.ply", "out.stl"):
            with self.subTest(output):
                before = self.write(output, "what was there before")
                self.expect_failure(*self.COMMAND, output, largest_file=1 << 20, says=[output, "ulimit -f"])
                self.assertEqual(before.read_text(), "what was there before")
                self.assertEqual(self.names(), sorted(["tube.swc", output]))
                before.unlink()

    def test_too_little_memory_even_for_streaming(self):
        self.expect_failure("mesh", "tube.swc", "--detail", "400", "--memory", "64M", "-o", "out.ply",
                            says=["million triangles", "MB", "--memory", "--detail"])
        self.assertEqual(self.names(), ["tube.swc"])


if __name__ == "__main__":
    unittest.main()
