"""Pictures for papers, slides and videos: what stands behind the tree, how large words are, and turntables.

A video needs ffmpeg. What is told to it, and what it is given, is tested with a program of that name that keeps both.
"""

import os
import shutil
import unittest

from png import Picture
from ramus import CommandLineTest

TREE = "1 1 0 0 -20 4 -1\n2 1 0 0 0 3 1\n3 1 -15 3 12 2 2\n4 1 14 -2 15 2 2\n"

KEEPER = """#!/bin/sh
for last; do :; done
echo "$@" > "$KEPT"
cat > "$last"
"""


class Figures(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("tree.swc", TREE)

    def picture(self, *words):
        self.expect_done("render", "tree.swc", "-o", "p.png", "--size", "320x240", *words)
        return Picture((self.folder / "p.png").read_bytes())

    def test_backgrounds(self):
        white = self.picture("--background", "white", "--overlays", "none")
        self.assertEqual((white.width, white.height), (320, 240))
        self.assertEqual(white.pixel(0, 0), (255, 255, 255))
        self.assertTrue(any(white.pixel(x, 120)[0] > white.pixel(x, 120)[2] + 60 for x in range(320)), "vessels are red")
        self.assertEqual(self.picture("--background", "transparent", "--overlays", "none").part(0, 0, 1, 1)[3], 0)
        self.assertLess(self.picture("--background", "dark", "--overlays", "none").pixel(0, 0)[0], 60)
        self.assertEqual(self.picture("--background", "dark").rows, self.picture().rows)

    def test_text_is_dark_on_white_and_has_the_requested_size(self):
        def ink(*words):  # dark pixels of the corner with the caption
            picture = self.picture("--background", "white", *words)
            return sum(picture.pixel(x, y)[0] < 100 for y in range(60) for x in range(120))
        small = ink("--caption", "Liver")
        self.assertGreater(small, 20)
        self.assertGreater(ink("--caption", "Liver", "--text-size", "2"), 2 * small)
        self.assertEqual(ink(), 0)

    def test_invalid_options_are_refused(self):
        for words in (("--background", "pink"), ("--text-size", "0"), ("--background", "white", "--transparent")):
            self.assertEqual(self.run_ramus("render", "tree.swc", "-o", "p.png", *words).returncode, 2)

    def test_commands_export_turntables_and_sheets(self):
        self.write("c", "export turntable t.png --pictures 3 --size 64x48\nexport sheet s.png --size 320x240\n")
        self.expect_done("render", "tree.swc", "--commands", "c", "--size", "64x64")
        self.assertEqual([name for name in self.names() if name.endswith(".png")],
                         ["s.png", "t_001.png", "t_002.png", "t_003.png"])
        self.assertEqual(Picture((self.folder / "t_002.png").read_bytes()).width, 64)
        self.assertEqual(Picture((self.folder / "s.png").read_bytes()).width, 320)

    def video(self, path=None):
        environment = dict(os.environ, KEPT=str(self.folder / "kept"))
        environment["PATH"] = path or environment["PATH"]
        return self.run_ramus("render", "tree.swc", "-o", "v.mp4", "--turntable", "3", "--size", "64x48", env=environment)

    def test_names_of_other_formats(self):
        for name, words in (("p.gif", ()), ("p.jpg", ()), ("v.webm", ("--turntable", "3")), ("p.mp4", ())):
            self.expect_failure("render", "tree.swc", "-o", name, "--size", "64x48", *words, says=[name, "PNG", ".png"])
        self.assertEqual([n for n in self.names() if n.startswith(("p", "v"))], [])
        self.expect_done("render", "tree.swc", "-o", "P.PNG", "--size", "64x48")

    def test_a_video_without_ffmpeg(self):
        done = self.video(str(self.folder))
        self.assertEqual(done.returncode, 1)
        self.assertIn("ffmpeg is not installed", done.stderr)
        self.assertNotIn("v.mp4", self.names())

    def test_what_ffmpeg_is_given(self):
        keeper = self.folder / "bin" / "ffmpeg"
        keeper.parent.mkdir()
        keeper.write_text(KEEPER)
        keeper.chmod(0o755)
        done = self.video(f"{keeper.parent}:/usr/bin:/bin")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "v.mp4").stat().st_size, 3 * 64 * 48 * 4)  # three pictures, four bytes a pixel
        words = (self.folder / "kept").read_text()
        for part in ("-s 64x48", "-pix_fmt rgba", "-r 30", "libx264"):
            self.assertIn(part, words)
        (self.folder / "v.mp4").unlink()
        keeper.write_text("#!/bin/sh\necho no such encoder >&2\nexit 1\n")
        done = self.video(f"{keeper.parent}:/usr/bin:/bin")
        self.assertEqual(done.returncode, 1)
        self.assertIn("no such encoder", done.stderr)
        self.assertNotIn("v.mp4", self.names())

    def test_a_video(self):
        if shutil.which("ffmpeg") is None:
            self.skipTest("ffmpeg is not installed")
        done = self.video()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(b"ftyp", (self.folder / "v.mp4").read_bytes()[:64])


if __name__ == "__main__":
    unittest.main()
