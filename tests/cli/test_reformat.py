"""ramus reformat: pictures along a vessel and its cross-sections, against phantoms with known values."""

import csv
import io
import json
import math
import unittest

from nifti import nifti, voxels
from png import Picture
from ramus import CommandLineTest

SIZE = (40, 40, 60)
AXIS = (20.0, 19.0)
RADIUS = 4.0
TREE = f"1 3 {AXIS[0]} {AXIS[1]} 4 {RADIUS} -1\n2 3 {AXIS[0]} {AXIS[1]} 54 {RADIUS} 1\n"
WAIST = "" + "".join(
    f"{n} 3 20 19 {z} {r} {n - 1 if n > 1 else -1}\n"
    for n, (z, r) in enumerate(((4, 4), (24, 4), (29, 2), (34, 4), (54, 4)), 1))
FORK = ("1 3 20 19 4 3 -1\n2 3 20 19 30 3 1\n3 3 30 19 54 2 2\n4 3 10 19 54 2 2\n")


def value(x, y, z):
    """Linear, so that trilinear interpolation is exact."""
    return 100 + 8 * (x - AXIS[0]) + 0.5 * (z - 30)


def grey(at):
    return round(255 * min(max(value(*at) / 200, 0), 1))


class Reformat(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("tree.swc", TREE)
        self.write("scan.nii", nifti(SIZE, [value(*v) for v in voxels(SIZE)], kind="f"))

    def reformat(self, *words, tree="tree.swc"):
        return self.json("reformat", tree, "--units", "mm", "--json", *words)

    def picture(self, name):
        return Picture((self.folder / name).read_bytes())

    def rows(self, text):
        return list(csv.DictReader(io.StringIO(text)))

    def check_greys(self, picture, report, across, rows):
        """Pixels away from the walls have the values of their places."""
        left, top = report["picture"]["corner"]
        columns = report["picture"]["size"][0]
        step = report["picture"]["pixel_mm"]
        checked = 0
        for row in rows:
            at = report["sections"][row]["at"]
            for column in range(columns):
                off = (column - columns // 2) * step
                if abs(abs(off) - RADIUS) < 3 * step:
                    continue
                shown = picture.pixel(left + column, top + row)
                place = [a + off * d for a, d in zip(at, across)]
                self.assertEqual(shown[0], shown[1])
                self.assertEqual(shown[0], shown[2])
                self.assertLessEqual(abs(shown[0] - grey(place)), 1, (row, column))
                checked += 1
        self.assertGreater(checked, 100)

    def check_walls(self, picture, report, row):
        """Coloured pixels are the walls, at the radius."""
        left, top = report["picture"]["corner"]
        columns, step = report["picture"]["size"][0], report["picture"]["pixel_mm"]
        weights = {-1: [], 1: []}
        for column in range(columns):
            shown = picture.pixel(left + column, top + row)
            colour = max(shown) - min(shown)
            if colour > 3:
                weights[-1 if column < columns // 2 else 1].append((colour, (column - columns // 2) * step))
        for side, found in weights.items():
            middle = sum(w * off for w, off in found) / sum(w for w, _ in found)
            self.assertAlmostEqual(side * middle, RADIUS, delta=0.3)

    def test_straightened_pictures_show_the_values_of_the_scan_and_the_walls(self):
        for angle, across in ((0, (-1, 0, 0)), (90, (0, -1, 0)), (180, (1, 0, 0))):
            with self.subTest(angle=angle):
                report = self.reformat("--scan", "scan.nii", "--path", "0", "-o", "out.png", "--angle", angle, "--across",
                                       24, "--window", "200,100")
                picture = self.picture("out.png")
                self.assertEqual([picture.width, picture.height],
                                 [report["picture"]["width"], report["picture"]["height"]])
                self.assertEqual(report["picture"]["size"], [49, 101])
                self.assertAlmostEqual(report["picture"]["pixel_mm"], 0.5)
                self.assertAlmostEqual(report["length_mm"], 50)
                self.assertEqual(report["picture"]["window"], {"width": 200, "level": 100})
                self.check_greys(picture, report, across, range(5, 95, 10))
                for row in (20, 50, 80):
                    self.check_walls(picture, report, row)

    def test_a_stretched_picture_of_a_straight_vessel_is_the_straightened_one(self):
        report = self.reformat("--scan", "scan.nii", "--path", "0", "-o", "out.png", "--kind", "stretched", "--across", 24,
                               "--window", "200,100")
        self.assertEqual(report["picture"]["size"], [49, 101])
        self.check_greys(self.picture("out.png"), report, (-1, 0, 0), range(5, 95, 10))
        self.check_walls(self.picture("out.png"), report, 40)

    def test_stretched_lengths_are_those_of_the_path(self):
        self.write("fork.swc", FORK)
        report = self.reformat("--scan", "scan.nii", "--path", "root..2", "-o", "out.png", "--kind", "stretched",
                               tree="fork.swc")
        length = 26 + math.hypot(10, 24)
        self.assertAlmostEqual(report["length_mm"], length, delta=0.1)
        # The way lies in a plane, and the vector of interest is at right angles to its main direction.
        self.assertAlmostEqual(report["picture"]["size"][1] * report["picture"]["pixel_mm"], length, delta=3)

    def test_tables_have_the_cross_sections(self):
        self.write("mask.nii", nifti(SIZE, [int(math.dist((x, y), AXIS) < RADIUS and 2 < z < 57)
                                            for x, y, z in voxels(SIZE)]))
        self.expect_done("reformat", "tree.swc", "--units", "mm", "--path", "0", "-o", "out.csv", "--step", 0.5, "--mask",
                         "mask.nii")
        rows = self.rows((self.folder / "out.csv").read_text())
        self.assertEqual(len(rows), 101)
        self.assertEqual(list(rows[0])[:9],
                         ["arc", "branch", "fraction", "x", "y", "z", "normal_x", "normal_y", "normal_z"])
        in_slice = sum(math.dist((x, y), AXIS) < RADIUS for x, y, z in voxels(SIZE) if z == 30)
        for n, row in enumerate(rows):
            self.assertAlmostEqual(float(row["arc"]), 0.5 * n)
            self.assertAlmostEqual(float(row["z"]), 4 + 0.5 * n)
            self.assertAlmostEqual(float(row["x"]), AXIS[0])
            self.assertAlmostEqual(float(row["fraction"]), n / 100)
            self.assertEqual((row["branch"], row["unit"], float(row["normal_z"])), ("0", "mm", 1))
            self.assertAlmostEqual(float(row["file_radius"]), RADIUS)
            if 10 <= n <= 90:
                self.assertEqual((row["closed"], row["shared_with"]), ("yes", ""))
                # The surface of usual detail is up to 3 % thinner.
                self.assertAlmostEqual(float(row["area"]) / (math.pi * RADIUS ** 2), 1, delta=0.06)
                for name in ("equivalent_diameter", "least_diameter", "largest_diameter"):
                    self.assertAlmostEqual(float(row[name]) / (2 * RADIUS), 1, delta=0.03)
                # The voxels of a slice, their corners cut.
                self.assertAlmostEqual(float(row["mask_area"]) / in_slice, 1, delta=0.03)
                self.assertAlmostEqual(float(row["mask_equivalent_diameter"]),
                                       2 * math.sqrt(float(row["mask_area"]) / math.pi), places=5)
        text = self.expect_done("reformat", "tree.swc", "--path", "0", "-o", "-", "--format", "csv", "--step", 5).stdout
        self.assertEqual(len(self.rows(text)), 11)

    def test_sections_are_on_a_sheet(self):
        report = self.reformat("--scan", "scan.nii", "--path", "0", "-o", "out.png", "--kind", "sections", "--step", 10,
                               "--across", 20, "--window", "200,100")
        picture, figures = self.picture("out.png"), report["picture"]
        self.assertEqual([round(one["arc_mm"], 6) for one in report["sections"]], [0, 10, 20, 30, 40, 50])
        self.assertEqual(figures["tiles"], [3, 2])
        side, gap, step = figures["size"][0], figures["gap"], figures["pixel_mm"]
        self.assertAlmostEqual(side * step, 20, delta=step)
        for n, one in enumerate(report["sections"]):
            left, top = (figures["corner"][k] + (n % 3, n // 3)[k] * (side + gap) for k in (0, 1))
            for x in (side // 2, side // 2 + 10, side - 3):
                off = (x - (side - 1) / 2) * step
                at = [one["at"][0] - off, one["at"][1], one["at"][2]]
                self.assertLessEqual(abs(picture.pixel(left + x, top + side // 2)[0] - grey(at)), 1)

    def test_a_fork_is_named(self):
        self.write("fork.swc", FORK)
        report = self.reformat("--path", "0..1", "--step", "0.5", tree="fork.swc")
        self.assertEqual([(part["branch"], part["from"], part["to"]) for part in report["path"]], [(0, 0, 1), (1, 0, 1)])
        shared = [one["surface"]["shared_with"] for one in report["sections"] if one["surface"]]
        self.assertIn([2], shared)
        self.assertEqual(shared[20], [])
        self.assertIsNone(report["picture"])

    def test_the_narrowest_place_against_a_reference(self):
        self.write("waist.swc", WAIST)
        for reference in ("8", "0@0.2", "0@0.15..0@0.3"):
            with self.subTest(reference=reference):
                found = self.reformat("--path", "0", "--step", "0.25", "--reference", reference, tree="waist.swc")["narrowest"]["surface"]
                self.assertAlmostEqual(found["reference"]["least_mm"], 8, delta=0.24)
                for measure, percent in (("least_diameter", 50), ("equivalent_diameter", 50), ("area", 75)):
                    # The surface rounds the waist, which has corners in the file.
                    self.assertAlmostEqual(found[measure]["percent"], percent, delta=3)
                    self.assertAlmostEqual(found[measure]["at"][2], 29, delta=0.6)
        away = self.reformat("--path", "0", "--step", "0.5", "--reference", "8", "--between", "0@0.1..0@0.3", tree="waist.swc")
        self.assertLess(abs(away["narrowest"]["surface"]["area"]["percent"]), 4)
        text = self.expect_done("reformat", "waist.swc", "--units", "mm", "--path", "0", "--reference", "8").stdout
        self.assertRegex(text, r"surface +least diameter [\d.]+ % less at 25.* mm \(0@0\.5")

    def test_commands_write_the_same_table(self):
        self.write("waist.swc", WAIST)
        for scan in ([], ["--scan", "scan.nii"]):
            with self.subTest(scan=scan):
                self.expect_done("reformat", "waist.swc", "--units", "mm", *scan, "--path", "0", "--step", 2.5, "-o", "a.csv")
                self.write("c.txt", "along 0\nsections b.csv --step 2.5\nstenosis 15 35 --reference 10\n")
                said = self.expect_done("render", "waist.swc", "--units", "mm", *scan, "--commands", "c.txt", "--overwrite",
                                        "--verbose").stderr
                self.assertIn("Least diameter", said)
                ours, theirs = (self.rows((self.folder / name).read_text()) for name in ("b.csv", "a.csv"))
                self.assertEqual(len(ours), len(theirs))
                self.assertGreater(len(ours), 15)
                self.assertEqual(list(ours[0]), list(theirs[0]))
                for mine, other in zip(ours, theirs):
                    for column, value in other.items():
                        try:
                            self.assertAlmostEqual(float(mine[column]), float(value), delta=1e-4 * max(1, abs(float(value))),
                                                   msg=column)
                        except ValueError:
                            self.assertEqual(mine[column], value, column)

    def test_the_vessel_that_slices_follow_is_in_pictures_and_reports(self):
        self.write("c.txt", "along root..0\nlayout along\nalong-at 20\nstenosis 15 45 --diameter 9\nreport r.html\n"
                            "save s.json\nalong-show stretched --degrees 40\n")
        self.expect_done("render", "tree.swc", "--units", "mm", "--scan", "scan.nii", "--commands", "c.txt", "-o", "p.png",
                         "--size", "640x400", "--overwrite")
        page = (self.folder / "r.html").read_text()
        self.assertIn("Along root to branch 0", page)
        self.assertIn("Stenosis", page)
        self.assertIn("Cross-sections along the vessel", page)
        picture = self.picture("p.png")
        self.assertEqual((picture.width, picture.height), (640, 400))
        along = json.loads((self.folder / "s.json").read_text())["slices"]["along"]
        self.assertEqual((along["way"], along["at"]), ("root..0", 20.0))

    def test_lengths_have_no_unit_that_nobody_states(self):
        text = self.expect_done("reformat", "tree.swc", "--path", "0", "-o", "out.csv").stdout
        self.assertIn("path          50.00 units", text)
        self.assertNotIn("mm", text)
        self.assertEqual({row["unit"] for row in self.rows((self.folder / "out.csv").read_text())}, {"unknown"})

    def test_what_cannot_be_is_refused(self):
        for words, status, says in (
                (("--path", "7"), 1, ["tree.swc", "no branch 7"]),
                (("--path", "x..y"), 2, ["x..y"]),
                (("--path", "0", "-o", "out.png"), 2, ["--scan"]),
                (("--path", "0", "-o", "out.jpg"), 1, ["out.jpg", ".png or .csv"]),
                (("--path", "0", "--step", "-1"), 2, ["-1"]),
                (("--path", "0@0.5..0@0.5"), 1, ["begins where it ends"]),
                (("--path", "0", "--window", "dark", "--scan", "scan.nii"), 2, ["dark"]),
                (("--path", "0@0..0@0.5", "--reference", "0@0.9"), 1, ["not on the path"]),
                (("--path", "0", "--step", "1e-9"), 1, ["greater step"])):
            with self.subTest(words=words):
                result = self.run_ramus("reformat", "tree.swc", *words)
                self.assertEqual(result.returncode, status, result.stderr)
                for word in says:
                    self.assertIn(word, result.stderr)
                self.assertEqual(self.names(), ["scan.nii", "tree.swc"])
        self.write("far.swc", "1 3 900 0 0 2 -1\n2 3 900 0 50 2 1\n")
        result = self.run_ramus("reformat", "far.swc", "--path", "0", "--scan", "scan.nii", "-o", "out.png")
        self.assertEqual(result.returncode, 1)
        self.assertIn("outside of the scan", result.stderr)


if __name__ == "__main__":
    unittest.main()
