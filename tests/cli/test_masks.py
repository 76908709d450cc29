"""Masks on the command line: their surface in every format, what info tells, and what is refused."""

import signal
import struct
import subprocess
import time
import unittest

from nifti import compressed, nifti, voxels
from ply import read_ply, volume_of
from ramus import GOOD, RAMUS, CommandLineTest

SIZE = (12, 9, 8)
# Two bars of 2 x 2 voxels along x, labels 1 and 2, apart.
BARS = [1 if 1 <= x <= 10 and y in (1, 2) and z in (3, 4) else
        2 if 1 <= x <= 5 and y in (5, 6) and z in (3, 4) else 0 for x, y, z in voxels(SIZE)]
ANISOTROPIC = ((-0.5, 0, 0, 7), (0, 0.5, 0, 8), (0, 0, 2, 9))


def block(l, m, n):
    """Volume, in voxels, of the surface of a block that is l, m, n steps long: derived in tests/core/volume/isosurface_test.cpp."""
    return l * m * n + l * m + m * n + n * l + (l + m + n) / 2 + 1 / 6


class Masks(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.mask = self.write("mask.nii.gz", compressed(nifti(SIZE, BARS, rows=ANISOTROPIC)))

    def mesh(self, *arguments):
        return self.json("mesh", "mask.nii.gz", "--method", "iso", "--json", *arguments)

    def test_the_surface_is_in_place_outward_and_without_a_tree(self):
        report = self.mesh("-o", "out.ply")
        self.assertEqual(set(report), {"vertices", "triangles", "components", "units", "unit", "orientation", "streamed", "load_s",
                                       "mesh_s", "write_s"})
        self.assertEqual(report["components"], 2)
        lines, vertices, faces = read_ply(self.folder / "out.ply")
        self.assertEqual((len(vertices), len(faces)), (report["vertices"], report["triangles"]))
        self.assertEqual(report["vertices"] - report["triangles"] / 2, 2 * 2)  # Euler's number
        self.assertIn("property float nz", lines)
        self.assertFalse([line for line in lines if "radius" in line or "branch" in line])
        # The mirrored axis does not turn the surface inside out.
        self.assertAlmostEqual(volume_of(vertices, faces), 0.5 * (block(9, 1, 1) + block(4, 1, 1)), places=3)
        low = [min(v[axis] for v in vertices) for axis in range(3)]
        high = [max(v[axis] for v in vertices) for axis in range(3)]
        self.assertEqual(low, [7 - 0.5 * 10.5, 8 + 0.5 * 0.5, 9 + 2 * 2.5])
        self.assertEqual(high, [7 - 0.5 * 0.5, 8 + 0.5 * 6.5, 9 + 2 * 4.5])

    def test_labels_and_isovalues(self):
        self.assertEqual(self.mesh("-o", "one.ply", "--label", "1")["components"], 1)
        two = self.mesh("-o", "two.ply", "--label", "2")
        self.assertEqual(self.mesh("-o", "both.ply", "--label", "1,2")["components"], 2)
        above = self.mesh("-o", "above.ply", "--isovalue", "1.5")
        self.assertEqual((above["vertices"], above["triangles"]), (two["vertices"], two["triangles"]))

    def test_every_format_of_meshes(self):
        for name in ("a.ply", "a.stl", "a.obj"):
            with self.subTest(name):
                report = self.mesh("-o", name)
                content = (self.folder / name).read_bytes()
                if name.endswith("stl"):
                    self.assertEqual(len(content), 84 + 50 * report["triangles"])
                if name.endswith("obj"):
                    self.assertEqual(content.count(b"\nf "), report["triangles"])

    def test_the_same_file_from_any_number_of_threads(self):
        self.mesh("-o", "a.ply", "--threads", "1")
        self.mesh("-o", "b.ply", "--threads", "4")
        self.assertEqual((self.folder / "a.ply").read_bytes(), (self.folder / "b.ply").read_bytes())

    def test_fractions_are_cut_at_a_half(self):
        ramp = [x / 11 for x, _, _ in voxels(SIZE)]
        self.write("ramp.nii", nifti(SIZE, ramp, "f", order=">"))
        self.expect_done("mesh", "ramp.nii", "-o", "out.ply", "--method", "iso")
        _, vertices, _ = read_ply(self.folder / "out.ply")
        self.assertAlmostEqual(min(v[0] for v in vertices), 5.5, places=5)
        self.expect_done("mesh", "ramp.nii", "-o", "out.ply", "--method", "iso", "--isovalue", "0.25")
        _, vertices, _ = read_ply(self.folder / "out.ply")
        self.assertAlmostEqual(min(v[0] for v in vertices), 2.75, places=5)

    def test_info(self):
        info = self.json("info", "mask.nii.gz", "--json")
        self.assertEqual(info["size"], list(SIZE))
        self.assertEqual(info["spacing_mm"], [0.5, 0.5, 2])
        self.assertEqual(info["orientation"], "LAS")
        self.assertEqual(info["to_patient"], [list(map(float, row)) for row in ANISOTROPIC])
        self.assertEqual(info["type"], "NIfTI-1, uint8")
        self.assertEqual(info["values"], {"min": 0, "max": 2})
        self.assertEqual([(l["label"], l["voxels"]) for l in info["labels"]], [(1, 40), (2, 20)])
        self.assertAlmostEqual(info["labels"][0]["volume_ml"], 40 * 0.5 / 1000)
        self.assertEqual(info["notes"], [])
        text = self.expect_done("info", "mask.nii.gz").stdout
        for words in ("12 x 9 x 8 voxels", "0.5 x 0.5 x 2 mm", "LAS", "label 2", "20 voxels"):
            self.assertIn(words, text)

    def test_the_requested_unit_is_used(self):
        info = self.json("info", "mask.nii.gz", "--json", "--units", "cm")
        self.assertEqual(info["spacing_mm"], [5, 5, 20])
        self.assertEqual(info["origin_mm"], [10 * row[3] for row in ANISOTROPIC])
        self.assertIn("as asked for; the file says mm", info["notes"][0])
        self.mesh("-o", "mm.ply")
        self.mesh("-o", "cm.ply", "--units", "cm")
        _, small, _ = read_ply(self.folder / "mm.ply")
        _, large, _ = read_ply(self.folder / "cm.ply")
        self.assertAlmostEqual(max(v[2] for v in large), 10 * max(v[2] for v in small), places=3)
        self.expect_failure("info", "mask.nii.gz", "--units", "furlong", status=2)

    def test_a_volume_that_is_small_is_suspected(self):
        self.write("small.nii", nifti((256, 1, 1), [0, 1] * 128, units=0, rows=((0.04, 0, 0, 0), (0, 0.04, 0, 0), (0, 0, 0.04, 0))))
        self.assertIn("--units cm", self.json("info", "small.nii", "--json")["suspicions"][0])
        told = self.expect_done("info", "small.nii")
        self.assertEqual((told.stdout.count("--units cm"), told.stderr), (1, ""))
        self.assertIn("--units cm", self.expect_done("mesh", "small.nii", "--method", "iso", "-o", "a.ply").stderr)

    def test_info_reports_assumptions(self):
        self.write("mask.nii", nifti(SIZE, BARS, units=0))
        self.assertEqual(len(self.json("info", "mask.nii", "--json")["notes"]), 1)
        self.assertIn("counts as 1 mm", self.expect_done("info", "mask.nii").stdout)

    def test_a_scan_needs_an_isovalue(self):
        self.write("scan.nii", nifti(SIZE, [100 * x - 500 for x, _, _ in voxels(SIZE)], "h"))
        self.expect_failure("mesh", "scan.nii", "-o", "out.ply", "--method", "iso",
                            says=["scan.nii", "not those of a mask", "--isovalue"])
        self.expect_done("mesh", "scan.nii", "-o", "out.ply", "--method", "iso", "--isovalue", "150")


class Refusals(CommandLineTest):
    def test_masks_instead_of_trees_and_trees_instead_of_masks(self):
        self.write("mask.nii.gz", compressed(nifti(SIZE, BARS)))
        self.write("tree.swc", GOOD)
        for command in (["mesh", "-o", "out.ply"], ["mesh", "-o", "out.ply", "--method", "cones"],
                        ["convert", "-o", "out.json"]):  # its tree is made
            with self.subTest(command):
                self.expect_done(command[0], "mask.nii.gz", *command[1:])
        self.expect_failure("mesh", "tree.swc", "-o", "other.ply", "--method", "iso",
                            says=["tree.swc", "segmentation mask is needed", ".nii"])
        self.expect_failure("info", "mask.nii.gz", "--branches", says=["no branches"])
        self.assertEqual(self.names(), ["mask.nii.gz", "out.json", "out.ply", "tree.swc"])

    def test_options_that_do_not_apply_are_refused(self):
        self.write("mask.nii", nifti(SIZE, BARS))
        self.write("tree.swc", GOOD)
        for options in (["--width", "3"], ["--detail", "8"], ["--smooth", "0"], ["--label", "0"],
                        ["--label", "1,,2"], ["--label", ""], ["--isovalue", "nan"], ["--label", "1", "--isovalue", "1"],
                        ["--session", "none.json"]):
            with self.subTest(options):
                self.expect_failure("mesh", "mask.nii", "-o", "out.ply", "--method", "iso", *options, status=2)
        self.expect_failure("mesh", "tree.swc", "-o", "out.ply", "--label", "1", status=2, says=["--method iso"])

    def test_bad_files(self):
        good = nifti(SIZE, BARS)
        huge = bytearray(good)
        struct.pack_into("<3h", huge, 42, 32767, 32767, 32767)
        cases = {
            "empty": (b"", ["is empty"]),
            "text": (b"This is no volume.\n" * 99, ["no NIfTI file"]),
            "short": (good[:-1], ["more than the file can hold", "copy"]),
            "short, compressed": (compressed(good)[:-30], ["bad.nii"]),
            "a claim": (bytes(huge), ["32767 x 32767 x 32767", "more than the file can hold"]),
            "a compressed claim": (compressed(bytes(huge)), ["more than the file can hold"]),
            "nothing inside": (nifti(SIZE, [0] * len(BARS)), ["nothing is inside"]),
            "infinity": (nifti((2, 1, 1), [0.5, float("inf")], "f"), ["voxel (1, 0, 0)", "not finite"]),
            "NaN": (nifti((2, 1, 1), [float("nan")] * 2, "f"), ["all its values are NaN"]),
            "flat": (nifti(SIZE, BARS, rows=((1, 0, 0, 0), (1, 0, 0, 0), (0, 0, 1, 0))), ["one plane", "sform"]),
        }
        for name, (content, says) in cases.items():
            with self.subTest(name):
                self.write("bad.nii", content)
                self.expect_failure("mesh", "bad.nii", "-o", "out.ply", "--method", "iso", says=["bad.nii", *says])
                if name != "nothing inside":
                    self.expect_failure("info", "bad.nii", says=["bad.nii", *says])
                self.assertEqual(self.names(), ["bad.nii"])
        for name in ("a.nrrd", "a.nhdr", "a.mha", "a.mhd"):
            self.write(name, "NRRD0004\n" if "n" in name else "ObjectType = Image\n")
            self.expect_failure("info", name, says=[name, "header"])
        self.expect_failure("info", "missing.nii", says=["missing.nii", "no such file"])
        self.expect_failure("mesh", "missing.nii", "-o", "out.ply", says=["missing.nii", "no such file"])

    def test_memory_is_limited(self):
        size = (200, 200, 100)
        self.write("mask.nii.gz", compressed(nifti(size, [(x + y + z) % 2 for x, y, z in voxels(size)])))
        self.expect_failure("mesh", "mask.nii.gz", "-o", "out.ply", "--method", "iso", "--memory", "60M",
                            says=["mask.nii.gz", "MB of memory", "--memory"])

    def test_an_interrupt_leaves_the_old_file_or_the_new_one(self):
        size = (200, 200, 60)
        content = nifti(size, [(x ^ y ^ z) & 1 for x, y, z in voxels(size)])
        self.write("mask.nii.gz", compressed(content))
        command = ["mesh", "mask.nii.gz", "-o", "out.ply", "--method", "iso"]
        self.expect_done(*command)
        new = (self.folder / "out.ply").read_bytes()
        for number in (signal.SIGINT, signal.SIGTERM):
            for wait in (0.0, 0.02, 0.05, 0.1, 0.2, 0.4):
                with self.subTest(number=number, wait=wait):
                    old = self.write("out.ply", "what was there before")
                    process = subprocess.Popen([RAMUS, *command], cwd=self.folder, stdout=subprocess.PIPE,
                                               stderr=subprocess.PIPE)
                    time.sleep(wait)
                    process.send_signal(number)
                    process.communicate(timeout=300)
                    self.assertIn(old.read_bytes(), (b"what was there before", new))
                    self.assertEqual(self.names(), ["mask.nii.gz", "out.ply"])


if __name__ == "__main__":
    unittest.main()
