"""The first TERM or INT ends any command, whatever it does, with nothing half written: no file, folder or process is left.

By hand, with what is said in the text: RAMUS_MOMENTS=100 RAMUS_SECONDS=1 test_signals.py
"""

import os
import random
import signal
import subprocess
import time
import unittest

from nifti import nifti, voxels
from ramus import GOOD, RAMUS, SANITIZER_MEMORY, CommandLineTest

MOMENTS = int(os.environ.get("RAMUS_MOMENTS", "1"))  # for each command and signal
SECONDS = float(os.environ.get("RAMUS_SECONDS", "5"))  # machines that test have other work

# What it is given, and whether it would go on for ever.
COMMANDS = {
    "grow": (["grow", "-o", "grown.swc", "--branches", "800"], False),
    "info": (["info", "tree.swc", "--contacts"], False),
    "convert": (["convert", "tree.swc", "-o", "pair.csv"], False),
    "mesh": (["mesh", "tree.swc", "-o", "a.stl", "--detail", "24"], False),
    "mesh of a mask": (["mesh", "mask.nii", "-o", "a.ply"], False),
    "skeletonize": (["skeletonize", "plane.nii", "-o", "plane.swc"], False),
    "territories": (["territories", "tree.swc", "--organ", "organ.nii", "-o", "labels.nii.gz"], False),
    "resect": (["resect", "--tree", "tree.swc", "--organ", "organ.nii", "--plane", "0,0,5,1,0,1", "-o", "parts.nii.gz"], False),
    "render": (["render", "tree.swc", "-o", "a.png", "--size", "500x400"], False),
    "turntable": (["render", "small.swc", "-o", "turn.png", "--turntable", "8", "--size", "200x150"], False),
    "standard output": (["render", "tree.swc", "-o", "-", "--size", "300x200"], False),
    "validate": (["validate", "tree.swc", "--mask", "mask.nii"], False),
    "report": (["validate", "small.swc", "--report", "new/report"], False),
    "kernels": (["validate", "small.swc", "--kernels"], False),
    "study": (["study", "small.swc", "-o", "new/study", "--size", "100x80"], False),
    "paper": (["paper", "-o", "new/paper", "--tree", "small.swc", "--figures", "2,5,12"], False),
    "compare": (["compare", "large.obj", "large.obj"], False),
    "ratings": (["ratings", "key.json", "/dev/stdin"], True),
    "a session that names a FIFO": (["render", "--session", "fifo.ramus.json", "-o", "a.png"], True),
    "a FIFO": (["info", "ff"], True),
    "standard input": (["info", "-"], True),
}


def processes_of(session):
    """Those whose session is this one."""
    found = []
    for name in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{name}/stat", encoding="utf-8", errors="replace") as file:
                fields = file.read().rsplit(")", 1)[1].split()
        except OSError:
            continue  # it has ended
        if int(fields[3]) == session and fields[0] not in "ZX":
            found.append(int(name))
    return found


def mask(size, inside):
    return nifti(size, [int(inside(x, y, z)) for x, y, z in voxels(size)])


@unittest.skipIf(SANITIZER_MEMORY > 0, "SKIPPED: a build with sanitizers takes many times as long")
class Signals(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("small.swc", GOOD)
        self.expect_done("grow", "-o", "tree.swc", "--branches", "200")
        self.write("mask.nii", mask((60, 60, 60), lambda x, y, z: (x - 30) ** 2 + (y - 30) ** 2 < 64))
        # Around the tree, with voxels of 1.5 mm.
        middle, far = (5, 3, 2), 90
        self.write("organ.nii", nifti((120, 120, 120), [1] * 120 ** 3,
                                      rows=tuple((1.5 * (k == 0), 1.5 * (k == 1), 1.5 * (k == 2), middle[k] - far) for k in range(3))))
        self.write("plane.nii", mask((400, 400, 3), lambda x, y, z: True))
        self.expect_done("mesh", "small.swc", "-o", "large.obj", "--detail", "64")
        self.write("key.json", "{}")
        self.write("fifo.ramus.json", '{"version": 1, "tree": {"path": "ff"}}')
        os.mkfifo(self.folder / "ff")
        (self.folder / "temporary").mkdir()
        self.environment = os.environ | {"TMPDIR": str(self.folder / "temporary")}

    def start(self, words):
        return subprocess.Popen([RAMUS, *words], cwd=self.folder, env=self.environment, stdin=subprocess.PIPE,
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True)

    def everything(self):
        return sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*"))

    def remove_new(self, before):
        for name in reversed(sorted(set(self.everything()) - set(before))):
            path = self.folder / name
            path.rmdir() if path.is_dir() else path.unlink()

    def lasts(self, words, endless):
        """How long it takes to its end, and what it leaves there."""
        if endless:
            return 0.6, None
        begun = time.monotonic()
        process = self.start(words)
        _, errors = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 0, errors)
        return time.monotonic() - begun, self.everything()

    def end_at(self, words, moment, number):
        """The status, and how long after the signal the process is gone."""
        process = self.start(words)
        time.sleep(moment)
        sent = time.monotonic()
        process.send_signal(number)
        process.wait(timeout=60)
        took = time.monotonic() - sent
        for end in (process.stdin, process.stderr):
            end.close()
        return process, took

    def test_each_command_ends_and_leaves_nothing(self):
        chosen = random.Random(7)
        before = self.everything()
        slowest = 0.0
        for name, (words, endless) in COMMANDS.items():
            seconds, complete = self.lasts(words, endless)
            self.remove_new(before)
            for number in [signal.SIGTERM, signal.SIGINT] * MOMENTS:
                moment = chosen.uniform(0.0, seconds)
                with self.subTest(name, signal=number.name, moment=moment):
                    process, took = self.end_at(words, moment, number)
                    slowest = max(slowest, took)
                    self.assertLess(took, SECONDS)
                    # Done all the same, refused with a word, or ended by the signal.
                    self.assertIn(process.returncode, (0, 1, -number))
                    gone = time.monotonic() + 1.0
                    while processes_of(process.pid) and time.monotonic() < gone:
                        time.sleep(0.01)
                    self.assertEqual(processes_of(process.pid), [])
                    left = self.everything()
                    if process.returncode == 1 or left != complete:
                        self.assertEqual(left, before)
                self.remove_new(before)
        print(f"slowest end: {slowest:.2f} s")


if __name__ == "__main__":
    unittest.main()
