"""What a file does not say of unit and orientation: said by flags, kept by sessions and files, never claimed without."""

import csv
import io
import json
import unittest

from ramus import GOOD, CommandLineTest

KNOWN = "# id type x y z radius parent (mm, RAS)\n" + GOOD


class Info(CommandLineTest):
    def claims(self, *arguments):
        info = self.json("info", *arguments, "--json")
        return info["units"], info["units_said_by"], info["orientation"], info["orientation_said_by"]

    def test_the_source_of_unit_and_orientation_is_reported(self):
        self.write("bare.swc", GOOD)
        self.write("known.swc", KNOWN)
        self.assertEqual(self.claims("bare.swc"), ("unknown", "nobody", "unknown", "nobody"))
        self.assertEqual(self.claims("known.swc"), ("mm", "file", "RAS", "file"))
        self.assertEqual(self.claims("bare.swc", "--units", "cm"), ("mm", "person", "unknown", "nobody"))
        self.assertEqual(self.claims("bare.swc", "--orientation", "LPS"), ("unknown", "nobody", "RAS", "person"))

    def test_an_unknown_unit_is_not_called_mm(self):
        self.write("bare.swc", GOOD)
        for options in ([], ["--branches"], ["--contacts"]):
            text = self.expect_done("info", "bare.swc", *options).stdout
            lines = [line for line in text.splitlines() if "counts as 1 mm" not in line]  # of the notes
            self.assertNotIn(" mm", "\n".join(lines))
            self.assertRegex(text, r"length +21.7 units")
            self.assertRegex(text, r"unit +not known")
            self.assertRegex(text, r"orientation +not known")
        text = self.expect_done("info", "bare.swc", "--units", "mm", "--orientation", "RAS").stdout
        self.assertRegex(text, r"length +21.7 mm")
        self.assertRegex(text, r"unit +mm, as asked for")
        self.assertRegex(text, r"orientation +RAS, as asked for")

    def test_each_of_the_48_orientations(self):
        self.write("bare.swc", GOOD)
        lines = [("R", "L"), ("A", "P"), ("S", "I")]
        orders = [(0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)]
        mirrored = 0
        for order in orders:
            for signs in range(8):
                letters = "".join(lines[line][signs >> axis & 1] for axis, line in enumerate(order))
                info = self.json("info", "bare.swc", "--json", "--branches", "--orientation", letters)
                expected = [0.0, 0.0, 0.0]
                for axis, value in enumerate((3.0, 0.0, 15.0)):  # where the second branch ends
                    expected[order[axis]] = -value if signs >> axis & 1 else value
                self.assertEqual([v + 0.0 for v in info["branch_list"][1]["last"]], [v + 0.0 for v in expected], letters)
                mirrored += any("left-handed" in text for text in info["suspicions"])
        self.assertEqual(mirrored, 24)

    def test_invalid_orientations_are_wrong_usage(self):
        self.write("bare.swc", GOOD)
        for wrong in ("RLS", "RA", "XYZ", "RASR", ""):
            result = self.run_ramus("info", "bare.swc", "--orientation", wrong)
            self.assertEqual(result.returncode, 2, wrong)
            self.assertIn("RAS", result.stderr)


class Files(CommandLineTest):
    def test_conversion_adds_no_claims(self):
        self.write("bare.swc", GOOD)
        for name in ("again.swc", "again.json", "again.vtp", "again.vmv", "again.graphml", "again.mrk.json"):
            with self.subTest(name=name):
                self.expect_done("convert", "bare.swc", "-o", name)
                info = self.json("info", name, "--json")
                self.assertEqual((info["units"], info["orientation"]), ("unknown", "unknown"))
                self.expect_done("convert", "bare.swc", "--units", "mm", "--orientation", "LPS", "-o", name)
                info = self.json("info", name, "--json")
                self.assertEqual((info["units"], info["orientation"]), ("mm", "RAS"))

    def test_meshes_state_unit_and_orientation(self):
        self.write("bare.swc", GOOD)
        self.expect_done("mesh", "bare.swc", "-o", "bare.ply")
        head = (self.folder / "bare.ply").read_bytes()[:200]
        self.assertIn(b"unit unknown, orientation unknown", head)
        self.expect_done("mesh", "bare.swc", "-o", "said.ply", "--units", "mm", "--orientation", "RAS")
        self.assertIn(b", mm, RAS; SPACE=RAS\n", (self.folder / "said.ply").read_bytes()[:200])
        self.expect_done("mesh", "bare.swc", "-o", "bare.glb")
        self.assertIn(b'"orientation":"unknown"', (self.folder / "bare.glb").read_bytes())
        report = self.json("mesh", "bare.swc", "-o", "bare.stl", "--json")
        self.assertEqual((report["units"], report["orientation"]), ("unknown", "unknown"))

    def test_columns_have_the_same_names_whatever_the_unit(self):
        self.write("bare.swc", GOOD)
        self.write("c.txt", "select 0 1\nreport t.csv\nread-as units cm\nreport u.csv\nmeasure distance 0,0,0 0,3,4\n"
                            "report m.csv measurements\n")
        self.expect_done("render", "bare.swc", "--commands", "c.txt")
        said, mm = (list(csv.DictReader(io.StringIO((self.folder / name).read_text()))) for name in ("t.csv", "u.csv"))
        self.assertEqual(list(said[0]), list(mm[0]))
        self.assertFalse([name for name in mm[0] if "mm" in name or "unit" in name and name != "unit"])
        self.assertEqual([row["unit"] for row in said + mm], ["unknown"] * 2 + ["mm"] * 2)
        for name in ("length", "volume", "mean_diameter"):
            self.assertAlmostEqual(float(mm[0][name]), float(said[0][name]) * {"volume": 1000}.get(name, 10), places=4)

    def test_json_has_names_without_a_unit_too(self):
        self.write("bare.swc", GOOD)
        for options, unit in (((), "unknown"), (("--units", "cm"), "mm")):
            info = self.json("info", "bare.swc", "--branches", "--json", *options)
            self.assertEqual((info["unit"], info["units"]), (unit, unit))
            for name, known in (("length", "length_mm"), ("volume", "volume_mm3"), ("radius", "radius_mm")):
                self.assertEqual(info[name], info[known])
            for branch in info["branch_list"]:
                self.assertEqual((branch["length"], branch["diameter"]), (branch["length_mm"], branch["diameter_mm"]))
            found = self.json("validate", "bare.swc", "--json", *options)
            self.assertEqual(found["unit"], unit)
            self.assertEqual(found["fidelity"]["axis_offset"], found["fidelity"]["axis_offset_mm"])
            found = self.json("compare", "bare.swc", "bare.swc", "--json", *options)
            self.assertEqual((found["unit"], found["area"]), (unit, found["area_mm2"]))
            bar = self.json("render", "bare.swc", "-o", "p.png", "--json", "--size", "400x300", *options)["scale_bar"]
            self.assertEqual((bar["unit"], bar["length"]), (unit, bar["mm" if unit == "mm" else "units"]))


class Sessions(CommandLineTest):
    def test_a_session_stores_unit_and_orientation(self):
        self.write("bare.swc", GOOD)
        self.write("c.txt", "orientation PIR\nunits cm\nsave s.ramus.json\n")
        self.expect_done("render", "bare.swc", "--commands", "c.txt")
        session = json.loads((self.folder / "s.ramus.json").read_text())
        self.assertEqual(session["reading"], {"orientation": "PIR", "units": "cm"})
        self.expect_done("convert", "--session", "s.ramus.json", "-o", "said.json")
        info = self.json("info", "said.json", "--json", "--branches")
        self.assertEqual((info["units"], info["orientation"]), ("mm", "RAS"))
        # x leads to the back, y down, z to the right: (3, 0, 15) in cm.
        self.assertEqual([v + 0.0 for v in info["branch_list"][1]["last"]], [150.0, -30.0, 0.0])

    def test_an_old_session_with_axes(self):
        self.write("bare.swc", GOOD)
        self.write("c.txt", "save s.ramus.json\n")
        self.expect_done("render", "bare.swc", "--commands", "c.txt")
        session = json.loads((self.folder / "s.ramus.json").read_text())
        session["reading"] = {"axes": "lps"}
        self.write("s.ramus.json", json.dumps(session))
        self.expect_done("convert", "--session", "s.ramus.json", "-o", "said.json")
        self.assertEqual(self.json("info", "said.json", "--json")["orientation"], "RAS")

    def test_undo_of_unit_and_orientation(self):
        self.write("bare.swc", GOOD)
        self.write("c.txt", "orientation LPS\nundo\nsave a.ramus.json\nredo\nsave b.ramus.json\n")
        self.expect_done("render", "bare.swc", "--commands", "c.txt")
        self.assertNotIn("reading", json.loads((self.folder / "a.ramus.json").read_text()))
        self.assertEqual(json.loads((self.folder / "b.ramus.json").read_text())["reading"], {"orientation": "LPS"})


class Pictures(CommandLineTest):
    def differ(self, tree, reference, *options):
        return self.run_ramus("render", tree, "--size", "400x300", "--reference", reference, "--tolerance", "0.0001",
                              "-o", "actual.png", *options).returncode

    def test_a_picture_shows_sides_and_unit_only_if_they_are_known(self):
        self.write("bare.swc", GOOD)
        self.write("known.swc", KNOWN)
        for name in ("bare", "known"):
            self.expect_done("render", name + ".swc", "--size", "400x300", "-o", name + ".png")
        self.assertEqual(self.differ("bare.swc", "known.png"), 3)  # cube and scale bar
        self.assertEqual(self.differ("bare.swc", "known.png", "--units", "mm", "--orientation", "RAS"), 0)
        self.assertEqual(self.differ("bare.swc", "known.png", "--units", "mm"), 3)
        self.assertEqual(self.differ("bare.swc", "known.png", "--orientation", "RAS"), 3)

    def test_views_have_neutral_names(self):
        self.write("bare.swc", GOOD)
        self.expect_done("render", "bare.swc", "--size", "400x300", "-o", "left.png", "--view", "left")
        self.assertEqual(self.differ("bare.swc", "left.png", "--view=-x"), 0)
        self.write("c.txt", "view -x\n")
        self.assertEqual(self.differ("bare.swc", "left.png", "--commands", "c.txt"), 0)

    def test_a_mask_keeps_the_axes_of_its_file(self):
        self.write("mask.nii", b"")
        self.assertNotEqual(self.run_ramus("render", "mask.nii", "--orientation", "LPS", "-o", "p.png").returncode, 0)


class Dependency(CommandLineTest):
    def test_info_reports_that_no_branch_of_separate_vessels_depends(self):
        self.write("apart.swc", "1 2 0 0 0 1 -1\n2 2 0 0 9 1 1\n3 2 9 0 0 1 -1\n4 2 9 0 9 1 3\n")
        self.assertIs(self.json("info", "apart.swc", "--json")["dependency_known"], False)
        self.assertRegex(self.expect_done("info", "apart.swc").stdout, r"dependency +not known: separate vessels")
        self.write("tree.swc", GOOD)
        self.assertIs(self.json("info", "tree.swc", "--json")["dependency_known"], True)
        self.assertNotIn("separate vessels", self.expect_done("info", "tree.swc").stdout)


if __name__ == "__main__":
    unittest.main()
