"""Saved views: saved by a key under a typed name, gone back to from the panel and from the menu, named and deleted; the
session keeps them.

Usage: views_journey.py PROGRAM
"""

import json
import sys

from screen import SMALL_TREE, Window, check, click, middle_of, page, run_journeys, saved_session

SAVE = "Saves the view as it is under a name; one that has the name already is replaced. Without a name, the window asks for it."


def row(name):
    return f"{name}: a click looks from there, a double click names it"


def from_left(status):
    return status["camera"]["position"][0] < -50


def from_front(status):
    return status["camera"]["position"][1] > 50


def typed(window, name):
    """Into the dialog that asks for a name."""
    window.wait("the field for a name", lambda s: s["typing"] and "dialog ##name" in s["controls"])
    window.xdotool("key", "ctrl+a")
    window.xdotool("type", name)


def named(window, name):
    typed(window, name)
    window.xdotool("key", "Return")
    window.wait("no dialog", lambda s: "dialog ##name" not in s["controls"])


def saving(window):
    window.xdotool("key", "l")
    window.wait("the left side", from_left)
    window.xdotool("key", "ctrl+d")
    window.wait("the dialog", lambda s: "dialog ##name" in s["controls"])
    window.shot("views-dialog")
    typed(window, "anterior")
    window.xdotool("key", "Return")
    status = window.wait("the dialog still", lambda s: s["typing"])
    check("dialog ##name" in status["controls"], "the name of an anatomical view is not taken, and the field keeps the keyboard")
    named(window, "behind the vein")
    status = window.wait("the word of it", lambda s: "View saved: behind the vein" in s["notice"])
    check(status["modified"], "a view is saved under its name, as work that the session has not yet")


def going(window):
    window.xdotool("key", "a")
    window.wait("the front", from_front)
    page(window, "plan")
    window.wait("the row", lambda s: row("behind the vein") in s["controls"])
    window.shot("views-panel")
    click(window, row("behind the vein"))
    window.wait("the saved view", from_left)
    check(True, "a click on its row goes back to it")
    window.xdotool("key", "a")
    window.wait("the front", from_front)
    window.xdotool("key", "F10")
    while window.wait("a menu", lambda s: s["menu"])["open_menu"] != "View":
        window.xdotool("key", "Right")
    status = window.wait("its entries", lambda s: SAVE in s["controls"])
    x, y = middle_of(status, SAVE)
    window.xdotool("mousemove", x, y + round(1.4 * status["controls"][SAVE][3]), "click", 1)  # the entry below
    window.wait("the list", lambda s: "Go to behind the vein" in s["controls"])
    window.shot("views-menu")
    click(window, "Go to behind the vein")
    window.wait("the saved view", lambda s: from_left(s) and not s["menu"])
    check(True, "so does the menu")


def naming(window):
    status = window.wait("the row", lambda s: row("behind the vein") in s["controls"])
    window.xdotool("mousemove", *middle_of(status, row("behind the vein")), "click", "--repeat", 2, "--delay", 60, 1)
    named(window, "lesion")
    window.wait("the name", lambda s: row("lesion") in s["controls"])
    check(True, "a double click names it")
    session = saved_session(window)
    views = json.loads(session.read_text())["views"]
    check([view["name"] for view in views] == ["lesion"], "the session has it under the new name")
    check(views[0]["camera"]["position"][0] < -50, "with its camera")
    click(window, "Remove")
    window.wait("no row", lambda s: row("lesion") not in s["controls"])
    window.xdotool("key", "ctrl+z")
    window.wait("the row again", lambda s: row("lesion") in s["controls"])
    check(True, "the cross deletes it, and undo brings it back")
    return session


def journey(program, screen, folder):
    (folder / "tree.swc").write_text(SMALL_TREE)
    window = Window(program, screen, folder, [folder / "tree.swc", "--size", "1440x900"])
    try:
        window.wait("the surface", lambda s: s["all_shown"])
        saving(window)
        going(window)
        session = naming(window)
        check(window.quit() == 0, "the window closes")
    finally:
        window.end()
    window = Window(program, screen, folder, [session, "--size", "1440x900"])
    try:
        window.wait("the surface", lambda s: s["all_shown"])
        window.xdotool("key", "a")
        window.wait("the front", from_front)
        page(window, "plan")
        click(window, row("lesion"))
        window.wait("the saved view", from_left)
        check(True, "and a session that is opened again has it")
        check(window.quit() == 0, "the window closes")
    finally:
        window.end()


if __name__ == "__main__":
    sys.exit(run_journeys(journey, size=(1500, 960)))
