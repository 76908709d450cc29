"""A window looks at its events again within a tenth of a second, whatever was asked of it: on a tree that is large enough
for what goes through all of a surface to show. In time that the window's own thread is on a processor, so that a busy
machine changes little, from the start on and with nothing in the graphics driver's cache: it compiles a shader when that
is used for the first time.

Usage: gaps_journey.py PROGRAM
"""

import os
import subprocess
import sys

from screen import Window, check, run_journeys

PROMISED = 0.1  # seconds


def rested(status):
    return status["surface_ready"]


def steps(window):
    """Each by its name; the window rests after each."""
    def press(*keys):
        window.xdotool("key", *keys)

    def look(key):
        camera = window.status()["camera"]
        press(key)
        window.wait("another view", lambda s: s["camera"] != camera)

    def resize(width, height):
        window.xdotool("search", "--name", "ramus", "windowsize", width, height)
        window.wait("another size", lambda s: s["window"] == [width, height])

    yield "all in the picture", lambda: press("f")
    yield "another view", lambda: look("l")
    yield "the first view", lambda: look("a")
    yield "all selected", lambda: press("ctrl+i")
    yield "all glass", lambda: press("g")
    yield "undo", lambda: press("ctrl+z")
    yield "nothing selected", lambda: press("Escape")
    yield "the overview", lambda: press("t")
    yield "no overview", lambda: press("t")
    yield "a smaller window", lambda: resize(1000, 700)
    yield "a larger window", lambda: resize(1100, 760)


def answers_in_time(program, screen, folder):
    tree = folder / "grown.swc"
    subprocess.run([program, "grow", "-o", tree, "--branches", "3000"], check=True)
    os.environ["XDG_CACHE_HOME"] = str(folder / "nothing in it")
    window = Window(program, screen, folder, [tree])
    try:
        if window.wait("the surface", rested)["units_panel"]:
            window.xdotool("key", "Escape")
        longest = {"the start": window.wait("the first rest", rested)["longest_gap"]["processor_seconds"]}
        for name, take in steps(window):
            known = {gap["ended"] for gap in window.wait(f"rest before: {name}", rested)["gaps"]}
            take()
            window.wait(f"rest after: {name}", rested)
            window.xdotool("key", "shift")  # its last gap is in the next status
            gaps = window.wait(f"the gaps of: {name}", rested)["gaps"]
            longest[name] = max([gap["processor_seconds"] for gap in gaps if gap["ended"] not in known], default=0.0)
        slowest = max(longest, key=longest.get)
        check(longest[slowest] < PROMISED,
              f"the window answers within {PROMISED} s: longest {longest[slowest]:.3f} s, {slowest}")
    finally:
        window.end()


sys.exit(run_journeys(answers_in_time))
