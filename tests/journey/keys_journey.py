"""The keyboard: + and - zoom to what the middle of the picture shows; arrows lead from menu to menu; the light theme, which
the next start knows.

Usage: keys_journey.py PROGRAM
"""

import math
import sys

from screen import SMALL_TREE, Window, check, project, run_journeys


def ready(status):
    return status["surface_ready"]


def distance(a, b):
    return math.dist(a, b)


def zoom(window):
    status = window.wait("the tree", ready)
    x, y, width, height = status["viewport"]
    # The end of the left branch comes to the middle; what the view turned about before lies elsewhere.
    place = [-40, 3, 25]
    at = project(status, place)
    middle = (x + width // 2, y + height // 2)
    window.xdotool("mousemove", *at, "mousedown", 2)
    window.xdotool("mousemove", (at[0] + middle[0]) // 2, (at[1] + middle[1]) // 2)
    window.xdotool("mousemove", *middle, "mouseup", 2)
    status = window.wait("the branch in the middle", lambda s: math.dist(project(s, place), middle) < 12)
    window.xdotool("mousemove", x + 30, y + height - 200)
    window.wait("nothing under the pointer", lambda s: s["hovered"] == -1)
    before = distance(status["camera"]["position"], place)
    for _ in range(14):
        window.xdotool("key", "plus")
    status = window.wait("near the branch", lambda s: distance(s["camera"]["position"], place) < 0.1 * before)
    check(math.dist(project(status, place), middle) < 0.25 * height, "+ comes near what the middle of the picture shows")
    check(not status["nothing_in_view"] and status["camera"]["position"][1] > 3, "and never goes through it")
    for _ in range(14):
        window.xdotool("key", "minus")
    window.wait("where it was", lambda s: abs(distance(s["camera"]["position"], place) - before) < 0.1 * before)
    check(True, "- leads back")


def menus(window):
    window.xdotool("key", "F10")
    window.wait("the first menu", lambda s: s["open_menu"] == "File")
    window.xdotool("key", "Right")
    window.wait("the next menu", lambda s: s["open_menu"] == "Edit")
    window.xdotool("key", "Right")
    window.wait("the one after it", lambda s: s["open_menu"] == "Select")
    window.xdotool("key", "Left")
    window.wait("back", lambda s: s["open_menu"] == "Edit")
    window.xdotool("key", "Left", "Left")
    window.wait("round", lambda s: s["open_menu"] == "Help")
    check(True, "arrows lead from menu to menu, round as well")
    window.xdotool("key", "Right", "Right", "Right")
    window.wait("another one", lambda s: s["open_menu"] == "Select")
    window.xdotool("key", "Down", "Escape")
    window.wait("no menu", lambda s: not s["menu"])


def light(window):
    window.xdotool("key", "ctrl+k")
    window.wait("the palette", lambda s: s["palette"]["open"] and s["typing"])
    window.xdotool("type", "light theme")
    window.xdotool("key", "Return")
    window.wait("a light window", lambda s: s["light_theme"])
    window.shot("light")
    window.xdotool("key", "b")
    window.wait("the planning half", lambda s: s["planning"])
    window.xdotool("key", "F10")
    window.wait("a menu", lambda s: s["open_menu"] == "File")
    window.shot("light menu")
    window.xdotool("key", "Escape")
    window.wait("no menu", lambda s: not s["menu"])
    check(True, "a command makes the panels light")


def journey(program, screen, folder):
    (folder / "tree.swc").write_text(SMALL_TREE)
    arguments = ["tree.swc", "--units", "mm", "--orientation", "RAS", "--size", "1180x780"]
    window = Window(program, screen, folder, arguments)
    try:
        zoom(window)
        menus(window)
        light(window)
        check(window.quit() == 0, "it quits")
    finally:
        window.end()
    window = Window(program, screen, folder, arguments)
    try:
        window.wait("the tree again", lambda s: ready(s) and s["light_theme"])
        check(True, "and the next start knows it")
    finally:
        window.end()


if __name__ == "__main__":
    sys.exit(run_journeys(journey))
