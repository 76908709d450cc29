"""Masks and scans without a tree: a scan opens as the surface of a threshold that is chosen in the dialog, a mask as
context and as the surface it is. They are saved, opened again and pictured, and a tree comes in among them.

Usage: scene_journey.py PROGRAM
"""

import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
from nifti import nifti, voxels
from screen import (SMALL_TREE, Window, check, click, differing, picture_pixels, run_journeys, saved_picture,
                    saved_session, slide)

SIZE, VOXEL_MM = (44, 36, 48), 2.0
VESSELS = [((44, 36, 4), (44, 36, 34), 7), ((44, 36, 34), (22, 30, 60), 5), ((44, 36, 34), (68, 44, 58), 5),
           ((22, 30, 60), (12, 42, 84), 4)]


def away(place, segment):
    """How far from its axis, in its radii."""
    a, b, radius = segment
    along = [q - p for p, q in zip(a, b)]
    t = sum((c - p) * d for c, p, d in zip(place, a, along)) / sum(d * d for d in along)
    t = min(1.0, max(0.0, t))
    return sum((c - p - t * d) ** 2 for c, p, d in zip(place, a, along)) ** 0.5 / radius


def volume(value, kind):
    """A file with value(radii from the nearest axis, number of the voxel)."""
    values = [value(min(away([VOXEL_MM * v for v in voxel], s) for s in VESSELS), n)
              for n, voxel in enumerate(voxels(SIZE))]
    rows = [[VOXEL_MM if i == j else 0 for j in range(3)] + [-40 if i < 2 else -50] for i in range(3)]
    return nifti(SIZE, values, kind=kind, rows=rows)


def scan():
    """Vessels of 300 that fade into a ground of about 40, as contrast agent does: noise without a generator."""
    return volume(lambda radii, n: int(40 + 260 / (1 + radii ** 6)) + (n * 7919) % 23 - 11, "h")


def mask():
    return volume(lambda radii, n: 1 if radii <= 1 else 0, "B")


def asked(window):
    return window.wait("what the file holds", lambda s: s["volume_dialog"] == {"open": True, "read": True})


def alone(window, count=1):
    return window.wait("what is shown without a tree", lambda s: len(s.get("context", [])) == count and s["all_shown"])


def off_picture(window):
    """The pointer, so that nothing is pointed at."""
    x, y, width, height = window.status()["viewport"]
    window.xdotool("mousemove", x + width // 2, y + height + 10)


def honest(status, what):
    check(status["branch_count"] == 0 and status["scale_bar"] is not None, f"{what}: no tree, and a scale bar")
    check(status["claims"] == {"units": "mm", "orientation": "RAS"}, "unit and sides are those that the file says")


def threshold(program, screen, folder):
    """A scan: its histogram, a threshold that is chosen, its surface alone; saved, opened again, pictured, as a tree."""
    (folder / "scan.nii").write_bytes(scan())
    window = Window(program, screen, folder, [folder / "scan.nii", "--size", "1100x860"])
    try:
        status = asked(window)
        check({"Threshold", "Show as context", "Show as the surface it is"} <= set(status["controls"]),
              "the dialog has a threshold and three ways")
        window.shot("scan-asked")
        slide(window, "Threshold", 0.75)
        window.shot("scan-bright")
        slide(window, "Threshold", 0.5)
        window.xdotool("key", "Right")
        window.xdotool("key", "Right")
        window.shot("scan-chosen")
        window.xdotool("key", "s")
        status = alone(window)
        item = status["context"][0]
        check(120 < item["isovalue"] < 220 and item["exact"] and item["opacity"] == 1.0,
              f"the surface of the threshold stands alone: {item}")
        honest(status, "a scan's surface")
        window.shot("scan-surface")
        window.xdotool("key", "l")
        window.wait("the left side", lambda s: s["camera"]["position"][0] < -100)
        window.xdotool("key", "a")
        window.wait("the front", lambda s: s["camera"]["position"][1] > 100)
        window.xdotool("key", "ctrl+z")
        window.wait("nothing", lambda s: not s["context"])
        window.shot("scan-undone")
        window.xdotool("key", "ctrl+y")
        alone(window)
        session = saved_session(window)
        check(json.loads(session.read_text())["tree"] is None, "the session has no tree")
        picture = saved_picture(window)
        check(len(set(picture_pixels(picture))) > 30, "the picture that was exported shows something")
        window.xdotool("key", "Escape")  # what was written is told over the picture
        window.wait("no word of it", lambda s: not s["written"])
        off_picture(window)
        status = window.status()
        seen = window.pixels(*status["viewport"])
        check(window.quit() == 0, "the window closes")
    finally:
        window.end()
    window = Window(program, screen, folder, [session, "--size", "1100x860"])
    try:
        again = alone(window)
        check(again["context"] == status["context"] and again["camera"] == status["camera"] and not again["modified"],
              "the session opens as it was")
        off_picture(window)
        window.shot("scan-again")
        check(differing(seen, window.pixels(*again["viewport"])) < 0.002, "and looks as before")
        window.xdotool("key", "ctrl+o")
        window.wait("the file dialog", lambda s: s["open_dialog"])
        window.xdotool("type", "scan.nii")
        window.xdotool("key", "Return")
        asked(window)
        window.xdotool("key", "t")
        status = window.wait("the tree", lambda s: s["surface_ready"] and s["branch_count"] > 0)
        check("isovalue" in status["reading"] and not status["context"],
              f"the threshold makes a tree, in the place of its own surface: {status['reading']}")
        window.shot("scan-tree")
        check(window.quit() == 0, "and closes again")
    finally:
        window.end()


def context(program, screen, folder):
    """A mask as context, clear and alone; then as the surface it is; then a tree comes in among both."""
    (folder / "vessels.nii").write_bytes(mask())
    (folder / "small.swc").write_text(SMALL_TREE)
    window = Window(program, screen, folder, [folder / "vessels.nii", "--size", "1100x860"])
    try:
        asked(window)
        window.shot("mask-alone-asked")
        window.xdotool("key", "b")
        honest(alone(window), "clear context")
        window.shot("mask-context")
        window.xdotool("key", "ctrl+o")
        window.wait("the file dialog", lambda s: s["open_dialog"])
        window.xdotool("type", "vessels.nii")
        window.xdotool("key", "Return")
        asked(window)
        click(window, "Show as the surface it is")
        honest(alone(window, 2), "the surface it is")
        window.shot("mask-alone")
        window.xdotool("key", "ctrl+o")
        window.wait("the file dialog", lambda s: s["open_dialog"])
        window.xdotool("type", "small.swc")
        window.xdotool("key", "Return")
        status = window.wait("the tree", lambda s: s["surface_ready"] and s["branch_count"] == 5)
        check(len(status["context"]) == 2, "a tree comes in among what is shown, and nothing is asked")
        window.shot("mask-and-tree")
        check(window.quit() == 0, "the window closes")
    finally:
        window.end()


if __name__ == "__main__":
    sys.exit(run_journeys(threshold, context, size=(1140, 900)))
