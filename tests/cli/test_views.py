"""Saved views on the command line: from commands into a session, from there into pictures and reports."""

import json
import re
import unittest

from ramus import GOOD, CommandLineTest


class SavedViews(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("commands.txt", 'view left\nview-save "behind the stem"\nturn up 30\northographic on\nview-save flat\n'
                                   "view anterior\northographic off\nsave case.json\n")
        self.expect_done("render", self.write("tree.swc", GOOD), "--commands", "commands.txt", "--size", "64x48")
        self.saved = {view["name"]: view["camera"] for view in json.loads((self.folder / "case.json").read_text())["views"]}

    def camera(self, *arguments):
        return self.json("render", "--session", "case.json", "-o", "a.png", "--size", "64x48", "--json", *arguments)["camera"]

    def test_commands_save_the_camera(self):
        self.assertEqual(list(self.saved), ["behind the stem", "flat"])
        self.assertEqual([camera["orthographic"] for camera in self.saved.values()], [False, True])

    def test_a_picture_looks_from_a_saved_view(self):
        for name, camera in self.saved.items():
            self.assertEqual(self.camera("--view", name), camera)
        self.assertNotIn(self.camera(), self.saved.values())
        self.assertNotIn(self.camera("--view", "left"), [self.saved["flat"], self.camera()])
        self.write("go.txt", "view-go flat\n")
        self.assertEqual(self.camera("--commands", "go.txt"), self.saved["flat"])

    def test_a_name_that_is_none_is_refused(self):
        render = ("render", "--session", "case.json", "-o", "b.png", "--view")
        self.expect_failure(*render, "behind the stems", says=["case.json", 'did you mean "behind the stem"?'])
        self.expect_failure(*render, "xyz", says=["case.json", "saved are behind the stem, flat"])
        self.expect_failure("render", "tree.swc", "-o", "b.png", "--view", "flat", says=["--view", "flat", "--session"],
                            status=2)
        self.expect_failure(*render, "", status=2)
        self.write("go.txt", "view-go flta\n")
        self.expect_failure("render", "--session", "case.json", "-o", "b.png", "--commands", "go.txt",
                            says=["go.txt:1", 'did you mean "flat"?'])
        self.assertNotIn("b.png", self.names())

    def test_a_session_with_a_bad_view_is_refused(self):
        session = json.loads((self.folder / "case.json").read_text())
        session["views"][1]["name"] = "behind the stem"
        self.write("twice.json", json.dumps(session))
        self.expect_failure("render", "--session", "twice.json", "-o", "b.png",
                            says=["twice.json", 'two saved views have the name "behind the stem"'])

    def test_a_report_pictures_them(self):
        self.expect_done("report", "--session", "case.json", "-o", "report.html")
        page = (self.folder / "report.html").read_text(encoding="utf-8")
        self.assertEqual(re.findall('<img alt="([^"]*)"', page),
                         ["As it was looked at", "Anterior", "Left", "behind the stem", "flat"])


if __name__ == "__main__":
    unittest.main()
