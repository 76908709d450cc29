"""What a graphics driver compiles for the first time does not hold up the window: pictures are drawn by another thread,
and the window's own makes a single program, the interface's. Where a driver lets one thread draw alone the window does
all by itself, and shows the same.

Usage: first_use_journey.py PROGRAM
"""

import os
import sys

from screen import SMALL_TREE, Window, check, choose, click, drag, page, project, run_journeys

INTERFACE = 1  # program that the window's own thread makes


def ready(status):
    return status["surface_ready"]


def first_uses(window):
    """Of what is drawn by programs of its own: each step by its name, and what it leads to."""
    def press(*keys):
        return lambda: window.xdotool("key", *keys)

    def skeleton():
        page(window, "surface")
        click(window, "Centerlines, and rings of the radius, over the vessels")

    def compare():
        choose(window, "Surfaces of the same vessels, seen together", "Side by side")

    def turned(status):
        return ready(status) and status["camera"] != before

    before = window.status()["camera"]
    yield "a selection", press("ctrl+i"), lambda s: len(s["selection"]) == s["branch_count"]
    yield "glass", press("g"), lambda s: ready(s) and len(s["states"]["defocused"]) == s["branch_count"]
    yield "the picture turns", press("Left", "Left"), turned
    yield "no glass", press("ctrl+z", "Escape"), lambda s: not s["states"]["defocused"]
    yield "the skeleton", skeleton, lambda s: s["options"].get("skeleton")
    yield "two surfaces side by side", compare, lambda s: ready(s) and len(s["viewports"]) == 2
    yield "the preview of an export", press("ctrl+e"), lambda s: s["open_dialog"]
    yield "no dialog", press("Escape"), lambda s: not s["open_dialog"]


def opened(program, screen, folder, *arguments):
    tree = folder / "small tree.swc"
    tree.write_text(SMALL_TREE)
    window = Window(program, screen, folder, [tree, *arguments])
    if window.wait("the surface", ready)["units_panel"]:
        window.xdotool("key", "Escape")
        window.wait("no question", lambda s: not s["units_panel"])
    return window


def drawn_elsewhere(program, screen, folder):
    window = opened(program, screen, folder)
    try:
        made = {"the start": window.status()["programs_made_here"]}
        for name, act, leads_to in first_uses(window):
            act()
            made[name] = window.wait(name, leads_to)["programs_made_here"]
        check(set(made.values()) == {INTERFACE}, f"the window's own thread makes the interface's program alone: {made}")
        check(window.quit() == 0, "and it closes")
    finally:
        window.end()


def drawn_by_one_thread(program, screen, folder):
    pictures = []
    for alone in ("", "1"):
        os.environ["RAMUS_ONE_THREAD"] = alone
        window = opened(program, screen, folder)
        try:
            status = window.wait("the finest picture", lambda s: ready(s) and s["picture"]["refined"])
            pictures.append(window.pixels(*status["viewport"]))
            made = status["programs_made_here"]
            check((made > INTERFACE) == bool(alone), f"{made} programs are made by the window's thread")
            check(window.quit() == 0, "and it closes")
        finally:
            window.end()
            del os.environ["RAMUS_ONE_THREAD"]
    check(pictures[0] == pictures[1], "both ways the picture is the same, to the bit")


def asked_meanwhile(program, screen, folder):
    """With nothing in the driver's cache glass takes its time: what a person does meanwhile is of what is seen then, takes
    effect in its order, and the window waits for none of it."""
    os.environ["XDG_CACHE_HOME"] = str(folder / "another empty cache")
    (folder / "another empty cache").mkdir()
    commands = folder / "commands"
    commands.write_text("lasso-mode any\nlasso-depth visible\n")
    window = opened(program, screen, folder, "--commands", commands)
    try:
        status = window.wait("the lasso takes what is visible", lambda s: ready(s) and s["lasso"]["depth"] == "visible")
        x, y = project(status, [-20.0, 0.0, 15.0])  # a point of the left child
        window.xdotool("key", "ctrl+i", "g", "mousemove", x, y, "click", 1, "key", "x")
        hidden = window.wait("one vessel hidden", lambda s: ready(s) and s["states"]["hidden"])["states"]["hidden"]
        check(len(hidden) == 1, f"the vessel that was clicked is hidden: {hidden}")
        window.xdotool("key", "ctrl+z", "w")
        window.wait("the lasso", lambda s: ready(s) and s["tool"] == "lasso" and not s["states"]["hidden"])
        window.xdotool("key", "shift+g")  # all else is glass: another picture
        drag(window, [(x - 40, y - 40), (x + 60, y - 40), (x + 60, y + 60), (x - 40, y + 60), (x - 40, y - 40)])
        window.xdotool("key", "x")
        status = window.wait("what was lassoed hidden", lambda s: ready(s) and s["states"]["hidden"])
        check(hidden[0] in status["states"]["hidden"], "so is what was lassoed")
        check(status["waits_for_drawing"] == 0, "the window waited for no picture")
        window.xdotool("key", "Escape", "Escape", "shift+n")
        window.wait("all of it", lambda s: ready(s) and s["tool"] == "navigate" and not s["states"]["hidden"])
        window.xdotool("mousemove", x, y)
        status = window.wait("the vessel under the pointer", lambda s: s["hovered"] >= 0)
        check([status["hovered"]] == hidden, "that vessel is what was under the pointer")
    finally:
        window.end()
        del os.environ["XDG_CACHE_HOME"]


def closed_meanwhile(program, screen, folder):
    """Nothing is in the driver's cache, so that the first picture takes its time."""
    os.environ["XDG_CACHE_HOME"] = str(folder / "empty cache")
    (folder / "empty cache").mkdir()
    window = Window(program, screen, folder, [])
    try:
        window.window()  # it is there
        window.xdotool("key", "ctrl+q")
        check(window.process.wait(timeout=120) == 0, "a window that is closed at once ends well")
    finally:
        window.end()
        del os.environ["XDG_CACHE_HOME"]


if __name__ == "__main__":
    sys.exit(run_journeys(drawn_elsewhere, drawn_by_one_thread, asked_meanwhile, closed_meanwhile))
