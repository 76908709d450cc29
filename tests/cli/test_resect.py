"""ramus resect: volumes, margins, cut vessels and the remnant of an organ, against brute force in Python."""

import gzip
import json
import math
import struct
import unittest

from nifti import nifti, voxels
from ply import read_ply
from ramus import CommandLineTest

SIZE = (26, 24, 14)
SPACING = (1.0, 1.0, 1.25)
ROWS = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, SPACING[2], 0))
VOXEL = SPACING[2] / 1000
POINTS = {1: (12, -6, 8, 1.8), 2: (12, 7, 8, 1.5), 3: (4, 14, 8, 1.0), 4: (20, 16, 7, 0.8), 5: (8, 19, 12, 0.5)}
PARENTS = {2: 1, 3: 2, 4: 2, 5: 3}
TREE = "# mm, RAS\n" + "".join(
    f"{n} 3 {x} {y} {z} {r} {PARENTS.get(n, -1)}\n" for n, (x, y, z, r) in POINTS.items())


def in_organ(x, y, z):
    return y >= 2 and (x - 12.5) ** 2 / 140 + (y - 12) ** 2 / 125 + (z - 8) ** 2 / 50 <= 1


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def unit(a):
    return [x / math.hypot(*a) for x in a]


def to_box(p, centre):
    """The distance of a point from the box of a voxel."""
    return math.hypot(*(max(abs(x - c) - s / 2, 0) for x, c, s in zip(p, centre, SPACING)))


class Resect(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("tree.swc", TREE)
        self.places = [(x, y, SPACING[2] * z) for x, y, z in voxels(SIZE)]
        self.inside = [int(in_organ(*place)) for place in self.places]
        self.organ = [place for place, inside in zip(self.places, self.inside) if inside]
        self.mask("organ.nii", self.inside)
        self.lesion = [place for place in self.places if math.dist(place, (15, 13, 7.5)) < 2.2]
        self.mask("lesion.nii", [int(place in self.lesion) for place in self.places])

    def mask(self, name, values):
        self.write(name, nifti(SIZE, values, rows=ROWS))

    def resect(self, *words):
        return self.json("resect", "--organ", "organ.nii", "--tree", "tree.swc", "--large-vessels", "100", "--json", *words)

    def removed_ml(self, removed, samples=5):
        """Of samples in each voxel's box."""
        offsets = [(n + 0.5) / samples - 0.5 for n in range(samples)]
        count = sum(removed((x + a * SPACING[0], y + b * SPACING[1], z + c * SPACING[2]))
                    for x, y, z in self.organ for a in offsets for b in offsets for c in offsets)
        return count / samples ** 3 * VOXEL

    def labels(self, name):
        content = (self.folder / name).read_bytes()
        content = gzip.decompress(content) if name.endswith(".gz") else content
        start = int(struct.unpack_from("<f", content, 108)[0])
        return list(content[start:])

    def test_planes_remove_what_their_normal_points_to(self):
        for point, normal in (((9.3, 0, 0), (1, 0, 0)), ((12, 11, 8), (1, -2, 0.7)), ((14, 12, 8), (-3, 1, 1))):
            with self.subTest(normal=normal):
                report = self.resect("--plane", ",".join(map(str, point + normal)))
                n = unit(normal)
                expected = self.removed_ml(lambda p: dot(minus(p, point), n) > 0)
                self.assertAlmostEqual(report["removed_ml"] / expected, 1, delta=0.005)
                self.assertAlmostEqual(report["organ_ml"], len(self.organ) * VOXEL)
                self.assertAlmostEqual(report["remnant_ml"] + report["removed_ml"], report["organ_ml"])
                self.assertAlmostEqual(report["functional_remnant_ml"], report["remnant_ml"], places=5)
                self.assertEqual(report["resections"], ["plane"])
                self.check_vessels(report, point, n)
        # Whole layers of voxels: exact.
        report = self.resect("--plane", "9.5,0,0,1,0,0")
        self.assertAlmostEqual(report["removed_ml"], sum(x > 9.5 for x, _, _ in self.organ) * VOXEL)
        within = self.resect("--plane", "9.7,0,0,1,0,0")
        self.assertAlmostEqual(within["area_mm2"], sum(x == 10 for x, _, _ in self.organ) * SPACING[2])
        # Two planes: the union.
        both = self.resect("--plane", "9.5,0,0,1,0,0", "--plane", "0,14.5,0,0,1,0")
        self.assertAlmostEqual(both["removed_ml"], sum(x > 9.5 or y > 14.5 for x, y, _ in self.organ) * VOXEL)

    def check_vessels(self, report, point, n):
        """All of the tree lies in the organ or near it, but for the first point."""
        expected = []
        for child, parent in PARENTS.items():
            a, b = POINTS[parent], POINTS[child]
            values = [dot(minus(p[:3], point), n) for p in (a, b)]
            if (values[0] >= 0) != (values[1] >= 0):
                t = values[0] / (values[0] - values[1])
                at = [x + t * (y - x) for x, y in zip(a[:3], b[:3])]
                angle = math.degrees(math.asin(abs(dot(unit(minus(b[:3], a[:3])), n))))
                if at[1] > 3:
                    expected.append((2 * (a[3] + t * (b[3] - a[3])), at, angle))
        expected.sort(key=lambda one: -one[0])
        self.assertEqual(len(report["vessels"]), len(expected))
        for vessel, (diameter, at, angle) in zip(report["vessels"], expected):
            self.assertAlmostEqual(vessel["diameter_mm"], diameter)
            self.assertAlmostEqual(math.dist(vessel["at"], at), 0)
            self.assertAlmostEqual(vessel["angle_deg"], angle, places=4)
            self.assertTrue(0 <= vessel["fraction"] <= 1)

    def test_margins_are_those_from_the_boxes_of_voxels(self):
        boxes = [tuple(c + s * side / 2 for c, s, side in zip(place, SPACING, sides)) for place in self.lesion
                 for sides in ((a, b, c) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1))]
        for point, normal in (((9.3, 12, 8), (1, 0, 0)), ((9.3, 12, 8), (-1, 0, 0)), ((18.8, 14, 7), (1, 1, 0.5))):
            n = unit(normal)
            report = self.resect("--plane", ",".join(map(str, point + normal)), "--lesions", "lesion.nii")
            (margin,) = report["margins"]
            heights = [dot(minus(corner, point), n) for corner in boxes]
            self.assertAlmostEqual(margin["mm"], min(map(abs, heights)), delta=1e-4)
            self.assertAlmostEqual(math.dist(margin["at"], margin["to"]), margin["mm"], places=6)
            self.assertAlmostEqual(dot(minus(margin["to"], point), n), 0, places=5)
            self.assertEqual(margin["removed"], "whole" if min(heights) > 0 else "none")
            self.assertAlmostEqual(margin["volume_ml"], len(self.lesion) * VOXEL)
        through = self.resect("--plane", "15,0,0,1,0,0", "--lesions", "lesion.nii")["margins"][0]
        self.assertEqual((through["mm"], through["removed"]), (0, "part"))
        beyond = self.resect("--plane", "90,0,0,1,0,0", "--lesions", "lesion.nii")
        self.assertEqual((beyond["margins"][0]["mm"], beyond["removed_ml"], beyond["area_mm2"]), (None, 0, 0))
        # Two labels, one of them in two parts.
        values = [0] * len(self.places)
        for n, (x, y, z) in enumerate(self.places):
            values[n] = 1 if (x, y, z) in ((8, 8, 7.5), (8, 9, 7.5), (16, 8, 7.5)) else 2 if (x, y, z) == (12, 16, 10) else 0
        self.mask("two.nii", values)
        several = self.resect("--plane", "10,0,0,1,0,0", "--lesions", "two.nii")["margins"]
        self.assertEqual([(one["lesion"], round(one["mm"], 4), one["removed"]) for one in several],
                         [("label 1 1", 1.5, "none"), ("label 1 2", 5.5, "whole"), ("label 2", 1.5, "whole")])

    def test_what_a_cut_takes_away_is_its_territory(self):
        for cut in ("1@0", "1@0.4", "2@0.3"):
            report = self.resect("--cut", cut)
            territories = self.json("territories", "tree.swc", "--organ", "organ.nii", "--large-vessels", "100", "--json",
                                    "--group", "cuts=" + cut)
            self.assertAlmostEqual(report["removed_ml"], territories["systems"][0]["lost_ml"])
            self.assertAlmostEqual(report["remnant"]["supplied_ml"], territories["remnant"]["supplied_ml"])
            branch, fraction = cut.split("@")
            self.assertEqual([(v["branch"], v["fraction"]) for v in report["vessels"]], [(int(branch), float(fraction))])
            wider = self.resect("--cut", cut, "--margin", "1.5")
            self.assertGreater(wider["removed_ml"], report["removed_ml"])

    def test_a_lesion_is_removed_with_a_margin(self):
        report = self.resect("--lesion", "lesion.nii", "--margin", "2")
        expected = self.removed_ml(lambda p: math.dist(p, (15, 13, 7.5)) < 6 and any(to_box(p, box) <= 2 for box in self.lesion), 3)
        self.assertAlmostEqual(report["removed_ml"] / expected, 1, delta=0.02)
        (margin,) = report["margins"]
        self.assertEqual(margin["removed"], "whole")
        self.assertAlmostEqual(margin["mm"], 2, delta=0.02)
        bare = self.resect("--lesion", "lesion.nii")
        self.assertAlmostEqual(bare["removed_ml"], len(self.lesion) * VOXEL)

    def test_the_remnant_is_what_is_kept_and_still_supplied(self):
        # Beyond the stem, all is lost, also what stays.
        stem = self.resect("--plane", "0,5,0,0,-1,0")
        self.assertEqual([vessel["branch"] for vessel in stem["vessels"]], [0])
        self.assertAlmostEqual(stem["remnant"]["supplied_ml"], 0)
        self.assertAlmostEqual(stem["remnant"]["drained_ml"], stem["remnant_ml"], places=5)
        self.assertAlmostEqual(stem["remnant"]["unsupplied_ml"], stem["remnant_ml"], places=5)
        self.assertEqual(stem["remnant"]["congested_ml"], 0)
        # The lesion is no functional tissue.
        with_lesion = self.resect("--plane", "9.5,0,0,1,0,0", "--lesions", "lesion.nii")
        self.assertAlmostEqual(with_lesion["functional_ml"], (len(self.organ) - len(self.lesion)) * VOXEL)
        self.assertAlmostEqual(with_lesion["functional_remnant_ml"], sum(x < 9.5 for x, _, _ in self.organ) * VOXEL, places=5)

    def test_sheets_and_surfaces_divide_the_organ_as_planes_do(self):
        point, normal = (10.2, 11, 8), unit((1, 0.3, -0.2))
        plane = self.resect("--plane", ",".join(map(str, (*point, *normal))))
        removed = min(plane["removed_ml"], plane["remnant_ml"])
        u = unit((0.3, -1, 0))
        v = [normal[1] * u[2] - normal[2] * u[1], normal[2] * u[0] - normal[0] * u[2], normal[0] * u[1] - normal[1] * u[0]]

        def at(a, b):
            return [p + a * x + b * y for p, x, y in zip(point, u, v)]

        ring = [at(11 * math.cos(n / 4), 8 * math.sin(n / 4)) for n in range(25)]
        self.write("contour.txt", "# mm\n" + "".join("%.9f, %.9f %.9f\n" % tuple(p) for p in ring))
        self.write("contour.json", json.dumps({"contour": ring, "control_points": [6, 5]}))
        self.write("sheet.json", json.dumps({"origin": at(-20, -20), "u": u, "v": v, "step": [10, 8], "size": [5, 6], "heights": [0] * 30}))
        corners = [at(*c) for c in ((-40, -40), (40, -40), (40, 40), (-40, 40))]
        self.write("wall.obj", "".join("v %.9f %.9f %.9f\n" % tuple(p) for p in corners) + "f 1 2 3 4\n")
        for words in (("--sheet", "contour.txt"), ("--sheet", "contour.json"), ("--surface", "wall.obj")):
            with self.subTest(words):
                report = self.resect(*words)
                self.assertAlmostEqual(report["removed_ml"] / removed, 1, delta=1e-3)
                self.assertAlmostEqual(report["area_mm2"] / plane["area_mm2"], 1, delta=1e-3)
                self.assertEqual(len(report["vessels"]), len(plane["vessels"]))
                for one, other in zip(report["vessels"], plane["vessels"]):
                    self.assertAlmostEqual(math.dist(one["at"], other["at"]), 0, delta=1e-4)
                other = self.resect(*words, "--other-side")
                self.assertAlmostEqual(other["removed_ml"], report["remnant_ml"], delta=1e-3 * removed)
        grid = self.resect("--sheet", "sheet.json")
        side = dot(normal, [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]])
        self.assertAlmostEqual(grid["removed_ml"] / plane["removed_ml" if side > 0 else "remnant_ml"], 1, delta=1e-4)

    def test_surfaces_that_do_not_divide_the_organ_are_refused(self):
        self.write("part.obj", "v 10 -9 -9\nv 10 9 -9\nv 10 9 40\nv 10 -9 40\nf 1 2 3 4\n")
        command = ("resect", "--organ", "organ.nii", "--tree", "tree.swc")
        self.expect_failure(*command, "--surface", "part.obj", says=("part.obj", "does not divide"))
        self.write("away.obj", "v 90 -9 -9\nv 90 90 -9\nv 90 90 90\nv 90 -9 90\nf 1 2 3 4\n")
        self.expect_failure(*command, "--surface", "away.obj", says=("away.obj", "on one side"))

    def test_outputs_are_a_label_map_or_the_surface(self):
        plane = ("--plane", "9.5,0,0,1,0,0")
        self.resect(*plane, "-o", "parts.nii.gz")
        self.assertEqual(self.labels("parts.nii.gz"),
                         [0 if not inside else 2 if place[0] > 9.5 else 1 for place, inside in zip(self.places, self.inside)])
        self.resect(*plane, "-o", "parts.seg.nrrd")
        info = self.json("info", "parts.seg.nrrd", "--json")
        self.assertEqual([label["name"] for label in info["labels"]], ["remnant", "removed"])
        report = self.resect("--plane", "12,11,8,1,-2,0.7", "-o", "cut.ply")
        _, vertices, faces = read_ply(self.folder / "cut.ply")
        n = unit((1, -2, 0.7))
        area = 0
        for vertex in vertices:
            self.assertAlmostEqual(dot(minus(vertex[:3], (12, 11, 8)), n), 0, places=4)
        for face in faces:
            a, b, c = (vertices[i][:3] for i in face)
            p, q = minus(b, a), minus(c, a)
            area += math.hypot(p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]) / 2
        self.assertAlmostEqual(area / report["area_mm2"], 1, delta=1e-4)

    def test_people_get_sentences(self):
        text = self.expect_done("resect", "--organ", "organ.nii", "--tree", "tree.swc", "--plane", "-1,11,8,0,1,0",
                                "--lesions", "lesion.nii").stdout
        for word in ("organ ", "removed ", "remnant ", "margin ", "vessels cut", "diameter", "ml"):
            self.assertIn(word, text)

    def test_bad_requests_are_refused(self):
        command = ("resect", "--organ", "organ.nii", "--tree", "tree.swc")
        self.expect_failure(*command, says=("--plane",), status=2)
        self.expect_failure(*command, "--plane", "1,2,3", says=("1,2,3",), status=2)
        self.expect_failure(*command, "--plane", "1,2,3,0,0,0", says=("1,2,3,0,0,0",), status=2)
        self.expect_failure(*command, "--plane", "1,2,3,1,0,0", "--margin", "3", says=("--margin",), status=2)
        self.expect_failure(*command, "--cut", "1@0.5", "--margin", "-3", says=("--margin",), status=2)
        self.expect_failure(*command, "--cut", "x", says=("x",), status=2)
        self.expect_failure(*command, "--cut", "77", says=("no branch 77",))
        self.expect_failure(*command, "--plane", "1,2,3,1,0,0", "--other-side", says=("--other-side",), status=2)
        self.expect_failure(*command, "--lesion", "missing.nii", says=("missing.nii",))
        self.expect_failure(*command, "--plane", "1,2,3,1,0,0", "-o", "labels.txt", says=(".seg.nrrd", ".ply"))
        for name, content, words in (("line.txt", "0 0 0\n1 1 1\n2 2 2\n", "on a line"), ("few.txt", "1 2 3\n", "three points"),
                                     ("words.txt", "1 2 three\n", "three"), ("empty.txt", "", "three points"),
                                     ("bad.json", '{"contour": [[1, 2]]}', "three numbers"), ("none.json", "{}", "neither"),
                                     ("grid.json", '{"origin":[0,0,0],"u":[1,0,0],"v":[1,0,0],"step":[1,1],"size":[2,2],"heights":[0,0,0,0]}', "right angles")):
            self.write(name, content)
            self.expect_failure(*command, "--sheet", name, says=(name, words))


if __name__ == "__main__":
    unittest.main()
