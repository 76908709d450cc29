"""Somebody who is faster than the window: all keys and buttons of a step reach it at once, before it can look up what the
first of them is on. Each takes effect in its turn, on what was meant.

Usage: hurry_journey.py PROGRAM
"""

import sys

from screen import SMALL_TREE, Window, check, click, project, run_journeys

ROOM = 110  # pixels around what is lassoed


def clicks(at, button=1):
    return ("mousemove", *at, "click", button)


def nothing_meant(window, what):
    """Back to where nothing is selected, in any state, or measured."""
    window.xdotool("key", "Escape", "Escape", "Escape", "Escape")
    status = window.wait(what, lambda s: s["tool"] == "navigate" and not s["selection"])
    while status["undo"]:
        window.xdotool("key", "ctrl+z")
        status = window.wait(what, lambda s, undo=status["undo"]: s["undo"] != undo)


def click_then_keys(window, left, trunk):
    window.xdotool(*clicks(left), "key", "h", *clicks(trunk), "key", "x")
    status = window.wait("both", lambda s: s["states"]["hidden"] and s["states"]["highlighted"])
    check(status["states"]["highlighted"] == [1] and status["states"]["hidden"] == [0],
          "what a key does is done to what was clicked before it, not after")
    nothing_meant(window, "as before")


def click_then_lasso(window, left, right):
    camera = window.status()["camera"]
    corners = [(right[0] + x * ROOM, right[1] + y * ROOM) for x, y in ((-1, -1), (-1, 1), (1, 1), (1, -1))]
    window.xdotool(*clicks(left), "key", "shift+w", *(word for corner in corners for word in clicks(corner)), "click", 3)
    status = window.wait("the lasso", lambda s: s["last_command"][:1] == ["lasso"])
    check(status["camera"] == camera, "what is clicked right after the key of the lasso turns nothing")
    check(1 not in status["selection"] and status["selection"],
          f"it is the lasso's: {status['selection']} {status['last_command']}")
    nothing_meant(window, "no lasso")


def click_then_palette(window, left):
    window.xdotool(*clicks(left), "key", "ctrl+k", "h", "x")
    status = window.wait("the palette", lambda s: s["palette"]["open"])
    states = status["states"]
    check(status["selection"] == [1] and not states["hidden"] and not states["highlighted"],
          "letters that are typed into the palette are no keys of commands")
    window.xdotool("key", "Escape")
    window.wait("no palette", lambda s: not s["palette"]["open"])
    nothing_meant(window, "nothing selected")


def menu_then_escape(window, left, trunk):
    window.xdotool(*clicks(left, 3), *clicks(trunk))
    window.wait("no menu", lambda s: s["selection"] and not s["menu"])
    window.xdotool(*clicks(left, 3), "key", "Escape")
    window.wait("no menu", lambda s: s["selection"] == [1] and not s["menu"])
    check(True, "no menu stays that was clicked beside, or sent away, before it was there")
    nothing_meant(window, "nothing selected")


def undo_what_is_held(window, trunk, left):
    window.xdotool("key", "shift+m")
    window.wait("the path tool", lambda s: s["tool"] == "measure-path")
    window.xdotool(*clicks(trunk))
    window.xdotool(*clicks(left))
    status = window.wait("the path", lambda s: len(s["measured"]) == 1)
    end = project(status, [0, 0, -30])
    window.xdotool("mousemove", *end, "mousedown", 1, "key", "ctrl+z")
    window.wait("it is undone", lambda s: not s["measured"])
    window.xdotool("mousemove", end[0] + 20, end[1] - 20, "mouseup", 1)
    status = window.wait("let go", lambda s: not s["tool_busy"])
    check(not status["measured"] and status["redo"].startswith("measure"), "what is undone while it is held is let go")
    nothing_meant(window, "no tool")


def edits_in_a_row(window, left, right):
    click(window, "Disconnect")
    before = window.wait("the tool", lambda s: s["tool"] == "disconnect")["pieces"]
    window.xdotool(*clicks(left), *clicks(right))
    status = window.wait("both came off", lambda s: s["pieces"] == before + 2)
    check(True, f"a second cut right after the first one is done, too: {status['undo']}")


def journey(program, screen, folder):
    (folder / "small tree.swc").write_text(SMALL_TREE)
    window = Window(program, screen, folder, ["small tree.swc", "--units", "mm", "--orientation", "RAS",
                                              "--size", "1200x960"])
    try:
        status = window.wait("the surface", lambda s: s["surface_ready"])
        trunk, left, right = (project(status, place) for place in ([0, 5, -30], [-30, 3, 20], [25, 3, 20]))
        click_then_keys(window, left, trunk)
        click_then_lasso(window, left, right)
        click_then_palette(window, left)
        menu_then_escape(window, left, trunk)
        undo_what_is_held(window, trunk, left)
        edits_in_a_row(window, left, right)
    finally:
        window.end()


if __name__ == "__main__":
    sys.exit(run_journeys(journey, size=(1240, 1000)))
