"""The window on an older OpenGL: the same pixels at 3.3, a clear message below. Mesa plays the older driver.

Usage: versions_journey.py PROGRAM
"""

import os
import subprocess
import sys

from screen import SMALL_TREE, Window, check, run_journeys


class OpenGL:
    """Of this version, for what is started inside."""

    def __init__(self, version):
        self.names = {"MESA_GL_VERSION_OVERRIDE": version, "MESA_GLSL_VERSION_OVERRIDE": version.replace(".", "") + "0"}

    def __enter__(self):
        os.environ.update(self.names)

    def __exit__(self, *ignored):
        for name in self.names:
            del os.environ[name]


def look(program, screen, folder, version):
    (folder / "tree.swc").write_text(SMALL_TREE)
    (folder / "glass.txt").write_text("select 1\ndefocus\nselect 2\nhighlight\nselect-none\n")
    with OpenGL(version):
        window = Window(program, screen, folder,
                        [folder / "tree.swc", "--size", "900x640", "--commands", folder / "glass.txt"],
                        state=folder / version)  # that of before did not close properly
    try:
        window.xdotool("mousemove", 1190, 790)
        window.wait("the glass", lambda s: s["surface_ready"] and "defocused" in str(s.get("states", "defocused")))
        # Messages go by themselves.
        status = window.wait("rest", lambda s: s["surface_ready"] and not s["error"])
        return window.pixels(*status["viewport"])
    finally:
        window.end()


def older(program, screen, folder):
    new, old = (look(program, screen, folder, version) for version in ("4.5", "3.3"))
    apart = max(abs(a - b) for a, b in zip(new, old))
    check(len(new) == len(old) and len(set(new)) > 50, "both windows show a picture")
    check(apart <= 1, f"OpenGL 3.3 shows what 4.5 shows: at most {apart} of 255 apart")


def too_old(program, screen, folder):
    environment = dict(os.environ, DISPLAY=screen.display, LIBGL_ALWAYS_SOFTWARE="1", HOME=str(folder))
    with OpenGL("2.1"):
        result = subprocess.run([program], env=environment | {"MESA_GL_VERSION_OVERRIDE": "2.1"}, stderr=subprocess.PIPE,
                                text=True, timeout=120)
    print(result.stderr.strip())
    check(result.returncode == 1, "below 3.3 there is no window")
    for words in ("OpenGL 2.1 is too old", "3.3 is needed", "update the graphics driver", "ramus render"):
        check(words in result.stderr, f"the message has: {words}")


if __name__ == "__main__":
    sys.exit(run_journeys(older, too_old))
