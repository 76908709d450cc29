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

# Of the pixels, that may differ so that an eye sees it: another rasteriser rounds edges otherwise.
NOTICEABLE = "0.0005"


class GalleryTest(ramus.CommandLineTest):
    def test_each_command_makes_its_picture(self):
        commands = [
            shlex.split(line) for line in (GALLERY / "README.md").read_text().splitlines() if line.startswith("    ramus render ")
        ]
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
