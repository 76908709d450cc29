"""A surgeon lassoes vessels away: draws around some, adds others by a polygon, takes all that depends on them, hides
them, takes that back and does it again; with the mouse in the window, and then with the same commands headless.

Usage: lasso_journey.py PROGRAM
"""

import json
import math
import subprocess
import sys

from screen import Window, below_tools, check, differing, drag, info_of, picture_pixels, run_journeys, saved_session

LEAST = 12  # branches that are lassoed


def around(centre, radius, steps=40):
    return [(round(centre[0] + radius * math.cos(2 * math.pi * i / steps)),
             round(centre[1] + radius * math.sin(2 * math.pi * i / steps))) for i in range(steps + 1)]


def with_dependents(branches, ids):
    found, open_ids = set(), list(ids)
    while open_ids:
        branch = open_ids.pop()
        if branch not in found:
            found.add(branch)
            open_ids += branches[branch]["children"]
    return sorted(found)


def lasso(program, screen, folder):
    tree = folder / "grown.swc"
    subprocess.run([program, "grow", "-o", tree, "--branches", "401", "--seed", "7"], check=True)
    branches = info_of(program, tree)["branch_list"]
    window = Window(program, screen, folder, [tree, "--size", "1100x760"])
    try:
        status = window.wait("the surface", lambda s: s["surface_ready"])
        view = status["viewport"]
        x, y, width, height = view
        whole = status["triangles"]

        # Its button is the second one at the upper left of the picture.
        window.xdotool("mousemove", x + 10 + 3 + 28 + 2 + 14, y + 10 + 3 + 14, "click", 1)
        window.wait("the lasso", lambda s: s["tool"] == "lasso")
        window.xdotool("key", "Escape")
        window.wait("no lasso", lambda s: s["tool"] == "navigate")
        window.xdotool("key", "w")
        window.wait("the lasso", lambda s: s["tool"] == "lasso")
        check(True, "a button and the key W give the lasso, Escape leaves it")

        centre = (x + round(0.34 * width), y + round(0.35 * height))
        camera = status["camera"]
        window.xdotool("mousemove", x + width // 2, y + height + 10)
        window.wait("the pointer away", lambda s: s["hovered"] == -1)
        before = window.pixels(*view)
        drag(window, around(centre, 60), end=False)
        window.wait("the stroke", lambda s: s["tool_busy"])
        share = differing(before, window.pixels(*view), threshold=3)
        check(share > 0.5 * math.pi * 60 * 60 / (width * height), "the lasso shows while it is drawn")
        window.xdotool("key", "Escape")
        window.wait("the stroke given up", lambda s: not s["tool_busy"])
        window.xdotool("mouseup", 1)
        status = window.wait("the lasso still", lambda s: s["tool"] == "lasso")
        check(status["selection"] == [] and status["camera"] == camera,
              "Escape gives a stroke up; a lasso neither turns the view nor selects by clicks")

        drag(window, around(centre, 100))
        status = window.wait("the lassoed branches", lambda s: len(s["selection"]) >= LEAST)
        first, lines = status["selection"], [status["last_command"]]
        check(status["last_command"][0] == "lasso", f"a stroke lassoes {len(first)} branches")

        window.xdotool("key", "shift+w")
        window.wait("the polygon", lambda s: s["tool"] == "lasso-polygon")
        corners = [(x + round(u * width), y + round(v * height))
                   for u, v in ((0.55, 0.28), (0.80, 0.24), (0.86, 0.42), (0.60, 0.50))]
        window.xdotool("keydown", "shift")
        for corner in corners:
            window.xdotool("mousemove", *corner, "click", 1)
        window.xdotool("keyup", "shift")
        window.xdotool("click", 3)
        status = window.wait("more branches", lambda s: len(s["selection"]) > len(first))
        expected = ["lasso", "--add"] + [f"{px - x},{py - y}" for px, py in corners]
        check(status["last_command"] == expected, "a polygon is closed by a right click, and Shift adds what is inside")
        check(set(first) < set(status["selection"]), "what was selected before stays")
        lines.append(status["last_command"])
        chosen = status["selection"]

        window.xdotool("key", "Escape")
        window.wait("no tool", lambda s: s["tool"] == "navigate" and s["selection"] == chosen)
        window.xdotool("key", "d")
        every = with_dependents(branches, chosen)
        window.wait("what depends on them", lambda s: s["selection"] == every)
        check(len(every) > len(chosen), f"D takes all {len(every)} that depend on the {len(chosen)}")

        window.xdotool("mousemove", x + width // 2, y + height + 10)
        window.wait("the pointer away", lambda s: s["hovered"] == -1)
        before = window.pixels(*view)
        window.xdotool("key", "x")
        status = window.wait("the rest", lambda s: s["states"]["hidden"] == every and s["surface_ready"])
        check(0 < status["triangles"] < whole, "X hides them")
        window.xdotool("key", "ctrl+z")
        status = window.wait("them again", lambda s: s["states"]["hidden"] == [] and s["surface_ready"])
        check(status["triangles"] == whole and status["selection"] == every, "undo brings them back, selected")
        share = differing(before, window.pixels(*view))
        check(share <= 0.001, f"and the picture is the one before ({100 * share:.4f} % of the pixels differ)")
        window.xdotool("key", "ctrl+shift+z")
        status = window.wait("them gone", lambda s: s["states"]["hidden"] == every and s["surface_ready"])
        check(status["triangles"] < whole, "redo hides them again")

        saved_session(window)
        session = folder / "grown.ramus.json"
        window.wait("the session file", lambda s: session.exists())
        headless(program, folder, tree, status, lines, json.loads(session.read_text()), window.pixels(*view))
    finally:
        window.end()


def headless(program, folder, tree, status, lines, saved, seen):
    """The commands that came out of the tool, without a window: the same session and the same picture."""
    width, height = status["viewport"][2:]
    commands, session, picture = folder / "lasso.txt", folder / "headless.json", folder / "headless.png"
    script = [" ".join(line) for line in lines]
    script += ["select-dependents", "hide", "undo", "redo", f'save "{session}"']
    commands.write_text("\n".join(script) + "\n")
    subprocess.run([program, "render", tree, "--size", f"{width}x{height}", "--camera", json.dumps(status["camera"]),
                    "--commands", commands, "-o", picture], check=True)
    made = json.loads(session.read_text())
    for part in sorted(set(saved) | set(made)):
        check(saved.get(part) == made.get(part), f"the headless session has the same {part}")
    view = status["viewport"]
    share = differing(below_tools(seen, view), below_tools(picture_pixels(picture), view))
    check(share <= 0.001, f"and its picture is the window's ({100 * share:.4f} % of the pixels differ)")


if __name__ == "__main__":
    sys.exit(run_journeys(lasso))
