"""An organ beside the tree: chosen in the dialog, seen in the list and in the picture, made denser, hidden, removed; all
of it undone.

Usage: context_journey.py PROGRAM
"""

import sys

from screen import SMALL_TREE, Window, check, click, differing, page, run_journeys, slide

ADD = "Show a mask or a mesh beside the tree: an organ, a bone"
LOWER, UPPER = (-50, -15, -30), (65, 25, 60)  # mm, around most of the tree


def box():
    """As an OBJ file: closed, seen from outside."""
    corners = [tuple((UPPER if i >> k & 1 else LOWER)[k] for k in range(3)) for i in range(8)]
    faces = ((1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6))
    lines = ["v %d %d %d" % corner for corner in corners]
    for a, b, c, d in faces:
        lines += [f"f {a} {b} {c}", f"f {a} {c} {d}"]
    return "\n".join(lines) + "\n"


def items(status):
    return status.get("context", [])


def context(program, screen, folder):
    tree = folder / "small tree.swc"
    tree.write_text(SMALL_TREE)
    (folder / "organ.obj").write_text(box())
    window = Window(program, screen, folder, [tree, "--size", "1100x900"])
    try:
        status = window.wait("the surface", lambda s: s["surface_ready"])
        view = x, y, width, height = status["viewport"]

        def seen():
            window.xdotool("mousemove", x + width // 2, y + height + 10)
            window.wait("nothing under the pointer", lambda s: s["hovered"] == -1)
            return window.pixels(*view)

        without = seen()
        page(window, "surface")
        check("Opacity" not in status["controls"], "the list of context is empty")
        click(window, ADD)
        window.wait("the dialog", lambda s: s["open_dialog"])
        window.xdotool("type", "organ")
        window.xdotool("key", "Return")
        status = window.wait("the organ", lambda s: len(items(s)) == 1 and "Opacity" in s["controls"])
        check(items(status)[0]["path"].endswith("organ.obj") and not status["open_dialog"],
              "the dialog's filter and Enter choose a mesh")
        check({"Hide", "Colour", "As a wireframe", "Remove"} <= set(status["controls"]), "the list has a row for it")
        veiled = seen()
        check(differing(without, veiled, threshold=3) > 0.1, "and it is in the picture")

        slide(window, "Opacity", 0.8)
        status = window.wait("more of it", lambda s: items(s)[0]["opacity"] > 0.7)
        check(status["undo"].startswith("opacity context"), "its slider is one step of undo when it is let go")
        dense = seen()
        check(differing(veiled, dense, threshold=3) > 0.1, "and the organ is denser")

        click(window, "Hide")
        window.wait("it is hidden", lambda s: not items(s)[0]["visible"] and "Show" in s["controls"])
        check(seen() == without, "the eye hides it: the picture is the one without it")
        window.xdotool("key", "ctrl+z")
        window.wait("it is shown", lambda s: items(s)[0]["visible"])
        check(seen() == dense, "undo shows it again")

        click(window, "Remove")
        window.wait("the empty list", lambda s: not items(s) and "Opacity" not in s["controls"])
        check(seen() == without, "the cross takes it out of the list and the picture")
        window.xdotool("key", "ctrl+z")
        window.wait("the organ again", lambda s: len(items(s)) == 1 and items(s)[0]["opacity"] > 0.7)
        check(seen() == dense, "undo brings it back as it was")
        window.xdotool("key", "ctrl+z", "ctrl+z")
        window.wait("the beginning", lambda s: not items(s) and s["undo"] == "")
        check(seen() == without, "and two more go back to the beginning")
        window.xdotool("key", "ctrl+q")
        check(window.process.wait(timeout=60) == 0, "Ctrl+Q closes the window")
    finally:
        window.end()


if __name__ == "__main__":
    sys.exit(run_journeys(context, size=(1200, 950)))
