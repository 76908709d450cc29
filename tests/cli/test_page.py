"""The page for browsers: its structure and policy, its facts against `ramus info`, its surface against `ramus mesh`."""

import array
import base64
import hashlib
import html
import json
import math
import pathlib
import re
import shutil
import subprocess
import unittest
from collections import Counter

from ply import read_ply, volume_of
from ramus import GOOD, CommandLineTest

NODE = shutil.which("node")
DECODE = pathlib.Path(__file__).with_name("decode_page.mjs")
DEMO = pathlib.Path(__file__).parents[2] / "assets" / "liver_portal_vein.swc"

# Ends an element, a comment and an attribute where it is not escaped; turns text around.
HOSTILE = "</script><script>alert(1)</script><!-- \" ' onload=x \u202e\u2066evil"


class Page:
    """The parts of a page, found as a browser finds them."""

    def __init__(self, path):
        self.text = path.read_text(encoding="utf-8")
        self.case_text = self.element(r'<script\b[^>]*\bid="case"[^>]*>')
        self.case = json.loads(self.case_text)
        self.geometry = self.element(r'<script\b[^>]*\bid="geometry"[^>]*>')
        self.script = self.element("<script>")
        self.style = self.element("<style>", "</style>")
        found = re.search(r'<meta http-equiv="Content-Security-Policy" content="([^"]*)">', self.text)
        self.policy = dict((words.split()[0], words.split()[1:]) for words in found[1].split(";"))

    def element(self, begin, end="</script>"):
        start, = re.finditer(begin, self.text)
        return self.text[start.end():self.text.index(end, start.end())]


def triples(numbers):
    return list(zip(numbers[0::3], numbers[1::3], numbers[2::3]))


class PageTest(CommandLineTest):
    def page(self, *arguments, name="case.html"):
        self.expect_done("page", *arguments, "-o", name)
        return Page(self.folder / name)

    def quick_page(self, *arguments, **options):
        """Without pictures: nothing is drawn."""
        return self.page(*arguments, "--without", "views", **options)

    def decoded(self, name="case.html"):
        """The arrays of a page as its own script decodes them."""
        if NODE is None:
            self.skipTest("SKIPPED: node is not installed")
        folder = self.folder / "decoded"
        folder.mkdir(exist_ok=True)
        subprocess.run([NODE, DECODE, self.folder / name, folder], check=True, timeout=120)
        found = {}
        for file in folder.glob("*.bin"):
            kind = "f" if file.stem.endswith(("positions", "points")) else "i"
            found[file.stem] = array.array(kind, file.read_bytes())
        return found


class Structure(PageTest):
    def test_policy_names_the_script_and_the_style_by_their_checksums(self):
        page = self.page(self.write("tree.swc", GOOD))

        def checksum(text):
            return "'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() + "'"

        self.assertEqual(page.policy["default-src"], ["'none'"])
        self.assertEqual(page.policy["script-src"], [checksum(page.script)])
        self.assertEqual(page.policy["style-src"], [checksum(page.style)])
        self.assertEqual(page.policy["img-src"], ["data:", "blob:"])
        self.assertNotIn("connect-src", page.policy)
        self.assertEqual(page.text.count("<script"), 3)

    def test_nothing_in_the_page_is_loaded(self):
        text = self.page(self.write("tree.swc", GOOD)).text
        for source in re.findall(r"\b(?:src|href|action|poster|data)\s*=\s*[\"']([^\"']*)", text):
            self.assertTrue(source.startswith(("data:", "#")), source[:80])
        self.assertNotRegex(text, r"@import|url\((?!data:|#)")
        self.assertNotIn(str(self.folder), text)

    def test_pictures_are_those_of_the_report(self):
        page = self.page(self.write("tree.swc", GOOD))
        pictures = re.findall(r'<img alt="([^"]*)" src="data:image/png;base64,([^"]*)"', page.text)
        self.assertEqual([alt for alt, _ in pictures], ["As it was looked at", "Anterior", "Left"])
        for _, picture in pictures:
            self.assertEqual(base64.b64decode(picture)[:4], b"\x89PNG")

    def test_goes_to_standard_output(self):
        tree = self.write("tree.swc", GOOD)
        result = self.expect_done("page", tree, "--without", "views", "-o", "-")
        self.assertTrue(result.stdout.startswith("<!DOCTYPE html>"))
        self.assertEqual(self.names(), ["tree.swc"])


class FactsOfThePage(PageTest):
    def test_branches_are_those_of_info(self):
        case = self.quick_page(DEMO).case
        branches = self.json("info", DEMO, "--json", "--branches")["branch_list"]
        self.assertEqual(len(case["branches"]), len(branches))
        for found, known in zip(case["branches"], branches):
            for name in ("id", "parent", "children", "generation", "strahler"):
                self.assertEqual(found[name], known[name])
            self.assertTrue(math.isclose(found["length_mm"], known["length_mm"], rel_tol=1e-6))
            for which in ("mean", "min", "max"):
                self.assertTrue(
                    math.isclose(found["diameter_mm"][which], known["diameter_mm"][which], rel_tol=1e-6))

    def test_dependents_are_one_range_of_the_order(self):
        case = self.quick_page(DEMO).case
        self.assertEqual(sorted(case["order"]), list(range(len(case["branches"]))))
        for place, branch in enumerate(case["order"]):
            below = case["order"][place + 1:place + 1 + case["dependents"][place]]
            self.assertTrue(set(case["branches"][branch]["children"]) <= set(below))
            self.assertTrue(all(case["branches"][b]["parent"] in {branch, *below} for b in below))

    def test_says_what_is_known_of_the_file(self):
        tree = self.write("tree.swc", GOOD)
        case = self.quick_page(tree, "--title", "Before the board").case
        self.assertEqual(case["title"], "Before the board")
        self.assertEqual(case["file"], "tree.swc")
        self.assertEqual(case["checksum"], hashlib.sha256(GOOD.encode()).hexdigest())
        self.assertEqual(case["claims"]["letters"], False)
        self.assertEqual(case["claims"]["unit"], "units")
        self.assertTrue(case["assumed"])
        said = self.quick_page(tree, "--units", "mm", "--orientation", "RAS").case["claims"]
        self.assertEqual((said["unit"], said["letters"]), ("mm", True))

    def test_columns_have_a_number_for_each_branch(self):
        case = self.quick_page(self.write("tree.swc", GOOD)).case
        columns = {column["key"]: column for column in case["columns"]}
        self.assertEqual(columns["length"]["values"], [branch["length_mm"] for branch in case["branches"]])
        for column in columns.values():
            self.assertEqual(len(column["values"]), 3)


VIEW_COMMANDS = """view left
view-save "{name}"
turn up 30
zoom in 3
view-save "behind the stem"
"""

SESSION_COMMANDS = """name 0 "{name}"
lesion 3,0,9,1.5
pin 0,0,5 "{name}"
measure distance 0,0,0 0,0,10
select 1
defocus
select 2
hide
cut 0 0.7
"""


class Session(PageTest):
    def session(self, name="stem"):
        tree = self.write("tree.swc", GOOD)
        self.write("commands.txt", SESSION_COMMANDS.format(name=name) + "save case.json\n")
        self.expect_done("render", tree, "--units", "mm", "--commands", "commands.txt", "--size", "64x48")
        return self.folder / "case.json"

    def test_a_session_brings_its_states_plans_and_measurements(self):
        case = self.quick_page("--session", self.session()).case
        self.assertEqual([branch["state"] for branch in case["branches"]], ["normal", "defocused", "hidden"])
        self.assertEqual(case["branches"][0]["name"], "stem")
        self.assertEqual([lesion["radius"] for lesion in case["lesions"]], [1.5])
        self.assertEqual([measurement["text"] for measurement in case["measurements"]], ["10.0 mm"])
        self.assertEqual([pin["name"] for pin in case["pins"]], ["stem"])
        plan, = case["plans"]
        self.assertEqual([(cut["branch"], cut["fraction"]) for cut in plan["cuts"]], [(0, 0.7)])
        self.assertEqual(plan["lost"], [1, 2])
        self.assertEqual(plan["lost_in_part"], [[0, 0.7, 1]])
        self.assertIn("Cuts", [table["title"] for table in case["tables"]])

    def test_hidden_branches_are_in_the_page_to_be_shown_again(self):
        self.quick_page("--session", self.session())
        first = self.decoded()["first"]
        self.assertTrue(all(first[i] < first[i + 1] for i in range(3)))

    def test_parts_are_left_out(self):
        session = self.session("Mrs Example")
        lists = {"measurements": ["measurements", "pins"], "lesions": ["lesions", "bands"], "plans": ["plans"],
                 "tables": ["tables"]}
        for part, missing in lists.items():
            page = self.quick_page("--session", session, "--without", part)
            for name in missing:
                self.assertNotIn(name, page.case, part)
        page = self.quick_page("--session", session, "--without", "names,tables")
        self.assertNotIn("Mrs Example", page.text)
        self.assertNotIn("tree.swc", page.text)
        self.assertNotIn("file", page.case)

    def test_names_are_in_no_table_of_a_page_without_names(self):
        page = self.page("--session", self.session("Mrs Example"), "--without", "names")
        self.assertTrue(page.case["tables"])
        self.assertNotIn("Mrs Example", html.unescape(page.text))
        self.assertNotIn("tree.swc", page.text)

    def viewed(self, name):
        tree = self.write("tree.swc", GOOD)
        self.write("commands.txt", VIEW_COMMANDS.format(name=name) + "save case.json\n")
        self.expect_done("render", tree, "--units", "mm", "--commands", "commands.txt", "--size", "64x48")
        return json.loads((self.folder / "case.json").read_text())["views"]

    def test_saved_views_are_in_the_page_with_their_cameras(self):
        saved = self.viewed("Mrs Example")
        self.assertEqual([view["name"] for view in saved], ["Mrs Example", "behind the stem"])
        self.assertNotEqual(saved[0]["camera"], saved[1]["camera"])
        page = self.page("--session", "case.json")
        self.assertEqual(page.case["views"], saved)
        for name in ("Mrs Example", "behind the stem"):
            self.assertIn(f'<img alt="{name}"', page.text)
        self.assertNotIn("views", self.quick_page("--session", "case.json").case)
        nameless = self.page("--session", "case.json", "--without", "names")
        self.assertEqual([view["name"] for view in nameless.case["views"]], ["View 1", "View 2"])
        self.assertEqual([view["camera"] for view in nameless.case["views"]], [view["camera"] for view in saved])
        self.assertNotIn("Mrs Example", html.unescape(nameless.text))

    def test_a_page_without_saved_views_has_no_list_of_them(self):
        self.assertNotIn("views", self.page(self.write("tree.swc", GOOD)).case)

    def test_hostile_names_of_saved_views_are_text(self):
        self.viewed("a")
        session = self.folder / "case.json"
        text = json.loads(session.read_text())
        text["views"][0]["name"] = HOSTILE
        session.write_text(json.dumps(text))
        page = self.page("--session", session)
        self.assertEqual(page.case["views"][0]["name"], HOSTILE)
        self.assertEqual(page.text.count("<script"), 3)
        self.assertEqual(page.text.count("</script>"), 3)
        self.assertNotIn("<!--", page.text)

    def test_hostile_names_are_text(self):
        quoted = HOSTILE.replace('"', '\\"')
        session = self.session("stem")
        text = json.loads(session.read_text())
        text["names"] = {"0": HOSTILE}
        session.write_text(json.dumps(text))
        hostile_tree = self.folder / "<img src=x onerror=alert(1)>.swc"
        (self.folder / "tree.swc").rename(hostile_tree)
        page = self.quick_page(hostile_tree, "--session", session, "--title", HOSTILE)
        self.assertEqual(page.case["branches"][0]["name"], HOSTILE)
        self.assertEqual(page.case["title"], HOSTILE)
        self.assertEqual(page.case["file"], hostile_tree.name)
        self.assertEqual(page.text.count("<script"), 3)
        self.assertEqual(page.text.count("</script>"), 3)
        self.assertNotIn("<!--", page.text)
        self.assertNotIn("<img src=x", page.text)
        self.assertNotIn(quoted, page.text.replace(page.case_text, ""))


class Surface(PageTest):
    def compare(self, tree):
        report = json.loads(self.expect_done("page", tree, "--without", "views", "-o", "case.html", "--json").stdout)
        self.expect_done("mesh", tree, "-o", "whole.ply")
        found = self.decoded()
        places = triples(found["positions"])
        corners = triples(found["indices"])
        self.assertEqual(len(corners), report["triangles"])
        lines = ["ply", "format ascii 1.0", f"element vertex {len(places)}", "property float x", "property float y",
                 "property float z", f"element face {len(corners)}", "property list uchar int vertex_indices",
                 "end_header"]
        lines += [f"{x:.9g} {y:.9g} {z:.9g}" for x, y, z in places] + [f"3 {a} {b} {c}" for a, b, c in corners]
        self.write("page.ply", "\n".join(lines) + "\n")
        away = self.json("compare", "whole.ply", "page.ply", "--json")["max"]
        self.assertLessEqual(away, report["largest_deviation_mm"] + 1e-6)
        return report, found, places, corners, away

    def test_the_surface_is_closed_and_as_near_as_the_page_says(self):
        _, found, places, corners, away = self.compare(self.write("tree.swc", GOOD))
        self.assertLess(away, 0.1) # of a stem with a radius of 1
        edges = Counter()
        for corner in corners:
            at = [places[v] for v in corner]
            for a, b in ((0, 1), (1, 2), (2, 0)):
                edges[at[a], at[b]] += 1
        self.assertTrue(all(edges[b, a] == count for (a, b), count in edges.items()))
        _, vertices, faces = read_ply(self.folder / "whole.ply")
        share = volume_of(places, corners) / volume_of(vertices, faces)
        self.assertGreater(share, 0.95 ** 2) # the simplifier may go a twentieth of the radius inside
        self.assertLess(share, 1.01)
        normals = found["normals"]
        for v in range(len(places)):
            self.assertAlmostEqual(math.hypot(*normals[4 * v:4 * v + 3]), 127, delta=1.5)

    def test_each_triangle_has_the_branch_of_its_vertices_in_the_mesh(self):
        _, found, places, corners, _ = self.compare(self.write("tree.swc", GOOD))
        _, vertices, _ = read_ply(self.folder / "whole.ply")
        step = 0.02
        known = {}
        for vertex in vertices:
            known.setdefault(tuple(round(x / step) for x in vertex[:3]), []).append(vertex)
        order = Page(self.folder / "case.html").case["order"]
        first, branches, compared = found["first"], found["branches"], 0
        sides = {} # of each place: the branches there; borders go through vertices of either side
        for place, branch in zip(places, branches):
            sides.setdefault(place, set()).add(branch)
        for rank, branch in enumerate(order):
            for v in set(found["indices"][first[rank]:first[rank + 1]]):
                self.assertEqual(branches[v], branch)
                if len(sides[places[v]]) > 1:
                    continue
                cell = [round(x / step) for x in places[v]]
                near = [other for dx in (-1, 0, 1) for dy in (-1, 0, 1) for dz in (-1, 0, 1)
                        for other in known.get((cell[0] + dx, cell[1] + dy, cell[2] + dz), [])
                        if math.dist(other[:3], places[v]) < 0.5 * step]
                compared += len(near)
                self.assertTrue(all(other[-1] == branch for other in near))
        self.assertGreater(compared, 100)

    def test_a_large_tree_has_fewer_triangles_for_moving(self):
        report, found, _, _, away = self.compare(DEMO)
        self.assertLess(away, 0.5)
        self.assertLess(report["triangles"], report["triangles_before"])
        self.assertEqual(found["first"][-1], len(found["indices"]))
        coarse, first = found["coarse"], found["coarse_first"]
        self.assertLess(len(coarse), 0.35 * len(found["indices"]))
        order = Page(self.folder / "case.html").case["order"]
        for rank, branch in enumerate(order):
            self.assertTrue(all(found["branches"][v] == branch for v in coarse[first[rank]:first[rank + 1]]))

    def test_centerlines_are_those_of_the_file(self):
        self.quick_page(self.write("tree.swc", GOOD))
        found = self.decoded()
        points, first = found["line_points"], found["line_first"]
        self.assertEqual(list(first), [0, 3, 5, 7])
        expected = [0, 0, 0, 1, 0, 0, 5, 1, 0, 0, 10, 0.9]
        for value, known in zip(points, expected):
            self.assertAlmostEqual(value, known, places=6)

    def test_context_is_in_the_page(self):
        tree = self.write("tree.swc", GOOD)
        self.expect_done("mesh", tree, "-o", "organ.ply")
        self.write("commands.txt", "context organ.ply\nsave case.json\n")
        self.expect_done("render", tree, "--commands", "commands.txt", "--size", "64x48")
        page = self.quick_page("--session", "case.json")
        self.assertEqual([entry["mesh"] for entry in page.case["context"]], [0])
        found = self.decoded()
        whole = volume_of(read_ply(self.folder / "organ.ply")[1], read_ply(self.folder / "organ.ply")[2])
        shown = volume_of(triples(found["mesh0_positions"]), triples(found["mesh0_indices"]))
        self.assertAlmostEqual(shown / whole, 1.0, delta=0.02)
        self.assertNotIn("context", self.quick_page("--session", "case.json", "--without", "context").case)


class Size(PageTest):
    def test_the_demo_tree_is_below_its_usual_limit(self):
        self.page(DEMO)
        self.assertLess((self.folder / "case.html").stat().st_size, 12e6)

    def test_a_page_is_no_larger_than_asked_for(self):
        whole = json.loads(self.expect_done("page", DEMO, "--without", "views,tables", "-o", "a.html",
                                            "--json").stdout)
        limit = 0.6 * whole["bytes"]
        small = json.loads(self.expect_done("page", DEMO, "--without", "views,tables", "-o", "b.html", "--size-limit",
                                            f"{limit / 1e6:.3f}", "--json").stdout)
        self.assertLessEqual((self.folder / "b.html").stat().st_size, limit)
        self.assertGreater((self.folder / "b.html").stat().st_size, 0.7 * limit)
        self.assertGreater(small["largest_deviation_mm"], 0.0)
        self.assertLess(small["triangles"], whole["triangles"])
        self.assertIn("for the size of the file", small["simplified"])
        self.assertEqual(Page(self.folder / "b.html").case["simplified"], small["simplified"])

    def test_sizes_of_the_parts_add_up(self):
        report = json.loads(self.expect_done("page", self.write("tree.swc", GOOD), "-o", "a.html", "--json").stdout)
        parts = sum(entry["bytes"] for entry in report["sizes"])
        self.assertEqual(report["bytes"], (self.folder / "a.html").stat().st_size)
        self.assertLess(parts, report["bytes"])
        self.assertGreater(parts, 0.5 * report["bytes"])


class Errors(PageTest):
    def test_says_what_is_wrong(self):
        tree = self.write("tree.swc", GOOD)
        self.expect_failure("page", tree, "-o", "case.txt", says=["case.txt", ".html"])
        self.expect_failure("page", DEMO, "--size-limit", "0.1", "-o", "case.html", says=["limit", "--size-limit"])
        self.expect_failure("page", "none.swc", "-o", "case.html", says=["none.swc"])
        self.expect_failure("page", tree, "-o", tree, says=["tree.swc"])
        self.assertEqual(self.names(), ["tree.swc"])

    def test_refuses_wrong_words(self):
        tree = self.write("tree.swc", GOOD)
        for words in (["--without", "blood"], ["--size-limit", "-1"], ["--size-limit", "much"]):
            self.expect_failure("page", tree, "-o", "case.html", *words, status=2)
        self.expect_failure("page", "-o", "case.html", status=2)
        self.expect_failure("page", tree, status=2)


if __name__ == "__main__":
    unittest.main()
