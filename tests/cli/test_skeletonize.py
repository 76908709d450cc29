"""ramus skeletonize: from a mask to a tree file."""

import json
import os
import random
import resource
import subprocess
import unittest

from nifti import nifti as grey_nifti
from ramus import RAMUS, SANITIZER_MEMORY, CommandLineTest


def nifti(size, label_at):
    """The bytes of a NIfTI-1 file with voxels of 1 mm and `label_at(i, j, k)`; None: its header alone."""
    places = [] if label_at is None else [(i, j, k) for k in range(size[2]) for j in range(size[1]) for i in range(size[0])]
    return grey_nifti(size, [label_at(*place) for place in places])


def two_tubes(i, j, k):
    if not 2 <= i < 48:
        return 0
    return 1 if (j - 6) ** 2 + (k - 8) ** 2 <= 16 else 2 if (j - 14) ** 2 + (k - 8) ** 2 <= 16 else 0


class Skeletonize(CommandLineTest):
    def setUp(self):
        super().setUp()
        (self.folder / "mask.nii").write_bytes(nifti((50, 22, 18), two_tubes))

    def test_labels_together_and_apart(self):
        report = self.json("skeletonize", "mask.nii", "-o", "one.json", "--label", "together", "--json")
        self.assertEqual((report["roots"], report["loops"], report["systems"]), (1, 0, []))
        self.assertEqual(report["mask"]["pieces"], 1)
        for words in ((), ("--label", "all"), ("--labels", "apart")):
            report = self.json("skeletonize", "mask.nii", "-o", "two.json", *words, "--json")
            self.assertEqual(report["roots"], 2)
            self.assertEqual([system["name"] for system in report["systems"]], ["label 1", "label 2"])
        self.expect_done("skeletonize", "mask.nii", "-o", "third.swc", "--label", "2")
        info = json.loads(self.expect_done("info", "third.swc", "--json").stdout)
        self.assertEqual((info["branches"], info["loops"]), (1, 0))

    def test_units(self):
        self.expect_done("skeletonize", "mask.nii", "-o", "mm.json", "--label", "1")
        self.expect_done("skeletonize", "mask.nii", "-o", "cm.json", "--label", "1", "--units", "cm")
        radius = [json.loads((self.folder / name).read_text())["points"][0][3] for name in ("mm.json", "cm.json")]
        self.assertAlmostEqual(radius[1], 10 * radius[0], places=6)

    def test_every_command_makes_the_same_tree_of_a_mask(self):
        """Labels apart, the mask's unit and axes, and its notes; in every format that can say so."""
        session = "read-as labels auto\nsave s.ramus.json\n"
        (self.folder / "commands.txt").write_text(session)
        for name, units in (("mask.nii", 2), ("none.nii", 0)):
            mask = bytearray((self.folder / "mask.nii").read_bytes())
            mask[123] = units
            (self.folder / name).write_bytes(mask)
            report = self.json("skeletonize", name, "-o", "made.json", "--json")
            self.expect_done("convert", name, "-o", "converted.json")
            self.assertEqual((self.folder / "made.json").read_bytes(), (self.folder / "converted.json").read_bytes())
            self.expect_done("render", name, "--commands", "commands.txt", "--overwrite", "--size", "64x48")
            self.expect_done("convert", "--session", "s.ramus.json", "-o", "session.json")
            self.assertEqual((self.folder / "made.json").read_bytes(), (self.folder / "session.json").read_bytes())
            topics = [note["topic"] for note in json.loads((self.folder / "made.json").read_text())["notes"]]
            self.assertIn("labels", topics)
            self.assertEqual("mask" in topics, units == 0)
            self.assertEqual([note["topic"] for note in report["notes"] if note["topic"] == "mask"], ["mask"] * (units == 0))
            said = ("mm" if units else "unknown", "RAS")
            for tree in ("made.json", "made.swc", "made.graphml", "made.mrk.json"):
                self.expect_done("skeletonize", name, "-o", tree)
                info = self.json("info", tree, "--json")
                self.assertEqual((info["units"], info["orientation"]), said, tree)

    def test_every_command_that_reads_trees_reads_masks(self):
        self.expect_done("mesh", "mask.nii", "-o", "surface.stl")
        self.expect_done("render", "mask.nii", "-o", "picture.png", "--size", "200x150")

    def test_a_scan_becomes_a_tree_at_an_isovalue(self):
        """Two tubes: one of 300, one of 150, in 10."""
        values = [(10, 300, 150)[two_tubes(i, j, k)] + (i + j) % 3 for k in range(18) for j in range(22) for i in range(50)]
        (self.folder / "scan.nii").write_bytes(grey_nifti((50, 22, 18), values, kind="h"))
        report = json.loads(self.expect_done("skeletonize", "scan.nii", "-o", "bright.json", "--isovalue", "200", "--json").stdout)
        self.assertEqual((report["roots"], report["branches"]), (1, 1))
        self.assertTrue(any("no segmentation" in note["text"] for note in report["notes"]), report["notes"])
        self.expect_done("convert", "scan.nii", "--isovalue", "200", "-o", "again.json")
        self.assertEqual(self.json("info", "again.json", "--json")["length_mm"],
                         self.json("info", "bright.json", "--json")["length_mm"])
        self.expect_done("mesh", "scan.nii", "--method", "iso", "--isovalue", "200", "-o", "iso.ply")
        self.expect_failure("skeletonize", "scan.nii", "-o", "x.json", "--isovalue", "1000", says=("nothing is inside",))
        self.expect_failure("convert", "scan.nii", "--isovalue", "200", "--labels", "1", "-o", "x.json", says=("leave out one",))
        for wrong in (("--isovalue", "much"), ("--isovalue", "200", "--label", "1")):
            self.assertEqual(self.run_ramus("skeletonize", "scan.nii", "-o", "x.json", *wrong).returncode, 2, wrong)

    def test_a_session_without_a_tree_is_drawn_and_has_no_surface(self):
        (self.folder / "s.ramus.json").write_text(json.dumps(
            {"version": 1, "tree": None, "context": [{"path": "mask.nii", "label": 1, "exact": True, "opacity": 1}]}))
        report = self.json("render", "--session", "s.ramus.json", "-o", "one.png", "--size", "200x150", "--json")
        self.assertGreater(report["triangles"], 1000)
        self.assertGreater(report["scale_bar"]["mm"], 0)
        (self.folder / "commands.txt").write_text("view left\nexport picture two.png --size 160x120\n")
        self.expect_done("render", "--session", "s.ramus.json", "--commands", "commands.txt", "--size", "64x64")
        self.assertTrue((self.folder / "two.png").exists())
        self.expect_done("render", "--session", "s.ramus.json", "--sheet", "-o", "four.png", "--size", "400x300")
        for command in ("mesh", "convert"):
            self.expect_failure(command, "--session", "s.ramus.json", "-o", "x.ply" if command == "mesh" else "x.swc",
                                says=("this session has no tree",))
        (self.folder / "commands.txt").write_text("export surface x.ply\n")
        self.expect_failure("render", "--session", "s.ramus.json", "--commands", "commands.txt", says=("no tree to export",))
        self.assertFalse((self.folder / "x.ply").exists())

    def test_options_of_masks_exist_wherever_trees_are_read(self):
        def branches(*arguments):
            self.expect_done("convert", *arguments, "-o", "tree.json")
            return self.json("info", "tree.json", "--json")

        apart, together = branches("mask.nii"), branches("mask.nii", "--labels", "together")
        self.assertEqual((apart["systems"], together["systems"]), (["label 1", "label 2"], []))
        self.assertEqual((apart["roots"], together["roots"]), (2, 1))
        self.assertEqual(branches("mask.nii", "--labels", "2+1")["roots"], 1)
        self.assertEqual(branches("mask.nii", "--labels", "2")["length_mm"], apart["system_list"][1]["length_mm"])
        far = branches("mask.nii", "--root", "47,6,8", "--labels", "1")
        self.expect_done("convert", "mask.nii", "--root", "47,6,8", "--labels", "1", "-o", "far.swc")
        first = next(line for line in (self.folder / "far.swc").read_text().splitlines() if line.split()[-1] == "-1")
        self.assertGreater(float(first.split()[2]), 40)
        self.assertEqual(far["branches"], 1)
        self.expect_failure("convert", "mask.nii", "--islands", "100", "-o", "x.json", says=("lower --islands",))
        for wrong in (("--labels", "1,1+"), ("--root", "1,2"), ("--islands", "-1"), ("--bulge-size", "x")):
            self.assertEqual(self.run_ramus("mesh", "mask.nii", "-o", "x.ply", *wrong).returncode, 2, wrong)
        self.assertEqual(self.run_ramus("mesh", "mask.nii", "--method", "iso", "--fill-holes", "-o", "x.ply").returncode, 2)

    def test_a_session_stores_the_options_of_its_mask(self):
        (self.folder / "commands.txt").write_text("read-as labels together fill-holes on bulge-size 1 root 47,6,8\n"
                                                  "save s.ramus.json\n")
        self.expect_done("render", "mask.nii", "--commands", "commands.txt", "--overwrite", "--size", "64x48")
        session = json.loads((self.folder / "s.ramus.json").read_text())
        self.assertEqual(session["reading"], {"labels": "together", "fill_holes": True, "bulge_size": 1.0,
                                              "root": [47.0, 6.0, 8.0]})
        self.expect_done("convert", "--session", "s.ramus.json", "-o", "tree.json")
        self.assertEqual(self.json("info", "tree.json", "--json")["systems"], [])
        self.expect_done("convert", "--session", "s.ramus.json", "--labels", "apart", "-o", "tree.json")
        self.assertEqual(self.json("info", "tree.json", "--json")["systems"], ["label 1", "label 2"])

    def test_notes_of_noise_are_summed_up(self):
        random.seed(51)
        (self.folder / "noise.nii").write_bytes(nifti((64, 64, 64), lambda i, j, k: int(random.random() < 0.03)))
        result = self.expect_done("skeletonize", "noise.nii", "-o", "noise.json")
        self.assertLess(result.stderr.count("\n"), 12)
        pieces = next(line for line in result.stderr.splitlines() if "connected with nothing else" in line)
        self.assertRegex(pieces, r", and 99 more like it \(the first at .*;.*;.*;.*;.*\)")
        self.assertRegex(result.stderr, r"the first 100 of \d+ such places \(pieces\) are listed")
        report = self.json("skeletonize", "noise.nii", "-o", "noise.json", "--json")
        notes = {(note["kind"], note["topic"]): note for note in report["notes"] if note["at"]}
        self.assertEqual((notes["suspect", "pieces"]["count"], len(notes["suspect", "pieces"]["at"])), (100, 5))
        self.assertLess(len(report["notes"]), 20)
        total = next(note["text"] for note in report["notes"] if "such places (pieces)" in note["text"])
        self.assertEqual(int(total.split()[4]), report["roots"] - 1)

    def test_noise_does_not_take_quadratic_time(self):
        """Eight times the voxels take eight times as long, not 64 times."""
        seconds = []
        for side in (48, 96):
            random.seed(51)
            voxels = bytes(random.random() < 0.2 for _ in range(side**3))
            (self.folder / "noise.nii").write_bytes(nifti((side,) * 3, None) + voxels)
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            self.expect_done("skeletonize", "noise.nii", "-o", "noise.json")
            seconds.append(resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before)
        self.assertLess(seconds[1], 20 * seconds[0])

    def test_a_sparse_mask_needs_memory_for_its_voxels_only(self):
        """One bit for each voxel of this volume would take 134 MB, four times."""
        side = 1024
        head = nifti((side,) * 3, None)
        with open(self.folder / "large.nii", "wb") as file:
            file.write(head)
            file.truncate(len(head) + side**3)
            for n in range(200):  # a thread across the volume, aslant
                for row in range(5 * n, 5 * n + 5):
                    for across in range(9):
                        file.seek(len(head) + 1 + n * 5 + side * (row + 2 + across % 3 + side * (row + across // 3)))
                        file.write(b"\1" * 7)
        report = self.json("skeletonize", "large.nii", "-o", "tree.json", "--memory", "200M", "--json")
        self.assertEqual((report["roots"], report["loops"], report["branches"]), (1, 0, 1))
        self.assertGreater(report["length_mm"], 1400)
        process = subprocess.Popen([RAMUS, "skeletonize", "large.nii", "-o", "tree.json"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        _, process.returncode, usage = os.wait4(process.pid, 0)
        self.assertEqual(process.returncode, 0)
        self.assertLess(usage.ru_maxrss * 1024, (150 << 20) + SANITIZER_MEMORY)
        self.expect_failure("skeletonize", "large.nii", "-o", "tree.json", "--memory", "10M", says=("--memory",))

    def test_a_mask_with_many_voxels_inside_is_thinned_on_the_disk(self):
        """Two million voxels in 256 tubes, which take 100 MB while they are thinned."""
        inside = [(j % 16 - 8) ** 2 + (k % 16 - 8) ** 2 <= 16 for k in range(256) for j in range(256)]
        self.write("tubes.nii", nifti((160, 256, 256), None) + b"".join(bytes((within,)) * 160 for within in inside))
        self.expect_done("skeletonize", "tubes.nii", "-o", "memory.json")
        most = (110 << 20) + SANITIZER_MEMORY
        with subprocess.Popen([RAMUS, "skeletonize", "tubes.nii", "-o", "disk.json", "--memory", f"{most >> 20}M"], cwd=self.folder,
                              stdout=subprocess.DEVNULL) as process:
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(process.returncode, 0)
        self.assertLess(usage.ru_maxrss * 1024, most)
        self.assertEqual((self.folder / "disk.json").read_bytes(), (self.folder / "memory.json").read_bytes())
        self.assertEqual(self.json("info", "disk.json", "--json")["branches"], 256)
        self.expect_failure("skeletonize", "tubes.nii", "-o", "t.json", "--memory", f"{most >> 20}M", largest_file=1 << 20,
                            says=("tubes.nii: this needs", "on the disk of", "ulimit -f"))

    def test_errors_are_reported(self):
        self.expect_failure("skeletonize", "mask.nii", "-o", "t.json", "--label", "7", says=("no voxel has label 7",))
        self.expect_failure("skeletonize", "mask.nii", "-o", "t.xyz", says=("t.xyz",))
        self.expect_failure("skeletonize", "mask.nii", "-o", "t.json", "--islands", "100", says=("lower --islands",))
        self.expect_failure("skeletonize", "nothing.nii", "-o", "t.json", says=("nothing.nii",))
        (self.folder / "scan.nii").write_bytes(nifti((50, 22, 18), lambda i, j, k: (i * j + k) % 251))
        self.expect_failure("skeletonize", "scan.nii", "-o", "t.json", says=("looks like a scan", "--label"))
        self.assertFalse((self.folder / "t.json").exists())


if __name__ == "__main__":
    unittest.main()
