"""`ramus info` of several files: blocks, one JSON object, or a table with a row for each file."""

import csv
import io
import json
import struct
import subprocess
import sys
import unittest

from nifti import nifti, voxels
from ramus import GOOD, RAMUS, CommandLineTest

MM = "# id type x y z radius parent (mm, RAS)\n"


class InfoFiles(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("a.swc", GOOD)
        self.write("mm.swc", MM + GOOD)
        self.write("bad.swc", GOOD.replace("0.9 2", "oops 2"))
        size = (4, 4, 4)
        self.write("mask.nii", nifti(size, [1 for _ in voxels(size)]))

    def test_facts_of_a_scan(self):
        self.write("ct.nrrd", b"NRRD0004\ntype: int16\ndimension: 3\nsizes: 2 1 1\nendian: little\nencoding: raw\n"
                              b"sample units: HU\n\n" + struct.pack("<2h", -1000, 400))
        window = bytearray(nifti((4, 4, 4), [1] * 64))
        window[124:132] = struct.pack("<2f", 240, -160)  # cal_max and cal_min of nifti1.h
        self.write("window.nii", bytes(window))
        self.assertIn("-1000 to 400 HU\n", self.expect_done("info", "ct.nrrd").stdout)
        self.assertIn("40, 400 wide\n", self.expect_done("info", "window.nii").stdout)
        self.assertEqual(self.json("info", "ct.nrrd", "--json")["values"], {"min": -1000, "max": 400, "unit": "HU"})
        self.assertEqual(self.json("info", "window.nii", "--json")["window"], {"centre": 40, "width": 400})
        plain = self.json("info", "mask.nii", "--json")
        self.assertEqual(plain["values"], {"min": 1, "max": 1})
        self.assertFalse({"window", "modality"} & set(plain))

    def test_blocks_of_text(self):
        result = self.run_ramus("info", "a.swc", "bad.swc", "mask.nii")
        self.assertEqual(result.returncode, 1)
        blocks = result.stdout.split("\n\n")
        self.assertEqual([block.splitlines()[0] for block in blocks], ["a.swc", "mask.nii"])
        self.assertEqual(blocks[0] + "\n", self.expect_done("info", "a.swc").stdout)
        self.assertEqual(result.stderr.count("\n"), 1)
        self.assertIn("bad.swc:3: the radius", result.stderr)
        self.expect_done("info", "a.swc", "mask.nii")

    def test_one_json_object(self):
        one = self.json("info", "mm.swc", "--json")
        self.assertNotIn("files", one)
        result = self.run_ramus("info", "mm.swc", "missing.swc", "mask.nii", "a.swc", "--json")
        self.assertEqual(result.returncode, 1)
        files = json.loads(result.stdout)["files"]
        self.assertEqual([each["file"] for each in files], ["mm.swc", "missing.swc", "mask.nii", "a.swc"])
        self.assertEqual({key: value for key, value in files[0].items() if key != "file"}, one)
        self.assertIn("no such file", files[1]["error"])
        self.assertEqual(files[2]["size"], [4, 4, 4])
        self.assertEqual([each.get("unit") for each in files], ["mm", None, "mm", "unknown"])
        self.expect_failure("info", "missing.swc", "--json", says=["no such file"])
        self.assertEqual(len(self.json("info", "a.swc", "a.swc", "--branches", "--json")["files"][1]["branch_list"]), 3)

    def test_a_table(self):
        result = self.run_ramus("info", "mm.swc", "bad.swc", "mask.nii", "a.swc", "--csv")
        self.assertEqual(result.returncode, 1)
        rows = list(csv.DictReader(io.StringIO(result.stdout)))
        self.assertEqual([row["file"] for row in rows], ["mm.swc", "bad.swc", "mask.nii", "a.swc"])
        self.assertEqual([row["kind"] for row in rows], ["tree", "", "volume", "tree"])
        self.assertEqual([row["unit"] for row in rows], ["mm", "", "", "unknown"])
        found = self.json("info", "mm.swc", "--json")
        for name in ("branches", "segments", "loops", "length", "volume"):
            self.assertAlmostEqual(float(rows[0][name]), found[name], delta=1e-6 * max(1, found[name]))
        self.assertAlmostEqual(float(rows[0]["radius_mean"]), found["radius"]["mean"], places=6)
        self.assertIn("bad.swc:3", rows[1]["error"])
        self.assertEqual([bool(row["error"]) for row in rows], [False, True, False, False])
        alone = self.run_ramus("info", "bad.swc", "--csv")
        self.assertEqual((alone.returncode, alone.stdout.count("\n")), (1, 2))
        for other in ("--json", "--branches", "--contacts"):
            self.expect_failure("info", "a.swc", "--csv", other, status=2)

    def test_many_files_need_the_memory_of_one_file(self):
        """As much of 120 trees as of three; and what is told comes before the last file is read."""
        big = "1 2 0 0 0 1 -1\n" + "".join(f"{i} 2 0 0 {i / 10} 1 {i - 1}\n" for i in range(2, 20_000))
        names = [self.write(f"tree{n:03}.swc", big).name for n in range(120)]
        peaks = []
        for count in (3, 120):
            script = ("import resource, subprocess, sys\n"
                      "subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, check=True)\n"
                      "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)\n")
            done = subprocess.run([sys.executable, "-c", script, RAMUS, "info", *names[:count], "--csv"], cwd=self.folder,
                                  capture_output=True, text=True, check=True, timeout=300)
            peaks.append(int(done.stdout))
        self.assertLess(peaks[1], 1.2 * peaks[0], peaks)


if __name__ == "__main__":
    unittest.main()
