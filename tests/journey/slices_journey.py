"""The scan in slices: an aorta with its CT. Scan, crosshair from a vessel, wheel, window and level, planes and cutting away
among the vessels; a vessel is followed and its stenosis judged; a region grows; a picture and a report with slices. A DICOM
folder is dropped on the window. What a person comes for takes five actions at most.

Usage: slices_journey.py PROGRAM
"""

import json
import math
import os
import shutil
import subprocess
import sys
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
import drop
from screen import (Window, check, choose, click, command, differing, drag, middle_of, page, project,
                    run_journeys, saved_picture, saved_session)

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
UP, DOWN = 4, 5  # of the wheel
PLOT = "Diameters along the vessel"
LESS, MORE = "Narrows the range of values; key -", "Widens the range of values; key +"


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


def fork(window, tree):
    """Three actions: a branch is followed by its menu, and a click on the start of the plot goes to where it begins."""
    ends = Counter(end for branch in tree["branches"] for end in (branch[0], branch[-1]))
    branch = next(n for n, points in enumerate(tree["branches"]) if n > 1 and ends[points[0]] > 2 and len(points) > 20)
    points = follow(window, tree, branch)
    left, top, width, height = window.status()["controls"][PLOT]
    window.xdotool("mousemove", left + 1, top + height // 2, "click", 1)
    status = window.wait("the start of the branch", lambda s: s["slices"]["along"]["at"] < 1.5)
    away = math.dist(status["slices"]["crosshair"], points[0][:3])
    check(away < 3.0, f"three actions show the slice of a fork: {away:.1f} mm away")
    window.shot("slices fork")
    three_slices(window)


def follow(window, tree, branch):
    """Two actions: the menu of the branch under the pointer, and its entry. The points of the branch."""
    points = [tree["points"][n] for n in tree["branches"][branch]]
    for at in points[len(points) // 2:]:
        window.xdotool("mousemove", *project(window.status(), at[:3]))
        if window.wait("rest", lambda s: True)["hovered"] == branch:
            break
    window.xdotool("click", 3)
    click(window, "menu: Follow in slices")
    window.wait("the vessel followed", lambda s: {"oblique", "along"} <= set(s["slices_at"]) and PLOT in s["controls"])
    return points


def scroll(window, button):
    """To the panel's first rows, or its last."""
    x, y, width, height = window.status()["viewport"]
    window.xdotool("mousemove", x + width + 100, y + height // 2, "click", "--repeat", 40, button)
    window.wait("rest", lambda s: True)


def three_slices(window):
    window.xdotool("mousemove", *middle_of(window.status(), PLOT), "key", "2")
    window.wait("three slices", lambda s: set(s["slices_at"]) == {"axial", "coronal", "sagittal"})
    scroll(window, UP)


def diameter(window):
    """Two actions: the key of measuring, and a drag across the vessel on the slice."""
    x, y = middle(window.status(), "axial")
    before = len(window.status()["measured"])
    window.xdotool("mousemove", x - 20, y, "key", "m")
    window.wait("the tool", lambda s: s["tool"] == "measure-distance")
    drag(window, [(x - 20, y), (x, y), (x + 20, y)])
    status = window.wait("the length", lambda s: len(s["measured"]) == before + 1)
    first, second = status["measurements"][-1]["points"]
    length = math.dist(first, second)
    check(f"{length:.1f}"[:-1] in status["measured"][-1] and first[2] == second[2],
          f"a drag measures on the slice: {status['measured'][-1]}")
    window.shot("slices measured")
    window.xdotool("key", "Escape")
    window.wait("no tool", lambda s: s["tool"] == "navigate")


def stenosis(window, folder, tree):
    """Four actions: a branch is followed by its menu, and a click on the plot is what the narrowest place is compared with."""
    points = follow(window, tree, 0)
    status = window.status()
    at, place = status["slices"]["along"]["at"], status["slices"]["crosshair"]
    away, radius = min((math.dist(place, p[:3]), p[3]) for p in points)
    check(away < 0.5 * radius, f"two clicks follow a vessel: the crosshair is {away:.1f} mm from its axis")
    window.shot("slices along")
    left, top, width, height = status["controls"][PLOT]
    window.xdotool("mousemove", left + width // 4, top + height // 2, "click", 1)
    status = window.wait("a quarter of the way", lambda s: s["slices"]["along"]["at"] < at)
    click(window, "The section at the current place is what others are compared with")
    status = window.wait("the stenosis", lambda s: "stenosis" in s["slices"]["along"])
    check("reference" in status["slices"]["along"]["stenosis"], "two more judge its narrowest place against another")
    window.shot("slices stenosis")
    at = status["slices"]["along"]["at"]
    window.xdotool("mousemove", *middle(status, "along"), "click", 5)
    window.wait("the next place", lambda s: s["slices"]["along"]["at"] > at)
    check(True, "the wheel goes on along the vessel")
    sections = folder / "sections.csv"
    command(window, f"sections {sections} --step 1")
    window.wait("the table", lambda s: sections.exists())
    check(len(sections.read_text().splitlines()) > 300, "and a table has a section for each mm of the way")
    three_slices(window)


def region(window):
    """A click on a slice grows a region, which buttons and keys widen; it leaves again."""
    scroll(window, DOWN)
    click(window, "Click in a vessel on a slice: similar values around it become a mask")
    window.wait("the tool", lambda s: s["tool"] == "region")
    x, y = middle(window.status(), "axial")
    window.xdotool("mousemove", x, y, "click", 1)
    window.wait("the region", lambda s: MORE in s["controls"])
    scroll(window, DOWN)
    click(window, MORE)
    window.shot("slices region")
    check(True, "a click grows a region of similar values, a button widens them")
    click(window, "Removes the region; Undo step brings it back")
    window.wait("no region", lambda s: MORE not in s["controls"])
    command(window, "tool navigate")
    window.wait("no tool", lambda s: s["tool"] == "navigate")


def leaks(window):
    """Three actions: the segmentation over the scan, in its own colours."""
    scroll(window, UP)
    click(window, ADD)
    window.wait("the dialog", lambda s: s["open_dialog"])
    window.xdotool("type", "lumens")
    window.xdotool("key", "Return")
    window.wait("the labels", lambda s: len(s["scans"]) == 2 and s["resting"])
    window.shot("slices labels")
    check(True, "labels lie over the scan")


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
    window.wait("the cut", lambda s: s["slices"].get("cut_away") == "axial")
    check(differing(before, window.pixels(x, y, width, height)) > 0.02, "cutting away opens the picture at the slice")
    window.shot("slices cut away")
    command(window, "cut-away off")
    window.wait("all vessels", lambda s: "cut_away" not in s["slices"])


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
    status = window.wait("the series", lambda s: any(scan["path"].endswith("series") for scan in s["scans"]))
    check(len(status["scans"]) == 3, "and the dialog shows it in slices")
    window.shot("slices three scans")


def written(window, folder):
    """A picture and a report."""
    report = folder / "report.html"
    command(window, f"report {report}")
    window.wait("the report", lambda s: report.exists() and s["resting"])
    text = report.read_text()
    check("axial" in text.lower() and text.count("data:image/png") > 3, "the report has its slices")
    picture = saved_picture(window)
    check(picture.stat().st_size > 10_000, "the picture is saved with its slices")
    saved = saved_session(window)
    check("slices" in saved.read_text(), "and the session keeps them")


def slices(program, screen, folder):
    for file in (SCAN, LUMENS):
        shutil.copy(file, folder)
    tree_file = folder / "aorta.json"
    subprocess.run([program, "skeletonize", LUMENS, "-o", tree_file, "--label", "all"], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    tree = json.loads(tree_file.read_text())
    window = Window(program, screen, folder, [tree_file, "--units", "mm", "--size", "1440x860"])
    try:
        window.wait("the surface", lambda s: s["surface_ready"])
        scan(window)
        crosshair(window, tree)
        fork(window, tree)
        window_and_level(window)
        diameter(window)
        cut_away(window)
        layouts(window)
        stenosis(window, folder, tree)
        region(window)
        leaks(window)
        dropped(window, folder)
        written(window, folder)
        check(window.quit() == 0, "Ctrl+Q closes the window")
    finally:
        window.end()


if __name__ == "__main__":
    if not VOLUMES.is_dir():
        print("SKIPPED: without the real volumes")
        sys.exit(0)
    sys.exit(run_journeys(slices, size=(1440, 900)))
