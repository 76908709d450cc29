"""Surfaces of the same vessels looked at together: side by side with one camera, another one chosen in the panel, a blend
by its slider; undone to the picture and the camera from before.

Usage: compare_journey.py PROGRAM
"""

import json
import shutil
import subprocess
import sys

from screen import (SMALL_TREE, Window, check, choose, cropped, differing, drag, page, picture_pixels, run_journeys, saved_session,
                    slide)

MODE = "Surfaces of the same vessels, seen together"
SECOND = "The surface that it is compared with"
SHARE = "How much there is of the second surface"
BELOW_HEADING = 90  # pixels: what the tools' bar and the words over the viewports take


def comparison(status):
    return status.get("comparison", {"mode": "off", "surfaces": ["cs", "cones"], "blend": 0.5})


def halves(window, view):
    """The two viewports without the edges that are theirs alone: the words at the top, scale bar and cube at the bottom."""
    x, y, width, height = view
    seen = window.pixels(x, y, width, height)
    viewport = (width - 1) // 2
    boxes = [(left, BELOW_HEADING, viewport, height - BELOW_HEADING - 140) for left in (0, width - viewport)]
    return [cropped(seen, width, box) for box in boxes]


def leave_picture(window, view):
    x, y, width, height = view
    window.xdotool("mousemove", x + width // 2, y + height + 10)
    window.wait("nothing under the pointer", lambda s: s["hovered"] == -1)


def compare(program, screen, folder):
    tree = folder / "small tree.swc"
    tree.write_text(SMALL_TREE)
    window = Window(program, screen, folder, [tree, "--size", "1300x900"])
    try:
        status = window.wait("the surface", lambda s: s["surface_ready"])
        view, camera = status["viewport"], status["camera"]
        leave_picture(window, view)
        before = window.pixels(*view)

        page(window, "surface")
        choose(window, MODE, "Side by side")
        status = window.wait("two viewports", lambda s: comparison(s)["mode"] == "side-by-side")
        narrow = status["camera"]
        check(narrow["position"][1] > camera["position"][1], "side by side, the eye goes back: the tree is whole in half the width")
        leave_picture(window, view)
        smooth, cones = halves(window, view)
        check(0.0 < differing(smooth, cones) < 0.2, "one viewport has the convolution surface, the other the truncated cones")

        window.xdotool("key", "ctrl+z")
        window.wait("one surface", lambda s: comparison(s)["mode"] == "off" and s["camera"] == camera)
        leave_picture(window, view)
        check(window.pixels(*view) == before, "undo brings back the picture from before, its camera too")
        window.xdotool("key", "ctrl+shift+z")
        window.wait("two viewports again", lambda s: comparison(s)["mode"] == "side-by-side" and s["camera"] == narrow)
        check(True, "redo compares again, with its camera")

        x, y, width, height = view
        # In the right viewport, where there is nothing.
        start = (x + round(0.55 * width), y + round(0.85 * height))
        drag(window, [start, (start[0] + 30, start[1]), (start[0] + 60, start[1] - 20)])
        status = window.wait("the turn", lambda s: s["camera"]["position"][0] != narrow["position"][0])
        leave_picture(window, view)
        turned = halves(window, view)
        check(min(differing(a, b) for a, b in zip(turned, (smooth, cones))) > 0.02, "a drag in one viewport turns both")
        check(differing(*turned) < 0.2, "by as much")

        choose(window, SECOND, "Isosurface")
        window.wait("the isosurface", lambda s: comparison(s)["surfaces"] == ["cs", "iso"])
        leave_picture(window, view)
        after = halves(window, view)
        check(after[0] == turned[0] and after[1] != turned[1], "the panel puts another surface into the second viewport alone")

        choose(window, MODE, "Blend")
        window.wait("the blend", lambda s: comparison(s)["mode"] == "blend")
        slide(window, SHARE, 0.8)
        status = window.wait("more of the second", lambda s: comparison(s)["blend"] > 0.7)
        check(status["undo"].startswith("compare blend"), "the slider is one step of undo when it is let go")
        leave_picture(window, view)
        saved_session(window)
        session = folder / "small tree.ramus.json"
        window.wait("the session file", lambda s: session.exists())
        compare_with_file(program, window, folder, session, view)
        window.xdotool("key", "ctrl+q")
        check(window.process.wait(timeout=60) == 0, "Ctrl+Q closes the window")
    finally:
        window.end()


def compare_with_file(program, window, folder, session, view):
    width, height = view[2:]
    picture = folder / "headless.png"
    subprocess.run([program, "render", "--session", session, "--size", f"{width}x{height}", "-o", picture], check=True)
    below = (0, BELOW_HEADING, width, height - BELOW_HEADING)
    seen = cropped(window.pixels(*view), width, below)
    share = differing(seen, cropped(picture_pixels(picture), width, below))
    if share > 0.001:
        shutil.copy(picture, "headless.png")  # stays where the test ran
    check(share <= 0.001, f"and a picture of the session shows the same blend ({100 * share:.4f} % of the pixels differ)")


if __name__ == "__main__":
    sys.exit(run_journeys(compare, size=(1400, 950)))
