"""The gallery's pictures are the golden ones: each command still makes the picture that stands above it. One for each style: the
plain surface, every depth cue, glass, highlight, colours, margins, cuts and cones. When a picture is meant to change,
scripts/gallery makes it anew, and somebody looks at it."""

import pathlib
import shlex
import subprocess
import unittest

import ramus

TOP = pathlib.Path(__file__).resolve().parents[2]
GALLERY = TOP / "assets" / "gallery"
GUIDE = TOP / "assets" / "guide"
LARGEST_OF_GUIDE = 150_000  # bytes

# Of the pixels, that may differ so that an eye sees it: another rasteriser rounds edges otherwise.
NOTICEABLE = "0.0005"


def commands_of(folder):
    lines = (folder / "README.md").read_text().splitlines()
    return [shlex.split(line) for line in lines if line.startswith("    ramus render ")]


class GalleryTest(ramus.CommandLineTest):
    def test_each_command_of_the_guide_draws_a_picture(self):
        """The pictures show the whole window: they are not compared, or every word in it would be a golden one."""
        commands, drawn = commands_of(GUIDE), set()
        self.assertGreaterEqual(len(commands), 5)
        for command in commands:
            at = command.index("-o") + 1
            picture = self.folder / pathlib.Path(command[at]).name
            drawn.add(picture.name)
            command[at] = str(picture)
            with self.subTest(picture=picture.name):
                done = subprocess.run([ramus.RAMUS, *command[1:]], cwd=TOP, capture_output=True, text=True, timeout=300, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertTrue(picture.is_file())
        for picture in GUIDE.glob("*.png"):
            self.assertIn(picture.name, drawn)
            self.assertLess(picture.stat().st_size, LARGEST_OF_GUIDE, picture.name)

    def test_each_command_makes_its_picture(self):
        commands = commands_of(GALLERY)
        self.assertGreaterEqual(len(commands), 12)
        drawn = set()
        for command in commands:
            at = command.index("-o") + 1
            golden = TOP / command[at]
            drawn.add(golden.name)
            command[at] = str(self.folder / golden.name)
            with self.subTest(picture=golden.name):
                done = subprocess.run(
                    [ramus.RAMUS, *command[1:], "--reference", str(golden), "--noticeable", NOTICEABLE],
                    cwd=TOP, capture_output=True, text=True, timeout=300, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(drawn, {picture.name for picture in GALLERY.glob("*.png")})


if __name__ == "__main__":
    unittest.main()
