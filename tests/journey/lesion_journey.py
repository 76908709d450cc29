"""A lesion and the vessels near it: its row says how far the nearest vessel is, the line to it is drawn while the pointer is
on the row and for good when it is ticked; a right click on it hides it; a distance snaps to the lesion, and with Shift is the shortest one.

Usage: lesion_journey.py PROGRAM
"""

import json
import math
import sys

from screen import SMALL_TREE, Window, check, click, differing, middle_of, project, run_journeys

LESION = [0, 30, -20, 10]  # before the trunk, which is a straight tube of 5 mm radius: 15 mm between the two


def press(window, at, *held):
    window.xdotool("mousemove", *at)
    for key in held:
        window.xdotool("keydown", key)
    window.xdotool("click", 1)
    for key in held:
        window.xdotool("keyup", key)


def row(window):
    status = window.wait("the lesion's row", lambda s: s["lesion_vessels"] and s["planning"])
    found = status["lesion_vessels"][0]
    check(abs(found["distance"] - 15) < 0.01 and found["branch"] == 0, f"the row has the distance: {found['distance']} mm")
    words = next(words for words in status["controls"] if "Click to go there" in words)
    check("15.0 mm" in words and "no contact" in words, f"and says so: {words}")
    return words


def pointed_at(window, words):
    view = window.status()["viewport"]
    window.xdotool("mousemove", view[0] + 20, view[1] + view[3] - 20)
    before = window.pixels(*view)
    window.xdotool("mousemove", *middle_of(window.status(), words))
    window.status()
    changed = differing(before, window.pixels(*view)) * view[2] * view[3]
    check(changed > 150, f"pointing at the row shows the vessel and draws the line: {changed:.0f} pixels")
    click(window, "Draws a line with its length from each lesion to the nearest vessel of each system")
    status = window.wait("the option", lambda s: s["options"].get("shortest_distances"))
    window.xdotool("mousemove", view[0] + 20, view[1] + view[3] - 20)
    window.status()
    line = differing(before, window.pixels(*view)) * view[2] * view[3]
    check(100 < line < 20000, f"the option draws the line alone: {line:.0f} pixels")


def measured(window):
    window.xdotool("key", "m")
    window.wait("the tool", lambda s: s["tool"] == "measure-distance")
    status = window.status()
    on_lesion = project(status, [0, 40, -20])
    window.xdotool("mousemove", *on_lesion)
    status = window.wait("what is snapped to", lambda s: s["tool_texts"])
    check(status["tool_texts"][0] == "On lesion 1", f"the pointer says what it is on: {status['tool_texts'][0]}")
    press(window, on_lesion)
    press(window, project(window.status(), [0, 5, -40]))
    status = window.wait("the distance", lambda s: len(s["measured"]) == 1)
    ends = status["measurements"][0]
    check(ends["lesions"] == ["sphere 1", ""], "an end names the lesion")
    away = math.dist(ends["points"][0], LESION[:3])
    check(abs(away - LESION[3]) < 1e-4, f"and lies on its surface, {away:.6f} mm from its middle")
    press(window, on_lesion, "shift")
    press(window, project(window.status(), [0, 5, -40]))
    status = window.wait("the shortest distance", lambda s: len(s["measured"]) == 2)
    check(status["measured"][1].startswith("Shortest distance, lesion 1 to the wall of branch 0") and
          status["measured"][1].endswith(": 15.0 mm"), status["measured"][1])


def clicked_in_the_picture(window):
    """The menu of the right button is about the lesion, and its row gives it another colour."""
    on_lesion = project(window.status(), [0, 40, -20])
    window.xdotool("mousemove", *on_lesion, "click", 3)
    window.wait("the lesion's menu", lambda s: "menu: Bring to the middle" in s["controls"])
    click(window, "menu: Hide")
    window.wait("it is hidden", lambda s: s["undo"] == "hide lesion 1" and "Show" in s["controls"])
    window.xdotool("key", "ctrl+z")
    window.wait("it is shown", lambda s: s["undo"] == "" and "Show" not in s["controls"])


def journey(program, screen, folder):
    (folder / "small tree.swc").write_text(SMALL_TREE)
    (folder / "plan.ramus.json").write_text(json.dumps({"version": 1, "tree": {"path": "small tree.swc"}, "lesions": [LESION]}))
    window = Window(program, screen, folder, ["--session", "plan.ramus.json", "--units", "mm", "--orientation", "RAS",
                                              "--size", "1200x960"])
    try:
        window.wait("the surface", lambda s: s["surface_ready"])
        window.xdotool("key", "b")
        row(window)
        clicked_in_the_picture(window)
        pointed_at(window, row(window))
        measured(window)
        window.shot("lesion")
    finally:
        window.end()


if __name__ == "__main__":
    sys.exit(run_journeys(journey, size=(1240, 1000)))
