"""ramus slice: pictures against the voxels of the file, sides for every way that a file can store them, refusals."""

import itertools
import json
import struct
import unittest

from nifti import nifti, voxels
from png import Picture
from ramus import CommandLineTest

# A phantom in the patient (RAS, mm): a bright block near each of the six sides, each with its own value.
SIDES = {"R": ((14, 0, 0), 250), "L": ((-14, 0, 0), 200), "A": ((0, 14, 0), 160), "P": ((0, -14, 0), 120),
         "S": ((0, 0, 14), 90), "I": ((0, 0, -14), 60)}


def phantom(place):
    for middle, value in SIDES.values():
        if max(abs(a - b) for a, b in zip(place, middle)) <= 3:
            return value
    return 10


# Another one: a letter in each corner of its three middle slices, as a person reads them there.
LETTERS = {"axial": "FGJL", "coronal": "PQRN", "sagittal": "247Y"}
GLYPHS = {"F": "##### #.... #.... ###.. #.... #.... #....", "G": ".###. #...# #.... #.### #...# #...# .####",
          "J": "..### ...#. ...#. ...#. ...#. #..#. .##..", "L": "#.... #.... #.... #.... #.... #.... #####",
          "P": "####. #...# #...# ####. #.... #.... #....", "Q": ".###. #...# #...# #...# #.#.# #..#. .##.#",
          "R": "####. #...# #...# ####. #.#.. #..#. #...#", "N": "##..# ##..# #.#.# #.#.# #..## #..## #...#",
          "2": ".###. #...# ....# ...#. ..#.. .#... #####", "4": "...#. ..##. .#.#. #..#. ##### ...#. ...#.",
          "7": "##### ....# ...#. ..#.. ..#.. ..#.. ..#..", "Y": "#...# #...# .#.#. ..#.. ..#.. ..#.. .##.."}
CORNERS = ((1, 1), (15, 1), (1, 13), (15, 13))  # column and row of each letter among the 21 of a slice
# The patient axes to whose negative ends a slice is read, across and down, and the one through it.
READ_ALONG = {"axial": (0, 1, 2), "coronal": (0, 2, 1), "sagittal": (1, 2, 0)}


def written(plane):
    """The values of a middle slice as rows."""
    rows = [[10] * 21 for _ in range(21)]
    for letter, (left, top) in zip(LETTERS[plane], CORNERS):
        for y, line in enumerate(GLYPHS[letter].split()):
            for x, ink in enumerate(line):
                rows[top + y][left + x] = 250 if ink == "#" else 10
    return rows


PAGES = {plane: written(plane) for plane in LETTERS}


def letters(place):
    for plane, (across, down, through) in READ_ALONG.items():
        if place[through] == 0:
            value = PAGES[plane][round(10 - place[down] / 2)][round(10 - place[across] / 2)]
            if value != 10:
                return value
    return 10


def stored(order, flips, value=phantom):
    """A phantom in a file whose axes are these patient axes, in this order and sense: 21 voxels of 2 mm each way."""
    size = (21, 21, 21)
    rows = []
    for axis in range(3):
        row = [0.0] * 4
        at = order.index(axis)
        row[at] = -2.0 if flips[axis] else 2.0
        row[3] = 20.0 if flips[axis] else -20.0
        rows.append(tuple(row))

    def place(voxel):
        return [sum(row[k] * voxel[k] for k in range(3)) + row[3] for row in rows]

    return nifti(size, [value(place(voxel)) for voxel in voxels(size)], rows=rows)


class Slices(CommandLineTest):
    def picture(self, *words):
        self.expect_done("slice", *words, "-o", "s.png", "--plain", "--window", "255,127.5")
        return Picture((self.folder / "s.png").read_bytes())

    def check_block(self, picture, pixel, side):
        """The grey at a pixel from the middle of the picture."""
        x, y = picture.width // 2 + pixel[0], picture.height // 2 + pixel[1]
        self.assertEqual(picture.pixel(x, y), (SIDES[side][1],) * 3, side)

    def test_no_way_of_storing_a_volume_mirrors_or_turns_its_slices(self):
        for order in itertools.permutations(range(3)):
            for flips in itertools.product((False, True), repeat=3):
                self.write("v.nii", stored(order, flips, letters))
                for plane, page in PAGES.items():
                    with self.subTest(order=order, flips=flips, plane=plane):
                        picture = self.picture("v.nii", "--plane", plane, "--nearest")
                        self.assertEqual([[picture.pixel(x, y)[0] for x in range(21)] for y in range(21)], page)

    def test_the_sides_of_each_plane(self):
        self.write("v.nii", stored((2, 0, 1), (True, False, True)))
        axial = self.picture("v.nii")
        for side, pixel in (("R", (-7, 0)), ("L", (7, 0)), ("A", (0, -7)), ("P", (0, 7))):
            self.check_block(axial, pixel, side)
        coronal = self.picture("v.nii", "--plane", "coronal")
        for side, pixel in (("R", (-7, 0)), ("L", (7, 0)), ("S", (0, -7)), ("I", (0, 7))):
            self.check_block(coronal, pixel, side)
        sagittal = self.picture("v.nii", "--plane", "sagittal")
        for side, pixel in (("A", (-7, 0)), ("P", (7, 0)), ("S", (0, -7)), ("I", (0, 7))):
            self.check_block(sagittal, pixel, side)
        oblique = self.picture("v.nii", "--plane", "oblique", "--normal", "0,0,2")
        self.check_block(oblique, (-7, 0), "R")
        self.check_block(oblique, (0, -7), "A")

    def test_the_report_says_where_the_picture_is(self):
        self.write("v.nii", stored((0, 1, 2), (False, False, False)))
        report = self.json("slice", "v.nii", "--at", "1,2,3", "--json")
        self.assertEqual(report["plane"], "axial")
        self.assertEqual(report["at"], [1, 2, 3])
        self.assertEqual(report["size"], [21, 21])
        self.assertEqual(report["corner"], [20, 20, 3])
        self.assertEqual((report["right"], report["down"]), ([-1, 0, 0], [0, -1, 0]))
        self.assertEqual(report["pixel_mm"], [2, 2])
        self.assertEqual((report["unit"], report["orientation"], report["value"]), ("mm", "RAS", 10))
        self.assertEqual(self.json("slice", "v.nii", "--at", "14,0,0", "--json")["value"], 250)

    def test_slabs(self):
        self.write("v.nii", stored((0, 1, 2), (False, False, False)))
        words = ("v.nii", "--at", "0,0,9", "--slab")
        self.assertEqual(self.picture(*words, "10,maximum").pixel(10, 10), (90,) * 3)
        self.assertEqual(self.picture(*words, "10,minimum").pixel(10, 10), (10,) * 3)
        # Planes at z 5, 7, 9, 11 and 13; the block begins with the voxel at 12.
        mean = (10 + 10 + 10 + 50 + 90) / 5
        self.assertLessEqual(abs(self.picture(*words, "10,mean").pixel(10, 10)[0] - mean), 1)

    def test_vessels_and_masks_are_drawn_and_reported(self):
        self.write("v.nii", stored((0, 1, 2), (False, False, False)))
        self.write("tree.swc", "# mm, RAS\n1 3 5 4 -15 3 -1\n2 3 5 4 15 3 1\n")
        report = self.json("slice", "v.nii", "--tree", "tree.swc", "-o", "t.png", "--plain", "--json")
        self.assertEqual(len(report["outlines"]), 1)
        outline = report["outlines"][0]
        self.assertTrue(outline["closed"])
        self.assertEqual(set(outline["branches"]), {0})
        for x, y, z in outline["points"]:
            self.assertAlmostEqual(((x - 5) ** 2 + (y - 4) ** 2) ** 0.5, 3, delta=0.07)  # about 16 sides
            self.assertAlmostEqual(z, 0, delta=1e-6)
        self.assertEqual(len(report["axes"]), 1)
        self.assertEqual(report["axes"][0]["branch"], 0)
        picture = Picture((self.folder / "t.png").read_bytes())
        red, green, blue = picture.pixel(10 - 4, 10 - 2)  # on the wall, to the patient's right
        self.assertGreater(red, blue + 30)
        values = [int(x > 10) * 2 for x, _, _ in voxels((21, 21, 21))]
        self.write("m.nii", nifti((21, 21, 21), values, rows=((2, 0, 0, -20), (0, 2, 0, -20), (0, 0, 2, -20))))
        masked = self.picture("v.nii", "--mask", "m.nii")
        self.assertEqual(masked.pixel(15, 10), (10,) * 3)  # left
        self.assertNotEqual(masked.pixel(5, 5), (10,) * 3)  # right: label 2

    def test_figures_with_slices(self):
        def many_values(place):  # a file with few values is taken for labels
            value = phantom(place)
            return value if value != 10 else round(sum(n * p for n, p in zip((3, 5, 7), place))) % 97

        self.write("v.nii", stored((0, 1, 2), (False, False, False), many_values))
        self.write("tree.swc", "# mm, RAS\n1 3 5 4 -15 3 -1\n2 3 5 4 15 3 1\n")
        shown = ("--scan", "v.nii", "--size", "241x201", "--view", "anterior", "--window", "255,127.5")

        def picture(*words):
            self.expect_done("render", "-o", "p.png", *shown, *words)
            return Picture((self.folder / "p.png").read_bytes())

        plain = picture("tree.swc", "--layout", "slices")
        finer = picture("tree.swc", "--layout", "slices", "--supersample", "2")
        # The blocks of the phantom at the right and the anterior side of the axial slice, at the upper left.
        for at in ((60 - 33, 46), (64, 50 - 33)):
            self.assertAlmostEqual(finer.pixel(*at)[0], plain.pixel(*at)[0], delta=4)
            self.assertGreater(plain.pixel(*at)[0], 100)
        turn = self.json("render", "tree.swc", "-o", "t.png", *shown, "--layout", "slices", "--turntable", "2", "--json")
        first, second = (Picture((self.folder / name).read_bytes()) for name in ("t_001.png", "t_002.png"))
        self.assertEqual(len(turn["pictures"]), 2)
        self.assertEqual(first.pixel(60 - 33, 46), second.pixel(60 - 33, 46))  # slices stay
        self.expect_failure("render", "tree.swc", "-o", "t.png", *shown, "--layout", "axial", "--turntable", "2",
                            says=("does not turn", "layout"))
        # A sheet shows the tree alone, as without slices.
        self.expect_done("render", "tree.swc", "-o", "a.png", *shown, "--layout", "slices", "--sheet")
        self.expect_done("render", "tree.swc", "-o", "b.png", *shown, "--sheet")
        a, b = (Picture((self.folder / name).read_bytes()) for name in ("a.png", "b.png"))
        self.assertTrue(all(a.pixel(x, y) == b.pixel(x, y) for x in range(0, 241, 5) for y in range(0, 201, 5)))
        # Without a tree: the slices, and a distance in the scan.
        self.write("c.txt", "crosshair 0,0,0\nmeasure distance -10,0,0 10,0,0\n")
        alone = picture("--commands", "c.txt")
        self.assertGreater(alone.pixel(64, 50 - 33)[0], 100)
        without = picture()
        self.assertNotEqual(alone.pixel(60 + 15, 50), without.pixel(60 + 15, 50))

    def test_what_nobody_states_is_not_claimed(self):
        self.write("v.nii", nifti((9, 9, 9), [n % 251 for n in range(729)], units=0))
        report = self.json("slice", "v.nii", "--json")
        self.assertEqual(report["unit"], "unknown")

    def test_refusals(self):
        self.write("v.nii", stored((0, 1, 2), (False, False, False)))
        self.write("empty.nii", b"")
        self.expect_failure("slice", "v.nii", "-o", "s.png", "--at", "0,0,50", says=("outside of the scan", "--at"))
        self.expect_failure("slice", "none.nii", "-o", "s.png", says=("none.nii",))
        self.expect_failure("slice", "empty.nii", "-o", "s.png", says=("empty.nii",))
        self.expect_failure("slice", "v.nii", "-o", "s.jpg", says=("s.jpg",))
        self.expect_failure("slice", "v.nii", "-o", "v.nii", says=("v.nii",))
        for words in (("--window", "skin"), ("--window", "0,3"), ("--slab", "0"), ("--slab", "3,least"), ("--normal", "0,0,1"),
                      ("--plane", "oblique"), ("--plane", "oblique", "--normal", "0,0,0"), ("--at", "1,2"), ("--size", "5"),
                      ("--plane", "front")):
            with self.subTest(words=words):
                self.assertEqual(self.run_ramus("slice", "v.nii", "-o", "s.png", *words).returncode, 2)
        self.assertEqual(self.run_ramus("slice", "v.nii").returncode, 2)
        self.assertNotIn("s.png", self.names())


if __name__ == "__main__":
    unittest.main()
