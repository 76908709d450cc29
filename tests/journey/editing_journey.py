"""A false connection is cut with the mouse, put back by undo, cut again; the session written out as a tree.

Usage: editing_journey.py PROGRAM
"""

import json
import subprocess
import sys

from screen import SMALL_TREE, Window, check, click, differing, project, run_journeys, saved_session

ON_RIGHT = [10, 2.5, 7.5]  # on the right side's trunk


def still(window):
    """The surface there, the pointer away from it."""
    x, y, width, height = window.status()["viewport"]
    window.xdotool("mousemove", x + width // 2, y + height + 10)
    window.wait("the surface", lambda s: s["surface_ready"] and s["hovered"] == -1 and s["resting"])
    return window.pixels(x, y, width, height)


def take_tool(window, label, name):
    click(window, label)
    window.wait("the tool " + name, lambda s: s["tool"] == name)


def point(window, place):
    at = project(window.status(), place)
    window.xdotool("mousemove", *at)
    window.xdotool("mousemove", at[0] + 1, at[1])


def editing(program, screen, folder):
    tree = folder / "small tree.swc"
    tree.write_text(SMALL_TREE)
    window = Window(program, screen, folder, [tree, "--size", "1100x800"])
    try:
        window.wait("the surface", lambda s: s["surface_ready"])
        check(window.status()["pieces"] == 1, "one piece at first")
        branches = window.status()["branch_count"]
        take_tool(window, "Disconnect", "disconnect")
        whole = still(window)
        point(window, ON_RIGHT)
        x, y, width, height = window.status()["viewport"]
        window.wait("the mark", lambda s: differing(whole, window.pixels(x, y, width, height)) > 0.0)
        check(True, "what a click would take out is shown before it")
        window.xdotool("click", 1)
        status = window.wait("two pieces", lambda s: s["pieces"] == 2)
        check(status["undo"].startswith("disconnect"), "a click is one step of undo")
        check("2 pieces now" in status["notice"], "and the status says what came off")
        apart = still(window)
        check(differing(whole, apart) > 0.002, "the gap can be seen")

        window.xdotool("key", "ctrl+z")
        window.wait("one piece", lambda s: s["pieces"] == 1 and s["branch_count"] == branches)
        check(differing(whole, still(window)) <= 0.001, "undo brings the picture back")
        point(window, ON_RIGHT)
        window.xdotool("click", 1)
        window.wait("two pieces again", lambda s: s["pieces"] == 2)
        check(differing(apart, still(window)) <= 0.01, "cut again, it looks the same again")

        take_tool(window, "Join ends", "join")
        point(window, [0, 0, -20])
        window.xdotool("click", 1)  # near its root, which lies open
        window.wait("a join begun", lambda s: s["tool_busy"])
        window.xdotool("key", "Escape")
        window.wait("a join given up", lambda s: not s["tool_busy"])
        saved_session(window)
        window.wait("the session's name", lambda s: "Session saved: " in s["notice"])
        session = folder / "small tree.ramus.json"
        edits = json.loads(session.read_text())["edits"]
        check([edit["edit"] for edit in edits] == ["cut"], "the session has the edit")
        window.quit()
    finally:
        window.end()
    mended = folder / "mended.swc"
    subprocess.run([program, "convert", "--session", session, "-o", mended], check=True)
    check(sum(line.split()[-1] == "-1" for line in mended.read_text().splitlines() if line[:1] not in "#") == 2,
          "convert writes the tree with its two pieces")
    check("edited: branch" in mended.read_text(), "and says that it was edited")
    again = Window(program, screen, folder, [session, "--size", "1100x800"])
    try:
        status = again.wait("the surface", lambda s: s["surface_ready"])
        check(status["pieces"] == 2 and not status["modified"], "the session opens with its edits")
        again.quit()
    finally:
        again.end()


if __name__ == "__main__":
    sys.exit(run_journeys(editing))
