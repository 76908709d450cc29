"""What a person does in the first minute: look, turn, point, select, highlight, ask for help, save. And the picture in
the window is the picture that `ramus render` makes of the saved session.

Usage: window_journey.py PROGRAM
"""

import json
import shutil
import subprocess
import sys

from screen import (SMALL_TREE, Window, below_tools, check, cropped, differing, looks_along, picture_pixels,
                    project, run_journeys, saved_picture, saved_session)


def explore(program, screen, folder):
    tree = folder / "small tree.swc"
    tree.write_text(SMALL_TREE)
    window = Window(program, screen, folder, [tree, "--size", "1100x760"])
    try:
        status = window.wait("the surface", lambda s: s["surface_ready"])
        check(status["triangles"] > 1000 and status["problem"] == "", "the surface is ready")
        x, y, width, height = status["viewport"]
        check(width > 600 and height > 600, "the picture has most of the window")

        at = project(status, [25, 6.5, 20])
        before = window.pixels(at[0], at[1], 200, 140)
        window.xdotool("mousemove", *at)
        status = window.wait("the branch under the pointer", lambda s: s["tooltip"])
        branch = status["hovered"]
        after = window.pixels(at[0], at[1], 200, 140)
        check(differing(before, after) > 0.2, "a tooltip appears beside the pointer")

        window.xdotool("click", 1)
        window.wait("the selection", lambda s: s["selection"] == [branch])
        check(True, "a click selects the branch under the pointer")
        window.xdotool("keydown", "ctrl", "keydown", "shift", "click", 1, "keyup", "shift", "keyup", "ctrl")
        status = window.wait("what depends on it", lambda s: len(s["selection"]) == 3)
        dependents = status["selection"]
        check(branch in dependents, "Ctrl+Shift+click selects the branch and all that depends on it")
        window.xdotool("key", "h")
        window.wait("the highlight", lambda s: s["states"]["highlighted"] == dependents)
        check(True, "H highlights the selection")
        window.xdotool("key", "ctrl+z")
        window.wait("undo", lambda s: s["states"]["highlighted"] == [])
        window.xdotool("key", "ctrl+shift+z")
        window.wait("redo", lambda s: s["states"]["highlighted"] == dependents)
        check(True, "undo takes the highlight back, redo brings it again")

        empty = (x + 40, y + 200)
        window.xdotool("mousemove", *empty)
        window.xdotool("mousedown", 1)
        window.xdotool("mousemove", empty[0] + 60, empty[1] + 20)
        window.xdotool("mousemove", empty[0] + 120, empty[1] + 40)
        window.xdotool("mouseup", 1)
        # 120 pixels of a picture 804 wide are 30 degrees: sin 30 = 0.5 of the way is along x; 40 pixels are 10 degrees.
        status = window.wait("the turn", lambda s: abs(looks_along(s)[0]) > 0.3 and abs(looks_along(s)[2]) > 0.1)
        check(status["selection"] == dependents, "a drag on the background turns both ways, and is not a click")

        save_and_compare(program, window, folder, status)
        hide_and_compare(program, window, folder, dependents)

        for key, way in (("l", [1, 0, 0]), ("s", [0, 0, -1]), ("r", [-1, 0, 0]), ("i", [0, 0, 1]), ("p", [0, 1, 0]),
                         ("a", [0, -1, 0])):
            window.xdotool("key", key)
            window.wait(f"the view of key {key}", lambda s: looks_along(s) == way)
        check(True, "the keys A P L R S I look from there")

        window.xdotool("mousemove", *empty)
        window.xdotool("click", 1)
        window.wait("nothing selected", lambda s: s["selection"] == [])
        check(True, "a click on the background selects nothing")

        window.xdotool("key", "question")
        window.wait("help", lambda s: s["help"])
        window.xdotool("type", "highlight")
        window.xdotool("key", "Escape")
        status = window.wait("no help", lambda s: not s["help"])
        check(status["states"]["highlighted"] == dependents, "? shows help, typing there searches, Escape closes it")
        window.xdotool("key", "ctrl+o")
        window.wait("the open dialog", lambda s: s["open_dialog"])
        window.xdotool("key", "Escape")
        window.wait("no open dialog", lambda s: not s["open_dialog"])
        check(True, "Ctrl+O asks for a file, Escape does not want one")

        window.xdotool("key", "ctrl+q")
        check(window.process.wait(timeout=60) == 0, "Ctrl+Q closes the window")
    finally:
        window.end()


def save_and_compare(program, window, folder, status):
    view = x, y, width, height = status["viewport"]
    window.xdotool("mousemove", x + width // 2, y + height + 10)  # on the status bar
    window.wait("nothing under the pointer", lambda s: s["hovered"] == -1)
    saved_session(window)
    session = folder / "small tree.ramus.json"
    window.wait("the session file", lambda s: session.exists())
    seen = window.pixels(x, y, width, height)
    picture = folder / "headless.png"
    subprocess.run([program, "render", "--session", session, "--size", f"{width}x{height}", "-o", picture], check=True)
    share = differing(below_tools(seen, view), below_tools(picture_pixels(picture), view))
    if share > 0.001:  # both stay where the test ran
        subprocess.run(["convert", "-size", f"{width}x{height}", "-depth", "8", "rgb:-", "window.png"], input=seen, check=True)
        shutil.copy(picture, "headless.png")
    check(share <= 0.001, f"window and headless picture are the same ({100 * share:.4f} % of the pixels differ)")
    shot = saved_picture(window)
    window.xdotool("key", "Escape")  # what was written is told over the picture
    window.wait("no word of it", lambda s: not s["written"])
    check(differing(below_tools(seen, view), below_tools(picture_pixels(shot), view)) <= 0.001,
          "F12 saves what the window shows")


def hide_and_compare(program, window, folder, branches):
    """Hidden branches leave a closed surface, in the window as in a picture of the session."""
    status = window.status()
    triangles = status["triangles"]
    view = x, y, width, height = status["viewport"]
    before = window.pixels(x, y, width, height)
    window.xdotool("key", "Delete")
    status = window.wait("the surface without them", lambda s: s["states"]["hidden"] == branches and s["surface_ready"])
    check(0 < status["triangles"] < triangles, "hidden branches are gone from the surface")
    seen = window.pixels(x, y, width, height)
    session = folder / "without.ramus.json"
    saved = json.loads((folder / "small tree.ramus.json").read_text())
    saved["states"] = status["states"]
    saved["selection"] = status["selection"]
    session.write_text(json.dumps(saved))
    picture = folder / "without.png"
    subprocess.run([program, "render", "--session", session, "--size", f"{width}x{height}", "-o", picture], check=True)
    share = differing(below_tools(seen, view), below_tools(picture_pixels(picture), view))
    check(share <= 0.001, f"and the picture is that of a surface made without them ({100 * share:.4f} % differ)")
    # Where they began, the others are closed: only left out of the drawing, they would leave a hole there.
    at_x, at_y = project(status, [0, 0, 0])
    joint = (at_x - x - 50, at_y - y - 50, 100, 100)
    share = differing(cropped(seen, width, joint), cropped(picture_pixels(picture), width, joint))
    check(share <= 0.01, f"and where they began it is closed ({100 * share:.4f} % differ there)")
    window.xdotool("key", "ctrl+z")
    status = window.wait("them again", lambda s: s["states"]["hidden"] == [] and s["surface_ready"])
    check(status["triangles"] == triangles and window.pixels(x, y, width, height) == before, "undo brings them back")


def bad_file(program, screen, folder):
    bad = folder / "junk.swc"
    bad.write_bytes(bytes(range(256)))
    window = Window(program, screen, folder, [bad, "--size", "800x600"])
    try:
        status = window.wait("the message", lambda s: s["error"])
        check("junk.swc" in status["error"], "a bad file gives a message that names it")
        window.xdotool("mousemove", 400, 300, "key", "Escape")
        window.wait("no message", lambda s: not s["error"])
        window.xdotool("key", "ctrl+q")
        check(window.process.wait(timeout=60) == 0, "and the window goes on")
    finally:
        window.end()


def managed(program, screen, folder):
    """What a window manager does: it closes the window, makes it as large as the screen and small again."""
    tree = folder / "managed.swc"
    tree.write_text(SMALL_TREE)
    window = Window(program, screen, folder, [tree, "--units", "mm", "--orientation", "RAS", "--size", "900x600"])
    try:
        status = window.wait("the surface", lambda s: s["surface_ready"])
        small = status["window"]
        window.xdotool("key", "ctrl+i")
        window.xdotool("key", "h")
        window.wait("a change", lambda s: s["modified"])
        window.xdotool("key", "alt+F4")
        window.wait("the question", lambda s: s["unsaved_dialog"])
        window.xdotool("key", "Escape")
        window.wait("the window", lambda s: not s["unsaved_dialog"])
        check(True, "closed by the window manager it asks what becomes of changes, and stays if it should")
        window.xdotool("key", "alt+F10")
        status = window.wait("a large window", lambda s: s["window"][0] > small[0] and s["window"][1] > small[1])
        x, y, width, height = status["viewport"]
        check(len(set(window.pixels(x, y + height // 2, width, 1))) > 20, "maximised, it shows the tree")
        window.xdotool("key", "alt+F10")
        window.wait("the window as it was", lambda s: s["window"] == small)
        check(window.quit() == 0, "and small again; Ctrl+Q closes it")
    finally:
        window.end()


def without_display(program, screen, folder):
    environment = {"PATH": "/usr/bin:/bin", "HOME": str(folder)}
    result = subprocess.run([program], env=environment, stderr=subprocess.PIPE, text=True)
    check(result.returncode == 1 and "display" in result.stderr and "ramus render" in result.stderr,
          "without a display ramus says so and points at ramus render")


if __name__ == "__main__":
    sys.exit(run_journeys(without_display, explore, managed, bad_file))
