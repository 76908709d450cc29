"""`ramus cohort`: a small cohort with a broken case, whatever the number of cores, after a kill, after changes."""

import csv
import json
import os
import pathlib
import shutil
import signal
import subprocess
import time
import unittest

from nifti import compressed, nifti, voxels
from ramus import GOOD, RAMUS, SANITIZER_MEMORY, CommandLineTest

# Letters that shells, Snakemake, CSV and HTML read in their own ways.
HOSTILE = ["a blank.swc", "-dash.swc", "q'uo\"te.swc", "co,mma.swc", "{case}.swc", "<b>ä&.swc"]
TABLES = ["cases.csv", "branches.csv", "statistics.csv", "failed.csv"]


def tree(lean):
    """A stem with two branches, one of which leans as far as this."""
    return GOOD.replace("4 2 3 0", f"4 2 {lean} 0")


def mask():
    """A vessel along z that forks; voxels of 1 mm."""
    def inside(x, y, z):
        side = 0 if z < 20 else 0.5 * (z - 20)
        return min((x - 15 - side) ** 2, (x - 15 + side) ** 2) + (y - 8) ** 2 <= 6 and 2 <= z < 38

    size = (30, 16, 40)
    return compressed(nifti(size, [int(inside(*at)) for at in voxels(size)]))


@unittest.skipIf(shutil.which("snakemake") is None, "SKIPPED: snakemake is not installed")
@unittest.skipIf(SANITIZER_MEMORY > 0, "SKIPPED: a build with sanitizers takes many times as long")
class Cohort(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.cases = self.folder / "in"
        (self.cases / "below").mkdir(parents=True)
        for lean in (2, 3):
            (self.cases / "below" / f"lean{lean}.swc").write_text(tree(lean))

    def cohort(self, out, *options, status=0, timeout=600):
        result = subprocess.run([RAMUS, "cohort", "in", "-o", out, "--size", "96x64", *options], cwd=self.folder,
                                capture_output=True, text=True, timeout=timeout)
        self.assertEqual(result.returncode, status, result.stderr)
        return result

    def tables(self, out):
        return {name: (self.folder / out / "tables" / name).read_bytes() for name in TABLES}

    def rows(self, out, name):
        with open(self.folder / out / "tables" / name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def times(self, out):
        """When each record was written."""
        return {str(path.relative_to(self.folder / out)): path.stat().st_mtime_ns
                for path in (self.folder / out / "cases").glob("*/*.json")}

    def test_failures_and_repeats(self):
        (self.cases / "mask.nii.gz").write_bytes(mask())
        (self.cases / "mask.json").write_text('{"Modality": "MR"}')  # a description beside a mask is no case
        (self.cases / "empty.nii.gz").write_bytes(compressed(nifti((8, 8, 8), [0] * 512)))
        (self.cases / "broken.swc").write_text(GOOD[:60])
        (self.cases / "notes.txt").write_text("no tree")
        before = sorted(self.cases.rglob("*"))
        done = self.cohort("two", "--cores", "2", "--json", status=1)
        report = json.loads(done.stdout)
        self.assertEqual((report["cases"], report["done"]), (5, 3))
        self.assertEqual([one["path"] for one in report["skipped"]], ["mask.json", "notes.txt"])
        failed = {one["case"]: one for one in report["failed"]}
        self.assertEqual(sorted(failed), ["broken", "empty"])
        # The message is that of ramus, and the command repeats it.
        for one in failed.values():
            again = subprocess.run(one["command"], shell=True, cwd=self.folder / "two", capture_output=True, text=True)
            self.assertEqual(again.returncode, 1)
            self.assertIn(one["message"], again.stderr)
            self.assertIn(one["message"], done.stderr)
        self.assertEqual(sorted(self.cases.rglob("*")), before)  # only read

        rows = self.rows("two", "cases.csv")
        self.assertEqual([row["case"] for row in rows], ["below/lean2", "below/lean3", "broken", "empty", "mask"])
        self.assertEqual([row["branches"] for row in rows], ["3", "3", "", "", "3"])
        self.assertGreater(float(rows[4]["dice"]), 0.8)
        self.assertEqual(len(self.rows("two", "branches.csv")), 9)
        branches = next(row for row in self.rows("two", "statistics.csv") if row["quantity"] == "branches")
        self.assertEqual((branches["n"], branches["mean"], branches["standard_deviation"]), ("3", "3", "0"))
        page = (self.folder / "two" / "index.html").read_text(encoding="utf-8")
        self.assertIn("cases/mask/picture.png", page)
        self.assertIn("below/lean2", page)
        self.assertIn("expected", page)  # the message of the broken tree

        # One core: the same bytes. A second run does nothing, and still names what failed.
        self.cohort("one", "--cores", "1", status=1)
        self.assertEqual(self.tables("one"), self.tables("two"))
        times = self.times("two")
        self.assertIn("broken", self.cohort("two", status=1).stderr)
        self.assertEqual(self.times("two"), times)
        # Asked for, the failed cases are tried again, and no others.
        self.cohort("two", "--retry", status=1)
        changed = {path.split("/")[1] for path, at in self.times("two").items() if at != times[path]}
        self.assertEqual(changed, {"broken", "empty"})

    def test_changes(self):
        self.cohort("out")
        times = self.times("out")
        # Another date is no change; other bytes are, of that case alone, whatever their date.
        os.utime(self.cases / "below" / "lean2.swc")
        file = self.cases / "below" / "lean3.swc"
        old = file.stat()
        file.write_text(tree(4))
        os.utime(file, ns=(old.st_atime_ns, old.st_mtime_ns - 10**12))  # older than the results
        plan = self.json("cohort", "in", "-o", "out", "--size", "96x64", "--dry-run", "--json")
        self.assertEqual(plan["steps"], 6)  # three of the case, tables, page, and the target of all
        self.assertEqual(self.times("out"), times)
        self.cohort("out")
        changed = {path.split("/")[1] for path, at in self.times("out").items() if at != times[path]}
        self.assertEqual(len(changed), 1)
        self.assertTrue(changed.pop().startswith("below_lean3"))
        # Other options concern the steps that have them. A case that is gone leaves the tables.
        times = self.times("out")
        file.unlink()
        self.cohort("out", "--detail", "8")
        changed = [path.split("/")[1:] for path, at in self.times("out").items() if at != times[path]]
        self.assertEqual({step for _, step in changed}, {"validate.json", "picture.json"})
        self.assertTrue(all(case.startswith("below_lean2") for case, _ in changed))
        self.assertEqual([row["case"] for row in self.rows("out", "cases.csv")], ["below/lean2"])

    def test_hostile_names(self):
        for name in HOSTILE:
            (self.cases / name).write_text(GOOD)
        (self.cases / "line\nfeed.swc").write_text(GOOD)
        report = json.loads(self.cohort("out", "--json").stdout)
        self.assertEqual((report["cases"], report["done"]), (2 + len(HOSTILE), 2 + len(HOSTILE)))
        self.assertIn("control characters", report["skipped"][0]["reason"])
        names = [row["case"] for row in self.rows("out", "cases.csv")]
        self.assertEqual([name.removeprefix("'") for name in names],
                         sorted([name.removesuffix(".swc") for name in HOSTILE] + ["below/lean2", "below/lean3"]))
        page = (self.folder / "out" / "index.html").read_text(encoding="utf-8")
        self.assertIn("&lt;b&gt;ä&amp;", page)
        self.assertNotIn("<b>ä", page)

    def started(self):
        """A run that has begun with a case, and its process."""
        run = subprocess.Popen([RAMUS, "cohort", "in", "-o", "ended", "--size", "96x64", "--cores", "2"], cwd=self.folder,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until = time.monotonic() + 100
        while run.poll() is None and not is_at_work(run.pid) and time.monotonic() < until:
            time.sleep(0.02)
        self.assertIsNone(run.poll(), "it ended too early")
        return run

    def test_ended_early(self):
        self.cohort("whole")
        # An interrupt ends ramus, snakemake and all steps.
        run = self.started()
        workers = descendants(run.pid)
        run.send_signal(signal.SIGINT)
        run.wait(timeout=30)
        self.assertNotEqual(run.returncode, 0)
        until = time.monotonic() + 20
        while any(map(is_alive, workers)) and time.monotonic() < until:
            time.sleep(0.05)
        self.assertEqual([process for process in workers if is_alive(process)], [])
        # A kill of everything at once leaves the lock of snakemake behind.
        run = self.started()
        self.assertIn("another run", self.cohort("ended", status=1).stderr)
        for process in [run.pid, *descendants(run.pid)]:
            if is_alive(process):
                os.kill(process, signal.SIGKILL)
        run.wait()
        self.assertTrue(list((self.folder / "ended" / ".snakemake" / "locks").iterdir()))
        self.assertFalse((self.folder / "ended" / "index.html").exists())
        self.cohort("ended")
        self.assertEqual(self.tables("ended"), self.tables("whole"))

    def test_refusals(self):
        self.expect_failure("cohort", "none", "-o", "out", says=["none", "folder"])
        self.expect_failure("cohort", "in", "-o", "in/out", says=["only read"])
        self.expect_failure("cohort", "in", "-o", "out", "--profile", "moon", says=["config.yaml"])
        (self.cases / "below" / "lean2.json").write_text('{"points": []}')
        self.expect_done("convert", "in/below/lean2.swc", "-o", "in/below/lean2.json")
        self.expect_failure("cohort", "in", "-o", "out", says=["two files are the same case", "lean2.swc", "lean2.json"])
        (self.folder / "bare").mkdir()
        self.expect_failure("cohort", "bare", "-o", "out", says=["no vessel tree and no mask"])
        self.assertFalse((self.folder / "out").exists())


class WithoutSnakemake(CommandLineTest):
    def test_it_says_what_to_install(self):
        (self.folder / "in").mkdir()
        (self.folder / "in" / "tree.swc").write_text(GOOD)
        result = subprocess.run([RAMUS, "cohort", "in", "-o", "out"], cwd=self.folder, capture_output=True, text=True,
                                env=os.environ | {"PATH": "/nowhere"})
        self.assertEqual(result.returncode, 1)
        self.assertIn("apt install snakemake", result.stderr)
        self.assertTrue((self.folder / "out" / "config.json").exists())  # to run it elsewhere


def is_alive(process):
    try:
        with open(f"/proc/{process}/stat", encoding="utf-8", errors="replace") as file:
            return file.read().rsplit(")", 1)[1].split()[0] not in "ZX"
    except OSError:
        return False


def is_at_work(process):
    """Whether a step runs below this process."""
    for one in descendants(process):
        try:
            if b"case_step.py" in pathlib.Path(f"/proc/{one}/cmdline").read_bytes():
                return True
        except OSError:
            pass  # it has ended
    return False


def descendants(process):
    """The processes below this one, whatever their sessions."""
    parents = {}
    for name in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{name}/stat", encoding="utf-8", errors="replace") as file:
                parents[int(name)] = int(file.read().rsplit(")", 1)[1].split()[1])
        except OSError:
            continue
    found = [process]
    for one in found:
        found += [child for child, parent in parents.items() if parent == one]
    return found[1:]


if __name__ == "__main__":
    if shutil.which("snakemake") is None:
        print("SKIPPED: snakemake is not installed: scripts/setup --cohorts")
    unittest.main()
