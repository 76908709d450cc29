"""What tests of `ramus validate` share: trees as SWC, and what stands in reports."""

import csv
import html.parser
import io


def swc(*rows):
    return "".join("{} 2 {} {} {} {} {}\n".format(n + 1, *row) for n, row in enumerate(rows))


def line(points, parent, begin, end, steps, radius):
    """Rows from the point `parent` on: x, y, z, radius, parent."""
    for i in range(1, steps + 1):
        place = [begin[k] + (end[k] - begin[k]) * i / steps for k in range(3)]
        points.append((*place, radius, parent if i == 1 else len(points)))
    return len(points)


def fork(with_leaf):
    points = [(0, 0, 0, 1.0, -1)]
    joint = line(points, 1, (0, 0, 0), (0, 0, 20), 20, 1.0)
    line(points, joint, (0, 0, 20), (0, 12, 36), 20, 1.0)
    if with_leaf:
        line(points, joint, (0, 0, 20), (0, -12, 36), 20, 1.0)
    return swc(*points)


CROSSING = swc((0, -10, 0, 1, -1), (0, 10, 0, 1, 1), (-10, 0, 1.8, 1, -1), (10, 0, 1.8, 1, 3))


TEXT_FILES = ["distances.csv", "fidelity.csv", "files.csv", "places.csv", "questions.csv", "radii.csv", "shapes.csv", "validation.json"]


class Page(html.parser.HTMLParser):
    """A page's words and elements; fails on tags that are not closed in order, and on anything from elsewhere."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.open, self.count, self.cells, self.words, self.pictures = [], {}, [], [], []
        self.feed(text)
        self.close()
        assert not self.open, self.open

    def handle_starttag(self, tag, attributes):
        self.count[tag] = self.count.get(tag, 0) + 1
        for name, value in attributes:
            assert name not in ("href", "srcset", "onload", "onclick"), name
            if name == "src":
                assert value.startswith("data:image/png;base64,"), value[:50]
                self.pictures.append(value)
        if tag not in ("meta", "img"):
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.count[tag] = self.count.get(tag, 0) + 1

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, (tag, self.open)
        self.open.pop()

    def handle_data(self, data):
        assert "script" not in self.open
        if self.open and self.open[-1] == "td":
            self.cells.append(data)
        if self.open and self.open[-1] != "style":
            self.words.append(data)


def rows_of(path):
    return list(csv.DictReader(io.StringIO(path.read_bytes().decode())))
