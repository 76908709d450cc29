"""The scan in slices: an aorta with its CT. Scan, crosshair from a vessel, wheel, window and level, planes and cutting away
among the vessels; a picture and a report with slices. A DICOM folder is dropped on the window.

Usage: slices_journey.py PROGRAM
"""

import json
import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
import drop
from screen import (Failure, Window, check, choose, click, differing, middle_of, page, project, run_journeys, saved_picture,
                    saved_session)

try:
    import numpy as np
    import pydicom  # noqa: F401
    from dicom import write_series
except ImportError:
    np = None

VOLUMES = Path(os.environ.get("RAMUS_SHARED_DATA", "")) / "volumes"
SCAN, LUMENS = VOLUMES / "aorta_dissection_ct.nii.gz", VOLUMES / "aorta_dissection_lumens.nii.gz"
ADD = "Show a scan, or the labels of a segmentation, in slices"
CUT = "Leaves out what lies before a slice"
WINDOW = "The values from black to white; right-drag over a slice changes width (across) and level (up and down)"


def middle(status, slice):
    x, y, width, height = status["slices_at"][slice]
    return x + width // 2, y + height // 2


def scan(window):
    """Chosen in the dialog: the picture is divided into the vessels and three slices."""
    page(window, "slices")
    click(window, ADD)
    window.wait("the dialog", lambda s: s["open_dialog"])
    window.xdotool("type", "ct.nii")
    window.xdotool("key", "Return")
    status = window.wait("the scan", lambda s: len(s.get("scans", [])) == 1 and len(s["slices_at"]) == 3)
    check(set(status["slices_at"]) == {"axial", "coronal", "sagittal"}, "a scan opens in three slices next to the vessels")
    check(CUT in status["controls"] and WINDOW in status["controls"], "and the page has its window and its planes")


def crosshair(window, tree):
    """A click on a vessel moves the slices there; on a slice it moves the other two; the wheel goes through them."""
    points = [tree["points"][n] for n in tree["branches"][0]]
    at = points[len(points) // 2]
    window.xdotool("mousemove", *project(window.status(), at[:3]))
    window.wait("the branch under the pointer", lambda s: s["hovered"] == 0)
    window.xdotool("click", 1)
    status = window.wait("the crosshair", lambda s: "crosshair" in s.get("slices", {}))
    place = status["slices"]["crosshair"]
    away = min(math.dist(place, p[:3]) for p in points)
    check(away < 2.0, f"a click on a vessel moves the crosshair onto its axis: {away:.2f} mm")
    x, y = middle(status, "axial")
    window.xdotool("mousemove", x, y, "click", 4)
    status = window.wait("the next slice", lambda s: s["slices"]["crosshair"][2] != place[2])
    step = abs(status["slices"]["crosshair"][2] - place[2])
    check(status["slices"]["crosshair"][:2] == place[:2] and 0.1 < step < 5, f"the wheel goes on by a slice: {step:.2f} mm")
    window.xdotool("mousemove", x + 40, y, "click", 1)
    moved = window.wait("the crosshair elsewhere", lambda s: s["slices"]["crosshair"][0] != place[0])
    check(moved["slices"]["crosshair"][2] == status["slices"]["crosshair"][2], "a click moves the place within the slice")
    check(math.dist(moved["slices"]["crosshair"], moved["slice_place"]) < 1e-6, "to what is under the pointer")
    window.shot("slices crosshair")


def window_and_level(window):
    """The right button changes them, as one step of undo; a name sets them."""
    x, y = middle(window.status(), "coronal")
    window.xdotool("mousemove", x, y, "mousedown", 3)
    for k in range(1, 9):
        window.xdotool("mousemove", x + 10 * k, y + 5 * k)
    window.xdotool("mouseup", 3)
    status = window.wait("another window", lambda s: s["scans"][0].get("window"))
    check(status["undo"].startswith("window"), "a drag with the right button is a window of its own, one step of undo")
    choose(window, WINDOW, "CT bone")
    window.wait("the window of bones", lambda s: s["scans"][0]["window"] == {"width": 2000, "level": 400} or
                s["scans"][0]["window"] == [2000, 400])
    window.xdotool("key", "ctrl+z", "ctrl+z")
    window.wait("the first one", lambda s: not s["scans"][0].get("window"))
    check(True, "a name sets the window, and undo brings the first one back")
    choose(window, WINDOW, "CT angiography")


def cut_away(window):
    """The vessels before a slice are left out; the picture shows the slice."""
    x, y, width, height = window.status()["viewports"][0]
    before = window.pixels(x, y, width, height)
    choose(window, CUT, "Before the axial")
    status = window.wait("the cut", lambda s: s["slices"].get("cut_away") == "axial")
    check(differing(before, window.pixels(x, y, width, height)) > 0.02, "cutting away opens the picture at the slice")
    window.shot("slices cut away")
    return status


def layouts(window):
    """A key each, and back."""
    for key, count in (("4", 1), ("3", 3), ("1", 0), ("2", 3)):
        window.xdotool("mousemove", *middle_of(window.status(), CUT), "key", key)
        window.wait(f"layout {key}", lambda s, n=count: len(s["slices_at"]) == n)
    check(True, "keys divide the picture otherwise")


def dropped(window, folder):
    """A DICOM folder is dropped on the picture, and the dialog shows it in slices, over the first scan."""
    if drop.MISSING or np is None:
        print(f"SKIPPED: nothing is dropped without python3-xlib and python3-pydicom ({drop.MISSING})")
        return
    series = folder / "series"
    series.mkdir()
    values = np.indices((40, 30, 20)).sum(axis=0).astype(np.uint16) * 20
    write_series(series, values, (1, 0, 0), (0, 1, 0), (0, 0, 2.5), corner=(10, -170, 600))
    check(drop.drop(window, [series]), "the window takes a folder that is dropped on it")
    window.wait("the question what it is for", lambda s: s["volume_dialog"]["open"] and s["volume_dialog"]["read"])
    window.shot("slices dropped")
    window.xdotool("key", "i")
    status = window.wait("the second scan", lambda s: len(s.get("scans", [])) == 2)
    check(status["scans"][1]["path"].endswith("series"), "and the dialog shows it in slices")
    window.shot("slices two scans")


def written(window):
    """A picture and a report."""
    picture = saved_picture(window)
    check(picture.stat().st_size > 10_000, "the picture is saved with its slices")
    saved = saved_session(window)
    check("slices" in saved.read_text(), "and the session keeps them")


def slices(program, screen, folder):
    shutil.copy(SCAN, folder)
    tree_file = folder / "aorta.json"
    subprocess.run([program, "skeletonize", LUMENS, "-o", tree_file, "--label", "all"], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    tree = json.loads(tree_file.read_text())
    window = Window(program, screen, folder, [tree_file, "--units", "mm", "--size", "1440x860"])
    try:
        window.wait("the surface", lambda s: s["surface_ready"])
        scan(window)
        crosshair(window, tree)
        window_and_level(window)
        cut_away(window)
        layouts(window)
        dropped(window, folder)
        written(window)
        check(window.quit() == 0, "Ctrl+Q closes the window")
    finally:
        window.end()


if __name__ == "__main__":
    if not VOLUMES.is_dir():
        print("SKIPPED: without the real volumes")
        sys.exit(0)
    sys.exit(run_journeys(slices, size=(1440, 900)))
