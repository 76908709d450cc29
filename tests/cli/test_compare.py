"""Surfaces of the same vessels in one picture, on the command line."""

import json
import struct
import unittest

from nifti import compressed, nifti, voxels
from png import Picture
from ramus import GOOD, CommandLineTest

LINE = (61, 66, 74)  # between viewports


class Compare(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("tree.swc", GOOD)
        size = (9, 5, 16)
        inside = [2 if 3 <= x <= 5 and 1 <= y <= 3 and 1 <= z <= 14 else 0 for x, y, z in voxels(size)]
        rows = ((1, 0, 0, -4), (0, 1, 0, -2), (0, 0, 1, 0))
        self.write("mask.nii.gz", compressed(nifti(size, inside, rows=rows)))

    def picture(self, name, *arguments):
        self.expect_done("render", "tree.swc", "-o", name, "--size", "300x160", *arguments)
        content = (self.folder / name).read_bytes()
        self.assertEqual(struct.unpack(">II", content[16:24]), (300, 160))
        return content

    def test_every_comparison_mode_gives_another_picture(self):
        all_three = ("--methods", "iso,cones,cs", "--mask", "mask.nii.gz")
        pictures = [self.picture("plain.png"), self.picture("s.png", "--skeleton")]
        for mode in ("side-by-side", "blend", "superimposed"):
            pictures.append(self.picture(mode + ".png", "--compare", mode, *all_three))
            pictures.append(self.picture(mode + "2.png", "--compare", mode))
        self.assertEqual(len(set(pictures)), len(pictures))
        self.assertEqual(self.picture("off.png", "--compare", "off"), pictures[0])

    def test_a_blend_is_exact_at_its_ends(self):
        parallel = ("--orthographic",)  # in perspective the scale bar says how deep both of them are
        first = self.picture("a.png", "--compare", "blend", "--methods", "cs,iso", "--share", "0", *parallel)
        self.assertEqual(first, self.picture("b.png", "--compare", "blend", "--methods", "cones,cs", "--share", "1", *parallel))
        self.assertNotEqual(first, self.picture("c.png", "--compare", "blend", "--methods", "cs,cones", "--share", "1", *parallel))

    def test_commands_and_sessions_do_the_same(self):
        flags = self.picture("flags.png", "--compare", "side-by-side", "--methods", "iso,cs", "--mask", "mask.nii.gz",
                             "--label", "2", "--skeleton")
        self.write("c.txt", "compare-mask mask.nii.gz 2\ncompare side-by-side iso,cs\nskeleton on\nfit\nsave s.json\nshot shot.png\n")
        self.assertEqual(self.picture("commands.png", "--commands", "c.txt"), flags)
        self.assertEqual((self.folder / "shot.png").read_bytes(), flags)
        session = json.loads((self.folder / "s.json").read_text())
        self.assertEqual(session["comparison"], {"mode": "side-by-side", "surfaces": ["iso", "cs"], "blend": 0.5,
                                                 "mask": "mask.nii.gz", "labels": [2]})
        self.assertEqual(self.picture("unit.png", "--compare", "side-by-side", "--methods", "iso,cs", "--mask", "mask.nii.gz",
                                      "--mask-units", "mm", "--label", "2", "--skeleton"), flags)
        self.write("u.txt", "compare-mask mask.nii.gz 2 --units mm\ncompare side-by-side iso,cs\nskeleton on\nfit\nsave u.json\n")
        self.assertEqual(self.picture("commands.png", "--commands", "u.txt"), flags)
        self.assertEqual(json.loads((self.folder / "u.json").read_text())["comparison"]["mask_units"], "mm")
        self.expect_done("render", "--session", "u.json", "-o", "again.png", "--size", "300x160")
        self.assertEqual((self.folder / "again.png").read_bytes(), flags)
        self.expect_done("render", "--session", "s.json", "-o", "again.png", "--size", "300x160")
        self.assertEqual((self.folder / "again.png").read_bytes(), flags)

    def test_every_picture_of_a_turntable_is_the_comparison(self):
        report = self.json("render", "tree.swc", "--compare", "side-by-side", "--size", "201x100", "--json", "-o", "a.png",
                           "--orthographic")
        camera = report["camera"]
        self.json("render", "tree.swc", "--compare", "side-by-side", "--size", "201x100", "--json", "-o", "t.png",
                  "--turntable", "4", "--camera", json.dumps(camera))
        self.assertEqual(self.names(), ["a.png", "mask.nii.gz", *(f"t_00{i}.png" for i in (1, 2, 3, 4)), "tree.swc"])
        self.assertEqual((self.folder / "t_001.png").read_bytes(), (self.folder / "a.png").read_bytes())
        # Half of the way around the eye is on the other side.
        behind = dict(camera, position=[2 * f - p for p, f in zip(camera["position"], camera["focal_point"])])
        self.expect_done("render", "tree.swc", "--compare", "side-by-side", "--size", "201x100", "-o", "behind.png",
                         "--camera", json.dumps(behind), "--reference", "t_003.png")
        frames = [Picture((self.folder / f"t_00{i}.png").read_bytes()) for i in (1, 2, 3, 4)]
        for frame in frames:
            self.assertEqual({frame.pixel(100, y) for y in range(100)}, {LINE})
            self.assertNotEqual(frame.part(0, 30, 100, 40), frame.part(101, 30, 100, 40))
        self.assertEqual(len({frame.part(0, 0, 201, 100) for frame in frames}), 4)
        for mode in ("blend", "superimposed"):
            self.expect_done("render", "tree.swc", "--compare", mode, "--size", "80x60", "-o", mode + ".png",
                             "--turntable", "2")
            self.assertNotEqual(*((self.folder / f"{mode}_00{i}.png").read_bytes() for i in (1, 2)))

    def test_a_turntable_keeps_the_tree_whole_in_its_panes(self):
        self.expect_done("render", "tree.swc", "--compare", "side-by-side", "--methods", "cs,cones,iso", "--size", "302x200",
                         "-o", "t.png", "--turntable", "3", "--overlays", "none", "--transparent")
        for i in (1, 2, 3):
            frame = Picture((self.folder / f"t_00{i}.png").read_bytes())
            for left in (0, 101, 202):
                # Below the words, where there would be vessel at the edges if it were cut.
                self.assertFalse(any(frame.part(left, 25, 1, 175)) or any(frame.part(left + 99, 25, 1, 175)))
                self.assertTrue(any(frame.part(left, 25, 100, 175)))

    def test_a_sheet_has_views_in_one_direction_and_surfaces_in_the_other(self):
        compare = ("render", "tree.swc", "--compare", "side-by-side", "--methods", "cs,cones,iso", "--sheet", "-o", "s.png")
        self.expect_done(*compare, "--size", "403x302")
        wide = Picture((self.folder / "s.png").read_bytes())
        self.assertEqual((wide.width, wide.height), (403, 302))
        columns, rows = (0, 101, 202, 303), (0, 101, 202)
        for x in (100, 201, 302):
            self.assertEqual({wide.pixel(x, y) for y in range(302)}, {LINE})
        for y in (100, 201):
            self.assertEqual({wide.pixel(x, y) for x in range(403)}, {LINE})
        cells = [[wide.part(x, y + 20, 100, 80) for x in columns] for y in rows]
        self.assertEqual(len({cell for row in cells for cell in row}), 12)  # no two are the same

        self.expect_done(*compare, "--size", "302x403")
        high = Picture((self.folder / "s.png").read_bytes())
        for x in (100, 201):
            self.assertEqual({high.pixel(x, y) for y in range(403)}, {LINE})
        # The same cells, the other way round; words and scale bars stand elsewhere.
        for view, x in enumerate(columns):
            for surface, y in enumerate(rows):
                self.assertEqual(high.part(rows[surface], columns[view] + 30, 100, 40), wide.part(x, y + 30, 100, 40))

        self.expect_failure(*compare, "--size", "3x3", says=("no room", "--size"))

    def test_a_sheet_of_blended_or_superimposed_surfaces_has_two_views_and_two(self):
        def cells(*more):
            self.expect_done("render", "tree.swc", "-o", "s.png", "--size", "322x202", "--sheet", "--overlays", "none", *more)
            sheet = Picture((self.folder / "s.png").read_bytes())
            return [sheet.part(x, y + 30, 161, 70) for x in (0, 161) for y in (0, 101)]

        first = cells("--compare", "blend", "--methods", "cs,cones", "--share", "0")
        self.assertEqual(len(set(first)), 4)
        self.assertEqual(first, cells("--compare", "blend", "--methods", "cones,cs", "--share", "1"))
        for other in (("blend", "--share", "0.7"), ("superimposed",)):
            sheet = cells("--compare", *other)
            self.assertTrue(all(one != another for one, another in zip(first, sheet)))
            self.assertEqual(len(set(sheet)), 4)

    def test_commands_compare_in_turntables_and_sheets_too(self):
        self.write("c.txt", "compare side-by-side cs,iso\n")
        for more in (("--sheet",), ("--turntable", "2")):
            names = ("s.png",) if len(more) == 1 else ("s_001.png", "s_002.png")
            pictures = []
            for how in (("--commands", "c.txt"), ("--compare", "side-by-side", "--methods", "cs,iso")):
                self.expect_done("render", "tree.swc", "--size", "202x100", "-o", "s.png", *more, *how)
                pictures.append([(self.folder / name).read_bytes() for name in names])
            self.assertEqual(*pictures)

    def test_headings_stand_in_one_line_below_a_caption(self):
        def first_line(picture, left, width, below=0):
            """Of pixels that are as bright as letters are."""
            return next(y for y in range(below, picture.height)
                        if any(min(picture.pixel(x, y)) > 150 for x in range(left, left + width)))

        common = ("--overlays", "none", "--supersample", "2", "--caption", "E", "--transparent")
        for mode, lefts in (("side-by-side", (100, 401)), ("blend", (150,))):
            self.expect_done("render", "tree.swc", "--compare", mode, "--size", "601x300", "-o", "c.png", *common)
            picture = Picture((self.folder / "c.png").read_bytes())
            caption = first_line(picture, 0, 40)
            # Titles begin with the same capital height, C or T; a rounding of half a pixel apart.
            lines = [first_line(picture, left, 150) for left in lefts]
            self.assertLessEqual(max(lines) - min(lines), 1)
            self.assertGreater(min(lines), caption + 8)  # capitals are ten points high, less in small pictures

    def test_a_benchmark_turns_all_panes(self):
        def benchmark(*more):
            return self.json("render", "tree.swc", "--size", "200x100", "--benchmark", "2", "--benchmark-full", "--json",
                             *more)

        triangles = {method: benchmark("--method", method)["triangles"] for method in ("cs", "cones")}
        both = benchmark("--compare", "side-by-side")
        self.assertEqual((both["panes"], both["frames"], both["difference"]), (2, 2, 0))
        self.assertEqual(both["triangles"], sum(triangles.values()))
        self.assertEqual(benchmark("--compare", "blend")["triangles"], sum(triangles.values()))
        self.assertGreater(benchmark("--compare", "superimposed")["triangles"], triangles["cs"])
        self.write("c.txt", "compare side-by-side cs,cones\n")
        self.assertEqual(benchmark("--commands", "c.txt")["triangles"], both["triangles"])
        self.assertEqual(benchmark()["panes"], 1)

    def test_comparison_inside_the_window(self):
        self.write("c.txt", "compare blend cs,iso\ncompare-blend 0.3\n")
        self.picture("ui.png", "--ui", "--commands", "c.txt")

    def test_invalid_comparisons_are_refused(self):
        for wrong in (["--compare", "magic"], ["--compare", "blend", "--methods", "cs"],
                      ["--compare", "blend", "--methods", "cs,cs"], ["--compare", "blend", "--share", "2"],
                      ["--share", "0.5"], ["--methods", "cs,iso"], ["--mask", "mask.nii.gz"],
                      ["--compare", "side-by-side", "--share", "0.5"], ["--compare", "blend", "--label", "1"],
                      ["--compare", "blend", "--mask", "mask.nii.gz", "--label", "0"],
                      ["--compare", "blend", "--sheet", "--turntable", "4"],
                      ["--compare", "blend", "--turntable", "4", "--benchmark", "2"]):
            with self.subTest(wrong):
                self.expect_failure("render", "tree.swc", "-o", "out.png", *wrong, status=2)
        common = ("render", "tree.swc", "-o", "out.png", "--compare", "blend", "--methods", "cs,iso", "--mask")
        self.expect_failure(*common, "absent.nii", says=("absent.nii",))
        self.expect_failure(*common, "tree.swc", says=("tree.swc",))
        self.expect_failure(*common, "mask.nii.gz", "--label", "7", says=("mask.nii.gz", "7"))
        self.write("far.nii", nifti((2, 2, 2), [1] * 8, rows=((1, 0, 0, 900), (0, 1, 0, 0), (0, 0, 1, 0))))
        self.expect_failure(*common, "far.nii", says=("far.nii", "elsewhere"))
        self.assertNotIn("out.png", self.names())


if __name__ == "__main__":
    unittest.main()
