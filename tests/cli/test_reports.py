"""The report as a page, read as a browser does: its head, its pictures and its tables."""

import base64
import math
import os
import shutil
import struct
import subprocess
import unittest
from html.parser import HTMLParser

from png import Picture
from ramus import GOOD, CommandLineTest


class Page(HTMLParser):
    """Tables by heading, each as a list of rows of cells; texts of paragraphs by class; pictures by caption."""

    def __init__(self, text):
        super().__init__()
        self.tables, self.paragraphs, self.pictures = {}, {}, {}
        self.title = ""
        self._heading, self._open, self._text = "", "", ""
        self._class = ""
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        named = dict(attributes)
        if tag == "tr":
            self.tables.setdefault(self._heading, []).append([])
        if tag == "img":
            data = named["src"].removeprefix("data:image/png;base64,")
            self.pictures[named["alt"]] = base64.b64decode(data)
        if tag in ("h2", "th", "td", "p", "title"):
            self._open, self._text, self._class = tag, "", named.get("class", "")

    def handle_data(self, data):
        self._text += data

    def handle_endtag(self, tag):
        if tag != self._open:
            return
        if tag == "h2":
            self._heading = self._text
        elif tag == "p":
            self.paragraphs.setdefault(self._class, []).append(self._text)
        elif tag == "title":
            self.title = self._text
        else:
            self.tables[self._heading][-1].append(self._text)
        self._open = ""

    def column(self, table, heading):
        rows = self.tables[table]
        return [row[rows[0].index(heading)] for row in rows[1:]]


def size_of(png):
    return struct.unpack(">II", png[16:24])


def edges(picture):
    """The darkest channel along the four edges: 255 where all of them are white."""
    last = picture.height - 1
    return min(min(min(picture.pixel(x, y)) for x in range(picture.width) for y in (0, last)),
               min(min(picture.pixel(x, y)) for y in range(picture.height) for x in (0, picture.width - 1)))


WHITE = 254  # but for the noise against banding
CUBE = "".join("v %d %d %d\n" % (x, y, z) for x in (12, 16) for y in (-2, 2) for z in (-2, 2)) + \
       "".join("f %s\n" % quad for quad in ("1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4"))


class Reports(CommandLineTest):
    def page(self, lines, tree=None, size="200x150", name="page.html", options=("--units", "mm")):
        self.write("plan.txt", lines)
        self.expect_done("render", tree or self.write("tree.swc", GOOD), "--size", size, *options, "--commands", "plan.txt",
                         "--overwrite")
        return Page((self.folder / name).read_text(encoding="utf-8"))

    def test_a_case_line_is_in_the_page_and_nowhere_else(self):
        line = 'Jane <b>Doe</b>, 1961 & "left"'
        quoted = line.replace('"', '\\"')
        page = self.page(f'select 0\nreport page.html --case "{quoted}"\nsave s.json\nexport report other.html --case "{quoted}"\n'
                         'report plain.html\n')
        self.assertEqual(page.paragraphs["case"], [line])
        self.assertNotIn("Doe", page.title)
        self.assertNotIn("<b>", (self.folder / "page.html").read_text())
        self.assertEqual(Page((self.folder / "other.html").read_text()).paragraphs["case"], [line])
        self.assertNotIn("case", Page((self.folder / "plain.html").read_text()).paragraphs)
        for name in ("s.json", "plain.html"):
            self.assertFalse("Jane &" in (self.folder / name).read_text() or "Jane <" in (self.folder / name).read_text(), name)

    def test_invalid_report_options_are_refused(self):
        tree = self.write("tree.swc", GOOD)
        for line, says in (("report r.csv --case x", "page"), ("report r.html --case", "--case"),
                           ("report r.html --size 3", "size"), ("report r.html --size 0x5", "size"),
                           ("report r.html --nonsense", "report takes"), ("report r.html cuts", "everything"),
                           ("export table r.csv --case x", "case line"), ("export surface r.stl --case x", "case line")):
            with self.subTest(line):
                self.write("plan.txt", "select 0\n" + line + "\n")
                self.expect_failure("render", tree, "--size", "200x150", "--commands", "plan.txt", says=["plan.txt:2", says])
        self.assertEqual(self.names(), ["plan.txt", "tree.swc"])

    def test_pictures_are_white_and_contain_all_vessels(self):
        self.write("organ.obj", CUBE)
        # A wide picture, of which a page in another shape would cut the ends off.
        far = "1 1 0 0 0 1 -1\n" + "".join("%d 3 %d 0 %d 1 %d\n" % (n + 2, 8 * n + 8, n % 2, n + 1) for n in range(12))
        tree = self.write("wide.swc", "# mm\n" + far)
        page = self.page("select 0\nview anterior\nfit\nreport page.html\n", tree=tree, size="900x150",
                         options=("--units", "mm", "--orientation", "RAS"))
        self.assertEqual(list(page.pictures), ["As it was looked at", "Anterior", "Left"])
        self.assertEqual(size_of(page.pictures["As it was looked at"]), (1200, 200))
        for caption, png in page.pictures.items():
            picture = Picture(png)
            self.assertGreaterEqual(edges(picture), WHITE, caption)
            inside = {picture.pixel(x, y) for x in range(0, picture.width, 3) for y in range(0, picture.height, 3)}
            self.assertGreater(len(inside), 20, caption)
        # Of the surface as it is now, and of context.
        page = self.page("surface width 2.5\ncontext organ.obj\nview left\nfit\nreport page.html\n", size="300x400")
        self.assertEqual(size_of(page.pictures["As it was looked at"]), (900, 1200))
        for caption in ("Anterior", "Left"):
            self.assertGreaterEqual(edges(Picture(page.pictures[caption])), WHITE, caption)

    def test_a_picture_of_the_window_may_show_its_dialogs_for_files(self):
        tree = self.write("tree.swc", GOOD)
        for command in ("export report", "open"):
            self.write("dialog.txt", command + "\n")
            self.expect_done("render", tree, "--ui", "--size", "800x600", "--commands", "dialog.txt", "-o", "window.png")

    def test_cuts_above_the_limit_are_emphasised(self):
        self.page("cut 0 0.5\nreconstruct 1\nreport page.html\nreconstruct 9\nreport other.html\n")
        self.assertIn('<tr class="flag">', (self.folder / "page.html").read_text())
        self.assertNotIn('<tr class="flag">', (self.folder / "other.html").read_text())

    def test_the_size_of_the_picture_can_be_set(self):
        page = self.page("report page.html --size 100x50\n")
        self.assertEqual(size_of(page.pictures["As it was looked at"]), (1200, 600))

    def test_context_is_listed(self):
        self.write("organ.obj", CUBE)
        self.write("bone.ply", "ply\nformat ascii 1.0\ncomment SPACE=LPS\nelement vertex 4\nproperty float x\nproperty float y\n"
                               "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
                               "0 0 0\n4 0 0\n0 4 0\n0 0 4\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n")
        page = self.page("context organ.obj --mesh-orientation LPS\ncontext bone.ply\ncontext-colour 1 c98268\n"
                         "context-opacity 1 0.4\ncontext-hide 2\nreport page.html\n")
        self.assertEqual(page.column("Context", "File"), ["organ.obj", "bone.ply"])
        self.assertEqual(page.column("Context", "Colour")[0], "#c98268")
        self.assertEqual(page.column("Context", "Opacity, %")[0], "40")
        self.assertEqual(page.column("Context", "Shown"), ["yes", "no"])
        axes = page.column("Context", "Axes")
        self.assertEqual(axes[0], "LPS, as the user says")
        self.assertIn(axes[1], ("as the file says", "not read"))
        self.assertIn('background:#c98268', (self.folder / "page.html").read_text())
        self.assertNotIn("Context", self.page("report page.html\n").tables)

    def test_pages_use_millilitres_and_tables_cubic_millimetres(self):
        # A tube of radius 5 mm and length 100 mm: pi 25 100 = 7,854 mm3.
        tree = self.write("tube.swc", "1 1 0 0 0 5 -1\n2 3 0 0 100 5 1\n")
        page = self.page("select 0\ncut 0 0\nreport page.html\nreport rows.csv selection\n", tree=tree)
        volume = math.pi * 25 * 100
        self.assertAlmostEqual(float(page.column("Selection", "Volume, ml")[0]), volume / 1000, delta=0.005)
        self.assertAlmostEqual(float(page.column("Cuts", "Lost volume, ml")[0]), volume / 1000, delta=0.005)
        header, row = (self.folder / "rows.csv").read_text().splitlines()
        values = dict(zip(header.split(","), row.split(",")))
        self.assertAlmostEqual(float(values["volume"]), volume, delta=0.01)
        self.assertEqual(values["unit"], "mm")
        # Volumes of which none is a millilitre stay as they are, and so do units that nobody knows.
        thin = self.write("thin.swc", "1 1 0 0 0 1 -1\n2 3 0 0 10 1 1\n")
        self.assertAlmostEqual(float(self.page("select 0\nreport page.html\n", tree=thin).column(
            "Selection", "Volume, mm\u00b3")[0]), math.pi * 10, delta=0.05)
        unknown = self.page("select 0\nreport page.html\n", tree=tree, options=())
        headings = [heading for heading in unknown.tables["Selection"][0] if heading.startswith("Volume")]
        self.assertEqual(len(headings), 1)
        self.assertNotIn("ml", headings[0])


class ReportCommand(CommandLineTest):
    """`ramus report` writes what the command `report` writes."""

    def setUp(self):
        super().setUp()
        self.tree = self.write("tree.swc", GOOD)
        self.write("plan.txt", "select 0\ncut 0 0.5\n")

    def report(self, output, *options):
        return self.expect_done("report", self.tree, "--units", "mm", "--commands", "plan.txt", "--size", "300x200", "-o", output,
                                *options)

    def test_pages_and_tables(self):
        self.report("page.html", "--case", "Case 12")
        page = Page((self.folder / "page.html").read_text(encoding="utf-8"))
        self.assertEqual(page.paragraphs["case"], ["Case 12"])
        self.assertIn("Cuts", page.tables)
        self.report("cuts.csv")
        self.assertTrue((self.folder / "cuts.csv").read_text().startswith("cut,"))
        self.report("selection.csv", "--table", "selection")
        self.assertIn("diameter", (self.folder / "selection.csv").read_text().splitlines()[0])

    def test_of_a_session(self):
        self.write("save.txt", "select 0\ncut 0 0.5\nsave s.json\n")
        self.expect_done("render", self.tree, "--units", "mm", "--size", "200x150", "--commands", "save.txt")
        self.expect_done("report", "--session", "s.json", "-o", "cuts.csv")
        self.assertEqual(len((self.folder / "cuts.csv").read_text().splitlines()), 3)  # the cut, and all of them

    def test_what_cannot_be_written_is_refused(self):
        for options, says in ((("-o", "r.txt"), ".pdf"), (("-o", "no/r.html"), "no"), (("-o", "r.csv", "--case", "x"), "--case"),
                              (("-o", "r.html", "--table", "cuts"), "--table"), (("-o", "r.csv", "--table", "none"), "table")):
            with self.subTest(says):
                result = self.run_ramus("report", self.tree, *options)
                self.assertIn(result.returncode, (1, 2))
                self.assertIn(says, result.stderr)
        self.assertEqual(self.names(), ["plan.txt", "tree.swc"])

    def test_printing(self):
        if not shutil.which("weasyprint") or not shutil.which("pdftotext"):
            self.skipTest("weasyprint or pdftotext is not installed")
        self.report("page.pdf", "--case", "Case 12")
        text = subprocess.run(["pdftotext", "-layout", "page.pdf", "-"], cwd=self.folder, check=True, stdout=subprocess.PIPE,
                              text=True).stdout
        for words in ("Case 12", "Cuts", "Selection", "Not a medical device"):
            self.assertIn(words, text)
        facts = subprocess.run(["pdfinfo", "page.pdf"], cwd=self.folder, check=True, stdout=subprocess.PIPE, text=True).stdout
        self.assertIn("A4", facts)
        images = subprocess.run(["pdfimages", "-list", "page.pdf"], cwd=self.folder, check=True, stdout=subprocess.PIPE,
                                text=True).stdout.splitlines()[2:]
        resolutions = [int(line.split()[12]) for line in images if line.split()[2] == "image"]
        self.assertGreaterEqual(len(resolutions), 3)
        self.assertGreaterEqual(min(resolutions), 290)

    def test_without_a_program_that_prints(self):
        empty = self.folder / "empty"
        empty.mkdir()
        result = self.run_ramus("report", self.tree, "-o", "page.pdf", env={**os.environ, "PATH": str(empty)})
        self.assertEqual(result.returncode, 1)
        self.assertIn("weasyprint", result.stderr)
        self.assertFalse((self.folder / "page.pdf").exists())


if __name__ == "__main__":
    unittest.main()
