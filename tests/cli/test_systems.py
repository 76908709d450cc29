"""Vessel systems on the command line: listed, chosen by name, apart from each other in meshes and in colours."""

import csv
import json
import struct
import unittest

from png import Picture
from ramus import CommandLineTest

# Two vessels of 2 mm radius whose axes are 2 mm apart: together in one system they are one piece.
TREE = {"format": "ramus-tree", "version": 2, "units": "mm", "orientation": "RAS",
        "points": [[-10, 0, 0, 2], [10, 0, 0, 2], [-10, 0, 2, 2], [10, 0, 2, 2]],
        "branches": [[0, 1], [2, 3]], "roots": [0, 2],
        "systems": [{"name": "portal vein", "colour": [60, 110, 180]}, {"name": "hepatic vein", "colour": [200, 80, 60]}],
        "branch_systems": [0, 1]}


def read_scene(path):
    """The JSON part of a GLB file."""
    data = path.read_bytes()
    length, = struct.unpack_from("<I", data, 12)
    return json.loads(data[20:20 + length])


class Systems(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.tree = self.write("two.json", json.dumps(TREE))

    def test_info_lists_systems(self):
        report = self.json("info", self.tree, "--json", "--branches")
        self.assertEqual(report["systems"], ["portal vein", "hepatic vein"])
        self.assertEqual([(s["name"], s["colour"], s["branches"], s["length_mm"]) for s in report["system_list"]],
                         [("portal vein", "#3c6eb4", 1, 20.0), ("hepatic vein", "#c8503c", 1, 20.0)])
        self.assertEqual([b["system"] for b in report["branch_list"]], ["portal vein", "hepatic vein"])
        text = self.expect_done("info", self.tree, "--branches").stdout
        self.assertIn("  hepatic vein: 1 branch, 20.0 mm, #c8503c\n", text)
        self.assertIn("portal vein", text.splitlines()[-2])

    def test_each_system_has_a_surface_of_its_own(self):
        self.assertEqual(self.json("mesh", self.tree, "-o", "a.ply", "--json")["components"], 2)
        joined = {key: value for key, value in TREE.items() if "systems" not in key}
        one = self.json("mesh", self.write("one.json", json.dumps(joined)), "-o", "b.ply", "--blend", "paper", "--json")
        self.assertEqual(one["components"], 1)

    def test_a_system_is_chosen_by_name_or_number(self):
        whole = self.json("mesh", self.tree, "-o", "a.ply", "--json")
        portal = self.json("mesh", self.tree, "--system", "Portal Vein", "-o", "b.ply", "--json")
        hepatic = self.json("mesh", self.tree, "--system", "2", "-o", "c.ply", "--json")
        self.assertEqual(portal["triangles"] + hepatic["triangles"], whole["triangles"])
        both = self.json("mesh", self.tree, "--system", "1", "--system", "2", "-o", "d.ply", "--json")
        self.assertEqual(both["triangles"], whole["triangles"])
        self.expect_failure("mesh", self.tree, "--system", "artery", "-o", "e.ply",
                            says=["artery", "portal vein", "two.json"])
        self.assertNotIn("e.ply", self.names())

    def test_names_and_colours_go_through_commands_sessions_and_reports(self):
        commands = self.write("commands.txt", 'name-system 1 "V. portae"\ncolour-system 1 102030\nhide-system 2\n'
                                              "colour-by system\nsave s.ramus.json\nreport r.csv systems\n")
        self.expect_done("render", self.tree, "--commands", commands, "--size", "64x48")
        session = json.loads((self.folder / "s.ramus.json").read_text())
        self.assertEqual(session["systems"], [{"name": "V. portae", "colour": "#102030"},
                                              {"name": "hepatic vein", "colour": "#c8503c"}])
        self.assertEqual(session["states"]["hidden"], [1])
        with open(self.folder / "r.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([(r["system"], r["visible_branches"]) for r in rows], [("V. portae", "1"), ("hepatic vein", "0")])
        part = self.json("mesh", "--session", "s.ramus.json", "-o", "a.ply", "--json")
        self.assertEqual(part["components"], 1)

    def test_written_files_have_the_names_and_colours_of_the_session(self):
        commands = self.write("commands.txt", 'name-system 1 "V. portae"\ncolour-system 1 102030\nsave s.ramus.json\n'
                                              "export tree exported.json\nexport surface exported.glb --parts system\n")
        self.expect_done("render", self.tree, "--commands", commands, "--size", "64x48")
        self.expect_done("convert", "--session", "s.ramus.json", "-o", "converted.json")
        for name in ("exported.json", "converted.json"):
            written = json.loads((self.folder / name).read_text())
            self.assertEqual(written["systems"], [{"name": "V. portae", "colour": [16, 32, 48]}, TREE["systems"][1]])
        self.expect_done("mesh", "--session", "s.ramus.json", "--parts", "system", "-o", "meshed.glb")
        for name in ("exported.glb", "meshed.glb"):
            scene = read_scene(self.folder / name)
            self.assertEqual([node["name"] for node in scene["nodes"] if "mesh" in node], ["V. portae", "hepatic vein"])
            self.assertEqual([material["name"] for material in scene["materials"]], ["V. portae", "hepatic vein"])
            red, green, blue = scene["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][:3]
            self.assertTrue(red < green < blue < 0.05, (red, green, blue))  # linear

    def test_convert_writes_one_system(self):
        self.expect_done("convert", self.tree, "--system", "hepatic vein", "-o", "one.json")
        self.assertEqual([(s["name"], s["branches"]) for s in
                          self.json("info", "one.json", "--json")["system_list"] if s["branches"]], [("hepatic vein", 1)])
        self.expect_done("convert", self.tree, "--system", "1", "--system", "2", "-o", "both.json")
        self.assertEqual(self.json("info", "both.json", "--json")["branches"], 2)
        self.expect_failure("convert", self.tree, "--system", "artery", "-o", "x.json", says=["artery", "portal vein"])

    def test_pictures_are_coloured_by_system_at_once(self):
        for name, options in {"at_once.png": [], "asked.png": ["--colour-by", "system"],
                              "plain.png": ["--colour-by", "nothing"]}.items():
            self.expect_done("render", self.tree, "-o", name, "--size", "160x120", *options)
        pictures = {name: (self.folder / name).read_bytes() for name in ("at_once.png", "asked.png", "plain.png")}
        self.assertEqual(pictures["at_once.png"], pictures["asked.png"])
        self.assertNotEqual(pictures["at_once.png"], pictures["plain.png"])
        # From the front the hepatic vein lies above the other, half in it: each is seen in its own colour.
        picture = Picture(pictures["at_once.png"])
        colours = [picture.pixel(x, y) for y in range(40, 80) for x in range(40, 120)]
        blue = sum(b > 1.3 * r for r, g, b, *_ in colours)
        red = sum(r > 1.3 * b for r, g, b, *_ in colours)
        self.assertGreater(blue, 100)
        self.assertGreater(red, 100)
        self.expect_failure("render", self.tree, "-o", "x.png", "--colour-by", "weather", says=["weather"])


if __name__ == "__main__":
    unittest.main()
