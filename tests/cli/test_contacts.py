"""Vessels that press on each other without being connected: what they are, and whether they merge."""

import json
import math
import unittest

from nifti import nifti
from ramus import CommandLineTest

# Two straight tubes of radius 1 whose axes cross at right angles, 1.8 apart: they overlap by 0.2 at (0, 0, 0.9).
CROSSING = """1 2 0 -10 0 1 -1
2 2 0 10 0 1 1
3 2 -10 0 1.8 1 -1
4 2 10 0 1.8 1 3
"""




def tubes(*lines):
    """An SWC file with a vessel of radius 1 along each list of places."""
    rows = []
    for line in lines:
        for place in line:
            rows.append((len(rows) + 1, *place, -1 if place is line[0] else len(rows)))
    return "".join("{} 2 {} {} {} 1 {}\n".format(*row) for row in rows)


class Info(CommandLineTest):
    def contacts(self, tree, *options):
        self.write("tree.swc", tree)
        return self.json("info", "tree.swc", "--contacts", "--json", *options)["contacts"]

    def listed(self, tree):
        self.write("tree.swc", tree)
        lines = self.expect_done("info", "tree.swc", "--contacts", "--units", "mm").stdout.splitlines()
        return lines[next(i for i, line in enumerate(lines) if line.startswith("contacts")):]

    def test_two_tubes_that_overlap(self):
        found, = self.contacts(CROSSING)
        self.assertEqual(found["branches"], [0, 1])
        self.assertAlmostEqual(found["gap_mm"], 1.8 - 2.0)
        self.assertAlmostEqual(found["closeness"], 1.8 / 2.0)
        self.assertIs(found["crossing"], False)
        for place, expected in ((found["at"], 0.9), (found["sides"][0]["at"], 0.0), (found["sides"][1]["at"], 1.8)):
            for value, wanted in zip(place, (0.0, 0.0, expected)):
                self.assertAlmostEqual(value, wanted)
        for side, branch in zip(found["sides"], (0, 1)):
            self.assertEqual((side["branch"], side["branches"], side["radius_mm"]), (branch, [branch], 1.0))
            self.assertAlmostEqual(side["narrowed_mm"], 0.1)  # the wall is half-way, 0.9 from either axis
            self.assertGreater(side["length_mm"], 0.0)
        summary, line = self.listed(CROSSING)
        self.assertEqual(summary.split(), ["contacts", "1", "(1", "overlap,", "0", "crossings)"])
        self.assertIn("1: branch 0 with 1 at 0, 0, 0.9 mm: overlap 0.2 mm; narrowed by 0.1 and 0.1 mm; along ", line)

    def test_a_small_gap_is_a_contact_and_a_large_one_is_not(self):
        apart = CROSSING.replace(" 1.8 ", " {} ")
        self.assertAlmostEqual(self.contacts(apart.format(2.1, 2.1))[0]["gap_mm"], 0.1)
        self.assertIn("gap 0.1 mm", self.listed(apart.format(2.1, 2.1))[1])
        # A closeness of 1.2 is beyond sqrt(1 + 2 / 5) = 1.18, where four vessels in a bundle would merge.
        self.assertEqual(self.contacts(apart.format(2.4, 2.4)), [])
        self.assertEqual(self.listed(apart.format(2.4, 2.4))[0].split(), ["contacts", "none"])
        self.assertNotIn("contacts", self.json("info", "tree.swc", "--json"))

    def test_crossing_axes_are_reported(self):
        found, = self.contacts(CROSSING.replace(" 1.8 ", " 0 "))
        self.assertIs(found["crossing"], True)
        self.assertAlmostEqual(found["gap_mm"], -2.0)
        self.assertIn("axes cross, overlap 2 mm", self.listed(CROSSING.replace(" 1.8 ", " 0 "))[1])

    def test_contacts_are_found_in_the_prepared_tree(self):
        # The bend at z = 1 goes to 0.5 in one pass: (0 + 2 x 1 + 0) / 4, with voxels so large that it reaches both ends.
        tree = "# id type x y z radius parent (unknown, unknown) voxel 100 0 0 0 100 0 0 0 100\n" + tubes([(0, -10, 0), (0, 0, 1), (0, 10, 0)], [(-10, 0, 2.5), (10, 0, 2.5)])
        # Round, the bend is lower by half a radius times the sine of half the angle that it turns by.
        for options, height in ((["--smooth", "0"], 1.0), (["--smooth", "1"], 0.5), ([], 0.5)):
            gap = 2.5 - height - 2.0 + 0.5 * height / math.hypot(10.0, height)
            self.assertAlmostEqual(self.contacts(tree, *options)[0]["gap_mm"], gap, 6)
        lines = self.contacts(tree, "--smooth", "0", "--centerline", "lines")
        self.assertAlmostEqual(lines[0]["gap_mm"], 2.5 - 1.0 - 2.0, 6)
        # Vessels of one radius merge below a closeness of sqrt(1 + 1 / width), which is 1.005 here; four below 1.01.
        near = CROSSING.replace(" 1.8 ", " 2.1 ")
        self.assertEqual(len(self.contacts(near)), 1)
        self.assertEqual(self.contacts(near, "--width", "100"), [])
        # Pruned, a twig touches nothing: 4 mm long, on a stem of 20 mm, 0.4 below the other vessel.
        twig = ("1 2 0 -20 0 1 -1\n2 2 0 0 0 1 1\n3 2 0 20 0 1 2\n4 2 4 0 0 1 2\n"
                "5 2 4 -10 1.6 1 -1\n6 2 4 10 1.6 1 5\n")
        self.assertEqual(len(self.contacts(twig)), 1)
        self.assertEqual(self.contacts(twig, "--prune", "0.5"), [])

    def test_text_lists_the_closest_and_json_lists_all(self):
        many = tubes([(0, 0, 0), (200, 0, 0)],
                     *([(8 * i, -3, 1.5 + 0.02 * i), (8 * i, 3, 1.5 + 0.02 * i)] for i in range(1, 24)))
        found = self.contacts(many)
        self.assertEqual(len(found), 23)
        for i, contact in enumerate(found, 1):
            self.assertEqual(contact["branches"], [0, i])
            self.assertAlmostEqual(contact["gap_mm"], -0.5 + 0.02 * i)
        lines = self.listed(many)
        self.assertIn("23 (23 overlaps", lines[0])
        self.assertEqual(len(lines), 22)
        self.assertTrue(lines[-1].endswith("and 3 more, which --json lists"), lines[-1])

    def test_contacts_option_is_refused_where_it_does_not_apply(self):
        self.write("tree.swc", CROSSING)
        for option in (("--prune", "0.5"), ("--centerline", "lines"), ("--width", "1")):
            self.expect_failure("info", "tree.swc", *option, says=["--contacts"], status=2)
        self.write("mask.nii", nifti((3, 3, 3), [0] * 27))
        self.expect_failure("info", "mask.nii", "--contacts", says=["mask.nii", "--contacts"])


class Blend(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("crossing.swc", CROSSING)

    def components(self, *arguments):
        return self.json("mesh", "-o", "out.ply", "--json", *arguments)["components"]

    def test_pieces_and_loops_are_compared_with_the_tree(self):
        """A vessel, and another one that crosses it twice: merged they are one piece with a loop, and that is told."""
        self.write("tree.swc", tubes([(0, -10, 0), (0, 10, 0)], [(-10, -5, 1.8), (10, -5, 1.8), (10, 5, 1.8), (-10, 5, 1.8)]))
        for blend, pieces, loops in (("tree", 2, 0), ("paper", 1, 1)):
            done = self.expect_done("mesh", "tree.swc", "-o", "o.ply", "--blend", blend, "--json")
            found = json.loads(done.stdout)
            self.assertEqual((found["components"], found["loops"]), (pieces, loops))
            self.assertEqual(found["tree"], {"components": 2, "loops": 0})
            told = "1 piece fewer and 1 loop more than the tree; vessels that come close are merged: --blend tree"
            self.assertEqual(told in done.stderr, blend == "paper", done.stderr)

    def test_vessels_that_touch_merge_or_stay_apart(self):
        self.assertEqual(self.components("crossing.swc"), 2)
        self.assertEqual(self.components("crossing.swc", "--blend", "paper"), 1)
        self.assertEqual(self.components("crossing.swc", "--blend", "tree"), 2)

    def test_commands_and_sessions_keep_the_blend(self):
        self.write("c.txt", "save tree.json\nblend\nsave paper.json\nsurface blend tree\nundo\nsave undone.json\n")
        self.expect_done("render", "crossing.swc", "-o", "out.png", "--size", "64x64", "--commands", "c.txt")
        blends = {name: json.loads((self.folder / name).read_text())["options"]["blend"]
                  for name in ("tree.json", "paper.json", "undone.json")}
        self.assertEqual(blends, {"tree.json": "tree", "paper.json": "paper", "undone.json": "paper"})
        self.assertEqual(self.components("--session", "tree.json"), 2)
        self.assertEqual(self.components("--session", "tree.json", "--blend", "paper"), 1)
        self.assertEqual(self.components("--session", "paper.json"), 1)
        self.assertEqual(self.components("--session", "paper.json", "--blend", "tree"), 2)

    def test_pictures_depend_on_the_blend(self):
        pictures = []
        for blend in ("paper", "tree"):
            self.expect_done("render", "crossing.swc", "-o", "out.png", "--size", "200x200", "--view", "superior",
                             "--blend", blend)
            pictures.append((self.folder / "out.png").read_bytes())
        self.assertNotEqual(*pictures)

    def test_unknown_blends_are_wrong_usage(self):
        for command in (("mesh", "crossing.swc", "-o", "out.ply"), ("render", "crossing.swc", "-o", "out.png"),
                        ("study", "crossing.swc", "-o", "study")):
            self.expect_failure(*command, "--blend", "0.5", says=["--blend", "paper", "tree"], status=2)
        self.write("c.txt", "blend apart\n")
        self.expect_failure("render", "crossing.swc", "-o", "out.png", "--commands", "c.txt", says=["c.txt:1", "paper", "tree"])


class Pictures(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("crossing.swc", CROSSING)

    def picture(self, name, *arguments):
        self.expect_done("render", "-o", name, "--size", "160x120", *arguments)
        return (self.folder / name).read_bytes()

    def test_contacts_are_marked_by_flag_command_and_session(self):
        plain = self.picture("plain.png", "crossing.swc")
        marked = self.picture("marked.png", "crossing.swc", "--contacts")
        self.assertNotEqual(marked, plain)
        self.write("c.txt", "contact-marks on\nsave s.json\nshot shot.png\n")
        self.assertEqual(self.picture("c.png", "crossing.swc", "--commands", "c.txt"), marked)
        self.assertEqual((self.folder / "shot.png").read_bytes(), marked)
        self.assertEqual(self.picture("s.png", "--session", "s.json"), marked)

    def test_a_command_goes_to_a_contact(self):
        self.write("c.txt", "contact 1\nsave s.json\nreport page.html\n")
        self.picture("c.png", "crossing.swc", "--commands", "c.txt")
        session = json.loads((self.folder / "s.json").read_text())
        self.assertEqual(session["selection"], [0, 1])
        for value, wanted in zip(session["camera"]["focal_point"], (0.0, 0.0, 0.9)):
            self.assertAlmostEqual(value, wanted)
        page = (self.folder / "page.html").read_text()
        self.assertIn("<h2>Contacts</h2>", page)
        self.assertEqual(self.picture("n.png", "crossing.swc", "--contact", "1"), (self.folder / "c.png").read_bytes())
        self.write("c.txt", "contact 2\n")
        self.expect_failure("render", "crossing.swc", "-o", "c.png", "--commands", "c.txt", says=["c.txt:1", "which contact?"])

    def test_a_contact_is_shown_with_both_blends(self):
        ways = [self.picture(f"{way}.png", "crossing.swc", "--contact", "1", "--compare", "wipe", "--wipe", at)
                for way, at in (("apart", "0"), ("merged", "1"), ("both", "0.5"))]
        self.assertEqual(len(set(ways)), 3)
        self.write("c.txt", "contact 1 wipe\nsave s.json\n")
        self.assertEqual(self.picture("c.png", "crossing.swc", "--commands", "c.txt"), ways[2])
        comparison = json.loads((self.folder / "s.json").read_text())["comparison"]
        self.assertEqual((comparison["mode"], comparison["surfaces"]), ("wipe", ["paper", "tree"]))
        # The session's own way is one of the two, whichever that is.
        self.assertEqual(self.picture("p.png", "crossing.swc", "--contact", "1", "--compare", "wipe", "--blend", "paper"),
                         ways[2])
        for wrong in (["--wipe", "0.5"], ["--compare", "blend", "--wipe", "0.5"], ["--compare", "wipe", "--wipe", "2"],
                      ["--contact", "0"]):
            self.expect_failure("render", "crossing.swc", "-o", "out.png", *wrong, says=[wrong[-2]], status=2)
        self.expect_failure("render", "crossing.swc", "-o", "out.png", "--contact", "2", says=["which contact?"])


if __name__ == "__main__":
    unittest.main()
