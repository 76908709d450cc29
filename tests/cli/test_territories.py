"""ramus territories: the parts of an organ by the branches that supply or drain it, against a search in Python."""

import gzip
import json
import math
import struct
import unittest
from collections import Counter

import ply
from nifti import nifti, voxels
from ramus import CommandLineTest

SIZE = (22, 24, 11)
SPACING = (1.0, 1.0, 1.25)


def in_organ(x, y, z):
    return y >= 3 and (x - 10.5) ** 2 / 110 + (y - 12) ** 2 / 120 + (z - 5) ** 2 / 30 <= 1


def swc(lines):
    return "\n".join(lines) + "\n"


PORTAL = {"0": ((10, -6, 5), (10, 6, 5)), "1": ((10, 6, 5), (4, 14, 5)), "2": ((10, 6, 5), (17, 15, 4))}
RADII = {"1": (1.5, 1.0), "2": (1.5, 0.8)}
TIPS = {"1": ((4, 14, 5), 1.0), "2": ((17, 15, 4), 0.8)}


def distance(p, a, b):
    ab = [y - x for x, y in zip(a, b)]
    ap = [y - x for x, y in zip(a, p)]
    share = min(1.0, max(0.0, sum(x * y for x, y in zip(ap, ab)) / sum(x * x for x in ab)))
    return math.dist(p, [x + share * y for x, y in zip(a, ab)])


def thick(p, a, b, radii):
    """The least distance to a point of the axis, plus 4 times its radius; by ternary search."""
    def value(t):
        return math.dist(p, [x + t * (y - x) for x, y in zip(a, b)]) + 4 * (radii[0] + t * (radii[1] - radii[0]))
    low, high = 0.0, 1.0
    for _ in range(60):
        first, second = low + (high - low) / 3, high - (high - low) / 3
        low, high = (low, second) if value(first) < value(second) else (first, high)
    return value((low + high) / 2)


class Territories(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("tree.swc", swc(["# mm, RAS", "1 3 10 -6 5 1.5 -1", "2 3 10 6 5 1.5 1", "3 3 4 14 5 1 2", "4 3 17 15 4 0.8 2"]))
        self.places = [(x, y, SPACING[2] * z) for x, y, z in voxels(SIZE)]
        self.inside = [int(in_organ(*place)) for place in self.places]
        self.write("organ.nii", nifti(SIZE, self.inside, rows=((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, SPACING[2], 0))))

    def territories(self, *words):
        return self.json("territories", "tree.swc", "--organ", "organ.nii", "--json", *words)

    def labels(self, name):
        content = (self.folder / name).read_bytes()
        content = gzip.decompress(content) if name.endswith(".gz") else content
        self.assertEqual(struct.unpack_from("<8h", content, 40)[:4], (3, *SIZE))
        start = int(struct.unpack_from("<f", content, 108)[0])
        return list(content[start:])

    def test_voxels_belong_to_the_nearest_branch(self):
        for rule in ("axis", "tips"):
            with self.subTest(rule):
                report = self.territories("--by", rule, "--group", "branches=1,2", "-o", f"{rule}.nii.gz")
                expected = {"branch 1": 0, "branch 2": 0}
                labels = self.labels(f"{rule}.nii.gz")
                for n, (place, inside) in enumerate(zip(self.places, self.inside)):
                    if not inside:
                        self.assertEqual(labels[n], 0)
                        continue
                    values = {}
                    for branch in ("1", "2"): # the stem is the trunk
                        values[branch] = distance(place, *PORTAL[branch])
                        if rule == "tips":
                            at, radius = TIPS[branch]
                            values[branch] = min(thick(place, *PORTAL[branch], RADII[branch]), math.dist(place, at) - 6 * radius)
                    nearest = min(values, key=values.get)
                    if abs(values["1"] - values["2"]) < 1e-4:
                        nearest = str(labels[n])
                    expected["branch " + nearest] += 1
                    self.assertEqual(labels[n], int(nearest))
                found = {one["name"]: one["voxels"] for one in report["territories"]}
                self.assertEqual(found, expected)
                self.assertEqual(sum(found.values()), sum(self.inside))
                self.assertAlmostEqual(report["remnant"]["supplied_ml"], report["functional_ml"])  # nothing is cut
        self.assertAlmostEqual(report["organ_ml"], sum(self.inside) * SPACING[2] / 1000)

    def test_a_cut_takes_away_what_lies_behind_it(self):
        whole = self.territories("--by", "axis", "--group", "cuts=1@0")
        half = self.territories("--by", "axis", "--group", "cuts=1@0.5")
        beyond = [report["territories"][0]["voxels"] for report in (whole, half)]
        self.assertGreater(beyond[0], beyond[1])
        self.assertGreater(beyond[1], 0)
        for report in (whole, half):
            self.assertEqual(sum(one["voxels"] for one in report["territories"]), sum(self.inside))
            remnant = report["remnant"]
            self.assertAlmostEqual(report["functional_ml"] - remnant["supplied_ml"], report["systems"][0]["lost_ml"])
            self.assertEqual(remnant["congested_ml"], 0)
        stem = self.territories("--group", "cuts=0@0.5")
        self.assertEqual(stem["remnant"]["supplied_ml"], 0)

    def test_lesions_and_large_vessels_are_not_functional(self):
        lesion = [int(math.dist(place, (16, 15, 5)) < 3) for place in self.places]
        self.write("lesion.nii", nifti(SIZE, lesion, rows=((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, SPACING[2], 0))))
        both = sum(a and b for a, b in zip(lesion, self.inside))
        voxel = SPACING[2] / 1000
        plain = self.territories("--large-vessels", "100")
        self.assertAlmostEqual(plain["functional_ml"], plain["organ_ml"])
        without = self.territories("--large-vessels", "100", "--lesions", "lesion.nii")
        self.assertAlmostEqual(without["functional_ml"], (sum(self.inside) - both) * voxel)
        stem = self.territories("--large-vessels", "3") # the stem alone is so thick at both ends
        walls = sum(1 for place, inside in zip(self.places, self.inside)
                    if inside and distance(place, *PORTAL["0"]) <= 1.5)
        self.assertAlmostEqual(stem["functional_ml"], (sum(self.inside) - walls) * voxel)

    def test_the_label_map_keeps_grid_and_names(self):
        self.territories("--group", "branches=1,2", "-o", "labels.seg.nrrd")
        info = self.json("info", "labels.seg.nrrd", "--json")
        self.assertEqual([label["name"] for label in info["labels"]], ["branch 1", "branch 2", "rest"])
        self.territories("--group", "branches=1,2", "-o", "labels.nii.gz")
        again = self.json("info", "labels.nii.gz", "--json")
        self.assertEqual([label["name"] for label in again["labels"]], ["branch 1", "branch 2"])
        for one in (info, again):
            self.assertEqual(one["size"], list(SIZE))
            self.assertEqual([round(x, 6) for x in one["spacing_mm"]], list(SPACING))

    def check_surface(self, corners, triangles, voxels):
        """Closed, oriented outward, one ring of triangles around each vertex; the volume of the voxels."""
        edges = Counter((t[n], t[(n + 1) % 3]) for t in triangles for n in range(3))
        self.assertEqual(set(edges.values()), {1})
        self.assertTrue(all((b, a) in edges for a, b in edges))
        onward = {(t[n], t[(n + 1) % 3]): t[(n + 2) % 3] for t in triangles for n in range(3)}
        for vertex in range(len(corners)):
            around = [b for a, b in edges if a == vertex]
            at, ring = around[0], 0
            while ring == 0 or at != around[0]:
                at, ring = onward[vertex, at], ring + 1
            self.assertEqual(ring, len(around))
        self.assertAlmostEqual(ply.volume_of(corners, triangles) / (voxels * SPACING[2]), 1, delta=0.01)

    def test_surfaces_are_closed_and_share_their_borders(self):
        groups = ("--group", "branches=1,2")
        report = self.territories(*groups, "--surfaces", "parts.ply")
        voxels = {one["name"]: one["voxels"] for one in report["territories"]}
        self.assertEqual([(one["name"], one["file"]) for one in report["surfaces"]],
                         [("branch 1", "parts-branch 1.ply"), ("branch 2", "parts-branch 2.ply")])
        faces = []
        for one in report["surfaces"]:
            _, vertices, triangles = ply.read_ply(self.folder / one["file"])
            self.assertEqual(len(triangles), one["triangles"])
            self.check_surface(vertices, triangles, voxels[one["name"]])
            faces.append([tuple(vertices[v][:3] for v in t) for t in triangles])
        sides = [{t[n:] + t[:n] for t in some for n in range(3)} for some in faces]
        shared = [t for t in faces[0] if t[::-1] in sides[1]]
        self.assertGreater(len(shared), 50)
        # Without the shared border both together are the closed surface of the organ.
        outer = [t for n in (0, 1) for t in faces[n] if t[::-1] not in sides[1 - n]]
        self.assertEqual(len(outer), len(faces[0]) + len(faces[1]) - 2 * len(shared))
        edges = Counter((t[n], t[(n + 1) % 3]) for t in outer for n in range(3))
        self.assertEqual(edges, Counter((b, a) for a, b in edges.elements()))
        # All in one file where that can hold names.
        for name, encoded in (("parts.vtp", lambda text: " ".join(str(ord(letter)) for letter in text) + " 0"), ("parts.glb", '"{}"'.format)):
            together = self.territories(*groups, "--surfaces", name)["surfaces"]
            self.assertEqual([(one["file"], one["triangles"]) for one in together],
                             [(name, one["triangles"]) for one in report["surfaces"]])
            content = (self.folder / name).read_bytes()
            for text in ("branch 1", "branch 2"):
                self.assertIn(encoded(text).encode(), content)
        self.expect_failure("territories", "tree.swc", "--organ", "organ.nii", "--surfaces", "parts.nii", says=(".ply", ".glb"))

    def test_the_system_that_divides_the_organ_must_be_known(self):
        # Two trees of tubes in the organ, which a mask has as two labels.
        tubes = [(n % 22, n // 22 % 24, n // 22 // 24) for n in range(22 * 24 * 11)]
        labels = [1 if (x - 6) ** 2 + (z - 4) ** 2 <= 3 else 2 if (x - 15) ** 2 + (z - 4) ** 2 <= 3 else 0 for x, y, z in tubes]
        self.write("vessels.nii", nifti(SIZE, labels, rows=((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, SPACING[2], 0))))
        command = ("territories", "vessels.nii", "--organ", "organ.nii", "--json")
        self.expect_failure(*command, "--group", "generation=0", says=("several systems", "--system", "--drains"))
        by_system = self.json(*command)
        self.assertEqual([one["name"] for one in by_system["territories"]], ["label 1", "label 2"])
        one = self.json(*command, "--group", "generation=0", "--drains", "2")
        self.assertEqual([(t["system"], t["voxels"]) for t in one["territories"]], [("label 1", sum(self.inside))])
        self.assertEqual([system["role"] for system in one["systems"]], ["supplies", "drains"])
        two = self.json(*command, "--group", "generation=0", "--system", "label 2")
        self.assertEqual([t["system"] for t in two["territories"]], ["label 2"])
        cut = self.json(*command, "--group", f"cuts={two['territories'][0]['branches'][0]}@0.5", "--drains", "2")
        remnant, functional = cut["remnant"], cut["functional_ml"]
        self.assertAlmostEqual(remnant["supplied_ml"], functional)
        self.assertGreater(remnant["congested_ml"], 0)
        self.assertAlmostEqual(remnant["congested_ml"] + remnant["drained_ml"], functional)

    def test_a_system_outside_of_the_organ_is_named_and_loses_nothing(self):
        # The second system lies in a corner of the grid, which the organ leaves free.
        labels = [1 if (x - 10) ** 2 + (z - 4) ** 2 <= 3 else 2 if x == z == 0 else 0 for x, y, z in
                  ((n % 22, n // 22 % 24, n // 22 // 24) for n in range(22 * 24 * 11))]
        self.write("vessels.nii", nifti(SIZE, labels, rows=((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, SPACING[2], 0))))
        command = ("vessels.nii", "--organ", "organ.nii", "--drains", "2", "--json")
        branch = self.json("territories", *command, "--group", "generation=0")["territories"][0]["branches"][0]
        cut = self.expect_done("territories", *command, "--group", f"cuts={branch}@0.5")
        self.assertIn("no vessel of label 2 lies in the organ", cut.stderr)
        report = json.loads(cut.stdout)
        self.assertEqual(report["systems"][1]["lost_ml"], 0)
        self.assertGreater(report["systems"][0]["lost_ml"], 0)
        self.assertAlmostEqual(report["remnant"]["drained_ml"], report["functional_ml"])
        self.expect_done("resect", "--tree", *command, "--plane", "10,12,5,0,1,0")

    def test_fewest_cuts_cover_the_lesion_with_the_least_loss(self):
        # Two lesions, one behind each of the two branches.
        lesion = [int(min(math.dist(place, (4, 14, 5)), math.dist(place, (17, 15, 4))) < 2.5) for place in self.places]
        self.write("lesion.nii", nifti(SIZE, lesion, rows=((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, SPACING[2], 0))))
        words = ("--by", "axis", "--lesions", "lesion.nii")
        margin = 1.5
        report = self.territories(*words, "--fewest-cuts", str(margin))
        cuts = report["fewest_cuts"]
        boxes = [place for place, inside in zip(self.places, lesion) if inside]
        def gap(a, b):
            return math.dist([max(0, abs(x - y) - half) for x, y, half in zip(a, b, (0.5, 0.5, SPACING[2] / 2))], (0, 0, 0))
        near = [bool(inside and min(gap(place, box) for box in boxes) <= margin) for place, inside in zip(self.places, self.inside)]
        voxel = SPACING[2] / 1000
        self.assertAlmostEqual(cuts["target_ml"], sum(near) * voxel)
        self.assertEqual(cuts["out_of_reach_ml"], 0)
        one, two = cuts["suggestions"]
        self.assertEqual([len(one["cuts"]), len(two["cuts"])], [1, 2])
        self.assertEqual(one["cuts"], ["0@1"])
        self.assertAlmostEqual(one["lost_ml"], report["functional_ml"])
        self.assertEqual([cut.split("@")[0] for cut in two["cuts"]], ["1", "2"])
        self.assertAlmostEqual(two["lost_percent"], 100 * two["lost_ml"] / report["functional_ml"])
        # The cuts take away what they say, all that is near, and less than cuts at the beginnings.
        after = self.territories(*words, "--group", "cuts=" + ",".join(two["cuts"]), "-o", "cut.nii")
        self.assertAlmostEqual(after["systems"][0]["lost_ml"], two["lost_ml"])
        labels = self.labels("cut.nii")
        self.assertTrue(all(label in (1, 2) for label, is_near in zip(labels, near) if is_near))
        begin = self.territories(*words, "--group", "cuts=1,2")
        self.assertLess(two["lost_ml"], begin["systems"][0]["lost_ml"])
        said = self.expect_done("territories", "tree.swc", "--organ", "organ.nii", *words, "--fewest-cuts", "1.5").stdout
        self.assertIn("cut 0@1: ", said)
        self.assertIn(f"cuts {two['cuts'][0]},{two['cuts'][1]}: ", said)
        self.assertEqual(len(self.territories(*words, "--fewest-cuts", "1.5", "--most-cuts", "1")["fewest_cuts"]["suggestions"]), 1)
        self.expect_failure("territories", "tree.swc", "--organ", "organ.nii", "--fewest-cuts", "5", says=("--lesions",), status=2)
        self.expect_failure("territories", "tree.swc", "--organ", "organ.nii", *words, "--fewest-cuts", "-1", says=("-1",), status=2)

    def test_bad_requests_are_refused(self):
        command = ("territories", "tree.swc", "--organ", "organ.nii")
        self.expect_failure(*command, "--group", "branches=7", says=("no branch 7",))
        self.expect_failure(*command, "--group", "house", says=("house",), status=2)
        self.expect_failure(*command, "--group", "cuts=1@2", says=("cuts=1@2",), status=2)
        self.expect_failure(*command, "--group", "cuts=1@0,1@0.5", says=("cuts=1",), status=2)
        self.expect_failure(*command, "--organ-label", "9", says=("organ.nii",))
        self.expect_failure(*command, "-o", "labels.stl", says=(".seg.nrrd",))
        self.expect_failure(*command, "--drains", "spleen", says=("no systems",))
        self.write("far.swc", swc(["# mm, RAS", "1 3 500 0 0 1 -1", "2 3 510 0 0 1 1"]))
        self.expect_failure("territories", "far.swc", "--organ", "organ.nii", says=("no vessel of the tree lies in the organ",))
        self.assertFalse((self.folder / "labels.stl").exists())


if __name__ == "__main__":
    unittest.main()
