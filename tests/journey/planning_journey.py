"""What a surgeon does with a tree: point at a vessel, select what depends on it, put the rest out of focus and keep the
picture; then place a lesion, read what lies near it, cut a vessel, read what is lost, and write the tables. Then the same
by commands without a window: the session comes out the same.

Usage: planning_journey.py PROGRAM
"""

import csv
import json
import subprocess
import sys
from pathlib import Path

from screen import (SMALL_TREE, Window, below_tools, check, differing, picture_pixels, project, run_journeys,
                    saved_picture, saved_session)


def commands(program, tree, folder, lines, session):
    """The session that these commands make of a tree, without a window."""
    script = folder / "commands.txt"
    script.write_text("".join(line + "\n" for line in lines) + f'save "{session}"\n')
    subprocess.run([program, "render", tree, "--commands", script, "-o", folder / "unused.png"], check=True)
    return json.loads(Path(session).read_text())


def same_marks(first, second):
    return all(first[name] == second[name] for name in ("selection", "states", "names", "options", "measurements"))


def focus(program, window, folder, tree):
    """Hover, select a subtree, defocus the rest, keep the picture."""
    at = project(window.status(), [25, 6.5, 20])
    window.xdotool("mousemove", *at)
    status = window.wait("the branch under the pointer", lambda s: s["tooltip"])
    branch = status["hovered"]
    window.xdotool("keydown", "ctrl", "keydown", "shift", "click", 1, "keyup", "shift", "keyup", "ctrl")
    status = window.wait("the branch and what depends on it", lambda s: len(s["selection"]) == 3)
    chosen = status["selection"]
    check(branch in chosen, "Ctrl+Shift+click selects the branch under the pointer and what depends on it")
    view = x, y, width, height = status["viewport"]
    window.xdotool("mousemove", x + width // 2, y + height + 10)
    window.wait("nothing under the pointer", lambda s: s["hovered"] == -1)
    before = window.pixels(x, y, width, height)
    window.xdotool("key", "shift+g")
    status = window.wait("the rest out of focus", lambda s: len(s["states"]["defocused"]) == 2)
    check(sorted(chosen + status["states"]["defocused"]) == [0, 1, 2, 3, 4], "the rest becomes glass in one step")
    check(differing(before, window.pixels(x, y, width, height)) > 0.02, "and it can be seen")
    saved = saved_session(window)
    picture = saved_picture(window)
    window.xdotool("key", "Escape")  # what was written is told over the picture
    window.wait("no word of it", lambda s: not s["written"])
    window.xdotool("mousemove", x + width // 2, y + height + 10)
    seen = window.pixels(x, y, width, height)
    check(differing(below_tools(seen, view), below_tools(picture_pixels(picture), view)) <= 0.001,
          "F12 keeps the picture that the window shows")
    by_commands = commands(program, tree, folder, [f"select {branch}", "select-dependents", "defocus-others"],
                           folder / "focus.ramus.json")
    check(same_marks(json.loads(saved.read_text()), by_commands), "and the commands make the same session without it")
    window.xdotool("key", "ctrl+z")
    window.wait("everything in focus", lambda s: s["states"]["defocused"] == [])


def lesion(window):
    """Placed on the left branch by a press, sized by dragging; sized again, moved; all of it undone and redone."""
    window.xdotool("key", "shift+l")
    window.wait("the tool", lambda s: s["tool"] == "lesion")
    at = project(window.status(), [-40, 0, 25])
    window.xdotool("mousemove", *at)
    window.xdotool("mousedown", 1)
    window.xdotool("mousemove", at[0] + 20, at[1])
    window.xdotool("mousemove", at[0] + 40, at[1])
    window.xdotool("mouseup", 1)
    status = window.wait("the lesion", lambda s: len(s["lesions"]) == 1)
    x, y, z, radius = status["lesions"][0]
    check(abs(x + 40) < 4 and abs(z - 25) < 4 and radius > 2, "a press and a drag place a lesion on the vessel")
    centre = project(status, [x, y, z])
    window.xdotool("mousemove", *centre)
    window.xdotool("mousedown", 1)
    window.xdotool("mousemove", centre[0] - 10, centre[1] - 5)
    window.xdotool("mousemove", centre[0] - 20, centre[1] - 10)
    window.xdotool("mouseup", 1)
    status = window.wait("the lesion elsewhere", lambda s: s["lesions"] and s["lesions"][0][0] != x)
    moved = status["lesions"]
    check(len(moved) == 1 and abs(moved[0][3] - radius) < 1e-9, "a drag from its middle moves it and keeps its size")
    window.xdotool("key", "ctrl+z")
    window.wait("the lesion where it was", lambda s: s["lesions"] == [[x, y, z, radius]])
    window.xdotool("key", "ctrl+shift+z")
    window.wait("the lesion moved again", lambda s: s["lesions"] == moved)
    check(True, "undo and redo cover it")


def cut(window, folder):
    """Across the trunk of the right side."""
    window.xdotool("key", "shift+c")
    window.wait("the tool", lambda s: s["tool"] == "cut")
    at = project(window.status(), [20, 5, 15])
    window.xdotool("mousemove", *at)
    window.xdotool("click", 1)
    status = window.wait("the cut", lambda s: len(s["cuts"]) == 1)
    branch, fraction = status["cuts"][0]
    check(0.4 < fraction < 0.9, "a click cuts the vessel there")
    x, y, width, height = status["viewport"]
    window.xdotool("key", "Escape")
    window.wait("no tool", lambda s: s["tool"] == "navigate")
    window.xdotool("key", "b")
    status = window.wait("the planning half of the panel", lambda s: s["planning"])
    panel = window.pixels(x + width, y, status["window"][0] - x - width, height)
    window.xdotool("key", "b")
    window.wait("the exploring half", lambda s: not s["planning"])
    check(differing(panel, window.pixels(x + width, y, status["window"][0] - x - width, height)) > 0.02,
          "B goes to the planning half of the panel and back")
    return branch, fraction


def tables(program, tree, folder, status):
    """The tables of the session, by the commands that write them."""
    session = folder / "plan.ramus.json"
    lesions = ["lesion " + ",".join(f"{v:.2f}" for v in sphere) for sphere in status["lesions"]]
    cuts = [f"cut {branch} {fraction:.3f}" for branch, fraction in status["cuts"]]
    bands, lost = folder / "bands.csv", folder / "cuts.csv"
    made = commands(program, tree, folder,
                    lesions + cuts + [f'report "{bands}" bands', f'report "{lost}" cuts'], session)
    check(made["lesions"] == status["lesions"] and made["cuts"] == status["cuts"],
          "commands place the same lesion and the same cut")
    with open(bands, newline="") as table:
        near = list(csv.DictReader(table))
    check(near and all("branch" in row for row in near), "the band table lists branches")
    check(any(row["branch"] == "1" for row in near), "the branch that the lesion lies on is among them")
    with open(lost, newline="") as table:
        rows = list(csv.DictReader(table))
    check(len(rows) >= 1 and rows[0]["branch"] == str(status["cuts"][0][0]), "the cut list names the branch that is cut")
    check(rows[0]["lost_branches"] == "3", "and counts it and the two that depend on it as lost")


def plan(program, screen, folder):
    tree = folder / "small tree.swc"
    tree.write_text(SMALL_TREE)
    window = Window(program, screen, folder, [tree, "--size", "1100x760"])
    try:
        window.wait("the surface", lambda s: s["surface_ready"])
        focus(program, window, folder, tree)
        lesion(window)
        cut(window, folder)
        tables(program, tree, folder, window.status())
    finally:
        window.end()


if __name__ == "__main__":
    sys.exit(run_journeys(plan))
