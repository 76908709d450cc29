"""Deviation as colours in the window: measured by itself, grey until it is there and after every change, with a scale
that is chosen in the panel, the other surface as lines; undo and the session keep what was chosen.

Usage: deviation_journey.py PROGRAM
"""

import json
import sys
import time
from pathlib import Path

from screen import PATIENCE, SMALL_TREE, Failure, Window, check, choose, click, drag, page, run_journeys, saved_session

FROM = "The surface that distances are measured to"
SCALE = "Where the colours end; automatic: 99 % of the distances lie below"
LINES = "The surface that distances are measured to, superimposed as lines"


def measured(status):
    return status["surface_ready"] and status["deviation_measured"]


def colourful(window, status):
    """Pixels of the picture's middle that are neither grey nor the background: those of the scale."""
    x, y, width, height = status["viewport"]
    pixels = window.pixels(x + 140, y + 60, width - 280, height - 200)  # beside legend and cube, below the tools
    return sum(1 for i in range(0, len(pixels), 3) if max(pixels[i:i + 3]) - min(pixels[i:i + 3]) > 40)


def turning(window, before):
    """The status once the camera is another; a view that turns does not rest."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        status = window.status()
        if status["camera"] != before:
            return status
        time.sleep(0.02)
    raise Failure("the view does not turn")


def chosen(status):
    return status.get("deviation", {})


def deviation(program, screen, folder):
    (folder / "small tree.swc").write_text(SMALL_TREE)
    session = folder / "by deviation.ramus.json"
    session.write_text(json.dumps({"version": 1, "tree": {"path": "small tree.swc"}, "options": {"colour_by": "deviation"}}))
    window = Window(program, screen, folder, [session, "--size", "1280x800"])
    try:
        status = window.wait("the distances", measured)
        check(0.0 < status["deviation_most_mm"] < 5.0, "distances from the cones are measured: less than a radius")
        first = colourful(window, status)
        check(first > 2000, f"the surface has the colours of the scale: {first} pixels")

        page(window, "surface")
        choose(window, SCALE, "Up to 0.1 mm")
        status = window.wait("the scale", lambda s: chosen(s) == {"from": "cones", "most": 0.1} and measured(s))
        check(status["undo"] == "deviation scale 0.1 mm", "the scale is a step of undo")
        window.xdotool("key", "ctrl+z")
        window.wait("the scale before", lambda s: not chosen(s))
        window.xdotool("key", "ctrl+shift+z")
        window.wait("the scale again", lambda s: chosen(s).get("most") == 0.1)

        x, y, width, height = status["viewport"]
        middle = (x + width // 2, y + height // 2)
        drag(window, [(x + 200, y + height - 160), (x + 240, y + height - 160)], end=False)
        moving = turning(window, status["camera"])
        check(moving["picture"]["of"] == "mesh", "while the view turns its colours stay: no cones stand in")
        window.xdotool("mouseup", 1)
        window.xdotool("mousemove", *middle)

        choose(window, FROM, "Isosurface")
        status = window.wait("the voxels' isosurface", lambda s: chosen(s).get("from") == "iso" and measured(s))
        choose(window, SCALE, "Up to 1 voxel diagonal")
        window.wait("a scale of voxels", lambda s: chosen(s) == {"from": "iso", "unit": "voxels", "most": 1.0})
        click(window, LINES)
        status = window.wait("its lines", lambda s: s.get("comparison", {}).get("mode") == "superimposed" and measured(s))
        check(status["comparison"]["surfaces"] == ["cs", "iso"], "the other surface lies over this one as lines")

        saved_session(window)
        status = window.wait("the session's name", lambda s: "Session saved: " in s["notice"])
        saved = json.loads(Path(status["notice"].split("Session saved: ")[1]).read_text())
        check(saved["deviation"] == {"from": "iso", "unit": "voxels", "most": 1.0} and
              saved["options"]["colour_by"] == "deviation", "the session keeps from what is measured, and the scale")
        check(window.quit() == 0, "Ctrl+Q closes the window")
    finally:
        window.end()


if __name__ == "__main__":
    sys.exit(run_journeys(deviation, size=(1300, 900)))
