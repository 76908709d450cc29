"""What scripts/validation makes docs/VALIDATION.md of: parts, marks, artificial trees, masks, the field that it sums."""

import gzip
import math
import pathlib
import re
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "validation"))

import parts  # noqa: E402
import plots  # noqa: E402
import support  # noqa: E402
import trees  # noqa: E402


class ValidationPage(unittest.TestCase):
    def test_each_part_has_marks_command_and_text(self):
        page = (ROOT / "docs" / "VALIDATION.md").read_text(encoding="utf-8")
        for name in parts.PARTS:
            found = re.findall(f"<!-- {name} -->\n(.+?)\n<!-- end of {name} -->\n\n    scripts/validation {name}\n", page, re.S)
            self.assertEqual(len(found), 1, name)
            for figure in re.findall(r"\]\((validation/\w+\.svg)\)", found[0]):
                self.assertTrue((ROOT / "docs" / figure).is_file(), figure)

    def test_the_field_of_a_straight_vessel_has_its_radius(self):
        rows = [(0.0, 0.0, z, 2.0, n - 1) for n, z in enumerate((0.0, 20.0, 40.0))]
        segments = [(rows[row[4]], row) for row in rows if row[4] >= 0]
        self.assertAlmostEqual(support.radius_there(segments, (0, 0, 20), (1, 0, 0), support.whole, 2.0), 2.0, places=6)

    def test_a_mask_has_the_volume_of_its_vessel(self):
        rows = []
        rows.append((0.0, 0.0, 0.0, 3.0, -1))
        trees.line(rows, 0, (0, 0, 0), (0, 0, 30), 1.0, lambda _: 3.0)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "mask.nii.gz"
            trees.write_mask(path, rows, (0.5, 0.5, 1.0))
            data = gzip.decompress(path.read_bytes())
        volume = 0.25 * sum(data[352:])
        self.assertAlmostEqual(volume / (math.pi * 9.0 * (30.0 + 4.0)), 1.0, delta=0.02)

    def test_a_stenosis_has_the_stated_width(self):
        rows = trees.stenosis(0.8, 3)
        self.assertAlmostEqual(min(row[3] for row in rows), 0.4, places=3)

    def test_a_box_plot_shows_all_its_boxes(self):
        svg = plots.box_plots("title", "mm", [("a < b", 0, 1, 2, 3, 4, 5), ("c", 0, 1, 1, 1, 2, 9)])
        self.assertEqual(svg.count("<rect"), 3)
        self.assertIn("a &lt; b", svg)


if __name__ == "__main__":
    unittest.main()
