"""The validation in the window: it is made once its panel is open, answers the paper's questions, leads to each finding
and selects its branches, shows the radius along the branch, and follows the surface's options.

Usage: validation_journey.py PROGRAM
"""

import sys

from screen import Window, check, choose, click, page, project, run_journeys

# Two tubes of radius 1 that cross 1.8 mm apart: they overlap by 0.2.
CROSSING = "1 2 0 -10 0 1 -1\n2 2 0 10 0 1 1\n3 2 -10 0 1.8 1 -1\n4 2 10 0 1.8 1 3\n"
BLEND = "Vessels stay apart where they only press on each other, or merge wherever they come close"
MERGED = "Vessels that pass each other, and are one in the surface"


def there(status):
    return status["surface_ready"] and status["validation"]["open"] and status["validation"]["count"] >= 0


def validation(program, screen, folder):
    tree = folder / "crossing.swc"
    tree.write_text(CROSSING)
    window = Window(program, screen, folder, [tree, "--size", "1280x800"])
    try:
        status = window.wait("the surface", lambda s: s["surface_ready"])
        check(status["validation"] == {"open": False, "finding": 0, "count": -1}, "nothing is validated by itself")
        window.xdotool("key", "shift+v")
        status = window.wait("the validation", there)
        check(MERGED in status["controls"], "the panel answers the questions")
        apart = status["validation"]["count"]
        page(window, "surface")
        choose(window, BLEND, "Wherever close")
        status = window.wait("that of the other surface", lambda s: s["options"]["blend"] == "paper" and there(s)
                             and s["validation"]["count"] > apart)
        click(window, "Finding 1")
        status = window.wait("the place", lambda s: s["validation"]["finding"] == 1)
        check(status["selection"] == [0, 1], "a click selects both vessels that are merged")
        x, y, width, height = status["viewport"]
        seen = project(status, (0, 0, 0.9))
        check(abs(seen[0] - x - width / 2) <= 12 and abs(seen[1] - y - height / 2) <= 12, "and brings them to the middle")
        window.xdotool("key", "shift+t")
        window.wait("contacts in its place", lambda s: s["contacts"]["open"] and not s["validation"]["open"])
        window.xdotool("key", "shift+v")
        window.wait("the validation again", there)
        window.xdotool("key", "ctrl+z")
        window.wait("what was selected before", lambda s: s["selection"] == [])
        check(window.quit() == 0, "Ctrl+Q closes the window")
    finally:
        window.end()


if __name__ == "__main__":
    sys.exit(run_journeys(validation, size=(1300, 900)))
