"""Contacts in the window: they are found by themselves, the list leads to each and selects both vessels, marks them in
the picture, follows the smoothing; the blend merges vessels; undo and the session keep what was chosen.

Usage: contacts_journey.py PROGRAM
"""

import json
import sys

from screen import Window, check, choose, click, page, project, run_journeys, saved_session, slide

# Tubes of radius 1. The first has a bend of 1 mm, 0.5 after one pass of smoothing, under one that is 2.5 mm high: they
# touch, or overlap by 0.5 without smoothing. The last two overlap by 0.2. Voxels are so large that smoothing reaches from
# end to end.
TUBES = """# id type x y z radius parent (unknown, unknown) voxel 100 0 0 0 100 0 0 0 100
1 2 0 -10 0 1 -1
2 2 0 0 1 1 1
3 2 0 10 0 1 2
4 2 -10 0 2.5 1 -1
5 2 10 0 2.5 1 4
6 2 30 -10 0 1 -1
7 2 30 10 0 1 6
8 2 20 0 1.8 1 -1
9 2 40 0 1.8 1 8
"""
LINE = "Lists where vessels press on each other without being connected there"
MARK = "Rings where vessels press on each other: yellow where they overlap, else blue"
BLEND = "Vessels stay apart where they only press on each other, or merge wherever they come close"
SMOOTH = "Passes against the steps of voxels: no point moves by more than half a voxel"


def ready(status):
    return status["surface_ready"] and status["contacts"]["count"] == 2


def yellow(window, status):
    """Pixels of the rings around overlaps in the picture."""
    x, y, width, height = status["viewport"]
    pixels = window.pixels(x + 360, y, width - 360, height)  # beside the list
    return sum(1 for i in range(0, len(pixels), 3)
               if pixels[i] > 200 and pixels[i + 1] > 195 and pixels[i + 2] < 150)


def listed(window):
    """The line in the side panel opens the list; it and the import doctor give way to each other."""
    status = window.wait("two contacts", ready)
    check(not status["contacts"]["open"], "contacts are found, and nothing opens by itself")
    click(window, LINE)
    window.wait("the list", lambda s: s["contacts"]["open"] and not s["doctor"]["open"])
    window.xdotool("key", "shift+d")
    window.wait("the doctor", lambda s: s["doctor"]["open"] and not s["contacts"]["open"])
    window.xdotool("key", "shift+t")
    window.wait("the list", lambda s: s["contacts"]["open"] and not s["doctor"]["open"])
    check(True, "a click or Shift+T opens the list in the doctor's place")


def places(window):
    for number, branches, at in ((1, [2, 3], (30, 0, 0.9)), (2, [0, 1], (0, 0, 1.5))):
        click(window, f"Contact {number}")
        status = window.wait("the place", lambda s: s["contacts"]["contact"] == number)
        check(status["selection"] == branches, f"contact {number} is between branches {branches}")
        x, y, width, height = status["viewport"]
        seen = project(status, at)
        check(abs(seen[0] - x - width / 2) <= 2 and abs(seen[1] - y - height / 2) <= 2, "in the middle of the picture")


def marks(window):
    click(window, "Contact 1")
    status = window.wait("the place", lambda s: s["contacts"]["contact"] == 1)
    window.xdotool("key", "Escape")
    status = window.wait("no list", lambda s: not s["contacts"]["open"])
    check(yellow(window, status) == 0, "without the list and marks there is no ring")
    window.xdotool("key", "shift+t")
    window.wait("the list", lambda s: s["contacts"]["open"])
    click(window, MARK)
    status = window.wait("marks", lambda s: s["options"].get("contact_marks"))
    check(status["undo"] == "contact marks on", "marks are a step of undo")
    seen = yellow(window, status)
    check(seen > 40, f"a ring is drawn: {seen} pixels")


def blends(window):
    before = window.status()["triangles"]
    page(window, "surface")
    choose(window, BLEND, "Wherever close")
    status = window.wait("vessels merged", lambda s: s["options"]["blend"] == "paper" and ready(s))
    check(status["undo"] == "surface blend paper" and status["triangles"] != before, "the surface is another")
    window.xdotool("key", "ctrl+z")
    status = window.wait("vessels apart", lambda s: s["options"]["blend"] == "tree" and ready(s))
    check(status["triangles"] == before, "undo brings the one before back")
    window.xdotool("key", "ctrl+shift+z")
    window.wait("vessels merged", lambda s: s["options"]["blend"] == "paper" and ready(s))


def wiped(window):
    click(window, "Wipe contact 1")
    status = window.wait("both ways", lambda s: s.get("comparison", {}).get("mode") == "wipe" and ready(s))
    check(status["comparison"]["surfaces"] == ["paper", "tree"] and status["contacts"]["contact"] == 1,
          "one click shows a contact both ways")
    x, y, width, height = status["viewport"]
    at = (int(x + width / 2), int(y + height - 60))
    window.xdotool("mousemove", *at, "mousedown", 1, "mousemove", at[0] + 40, at[1], "mousemove", at[0] + 100, at[1],
                   "mouseup", 1)
    status = window.wait("the line", lambda s: s["comparison"].get("wipe", 0.5) > 0.5)
    check(abs(status["comparison"]["wipe"] - (0.5 + 100 / width)) < 0.01, "the line is dragged to where the pointer is")
    check(status["undo"].startswith("compare wipe"), "as one step of undo")
    click(window, "Wipe contact 1")
    window.wait("one surface", lambda s: s.get("comparison", {"mode": "off"})["mode"] == "off")


def follows(window):
    slide(window, SMOOTH, 0.0)
    window.wait("no smoothing", lambda s: s["options"]["smooth"] == 0 and ready(s))
    click(window, "Contact 1")
    status = window.wait("the place", lambda s: s["contacts"]["contact"] == 1)
    check(status["selection"] == [0, 1], "unsmoothed, other vessels are the closest")


def contacts(program, screen, folder):
    tree = folder / "tubes.swc"
    tree.write_text(TUBES)
    window = Window(program, screen, folder, [tree, "--size", "1200x800"])
    try:
        listed(window)
        places(window)
        marks(window)
        blends(window)
        wiped(window)
        follows(window)
        session = saved_session(window)
        options = json.loads(session.read_text())["options"]
        check(options["blend"] == "paper" and options["contact_marks"], "the session keeps the blend and the marks")
        check(window.quit() == 0, "Ctrl+Q closes the window")
    finally:
        window.end()


if __name__ == "__main__":
    sys.exit(run_journeys(contacts, size=(1300, 900)))
