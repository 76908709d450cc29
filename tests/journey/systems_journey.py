"""Two vessel systems in one tree: coloured at once, one hidden and shown by its eye, selected by a click, named in the
panel; all of it undone.

Usage: systems_journey.py PROGRAM
"""

import json
import sys

from screen import Window, check, click, differing, middle_of, run_journeys

# A portal vein that forks, and a hepatic vein that crosses it.
TREE = {"format": "ramus-tree", "version": 2, "units": "mm", "orientation": "RAS",
        "points": [[0, 0, -40, 5], [0, 0, 0, 5], [-25, 0, 30, 4], [25, 0, 30, 4], [-40, 4, -10, 4], [40, 4, 10, 4]],
        "branches": [[0, 1], [1, 2], [1, 3], [4, 5]], "roots": [0, 4],
        "systems": [{"name": "portal vein", "colour": [60, 110, 180]}, {"name": "hepatic vein", "colour": [200, 80, 60]}],
        "branch_systems": [0, 0, 0, 1]}
HIDE, SHOW = "Hide hepatic vein", "Show hepatic vein"
FIRST_ROW = "portal vein: click selects its 3 branches, a double click names it"
ROW = "hepatic vein: click selects its 1 branch, a double click names it"


def systems(program, screen, folder):
    tree = folder / "two systems.json"
    tree.write_text(json.dumps(TREE))
    window = Window(program, screen, folder, [tree, "--size", "1100x900"])
    try:
        status = window.wait("the surface", lambda s: s["surface_ready"])
        view = x, y, width, height = status["viewport"]

        def seen():
            window.xdotool("mousemove", x + width // 2, y + height + 10)
            window.wait("nothing under the pointer", lambda s: s["hovered"] == -1 and s["surface_ready"])
            return window.pixels(*view)

        check(status["options"]["colour_by"] == "system", "several systems are coloured by system at once")
        check({HIDE, ROW, "Colour"} <= set(status["controls"]), "the panel has a row for each")
        both = seen()

        click(window, HIDE)
        status = window.wait("it hidden", lambda s: s["states"]["hidden"] == [3] and SHOW in s["controls"])
        one = seen()
        check(0.01 < differing(both, one) < 0.5, "the eye of a system hides it in the picture")
        click(window, SHOW)
        window.wait("it back", lambda s: s["states"]["hidden"] == [] and s["surface_ready"])
        check(differing(both, seen()) < 0.001, "and shows it again as it was")

        click(window, FIRST_ROW)
        status = window.wait("the selection", lambda s: s["selection"] == [0, 1, 2])
        check(status["undo"].startswith("select system"), "a click on its name selects it")

        at = middle_of(status, ROW)
        window.xdotool("mousemove", *at, "click", "--repeat", "2", "--delay", "60", "1")
        window.wait("the field", lambda s: s["rename"])
        window.xdotool("key", "ctrl+a")
        window.xdotool("type", "vena cava")
        window.xdotool("key", "Return")
        status = window.wait("the name", lambda s: any(one["name"] == "vena cava" for one in s.get("systems", [])))
        check("Hide vena cava" in status["controls"], "a double click names it")
        window.xdotool("key", "ctrl+z")
        window.wait("its old name", lambda s: not s.get("systems"))
        check(window.quit() == 0, "the window closes")
    finally:
        window.end()


if __name__ == "__main__":
    sys.exit(run_journeys(systems, size=(1200, 950)))
