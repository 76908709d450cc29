"""Whether surfaces are true to their trees: `ramus validate`."""

import json
import math
import signal
import subprocess
import time
import unittest

from nifti import nifti, voxels
from ramus import RAMUS, TUBE, CommandLineTest
from validated import CROSSING, TEXT_FILES, Page, fork, line, rows_of, swc


class Validate(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("fork.swc", fork(True))

    def counts(self, found):
        return [len(found["questions"][name]) for name in ("lost", "false", "merged", "constrictions")]

    def test_its_own_surface(self):
        found = self.json("validate", "fork.swc", "--blend", "tree", "--json")
        self.assertEqual(self.counts(found), [0, 0, 0, 0])
        self.assertLess(found["radius_error"]["median"], 0.005)
        self.assertLess(found["distances"]["to_cones"]["mean"], 0.09)
        self.assertIsNone(found["distances"]["to_mask"])
        text = self.expect_done("validate", "fork.swc", "--blend", "tree").stdout
        for words in ("lost branches: none", "false branches: none", "merged branches: none", "radius away from joints"):
            self.assertIn(words, text)

    def test_distances_are_also_given_without_free_ends(self):
        # A tube of radius 2 goes on half a ball beyond its ends as cones, 0.7075 radii as a convolution surface. Fine
        # triangles: chords of the half balls are nearer.
        self.write("tube.swc", swc((0, 0, 0, 2, -1), (0, 0, 30, 2, 1)))
        cones = self.json("validate", "tube.swc", "--detail", "64", "--json")["distances"]["to_cones"]
        self.assertAlmostEqual(cones["max"], 2 * (1 - 0.7075), delta=0.03)
        others = cones["but_for_free_ends"]
        self.assertLess(others["max"], 0.3)
        self.assertLess(others["count"], cones["count"])
        self.expect_done("mesh", "tube.swc", "-o", "tube.stl")
        given = self.json("validate", "tube.swc", "--surface", "tube.stl", "--json")["distances"]["to_cones"]
        self.assertNotIn("but_for_free_ends", given)

    def test_the_surface_of_another_program(self):
        self.write("less.swc", fork(False))
        self.expect_done("mesh", "less.swc", "-o", "less.stl")
        self.expect_done("mesh", "fork.swc", "-o", "fork.stl")
        lost = self.json("validate", "fork.swc", "--surface", "less.stl", "--json")
        self.assertEqual(self.counts(lost), [1, 0, 0, 0])
        place = lost["questions"]["lost"][0]
        self.assertAlmostEqual(place["at"][1], -6, delta=2)
        self.assertAlmostEqual(place["at"][2], 28, delta=2)
        false = self.json("validate", "less.swc", "--surface", "fork.stl", "--json")
        self.assertEqual(self.counts(false), [0, 1, 0, 0])
        self.assertEqual(self.counts(self.json("validate", "fork.swc", "--surface", "fork.stl", "--json")), [0, 0, 0, 0])

    def test_a_branch_of_another_width_or_elsewhere(self):
        def bent(scale, shift):
            points = [(0, 0, 0, 1.0, -1)]
            joint = line(points, 1, (0, 0, 0), (0, 0, 20), 20, 1.0)
            line(points, joint, (0, 0, 20), (0, 12, 36), 20, 1.0)
            first = line(points, joint, (0, 0, 20), (shift, -6, 28), 10, scale)
            line(points, first, (shift, -6, 28), (shift, -24, 52), 30, scale)
            return swc(*points)

        self.write("bent.swc", bent(1.0, 0.0))
        for scale in (2.0, 1.3, 0.7):
            self.write("other.swc", bent(scale, 0.0))
            self.expect_done("mesh", "other.swc", "-o", "other.stl")
            found = self.json("validate", "bent.swc", "--surface", "other.stl", "--json")
            self.assertEqual(self.counts(found), [0, 0, 0, 0])
            self.assertEqual(found["questions"]["position"], [])
            [one] = found["questions"]["width"]
            self.assertEqual(one["branch"], 2)
            self.assertAlmostEqual(one["expected_radius_mm"], 1.0, delta=0.01)
            self.assertAlmostEqual(one["radius_mm"], scale, delta=0.04)
        for shift in (0.5, 0.9, 1.3):
            self.write("other.swc", bent(1.0, shift))
            self.expect_done("mesh", "other.swc", "-o", "other.stl")
            found = self.json("validate", "bent.swc", "--surface", "other.stl", "--json")
            self.assertEqual(self.counts(found), [0, 0, 0, 0])
            self.assertEqual(found["questions"]["width"], [])
            [one] = found["questions"]["position"]
            self.assertEqual(one["branch"], 2)
            self.assertAlmostEqual(one["offset_mm"], shift, delta=0.05)
            outside = found["fidelity"]["points_outside_percent"]
            if shift != 0.9:  # there the walls are so near that corners tell
                self.assertEqual(outside > 0, shift > 1)
            self.assertIn("moved branches: 1",
                          self.expect_done("validate", "bent.swc", "--surface", "other.stl").stdout)

    def test_smoothing_does_not_move_the_reference(self):
        # From voxel to voxel around a circle: smoothed, the surface still counts against the steps as they are.
        points, at = [(40, 0, 0, 3.0, -1)], (40, 0)
        while len(points) < 60:
            x, y = at
            at = min(((x - 1, y), (x, y + 1), (x - 1, y + 1)), key=lambda p: abs(math.hypot(*p) - 40))
            points.append((*at, 0, 3.0, len(points)))
        self.write("stairs.swc", swc(*points))
        fidelity = {passes: self.json("validate", "stairs.swc", "--smooth", passes, "--json")["fidelity"]
                    for passes in ("0", "1", "100")}
        for passes, least in (("0", 0.0), ("1", 0.05), ("100", 0.05)):
            self.assertEqual(fidelity[passes]["points_outside"], 0)
            self.assertGreater(fidelity[passes]["axis_offset_mm"]["max"], least)
            self.assertLess(fidelity[passes]["axis_offset_mm"]["max"], 0.75)
        found = self.json("info", "stairs.swc", "--json")["smoothing"]
        self.assertEqual((found["voxel_mm"], found["voxel_from"]), ([1, 1, 1], "points"))
        self.assertLessEqual(self.json("info", "stairs.swc", "--smooth", "100", "--json")["smoothing"]["displacement_mm"]["max"], 0.5 + 1e-9)
        self.assertIn("voxels of 1.00 units (estimated)", self.expect_done("info", "stairs.swc").stdout)

    def test_vessels_that_touch(self):
        self.write("crossing.swc", CROSSING)
        self.assertEqual(self.counts(self.json("validate", "crossing.swc", "--blend", "tree", "--json")), [0, 0, 0, 0])
        apart = self.json("validate", "crossing.swc", "--blend", "tree", "--json")["shape"]
        self.assertEqual(apart, {"components": 2, "loops": 0, "tree": {"components": 2, "loops": 0}})
        grown = self.json("validate", "crossing.swc", "--blend", "paper", "--json")
        self.assertEqual(grown["shape"], {"components": 1, "loops": 0, "tree": {"components": 2, "loops": 0}})
        self.assertIn("hangs together: 1 piece, 0 loops; the tree has 2 pieces, 0 loops",
                      self.run_ramus("validate", "crossing.swc", "--blend", "paper").stdout)
        self.write("open.obj", "v 0 -1 -1\nv 1 -1 1\nv 2 1 1\nf 1 2 3\n")  # has a hole, and with it no loops to count
        self.assertIsNone(self.json("validate", "crossing.swc", "--surface", "open.obj", "--json")["shape"])
        merged = grown["questions"]["merged"]
        self.assertEqual([one["branches"] for one in merged], [[0, 1]])
        self.assertAlmostEqual(merged[0]["gap_mm"], -0.2)
        self.assertAlmostEqual(merged[0]["at"][2], 0.9)

    def test_pruned_branches_are_lost(self):
        self.write("twig.swc", swc((0, 0, 0, 1, -1), (0, 0, 20, 1, 1), (0, 0, 40, 1, 2), (0, 6, 20, 1, 2)))
        found = self.json("validate", "twig.swc", "--prune", "0.5", "--blend", "tree", "--json")
        self.assertEqual([one["branch"] for one in found["questions"]["lost"]], [2])

    def test_a_mask_and_a_report(self):
        size = (9, 9, 14)
        inside = [1 if 3 <= x <= 5 and 3 <= y <= 5 and 2 <= z <= 11 else 0 for x, y, z in voxels(size)]
        self.write("mask.nii", nifti(size, inside, rows=((1, 0, 0, -4), (0, 1, 0, -4), (0, 0, 2, 0))))
        self.write("tree.swc", "1 2 0 0 4 1.5 -1\n2 2 0 0 22 1.5 1\n")
        found = self.json("validate", "tree.swc", "--mask", "mask.nii", "--report", "made/report", "--json")
        self.assertLess(found["distances"]["to_mask"]["mean"], 0.6)
        self.assertAlmostEqual(found["distances"]["to_mask"]["threshold_mm"], 0.5 * 6 ** 0.5)
        report = self.folder / "made" / "report"
        self.assertEqual(sorted(path.name for path in report.iterdir()),
                         sorted([*TEXT_FILES, "volumes.csv", "boxes_from_mask.svg", "boxes_to_cones.svg",
                                 "boxes_to_mask.svg", "index.html"]))
        self.assertEqual(json.loads((report / "validation.json").read_text()), found)
        self.assertLess(found["distances"]["from_mask"]["mean"], 0.6)
        # All 90 voxels of the mask are within the tube, but for the corners of the two slices at its end points: there
        # half of the field is left, and the surface is at sqrt(1 - 1 / 5) = 0.894 radii. Voxels are 2 mm3.
        self.assertAlmostEqual(found["volumes"]["mask_mm3"], 180)
        self.assertAlmostEqual(found["volumes"]["dice"], 2 * 82 / (90 + 82))
        # A tube, and two domes that hold as much as 0.277 radii of it; triangles are chords.
        tube = math.pi * 1.5 ** 2 * (18 + 2 * 0.277 * 1.5)
        self.assertAlmostEqual(found["volumes"]["surface_mm3"] / tube, 0.99, delta=0.015)
        # What scripts know of one tree.
        self.assertEqual(list(found), ["tree", "units", "unit", "surface", "distances", "volumes", "fidelity", "radius_error",
                                       "questions", "shape"])
        self.assertIsNone(found["distances"]["to_cones"]["above_percent"])
        self.assertNotIn("threshold_mm", found["distances"]["to_cones"])
        text = (report / "radii.csv").read_text()
        self.assertTrue(text.startswith("branch,along,x,y,z,input_radius,"))
        rows = rows_of(report / "radii.csv")
        self.assertGreater(len(rows), 20)
        middle = next(row for row in rows if row["alone"] == "yes")
        # A tube of radius 1.5; its mask has 3 x 3 voxels across, cut at half of their height.
        for name in ("input_radius", "surface_radius", "cones_radius"):
            self.assertAlmostEqual(float(middle[name]), 1.5, delta=0.03)
        self.assertAlmostEqual(float(middle["mask_radius"]), 1.6, delta=0.2)
        page = Page((report / "index.html").read_text())
        # From three sides, and coloured by how far it is from cones and from the mask.
        self.assertEqual(len(page.pictures), 5)
        # Box plots and histograms to cones, to the mask and from it, and one branch.
        self.assertEqual(page.count["svg"], 7)
        self.assertIn("mask", page.words)
        # Nobody says that the tree's lengths are mm.
        self.assertIn("Mean, units", page.words)
        self.assertNotIn("Mean, mm", page.words)

    def test_a_mask_in_another_place_is_reported(self):
        size = (9, 9, 14)
        inside = [1 if 3 <= x <= 5 and 3 <= y <= 5 and 2 <= z <= 11 else 0 for x, y, z in voxels(size)]
        self.write("mask.nii", nifti(size, inside, rows=((1, 0, 0, -4), (0, 1, 0, -4), (0, 0, 2, 0))))
        for name, x, told in (("here.swc", 0, False), ("beside.swc", 4, True), ("far.swc", 400, True)):
            with self.subTest(name):
                self.write(name, f"1 2 {x} 0 4 1.5 -1\n2 2 {x} 0 22 1.5 1\n")
                errors = self.expect_done("validate", name, "--mask", "mask.nii", "--json").stderr
                self.assertEqual("mask.nii: the mask does not lie where the vessels do" in errors, told)

    def test_kernels_compared(self):
        self.write("crossing.swc", CROSSING)
        found = self.json("validate", "crossing.swc", "--kernels", "--detail", "8", "--json")
        self.assertEqual(found["graph"], {"pieces": 2, "loops": 0})
        kinds = {(one["kernel"], one["width"]) for one in found["kernels"]}
        self.assertEqual(len(kinds), len(found["kernels"]))
        self.assertEqual({kind for kind, _ in kinds}, {"gaussian", "inverse-square", "inverse-cubic", "cauchy", "polynomial"})
        for one in found["kernels"]:
            self.assertLess(one["joints"]["straight_percent"], 0.1)
            self.assertEqual(one["width"] is None, one["kernel"].startswith("inverse"))
            self.assertEqual((one["pieces"], one["merged"]), (1, 1))  # their tubes overlap
        text = self.expect_done("validate", "crossing.swc", "--kernels", "--detail", "8").stdout
        self.assertIn("inverse-cubic", text)
        self.assertIn("The tree has 2 pieces and 0 loops", text)
        for words in (("--kernel", "cauchy"), ("--width", "3"), ("--report", "folder"), ("--blend", "tree")):
            self.assertEqual(self.run_ramus("validate", "crossing.swc", "--kernels", *words).returncode, 2)

    def test_another_kernel(self):
        gaussian, cubic = (self.json("validate", "fork.swc", "--json", "--kernel", kernel)
                           for kernel in ("gaussian", "inverse-cubic"))
        self.assertGreater(cubic["distances"]["to_cones"]["mean"], gaussian["distances"]["to_cones"]["mean"])
        self.expect_failure("validate", "fork.swc", "--kernel", "inverse-square", says=["inverse-square", "--blend paper"])
        self.expect_done("validate", "fork.swc", "--kernel", "inverse-square", "--blend", "paper")
        for words in (("cubic",), ("inverse-cubic", "--width", "2"), ("polynomial", "--width", "20")):
            self.assertEqual(self.run_ramus("validate", "fork.swc", "--kernel", *words).returncode, 2)

    def test_invalid_inputs_are_refused(self):
        self.expect_failure("validate", "fork.swc", "--surface", "missing.ply", says=["missing.ply"])
        self.expect_failure("validate", "fork.swc", "--mask", "fork.swc", says=["fork.swc"])
        self.write("file", "not a folder")
        self.expect_failure("validate", "fork.swc", "--report", "file", says=["file", "folder"])
        self.assertEqual(self.names(), ["file", "fork.swc"])
        for words in ((), ("fork.swc", "--label", "1"), ("fork.swc", "--mask-units", "cm")):
            self.assertEqual(self.run_ramus("validate", *words).returncode, 2)

    def test_the_report_does_not_replace_inputs(self):
        (self.folder / "report").mkdir()
        for name in ("index.html", "radii.csv"):
            target = self.folder / "report" / name
            target.symlink_to(self.folder / "fork.swc")
            self.expect_failure("validate", "fork.swc", "--report", "report", says=[name, "this run reads it"])
            self.assertTrue(target.is_symlink())
            target.unlink()
        self.assertEqual((self.folder / "fork.swc").read_text(), fork(True))

    def test_a_full_disk_leaves_the_old_report(self):
        (self.folder / "report").mkdir()
        for name in ("index.html", "validation.json"):
            self.write("report/" + name, "old")
        # Small tables fit, the page does not.
        self.expect_failure("validate", "fork.swc", "--report", "report", largest_file=30000, says=["report/", "ulimit -f"])
        self.assertEqual(sorted(path.name for path in (self.folder / "report").iterdir()),
                         ["index.html", "validation.json"])
        self.assertEqual((self.folder / "report" / "validation.json").read_text(), "old")

    def test_a_report_that_cannot_be_written(self):
        (self.folder / "report" / "index.html").mkdir(parents=True)
        self.expect_failure("validate", "fork.swc", "--report", "report", says=["index.html", "is a folder"])
        self.expect_failure("validate", "fork.swc", "--report", "/proc/report", says=["/proc/report", "cannot be made"])

    def test_an_interrupt_leaves_nothing(self):
        self.write("tube.swc", TUBE)
        before = self.names()
        process = subprocess.Popen(
            [RAMUS, "validate", "tube.swc", "tube.swc", "tube.swc", "--detail", "256", "--report", "a/report"],
            cwd=self.folder, stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        while not (self.folder / "a" / "report").exists() and process.poll() is None:
            time.sleep(0.01)
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        out, errors = process.communicate(timeout=120)
        self.assertEqual(out, "")
        self.assertIn(process.returncode, (1, -signal.SIGINT), errors)  # where the machine is busy, it ends by the signal
        if process.returncode == 1:
            self.assertIn("cancelled", errors)
        self.assertEqual(self.names(), before)


if __name__ == "__main__":
    unittest.main()
