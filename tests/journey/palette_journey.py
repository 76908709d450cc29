"""Commands without the mouse, and the menu of its right button: the palette finds them by words and asks for arguments,
arrows lead through the menus, turn the view and leave fields alone.

Usage: palette_journey.py PROGRAM
"""

import sys

from screen import SMALL_TREE, Window, check, click, middle_of, run_journeys


def ready(status):
    return status["surface_ready"]


def palette(window, words, key="Return"):
    window.xdotool("key", "ctrl+k")
    window.wait("the palette", lambda s: s["palette"]["open"] and s["typing"])
    window.xdotool("type", words)
    if key:
        window.xdotool("key", key)


def by_words(window):
    window.wait("the tree", ready)
    palette(window, "tumour")
    window.wait("the tool for lesions", lambda s: s["tool"] == "lesion" and not s["palette"]["open"])
    check(True, "Ctrl+K, \"tumour\" and Enter take the tool that places lesions")
    window.xdotool("key", "Escape")
    window.wait("no tool", lambda s: s["tool"] != "lesion")

    palette(window, "select-diameter")
    palette_asks = window.wait("it asks for the diameters", lambda s: s["palette"]["open"] and s["typing"])
    window.xdotool("type", "3 nonsense")
    window.xdotool("key", "Return")
    window.wait("what is wrong", lambda s: s["palette"]["open"] and s["typing"] and "diameter" in s["palette"]["trouble"])
    check(palette_asks["selection"] == [], "arguments that cannot be are said, and the field stays")
    window.xdotool("key", "ctrl+a")
    window.xdotool("type", "4.5 5.5")
    window.xdotool("key", "Return")
    status = window.wait("the thin branches", lambda s: not s["palette"]["open"] and s["selection"])
    check(0 not in status["selection"], "with those that can be it runs")
    window.xdotool("key", "Escape")
    window.wait("nothing selected", lambda s: s["selection"] == [])

    palette(window, "select 999")
    window.wait("what is wrong", lambda s: s["palette"]["open"] and s["typing"] and "999" in s["palette"]["trouble"])
    window.xdotool("key", "ctrl+a")
    window.xdotool("type", "select 1")
    window.xdotool("key", "Return")
    window.wait("the branch", lambda s: not s["palette"]["open"] and s["selection"] == [1])
    check(True, "a command that is typed with its arguments runs, or says what is wrong")
    window.xdotool("key", "Escape")
    window.wait("nothing selected", lambda s: s["selection"] == [])

    palette(window, "panel surface")
    window.wait("the page of the surface", lambda s: not s["palette"]["open"] and s["page"] == "surface")
    palette(window, "panel explore")
    shown = window.wait("the first page again", lambda s: not s["palette"]["open"] and s["page"] == "explore")
    palette(window, "Side panel")
    window.wait("no panel", lambda s: not s["palette"]["open"] and s["viewport"][2] > shown["viewport"][2])
    palette(window, "Side panel")
    window.wait("the panel", lambda s: not s["palette"]["open"] and s["viewport"][2] == shown["viewport"][2])
    check(True, "the words of a command lead to its page, and the label of an entry to that entry")

    palette(window, "hide", "Escape")
    window.wait("the palette closed", lambda s: not s["palette"]["open"])
    check(not window.status()["states"]["hidden"], "Escape closes it and does nothing")


def by_pointer(window):
    other = set(window.status()["controls"])
    palette(window, "select", None)

    def rows(status):
        found = set(status["controls"]) - other - {"command", "dialog ##palette"}
        return sorted(found, key=lambda name: status["controls"][name][1])

    status = window.wait("some commands", lambda s: s["palette"]["typed"] == "select" and len(rows(s)) > 3)
    check(status["palette"]["chosen"] == 0, "the first that is found is chosen")
    window.xdotool("mousemove", *middle_of(status, rows(status)[1]))
    window.wait("the row under the pointer", lambda s: s["palette"]["chosen"] == 1)
    window.xdotool("key", "Down")
    window.wait("the row below", lambda s: s["palette"]["chosen"] == 2)
    window.xdotool("key", "ctrl+a")
    window.xdotool("type", "hide")
    window.wait("the first again", lambda s: s["palette"]["typed"] == "hide" and s["palette"]["chosen"] == 0)
    check(True, "a pointer that moves chooses, one at rest does not")
    window.xdotool("key", "Escape")
    window.wait("the palette closed", lambda s: not s["palette"]["open"])


def by_keys(window):
    before = window.status()["camera"]["position"]

    def as_before(status):
        return all(abs(a - b) < 1e-6 for a, b in zip(status["camera"]["position"], before))

    window.xdotool("key", "Left")
    window.wait("another view", lambda s: not as_before(s))
    window.xdotool("key", "Right")
    window.wait("the first view", as_before)
    check(True, "arrows turn the view, to and fro")
    palette(window, "fit", None)
    window.xdotool("key", "Left", "Left", "Escape")
    check(as_before(window.wait("the palette closed", lambda s: not s["palette"]["open"])), "in a field they are the field's")

    window.xdotool("key", "F10")
    window.wait("the first menu", lambda s: s["menu"])
    window.xdotool("key", "Down")
    window.wait("an entry of it", lambda s: s["menu"])
    window.xdotool("key", "Escape")
    status = window.wait("no menu", lambda s: not s["menu"])
    check(as_before(status), "F10 opens the menus, where arrows turn nothing")


def by_the_right_button(window):
    status = window.status()
    x, y, width, height = status["viewport"]
    window.xdotool("mousemove", x + width // 2, y + height // 2)
    status = window.wait("a branch under the pointer", lambda s: s["hovered"] >= 0)
    branch = status["hovered"]
    window.xdotool("click", 3)
    window.wait("its menu", lambda s: s["menu"] and s["selection"] == [branch])
    click(window, "menu: Hide")
    window.wait("it is hidden", lambda s: s["states"]["hidden"] == [branch] and not s["menu"])
    check(True, f"the right button selects branch {branch} and its menu hides it")
    window.xdotool("mousemove", x + 40, y + height - 160, "click", 3)
    window.wait("the view's menu", lambda s: s["menu"])
    click(window, "menu: Show all")
    window.wait("nothing is hidden", lambda s: s["states"]["hidden"] == [])
    check(True, "on the background it is the view's")


def journey(program, screen, folder):
    (folder / "tree.swc").write_text(SMALL_TREE)
    window = Window(program, screen, folder, ["tree.swc", "--size", "1280x800"])
    try:
        by_words(window)
        by_pointer(window)
        by_keys(window)
        by_the_right_button(window)
        check(window.quit() == 0, "it quits")
    finally:
        window.end()


if __name__ == "__main__":
    sys.exit(run_journeys(journey))
