"""What a file does not say: a bare SWC opens with a neutral cube and a question; what is chosen shows at once in the cube,
and is taken as one step of undo that the session keeps. Warnings are counted until they are read, and what was undone
survives Escape.

Usage: orientation_journey.py PROGRAM
"""

import json
import sys

from screen import SMALL_TREE, Window, check, choose, click, run_journeys, saved_session

SIDES = {"x": "Which side of the patient x leads to", "y": "Which side of the patient y leads to",
         "z": "Which side of the patient z leads to"}
UNIT = "What one unit of the file's numbers is"


def cube_of(window):
    """The lower right corner of the picture."""
    x, y, width, height = window.status()["viewport"]
    return window.pixels(x + width - 130, y + height - 130, 130, 130)


def question(window):
    status = window.wait("the question", lambda s: s["surface_ready"] and s["units_panel"])
    check(status["claims"] == {"units": "unknown", "orientation": "unknown"}, "nothing is claimed of a bare file")
    neutral = cube_of(window)
    choose(window, SIDES["x"], "posterior (P)")
    choose(window, SIDES["y"], "inferior (I)")
    window.wait("the list is closed", lambda s: "right (R)" not in s["controls"])
    click(window, SIDES["z"])
    status = window.wait("the list of z", lambda s: "left (L)" in s["controls"])
    check("right (R)" in status["controls"] and "anterior (A)" not in status["controls"],
          "a side on a line that is taken is not offered")
    click(window, "right (R)")
    choose(window, UNIT, "Centimetres (cm)")
    check(cube_of(window) != neutral, "the cube shows the choice before it is taken")
    check(window.status()["claims"]["orientation"] == "unknown", "which claims nothing yet")
    click(window, "Take")
    status = window.wait("the answer", lambda s: s["claims"] == {"units": "mm", "orientation": "RAS"} and s["surface_ready"])
    check(status["reading"] == {"orientation": "PIR", "units": "cm"} and not status["units_panel"], "the answer is taken")
    check(status["undo"].startswith("read as"), "as one step of undo")
    window.xdotool("key", "ctrl+z")
    window.wait("nothing said", lambda s: s["claims"]["orientation"] == "unknown" and s["surface_ready"])
    window.xdotool("key", "Escape")
    window.xdotool("key", "ctrl+shift+z")
    window.wait("said again", lambda s: s["claims"]["orientation"] == "RAS" and s["surface_ready"])
    check(True, "undo takes it back, redo gives it again, Escape in between costs nothing")


def undo_survives(window):
    """Selecting and deselecting leave what was undone."""
    status = window.status()
    x, y, width, height = status["viewport"]
    window.xdotool("key", "ctrl+i")  # all branches
    window.wait("a selection", lambda s: s["undo"])
    window.xdotool("key", "h")
    window.wait("highlighted", lambda s: s["undo"].startswith("highlight"))
    window.xdotool("key", "ctrl+z")
    window.wait("not highlighted", lambda s: s["redo"].startswith("highlight"))
    window.xdotool("key", "Escape")
    status = window.wait("no selection", lambda s: not s["undo"].startswith("highlight"))
    check(status["redo"].startswith("highlight"), "deselecting leaves what was undone")
    window.xdotool("key", "ctrl+shift+z")
    window.wait("highlighted again", lambda s: s["undo"].startswith("highlight"))
    check(True, "and it is redone")


def warnings(window):
    status = window.wait("the count", lambda s: s["warnings"]["unread"] > 0)
    unread = status["warnings"]["unread"]
    window.xdotool("mousemove", 400, 400)
    window.xdotool("mousemove", 420, 380)
    check(window.wait("rest", lambda s: True)["warnings"]["unread"] == unread, "hovering takes no warning away")
    click(window, "Warnings")
    window.wait("the list", lambda s: s["warnings"]["open"])
    click(window, f"Read warning {status['warnings']['count']}")
    window.wait("one less", lambda s: s["warnings"]["unread"] == unread - 1)
    if unread > 1:
        click(window, "Read all warnings")
    window.wait("none", lambda s: s["warnings"]["unread"] == 0)
    check(True, "read warnings leave the count, one or all")
    window.xdotool("key", "Escape")
    window.wait("the list is closed", lambda s: not s["warnings"]["open"])


def orientation(program, screen, folder):
    tree = folder / "bare.swc"
    tree.write_text(SMALL_TREE.split("\n", 1)[1])
    window = Window(program, screen, folder, [tree, "--size", "1200x800"])
    try:
        question(window)
        undo_survives(window)
        warnings(window)
        session = saved_session(window)
        check(json.loads(session.read_text())["reading"] == {"orientation": "PIR", "units": "cm"}, "the session keeps both")
        check(window.quit() == 0, "Ctrl+Q closes the window")
    finally:
        window.end()
    window = Window(program, screen, folder, [session, "--size", "1200x800"])
    try:
        status = window.wait("the session", lambda s: s["surface_ready"])
        check(status["claims"] == {"units": "mm", "orientation": "RAS"} and not status["units_panel"],
              "it opens with both, and does not ask again")
        check(window.quit() == 0, "and closes again")
    finally:
        window.end()


if __name__ == "__main__":
    sys.exit(run_journeys(orientation, size=(1300, 900)))
