"""Surfaces in parts: one process makes each, or the processes of an MPI job make all of them at once."""

import filecmp
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree

from ply import read_ply
from ramus import GOOD, RAMUS, TUBE, CommandLineTest

RAMUS_MPI = pathlib.Path(RAMUS).with_name("ramus-mpi")
MPIRUN = shutil.which("mpirun")
JOB = ["--allow-run-as-root", "--oversubscribe"]  # a container's user, and few cores


class Parts(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.expect_done("grow", "--branches", "60", "-o", "tree.swc")

    def test_the_parts_are_the_surface(self):
        whole = json.loads(self.expect_done("mesh", "tree.swc", "-o", "whole.ply", "--json").stdout)
        self.assertEqual((whole["cut_loops"], whole["intersections"]["found"]), (0, 0))
        parts = [json.loads(self.expect_done("mesh", "tree.swc", "--part", f"{n}/4", "-o", f"{n}.ply", "--json").stdout)
                 for n in range(1, 5)]
        self.assertEqual(sum(part["triangles"] for part in parts), whole["triangles"])
        self.assertEqual(sum(part["evaluations"] for part in parts), whole["evaluations"])
        self.assertAlmostEqual(sum(part["part"]["share"] for part in parts), 1.0)
        work = [part["evaluations"] + part["part"]["border_evaluations"] for part in parts]
        self.assertLess(max(work), 1.2 * sum(work) / len(work))
        self.assertGreater(min(part["part"]["border_evaluations"] for part in parts), 0)
        corners = set()
        for n in range(1, 5):
            corners |= {vertex[:3] for vertex in read_ply(self.folder / f"{n}.ply")[1]}
        self.assertEqual(corners, {vertex[:3] for vertex in read_ply(self.folder / "whole.ply")[1]})

    def test_a_part_says_that_it_is_not_repaired(self):
        said = self.expect_done("mesh", "tree.swc", "--part", "2/3", "-o", "part.vtp").stdout
        self.assertIn("part 2 of 3", said)
        self.assertIn("nothing of it is repaired", said)

    def test_wrong_parts(self):
        for part in ("0/4", "5/4", "1", "1/", "/4", "a/b", "-1/4", "1/0", "1/1000000"):
            with self.subTest(part):
                self.expect_failure("mesh", "tree.swc", f"--part={part}", "-o", "part.ply", status=2, says=["1/4 to 4/4"])
        self.expect_failure("mesh", "tree.swc", "--part", "1/2", "--method", "cones", "-o", "part.ply",
                            says=["convolution surfaces"])
        self.expect_failure("mesh", "tree.swc", "--part", "1/2", "--for-printing", "-o", "part.ply", status=2,
                            says=["--for-printing"])
        self.assertEqual(self.names(), ["tree.swc"])

    def test_pieces_for_paraview(self):
        report = json.loads(self.expect_done("mesh", "tree.swc", "-o", "a & b.pvtp", "--json").stdout)
        pieces = [piece.get("Source") for piece in
                  xml.etree.ElementTree.parse(self.folder / "a & b.pvtp").getroot().iter("Piece")]
        self.assertEqual(pieces, ["a & b_0.vtp"])
        self.assertIn(f'NumberOfPolys="{report["triangles"]}"', (self.folder / pieces[0]).read_text(errors="replace"))
        self.expect_failure("mesh", "tree.swc", "-o", "-", "--format", "pvtp", status=2, says=["pvtp"])


@unittest.skipUnless(RAMUS_MPI.is_file() and MPIRUN, "SKIPPED: no ramus-mpi or no mpirun (scripts/setup has openmpi-bin)")
class Together(CommandLineTest):
    def together(self, processes, *arguments):
        return subprocess.run([MPIRUN, *JOB, "-n", str(processes), RAMUS_MPI, "mesh", *arguments], cwd=self.folder,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=300)

    def expect_same(self, arguments, output, processes=(1, 2, 3, 4)):
        alone = json.loads(self.expect_done("mesh", *arguments, "-o", output, "--json").stdout)
        for count in processes:
            with self.subTest(arguments=arguments, processes=count):
                done = self.together(count, *arguments, "-o", "together" + output, "--json")
                self.assertEqual(done.returncode, 0, done.stderr)
                report = json.loads(done.stdout)
                for key in ("vertices", "triangles", "components", "loops", "evaluations", "cut_loops", "intersections"):
                    self.assertEqual(report[key], alone[key], key)
                self.assertTrue(filecmp.cmp(self.folder / output, self.folder / ("together" + output), shallow=False))
        return alone

    def test_processes_give_the_bytes_of_one(self):
        self.expect_done("grow", "--branches", "151", "-o", "tree.swc")
        self.expect_same(["tree.swc"], "tree.ply")
        self.expect_same(["tree.swc", "--cell", "0.9"], "tree.stl", (3,))

    def test_repairs_and_systems(self):
        # So thick that vessels touch: there are walls, false loops and folds to repair.
        self.expect_done("grow", "--branches", "301", "--organ-size", "150", "--root-radius", "5", "-o", "packed.swc")
        alone = self.expect_same(["packed.swc", "--detail", "8"], "packed.ply", (2, 4))
        self.assertGreater(alone["intersections"]["found"] + alone["cut_loops"], 0)

    def test_memory_that_does_not_suffice(self):
        self.write("tube.swc", TUBE)
        self.expect_done("mesh", "tube.swc", "--detail", "200", "-o", "alone.ply")
        done = self.together(2, "tube.swc", "--detail", "200", "--memory", "400M", "-o", "together.ply")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(filecmp.cmp(self.folder / "alone.ply", self.folder / "together.ply", shallow=False))

    def test_pieces(self):
        self.expect_done("grow", "--branches", "60", "-o", "tree.swc")
        whole = json.loads(self.expect_done("mesh", "tree.swc", "-o", "tree.ply", "--json").stdout)
        done = self.together(3, "tree.swc", "-o", "tree.pvtp", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        counts = [int(re.search(rb'NumberOfPolys="(\d+)"', (self.folder / f"tree_{n}.vtp").read_bytes()).group(1))
                  for n in range(3)]
        self.assertEqual(sum(counts), whole["triangles"])
        self.assertLess(max(counts) - min(counts), 2)

    def test_errors_are_said_once_and_end_all(self):
        for arguments, status, says in ((["no.swc", "-o", "out.ply"], 1, "no such file"),
                                        (["tree.swc"], 2, "--output"),
                                        (["tree.swc", "-o", "out.xyz"], 1, ".xyz"),
                                        (["tree.swc", "-o", "-", "--format", "ply"], 2, "must be a file")):
            with self.subTest(arguments):
                self.write("tree.swc", GOOD)
                done = self.together(2, *arguments)
                self.assertNotEqual(done.returncode, 0)
                self.assertEqual(sum(says in line for line in done.stderr.splitlines()), 1, done.stderr)
                self.assertEqual(self.names(), ["tree.swc"])

    def test_a_killed_process_ends_the_job_and_leaves_nothing(self):
        self.expect_done("grow", "--branches", "60", "-o", "tree.swc")
        with subprocess.Popen([MPIRUN, *JOB, "-n", "3", RAMUS_MPI, "mesh", "tree.swc", "--detail", "200", "-o", "out.ply"],
                              cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as job:
            killed = None
            for _ in range(200):
                time.sleep(0.05)
                children = subprocess.run(["pgrep", "-P", str(job.pid), "ramus-mpi"], stdout=subprocess.PIPE, text=True)
                if len(children.stdout.split()) == 3:
                    time.sleep(1.0)  # of several
                    killed = int(children.stdout.split()[1])
                    os.kill(killed, signal.SIGKILL)
                    break
            self.assertIsNotNone(killed)
            _, said = job.communicate(timeout=60)
        self.assertNotEqual(job.returncode, 0)
        self.assertIn("signal 9", said)
        self.assertEqual(self.names(), ["tree.swc"])


if __name__ == "__main__":
    unittest.main()
