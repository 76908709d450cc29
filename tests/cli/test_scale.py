"""The scale of saved pictures: a bar is as long as it says where it says, or it is not there."""

import json
import unittest

from png import Picture
from ramus import GOOD, CommandLineTest

DIAMETER = 4.0  # mm
# A straight vessel across the picture, sloping by a thirtieth, so that its columns see every part of a pixel's height; y
# is away from the eye that stands before the patient.
TUBE = "1 0 -45 {y} -1.5 2 -1\n2 0 45 {y} 1.5 2 1\n"
WIDTH, SIZE = 240, 900


def camera(distance, **more):
    return json.dumps({"position": [0, distance, 0], "focal_point": [0, 0, 0], "view_up": [0, 0, 1], "view_angle": 30, **more})


class Scale(CommandLineTest):
    def render(self, tree, *arguments, size=f"{WIDTH}x{SIZE}"):
        # The sides of a mesh's tube are flat, and as much narrower between its edges: a thousandth at this detail.
        return self.json("render", tree, "-o", "p.png", "--size", size, "--json", "--detail", "72", "--units", "mm", *arguments)

    def thickness(self):
        """Of the vessel in the picture's middle, in pixels: what it covers of columns, added up."""
        picture = Picture((self.folder / "p.png").read_bytes())
        self.assertEqual(picture.channels, 4)
        columns = range(130, 210)  # right of the bar
        covered = sum(row[4 * x + 3] for row in picture.rows for x in columns) / 255 / len(columns)
        return covered / (1 + 1 / 30**2) ** 0.5

    def test_a_bar_measures_a_vessel_of_known_diameter(self):
        for y in (-30, 0, 30):
            self.write("tube.swc", TUBE.format(y=y))
            for distance in (140, 200, 300, 450, 640):
                with self.subTest(y=y, distance=distance):
                    report = self.render("tube.swc", "--camera", camera(distance), "--transparent", "--overlays", "scale")
                    bar = report["scale_bar"]
                    self.assertEqual(bar["at"], "middle")
                    measured = self.thickness() * bar["mm"] / bar["pixels"]
                    self.assertAlmostEqual(measured / DIAMETER, 1.0, delta=0.02)

    def test_in_parallel_projection_it_holds_everywhere(self):
        for y in (-30, 0, 30):
            self.write("tube.swc", TUBE.format(y=y))
            report = self.render("tube.swc", "--camera", camera(200, orthographic=True, scale=40), "--transparent",
                                 "--overlays", "scale")
            bar = report["scale_bar"]
            self.assertEqual((bar["at"], bar["percent"]), ("everywhere", 0))
            self.assertAlmostEqual(bar["mm"] / bar["pixels"], 80 / SIZE, places=9)
            self.assertAlmostEqual(self.thickness() * bar["mm"] / bar["pixels"] / DIAMETER, 1.0, delta=0.02)

    def test_the_depth_of_a_bar_is_stated_and_too_deep_pictures_have_none(self):
        # From 60 mm to 140 mm before the eye: more than twice as far.
        self.write("deep.swc", "1 0 -20 40 -8 2 -1\n2 0 20 40 -8 2 1\n3 0 -20 -40 8 2 -1\n4 0 20 -40 8 2 3\n")
        self.assertIsNone(self.render("deep.swc", "--camera", camera(100))["scale_bar"])
        # From 260 mm to 340 mm: 13 % of the middle.
        bar = self.render("deep.swc", "--camera", camera(300))["scale_bar"]
        self.assertEqual(bar["at"], "middle")
        self.assertAlmostEqual(bar["percent"], 14, delta=1)
        bar = self.render("deep.swc", "--camera", camera(300), "--orthographic")["scale_bar"]
        self.assertEqual((bar["at"], bar["percent"]), ("everywhere", 0))
        # Nothing in view, and no bar wanted.
        away = json.dumps({"position": [0, 300, 0], "focal_point": [0, 600, 0]})
        self.assertIsNone(self.render("deep.swc", "--camera", away)["scale_bar"])
        self.assertIsNone(self.render("deep.swc", "--orthographic", "--overlays", "cube")["scale_bar"])

    def test_pixels_refer_to_the_written_picture(self):
        self.write("tree.swc", GOOD)
        plain = self.render("tree.swc", size="450x300")["scale_bar"]
        finer = self.render("tree.swc", "--supersample", "3", size="450x300")["scale_bar"]
        self.assertEqual(finer["mm"], plain["mm"])
        self.assertAlmostEqual(finer["pixels"] / plain["pixels"], 1.0, delta=0.01)
        # Of pictures from several sides that which all have.
        for many in (["--sheet"], ["--turntable", "3"]):
            self.assertIsNone(self.render("tree.swc", *many, size="450x300")["scale_bar"])
            self.assertEqual(self.render("tree.swc", "--orthographic", *many, size="450x300")["scale_bar"]["at"], "everywhere")

    def test_compared_surfaces_share_a_bar_that_is_valid_for_both(self):
        self.write("tree.swc", GOOD)
        alone = self.render("tree.swc", "--view", "left", size="301x300")["scale_bar"]
        both = self.render("tree.swc", "--camera", json.dumps(self.render("tree.swc", "--view", "left", size="301x300")["camera"]),
                           "--compare", "side-by-side", "--methods", "cones,cs", size="603x300")["scale_bar"]
        self.assertEqual(both["mm"], alone["mm"])
        self.assertAlmostEqual(both["pixels"] / alone["pixels"], 1.0, delta=0.02)
        for mode in ("blend", "wipe"):
            self.assertEqual(self.render("tree.swc", "--compare", mode, size="301x300")["scale_bar"]["at"], "middle")


if __name__ == "__main__":
    unittest.main()
