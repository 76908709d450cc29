"""Lesions and the vessels near them: shortest distances, contact and measurements from lesions, through commands, sessions,
tables, pages and pictures. The witnesses are closed forms of spheres, boxes and straight vessels, and brute force."""

import csv
import json
import math
import unittest

from png import Picture
from ramus import CommandLineTest

# Two straight vessels along x, of 3 mm and 2 mm radius, their axes 30 mm apart.
TREE = {"format": "ramus-tree", "version": 2, "units": "mm", "orientation": "RAS",
        "points": [[-30, 0, 0, 3], [30, 0, 0, 3], [-30, 0, 30, 2], [30, 0, 30, 2]],
        "branches": [[0, 1], [2, 3]], "roots": [0, 2],
        "systems": [{"name": "portal vein", "colour": [60, 110, 180]}, {"name": "hepatic vein", "colour": [200, 80, 60]}],
        "branch_systems": [0, 1]}


def box(low, high):
    corners = [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
    quads = "1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4"
    return "".join("v %g %g %g\n" % corner for corner in corners) + "".join("f %s\n" % quad for quad in quads)


def sphere_contact(wall, ball, between, touch):
    """Angle and length of the contact of a ball with a straight wall, from the distance between centre and axis."""
    reach = ball + touch
    cosine = (between ** 2 + wall ** 2 - reach ** 2) / (2 * between * wall)
    angle = 2 * math.degrees(math.acos(max(-1.0, min(1.0, cosine))))
    return angle, 2 * math.sqrt(reach ** 2 - (between - wall) ** 2)


class Lesions(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.tree = self.write("two.json", json.dumps(TREE))

    def run_commands(self, lines, *more, tree=None):
        self.write("c.txt", lines)
        return self.expect_done("render", tree or self.tree, "--size", "320x240", "--commands", "c.txt", "--overwrite", "-o",
                                "p.png", "--verbose", *more).stderr

    def rows(self, name):
        with open(self.folder / name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def number(self, row, name):
        return float(row[name])


class Distances(Lesions):
    def test_a_row_for_each_lesion_and_each_system(self):
        self.run_commands("lesion 0,0,12,4\nlesion 10,0,33,2.5\nreport l.csv lesions\n")
        rows = self.rows("l.csv")
        self.assertEqual([(r["lesion"], r["system"], r["branch"]) for r in rows],
                         [("1", "portal vein", "0"), ("1", "hepatic vein", "1"),
                          ("2", "portal vein", "0"), ("2", "hepatic vein", "1")])
        found = [(self.number(r, "distance"), self.number(r, "overlap")) for r in rows]
        for (distance, overlap), (wanted, deep) in zip(found, [(5, 0), (12, 0), (27.5, 0), (0, 1.5)]):
            self.assertAlmostEqual(distance, wanted, places=4)
            self.assertAlmostEqual(overlap, deep, places=4)
        first = rows[0]
        self.assertAlmostEqual(self.number(first, "lesion_z"), 8, places=4)
        self.assertAlmostEqual(self.number(first, "wall_z"), 3, places=4)
        self.assertEqual({r["unit"] for r in rows}, {"mm"})
        self.assertEqual(self.number(rows[0], "contact_angle"), 0)
        self.assertEqual(rows[0]["contact_branch"], "")

    def test_a_tree_without_systems_is_one(self):
        tree = self.write("one.json", json.dumps({k: v for k, v in TREE.items() if "systems" not in k}))
        self.run_commands("lesion 0,0,20,4\nreport l.csv lesions\n", tree=tree)
        rows = self.rows("l.csv")
        self.assertEqual(len(rows), 1)
        self.assertNotIn("system", rows[0])
        self.assertEqual(rows[0]["branch"], "1")
        self.assertAlmostEqual(self.number(rows[0], "distance"), 30 - 2 - 24, places=4)

    def test_meshes_are_measured_as_spheres_are(self):
        self.write("box.obj", box((-5, -5, 5.5), (5, 5, 12)))
        self.run_commands("lesion-mesh box.obj\nreport l.csv lesions\n")
        rows = self.rows("l.csv")
        self.assertAlmostEqual(self.number(rows[0], "distance"), 2.5, places=3)
        self.assertAlmostEqual(self.number(rows[1], "distance"), 16, places=2)

    def test_going_to_the_nearest_vessel_reports_the_distance(self):
        said = self.run_commands("lesion 0,0,12,4\nlesion-vessel 1\nlesion-vessel 1 hepatic\\ vein\nsave s.json\n"
                                 .replace("hepatic\\ vein", '"hepatic vein"'))
        self.assertIn("Lesion 1 to portal vein, branch 0: 5.00 mm; no contact", said)
        self.assertIn("Lesion 1 to hepatic vein, branch 1: 12.0 mm; no contact", said)
        self.assertEqual(json.loads((self.folder / "s.json").read_text())["selection"], [1])
        for line, says in (("lesion-vessel 2", "lesion"), ("lesion-vessel", "number"), ("lesion-vessel 1 artery", "artery"),
                           ("lesion-contact -1", "distance"), ("shortest-distances maybe", "on or off")):
            with self.subTest(line):
                self.write("c.txt", "lesion 0,0,12,4\n" + line + "\n")
                self.expect_failure("render", self.tree, "--commands", "c.txt", "-o", "no.png", says=[says])


class Contact(Lesions):
    def test_contact_of_a_sphere_agrees_with_the_closed_form(self):
        for between, ball, touch in ((9.0, 6.0, 0.5), (8.0, 6.0, 0.0), (7.0, 6.0, 1.0), (10.5, 8.0, 0.25)):
            with self.subTest(between=between, ball=ball, touch=touch):
                self.run_commands(f"lesion 0,{between},0,{ball}\nlesion-contact {touch}\nreport l.csv lesions\n")
                row = self.rows("l.csv")[0]
                angle, length = sphere_contact(3.0, ball, between, touch)
                self.assertAlmostEqual(self.number(row, "contact_angle"), angle, delta=0.1)
                self.assertAlmostEqual(self.number(row, "contact_length"), length, delta=0.02)
                self.assertEqual(self.number(row, "contact_within"), touch)
                self.assertEqual((row["contact_branch"], row["contact_branches"]), ("0", "1"))

    def test_half_and_all_of_a_vessel(self):
        self.write("half.obj", box((-6, 0, -20), (6, 20, 20)))
        self.run_commands("lesion-mesh half.obj\nlesion 0,0,30,12\nlesion-contact 0\nreport l.csv lesions\n")
        rows = {(r["lesion"], r["system"]): r for r in self.rows("l.csv")}
        half = rows["2", "portal vein"]
        self.assertAlmostEqual(self.number(half, "contact_angle"), 180, delta=0.2)
        self.assertAlmostEqual(self.number(half, "contact_length"), 12, delta=0.02)
        whole = rows["1", "hepatic vein"]
        self.assertAlmostEqual(self.number(whole, "contact_angle"), 360, delta=1e-6)
        self.assertAlmostEqual(self.number(whole, "contact_length"), 2 * math.sqrt(144 - 4), delta=0.05)
        self.assertAlmostEqual(self.number(whole, "overlap"), 14, delta=1e-3)

    def test_brute_force_agrees_on_an_oblique_ball_and_a_cone(self):
        # A vessel from 4 mm to 1.5 mm; cross-sections by the twentieth of a millimetre, walls by the half degree.
        self.write("cone.swc", "1 0 -20 0 0 4 -1\n2 0 20 0 0 1.5 1\n")
        self.run_commands("lesion -2,5,3,5\nlesion-contact 0.3\nreport l.csv lesions\n", "--units", "mm",
                          tree=self.folder / "cone.swc")
        best, length = 0, 0.0
        for i in range(800):
            x = -20 + 0.05 * (i + 0.5)
            r = 4 - 2.5 * (x + 20) / 40
            touching = sum((x + 2) ** 2 + (r * math.cos(a) - 5) ** 2 + (r * math.sin(a) - 3) ** 2 <= 5.3 ** 2
                           for a in (math.radians(k / 2) for k in range(720)))
            best, length = max(best, touching / 2), length + (0.05 if touching else 0)
        row = self.rows("l.csv")[0]
        self.assertAlmostEqual(self.number(row, "contact_angle"), best, delta=1.0)
        self.assertAlmostEqual(self.number(row, "contact_length"), length, delta=0.1)

    def test_sessions_and_report_pages_keep_the_contact_distance(self):
        self.run_commands("lesion 0,8,0,6\nlesion-contact 0.75\nshortest-distances on\nsave s.json\nreport r.html\n")
        options = json.loads((self.folder / "s.json").read_text())["options"]
        self.assertEqual((options["lesion_contact"], options["shortest_distances"]), (0.75, True))
        page = (self.folder / "r.html").read_text()
        self.assertIn("Lesions and the nearest vessels", page)
        self.assertIn("within 0.75", page.replace("\n", " "))
        self.expect_done("render", "--session", "s.json", "--commands", self.write("d.txt", "report again.csv lesions\n"),
                         "-o", "q.png", "--size", "100x80")
        self.assertEqual(self.number(self.rows("again.csv")[0], "contact_within"), 0.75)
        session = json.loads((self.folder / "s.json").read_text())
        for key, value in (("lesion_contact", -1), ("lesion_contact", "near"), ("shortest_distances", 3)):
            with self.subTest(key, value=value):
                self.write("bad.json", json.dumps({**session, "options": {**session["options"], key: value}}))
                self.expect_failure("render", "--session", "bad.json", "-o", "no.png", says=[key])


class Pictures(Lesions):
    def test_the_line_is_drawn_between_lesion_and_vessel(self):
        self.run_commands("lesion 0,0,14,4\nsave s.json\n", "--view", "anterior")
        plain = Picture((self.folder / "p.png").read_bytes())
        self.expect_done("render", "--session", "s.json", "--shortest-distances", "--size", "320x240", "-o", "q.png")
        self.expect_done("render", "--session", "s.json", "--size", "320x240", "-o", "again.png")
        self.assertEqual((self.folder / "again.png").read_bytes(), (self.folder / "p.png").read_bytes())
        lines = Picture((self.folder / "q.png").read_bytes())
        changed = [(x, y) for y in range(240) for x in range(320) if plain.pixel(x, y)[:3] != lines.pixel(x, y)[:3]]
        self.assertGreater(len(changed), 100)
        xs = [x for x, _ in changed]
        self.assertLess(max(xs) - min(xs), 80)  # upright in the middle, with its numbers, from one vessel to the other
        self.assertLess(abs(sum(xs) / len(xs) - 160), 25)


class Inside(Lesions):
    """A lesion within an organ of any opacity is seen from outside; what hides it differs from what does not."""

    def yellow(self, lines):
        """Pixels of the outline's colour, which neither vessels nor the organ have."""
        self.run_commands("view anterior\n" + lines, "--overlays", "none")
        picture = Picture((self.folder / "p.png").read_bytes())
        found = []
        for y in range(picture.height):
            for x in range(picture.width):
                r, g, b = picture.pixel(x, y)[:3]
                if min(r, g) - b > 70 and abs(r - g) < 40:
                    found.append((x, y))
        return found

    def test_outlines_through_an_organ(self):
        self.write("organ.obj", box((-35, -25, -20), (35, 25, 50)))
        self.write("tumour.obj", box((-8, -6, 12), (6, 6, 22)))
        context = "context organ.obj\ncontext-opacity 1 %g\ncontext-colour 1 c98268\nfit\n"
        for lesion in ("lesion 0,0,16,5\n", "lesion-mesh tumour.obj\n"):
            for opacity in (0.25, 0.5, 0.75, 0.9):
                with self.subTest(lesion=lesion, opacity=opacity):
                    found = self.yellow(lesion + context % opacity)
                    self.assertGreater(len(found), 40)
                    xs, ys = [x for x, _ in found], [y for _, y in found]
                    self.assertLess(max(xs) - min(xs), 80)
                    self.assertLess(max(ys) - min(ys), 80)
        self.assertLess(len(self.yellow("lesion 0,0,16,5\n" + context % 1)), 10)  # solid is solid

    def test_a_vessel_in_front_hides_the_outline(self):
        # A lesion behind the vessel: where that passes before the outline, it is fainter.
        organ = self.write("organ.obj", box((-35, -25, -20), (35, 45, 50)))
        context = f"context {organ.name}\ncontext-opacity 1 0.5\nfit\n"
        before, behind = (len(self.yellow(f"lesion 0,{y},0,4\n" + context)) for y in (12, -12))
        self.assertGreater(before, 1.2 * behind)


class Measurements(Lesions):
    LINES = ("lesion 0,0,14,4\nmeasure distance lesion:1 branch:1\nmeasure distance lesion:1@0,0,100 0,0,30\n"
             "measure distance branch:0 lesion:1\n")

    def values(self):
        return [self.number(r, "value") if r["value"] else r["what"] for r in self.rows("m.csv")]

    def test_measurements_snap_to_lesions_and_report_it(self):
        said = self.run_commands(self.LINES + "report m.csv measurements\nsave s.json\n")
        self.assertIn("Shortest distance, lesion 1 to the wall of branch 1 at 50.0 %: 10.0 mm", said)
        self.assertIn("lesion 1 at (0, 0, 18.0) to (0, 0, 30.0): 12.0 mm", said)
        self.assertEqual(self.values(), [10, 12, 7])
        self.write("again.txt", "report m.csv measurements\nsave t.json\n")
        self.expect_done("render", "--session", "s.json", "--commands", "again.txt", "--overwrite", "-o", "q.png", "--size", "100x80")
        self.assertEqual(self.values(), [10, 12, 7])
        first, second = (json.loads((self.folder / name).read_text())["measurements"] for name in ("s.json", "t.json"))
        self.assertEqual(first, second)

    def test_measurements_follow_moved_lesions_and_are_removed_with_them(self):
        self.run_commands("lesion 20,0,80,2\n" + self.LINES.replace("lesion:1", "lesion:2") +
                          "lesion-change 2 0,0,16,6\nreport m.csv measurements\n")
        self.assertEqual(self.values(), [6, 8, 7])
        self.run_commands("lesion 20,0,80,2\n" + self.LINES.replace("lesion:1", "lesion:2") +
                          "lesion-remove 1\nreport m.csv measurements\n")
        self.assertEqual(self.values(), [10, 12, 7])  # what was lesion 2 is lesion 1 now
        said = self.run_commands(self.LINES + "measure diameter 0\nlesion-remove 1\nreport m.csv measurements\nundo\n"
                                 "save s.json\n")
        self.assertIn("Removed with 3 measurements", said)
        self.assertEqual(self.values(), [6])
        self.assertEqual(len(json.loads((self.folder / "s.json").read_text())["measurements"]), 4)
        self.run_commands(self.LINES + "measure diameter 0\nlesion-clear\nreport m.csv measurements\n")
        self.assertEqual(self.values(), [6])

    def test_a_changed_lesion_mesh_is_reported(self):
        self.write("box.obj", box((-5, -5, 10), (5, 5, 20)))
        self.run_commands("lesion-mesh box.obj\nmeasure distance lesion:1@0,0,40 0,0,28\n"
                          "measure distance lesion:1 branch:0\nsave s.json\nreport m.csv measurements\n")
        self.assertEqual(self.values()[0], 8)
        self.assertAlmostEqual(self.values()[1], 7, places=3)
        self.write("box.obj", box((-5, -5, 12), (5, 5, 24)))
        self.write("again.txt", "report m.csv measurements\n")
        self.expect_done("render", "--session", "s.json", "--commands", "again.txt", "--overwrite", "-o", "q.png", "--size", "100x80")
        moved, shortest = self.values()
        self.assertIn("no longer on lesion 1", moved)
        self.assertAlmostEqual(shortest, 9, places=3)
        (self.folder / "box.obj").unlink()
        self.expect_done("render", "--session", "s.json", "--commands", "again.txt", "--overwrite", "-o", "q.png", "--size", "100x80")
        self.assertTrue(all("has not been read" in str(value) for value in self.values()))

    def test_invalid_measurements_are_refused(self):
        for line, says in (("measure distance lesion:2 branch:0", "lesion"), ("measure distance lesion:1 branch:9", "9"),
                           ("measure distance lesion:1 0,0,0", "lesion:N@X,Y,Z"), ("measure distance 0,0,0 branch:1", "lesion"),
                           ("measure distance lesion:x@0,0,0 0,0,0", "lesion"), ("measure path lesion:1 1", "")):
            with self.subTest(line):
                self.write("c.txt", "lesion 0,0,14,4\n" + line + "\n")
                self.expect_failure("render", self.tree, "--commands", "c.txt", "-o", "no.png", says=[says])

    def test_invalid_sessions_are_refused(self):
        self.run_commands(self.LINES + "save s.json\n")
        session = json.loads((self.folder / "s.json").read_text())
        good = session["measurements"][0]
        for change, says in (({"lesions": ["sphere 0", ""]}, "sphere 0"), ({"lesions": ["cube 1", ""]}, "cube 1"),
                             ({"lesions": ["sphere 1"]}, "two"), ({"lesions": ["", ""]}, "one lesion"),
                             ({"lesions": 3}, "two"), ({"lesions": [3, ""]}, "lesion"), ({"shortest": 1}, "shortest"),
                             ({"kind": "path", "branches": [0, 1]}, "lesion")):
            with self.subTest(change):
                self.write("bad.json", json.dumps({**session, "measurements": [{**good, **change}]}))
                self.expect_failure("render", "--session", "bad.json", "-o", "no.png", says=[says])
        self.write("few.json", json.dumps({**session, "measurements": [{**good, "lesions": ["sphere 7", ""]}]}))
        self.write("again.txt", "report m.csv measurements\n")
        self.expect_done("render", "--session", "few.json", "--commands", "again.txt", "--overwrite", "-o", "q.png", "--size", "100x80")
        self.assertIn("is not there", self.values()[0])


if __name__ == "__main__":
    unittest.main()
