"""What `ramus render` draws with: backends, versions of OpenGL, and what it says when they cannot be had."""

import json
import os
import unittest

from ramus import GOOD, CommandLineTest


class Backends(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.tree = self.write("tree.swc", GOOD)
        self.commands = self.write("glass.txt", "select 1\ndefocus\nselect 2\nhighlight\n")

    def draw(self, name, *arguments, version=None, status=0, **environment):
        """Draws into `name`; what --json printed."""
        if version:
            environment |= {"MESA_GL_VERSION_OVERRIDE": version, "MESA_GLSL_VERSION_OVERRIDE": version.replace(".", "") + "0"}
        result = self.run_ramus("render", self.tree, "-o", name, "--size", "320x240", "--commands", self.commands, "--json",
                                *arguments, env={**os.environ, **environment})
        self.assertEqual(result.returncode, status, result.stderr)
        return json.loads(result.stdout) if status == 0 else result.stderr

    def difference(self, first, second):
        """Of two pictures, by ramus itself: the largest, of 255."""
        result = self.run_ramus("render", self.tree, "-o", "again.png", "--size", "320x240", "--commands", self.commands,
                                "--reference", second, "--tolerance", "1", "--json")
        return json.loads(result.stdout)["comparison"]["largest"]

    def bytes(self, name):
        return (self.folder / name).read_bytes()

    def has_egl(self):
        result = self.run_ramus("render", self.tree, "-o", "egl.png", "--size", "32x24", "--backend", "egl")
        if result.returncode != 0:
            print("SKIPPED: no EGL here:", result.stderr.strip())
        return result.returncode == 0

    def test_json_and_verbose_name_the_backend(self):
        report = self.draw("a.png")
        self.assertEqual(report["gl"]["backend"], "osmesa")
        self.assertGreaterEqual([int(part) for part in report["gl"]["version"].split(".")], [3, 3])
        self.assertTrue(report["gl"]["renderer"])
        result = self.expect_done("render", self.tree, "-o", "b.png", "--size", "32x24", "--verbose")
        self.assertIn("drawing with osmesa: ", result.stderr)
        self.assertIn("OpenGL", result.stderr)

    def test_egl_draws_the_same_picture(self):
        if not self.has_egl():
            return
        report = self.draw("egl.png", "--backend", "egl")
        self.assertEqual(report["gl"]["backend"], "egl")
        if "llvmpipe" not in report["gl"]["renderer"]:
            print("SKIPPED: EGL draws with", report["gl"]["renderer"])
            return
        self.draw("osmesa.png")
        self.assertLessEqual(self.difference("osmesa.png", "egl.png"), 1)
        self.draw("egl33.png", "--backend", "egl", version="3.3")
        self.assertLessEqual(self.difference("osmesa.png", "egl33.png"), 1)

    def test_older_versions_draw_the_same_picture(self):
        if "llvmpipe" not in self.draw("new.png")["gl"]["renderer"]:
            print("SKIPPED: another OpenGL than Mesa's")
            return
        for version in ("4.3", "4.1", "3.3"):
            with self.subTest(version):
                self.assertEqual(self.draw("old.png", version=version)["gl"]["version"], version)
                self.assertLessEqual(self.difference("new.png", "old.png"), 1)

    def test_too_old_opengl_is_refused(self):
        says = self.draw("no.png", version="3.1", status=1)
        for words in ("OpenGL 3.1 is too old", "3.3 is needed", "install"):
            self.assertIn(words, says)
        self.assertFalse((self.folder / "no.png").exists())

    def test_without_egl(self):
        # A file that is no library, where it is looked for first.
        (self.folder / "lib").mkdir()
        (self.folder / "lib" / "libEGL.so.1").write_bytes(b"")
        says = self.draw("no.png", "--backend", "egl", status=1, LD_LIBRARY_PATH=str(self.folder / "lib"))
        for words in ("EGL cannot be loaded", "install libegl1", "--backend osmesa"):
            self.assertIn(words, says)
        # All else goes on without it.
        self.draw("a.png", LD_LIBRARY_PATH=str(self.folder / "lib"))

    def test_missing_device(self):
        if not self.has_egl():
            return
        self.assertIn("no device 63", self.draw("no.png", "--backend", "egl", "--device", "63", status=1))

    def test_wrong_usage(self):
        self.draw("no.png", "--backend", "vulkan", status=2)
        self.draw("no.png", "--device", "0", status=2)
        self.draw("no.png", "--backend", "egl", "--device", "-1", status=2)


if __name__ == "__main__":
    unittest.main()
