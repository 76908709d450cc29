"""How far surfaces are from each other: `ramus compare`."""

import math
import struct
import unittest

from nifti import nifti, voxels
from ramus import GOOD, CommandLineTest


def ply(vertices, faces):
    header = ("ply\nformat binary_little_endian 1.0\n"
              f"element vertex {len(vertices)}\nproperty float x\nproperty float y\nproperty float z\n"
              f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    return (header.encode() + b"".join(struct.pack("<3f", *vertex) for vertex in vertices) +
            b"".join(struct.pack("<B3i", 3, *face) for face in faces))


def tube(radius, length=20.0, sides=40, rings=10):
    """Around z, open at both ends."""
    vertices = [(radius * math.cos(2 * math.pi * s / sides), radius * math.sin(2 * math.pi * s / sides), length * r / rings)
                for r in range(rings + 1) for s in range(sides)]
    faces = []
    for r in range(rings):
        for s in range(sides):
            a, b = r * sides + s, r * sides + (s + 1) % sides
            faces += [(a, b, b + sides), (a, b + sides, a + sides)]
    return ply(vertices, faces)


CUBE_FACES = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7), (0, 4, 2),
              (2, 4, 6), (1, 3, 5), (3, 7, 5)]


def cube(half):
    return ply([(half * (2 * (i & 1) - 1), half * (2 * (i >> 1 & 1) - 1), half * (2 * (i >> 2) - 1)) for i in range(8)],
               CUBE_FACES)


class Compare(CommandLineTest):
    def test_coaxial_tubes(self):
        self.write("wide.ply", tube(3.0))
        self.write("narrow.ply", tube(2.25))
        found = self.json("compare", "wide.ply", "narrow.ply", "--json", "--threshold", "0.7")
        # Across the radius through an edge of the narrow prism all of it lies on one side: the edge is nearest.
        for name in ("mean", "rms", "min", "max", "median"):
            self.assertAlmostEqual(found[name], 0.75, delta=1e-5)
        self.assertAlmostEqual(found["sigma"], 0.0, delta=1e-5)
        self.assertEqual((found["above_percent"], found["threshold_mm"], found["count"]), (100.0, 0.7, 440))
        # Back, a side of the wide prism is nearest: its edge's way times the cosine of what the prism turns by.
        back = 3.0 * math.cos(math.pi / 40) - 2.25 * math.cos(math.pi / 40)
        self.assertAlmostEqual(found["back"]["mean"], back, delta=1e-5)
        self.assertAlmostEqual(found["hausdorff"], 0.75, delta=1e-5)
        self.assertAlmostEqual(found["hausdorff_95"], 0.75, delta=1e-5)
        area = 40 * 2 * 3.0 * math.sin(math.pi / 40) * 20.0
        self.assertAlmostEqual(found["area_mm2"], area, delta=1e-3)
        self.assertIsNone(found["volume_mm3"])
        self.assertEqual(sum(found["histogram"]["counts"]), 440)

    def test_both_ways_differ(self):
        self.write("small.ply", cube(1.0))
        self.write("large.ply", cube(3.0))
        found = self.json("compare", "small.ply", "large.ply", "--json")
        self.assertAlmostEqual(found["max"], 2.0)
        self.assertAlmostEqual(found["back"]["max"], 2.0 * math.sqrt(3.0))
        self.assertAlmostEqual(found["hausdorff"], 2.0 * math.sqrt(3.0))
        self.assertIsNone(found["above_percent"])
        self.assertAlmostEqual(found["a"]["volume_mm3"], 8.0)
        self.assertAlmostEqual(found["b"]["volume_mm3"], 216.0)
        self.assertAlmostEqual(found["b"]["area_mm2"], 216.0)

    def test_a_tree_is_compared_by_its_surface(self):
        self.write("tree.swc", GOOD)
        self.expect_done("mesh", "tree.swc", "-o", "tree.ply")
        found = self.json("compare", "tree.swc", "tree.ply", "--json")
        self.assertLess(found["hausdorff"], 1e-6)
        self.expect_done("mesh", "tree.swc", "-o", "fine.stl", "--detail", "40", "--smooth", "0")
        same = self.json("compare", "tree.swc", "fine.stl", "--json", "--detail", "40", "--smooth", "0")
        self.assertLess(same["hausdorff"], 1e-6)
        self.assertGreater(self.json("compare", "tree.swc", "fine.stl", "--json")["max"], 1e-3)

    def test_a_mask_gives_the_threshold(self):
        size = (9, 9, 14)
        inside = [1 if 3 <= x <= 5 and 3 <= y <= 5 and 2 <= z <= 11 else 0 for x, y, z in voxels(size)]
        self.write("mask.nii", nifti(size, inside, rows=((1, 0, 0, -4), (0, 1, 0, -4), (0, 0, 2, 0))))
        self.write("tree.swc", "1 2 0 0 4 1.5 -1\n2 2 0 0 22 1.5 1\n")
        found = self.json("compare", "tree.swc", "mask.nii", "--json")
        self.assertAlmostEqual(found["threshold_mm"], 0.5 * math.sqrt(6.0))
        self.assertLess(found["above_percent"], 5.0)
        self.assertEqual(self.json("compare", "tree.swc", "mask.nii", "--json", "--threshold", "0")["threshold_mm"], 0.0)

    def test_text_output(self):
        self.write("a.ply", cube(1.0))
        self.write("b.ply", cube(2.0))
        text = self.expect_done("compare", "a.ply", "b.ply", "--threshold", "0.5").stdout
        for words in ("a.ply: 8 vertices, 12 triangles", "A to B, mm: mean 1", "100 % above", "Hausdorff distance 1.732 mm"):
            self.assertIn(words, text)

    def test_files_that_cannot_be_compared(self):
        self.write("a.ply", cube(1.0))
        self.write("damaged.ply", cube(1.0)[:-7])
        self.expect_failure("compare", "a.ply", "missing.ply", says=["missing.ply"])
        self.expect_failure("compare", "damaged.ply", "a.ply", says=["damaged.ply"])
        self.expect_failure("compare", "a.ply", "missing.swc", says=["missing.swc"])
        for words in (("a.ply",), (), ("a.ply", "a.ply", "--threshold", "nan"), ("a.ply", "a.ply", "--threshold", "-1")):
            self.assertEqual(self.run_ramus("compare", *words).returncode, 2)


if __name__ == "__main__":
    unittest.main()
