"""Planning in an organ: a liver and its two systems of vessels. Its mask is chosen in the dialog, the veins drain, the right
portal branch is cut; branches are named as segments; a line becomes a plane, a stroke a sheet, a lesion of a mask a wedge; two
plans are compared side by side, and the report is written. The numbers are those of the command line.

Usage: organ_journey.py PROGRAM
"""

import csv
import gzip
import html
import json
import math
import os
import re
import struct
import subprocess
import sys
import time
from pathlib import Path

from screen import PATIENCE, Failure, Window, check, choose, click, command, drag, page, project, run_journeys, saved_session

SHARED = Path(os.environ.get("RAMUS_SHARED_DATA", "")) / "volumes"
VESSELS, ORGAN = SHARED / "liver_002_vessels.nii.gz", SHARED / "liver_002_organ.nii.gz"
VEINS = "label 1"
RIGHT_PORTAL = 30
ASK = "Choose the mask of the organ: what do the vessels supply, what do cuts cost?"
SHOW = "The parts of the organ by the branches that supply or drain them"
PLANE = "Draw a line across the picture: a plane behind it divides the organ"
SHEET = "Draw a stroke across the picture: a sheet behind it divides the organ"
COPY = "Begin another plan as a copy of this one"
AROUND = "Remove a lesion with a margin of 10 mm, which can be changed"
MAP = "Lays its surface flat: distances to lesions, and the vessels that it cuts"
BESIDE = "Another plan next to this one, with one camera. Tools act on the one they are used in"
KEPT = "What remains and is still reached by the vessels that supply, in percent of the functional organ"


def answer(program, *words):
    return json.loads(subprocess.run([program, *map(str, words), "--json"], check=True, stdout=subprocess.PIPE,
                                     stderr=subprocess.DEVNULL).stdout)


def spelled(place):
    return ",".join(f"{x:.9g}" for x in place)


def table(window, name):
    """A table of the report, as its rows."""
    path = window.folder / f"{name}.csv"
    path.unlink(missing_ok=True)
    window.xdotool("key", "ctrl+k")
    window.wait("the palette", lambda s: s["palette"]["open"] and s["typing"])
    window.xdotool("type", f"report {path} {name}")
    end = time.monotonic() + PATIENCE
    while window.status()["palette"]["open"] and time.monotonic() < end:
        window.xdotool("key", "Return")  # again while a worker computes the figures: there is no table before
        window.wait("an answer", lambda s: not s["palette"]["open"] or s["palette"]["trouble"])
    window.wait("the table", lambda s: path.exists() and path.stat().st_size > 0)
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def figures(window, plan):
    """Volumes in ml, areas and lengths of the table of figures, by their name."""
    found = {}
    for row in table(window, "organ"):
        if row["plan"] == plan:
            volume = next((row[key] for key in row if key.startswith("volume")), "")
            other = next((row[key] for key in row if key.startswith("area") and row[key]), "")
            found[row["figure"]] = float(volume) / 1000 if volume else float(other) if other else None
    return found


def check_close(found, expected, what):
    check(abs(found - expected) <= 1e-6 * max(1.0, abs(expected)), f"{what}: {found:.3f}, {expected:.3f}")


def over(window, tree, branch):
    """Moves the pointer to a place where the picture shows this branch."""
    points = [tree["points"][point] for point in tree["branches"][branch]]
    places = points + [[(a + b) / 2 for a, b in zip(p, q)] for p, q in zip(points, points[1:])]
    for place in sorted(places, key=lambda p: math.dist(p[:3], points[len(points) // 2][:3])):
        window.xdotool("mousemove", *project(window.status(), place[:3]))
        if window.wait("the pointer at rest", lambda s: True)["hovered"] == branch:
            return
    raise Failure(f"branch {branch} is hidden by others")


def organ(window):
    """The mask in the dialog, and what the systems do."""
    page(window, "plan")
    click(window, ASK)
    window.wait("the dialog", lambda s: s["open_dialog"])
    window.xdotool("type", "organ")
    window.xdotool("key", "Return")
    window.wait("the organ", lambda s: s.get("organ") and SHOW in s["controls"])
    choose(window, f"{VEINS}: what it does for the organ", "Drains the organ")
    window.wait("the role", lambda s: "drains" in json.dumps(s["organ"]))
    check(True, "the dialog reads the mask, and a list says which vessels drain")


def cut(window, program, tree, vessels):
    """The right portal branch: a click, and the figures."""
    over(window, tree, RIGHT_PORTAL)
    window.xdotool("key", "shift+c")
    window.wait("the tool", lambda s: s["tool"] == "cut")
    window.xdotool("click", 1)
    status = window.wait("the cut", lambda s: len(s["cuts"]) == 1 and KEPT in s["controls"])
    branch, fraction = status["cuts"][0]
    check(branch == RIGHT_PORTAL, "a click cuts the right portal branch, and the panel has its figures")
    window.xdotool("key", "Escape")
    expected = answer(program, "territories", vessels, "--organ", ORGAN, "--drains", VEINS, "--group",
                      f"cuts={branch}@{fraction:.17g}")
    found = figures(window, "A")
    check_close(found["Organ"], expected["organ_ml"], "the organ is that of the command line")
    check_close(found["Functional"], expected["functional_ml"], "the functional organ, too")
    remnant = expected["remnant"]
    check_close(found["Keeps supply"], remnant["supplied_ml"], "and what keeps its supply")
    check_close(found["Keeps drainage"], remnant["drained_ml"], "and its drainage")
    check_close(found["Not supplied"], remnant["unsupplied_ml"], "and what loses its supply alone")
    check(0.55 < remnant["unsupplied_ml"] / expected["functional_ml"] < 0.75, "which is the right half of the liver")
    choose(window, SHOW, "What remains after cuts")
    window.wait("the remnant", lambda s: s["organ"].get("territories") == "remnant")
    parts = {row["name"] for row in table(window, "territories")}
    check(len(parts) == 2, f"it is shown in two parts: {sorted(parts)}")
    window.shot("organ remnant")


def names(window, program, tree, vessels):
    """A branch is named as a segment by its menu; the territory of the name is that of the branch."""
    choose(window, SHOW, "None")
    window.wait("the vessels alone", lambda s: s["organ"].get("territories", "off") == "off")
    over(window, tree, 32)
    window.xdotool("click", 3)
    click(window, "menu: Name as segment")
    click(window, "menu: S6")
    window.wait("the name", lambda s: "S6" in json.dumps(s["names"]))
    choose(window, SHOW, "Of named branches")
    window.wait("its territory", lambda s: s["organ"].get("territories") == "names")
    rows = {row["name"]: row for row in table(window, "territories")}
    check(set(rows) == {"S6", "rest"}, "the menu names a segment, and it has a territory")
    expected = answer(program, "territories", vessels, "--organ", ORGAN, "--system", "label 2", "--group", "branches=32")
    volume = next(float(value) for key, value in rows["S6"].items() if key.startswith("volume"))
    check_close(volume / 1000, expected["territories"][0]["volume_ml"], "whose volume is that of the command line")
    window.shot("organ names")


def across(status, share, steps):
    """A way down the picture at a share of its width, bent to the right in the middle."""
    x, y, width, height = status["viewport"]
    ways = [n / (steps - 1) for n in range(steps)]
    return [(x + round(width * (share + (0.0 if steps == 2 else 0.05 * math.sin(math.pi * way)))),
             y + round(height * (0.12 + 0.8 * way))) for way in ways]


def resections(window, program, vessels):
    """A plane in plan A; plan B has the sheet instead."""
    click(window, PLANE)
    status = window.wait("the tool", lambda s: s["tool"] == "resect-plane")
    drag(window, across(status, 0.42, 2))
    status = window.wait("the plane", lambda s: len(s.get("resections", [])) == 1)
    window.xdotool("key", "Escape")
    plane = status["resections"][0]
    command(window, "cut-clear")
    window.wait("no cut", lambda s: not s.get("cuts"))
    found = figures(window, "A")
    expected = answer(program, "resect", "--organ", ORGAN, "--tree", vessels, "--drains", VEINS, "--plane",
                      spelled(plane["point"] + plane["normal"]))
    check_close(found["Removed"], expected["removed_ml"], "a line becomes a plane, which removes what the command line says")
    check_close(found["Remnant"], expected["remnant_ml"], "and leaves the same")
    check(0.0 < found["Removed"] < found["Remnant"], "the smaller side")
    vessels_cut = table(window, "cut-vessels")
    check(len(vessels_cut) == len([one for one in expected["vessels"]]), f"it cuts {len(vessels_cut)} vessels in both")

    for section in ("Lesions", "Cuts"):  # makes room for the sections below
        click(window, f"Closes {section}")
        window.wait("a closed section", lambda s: f"Opens {section}" in s["controls"])
    click(window, COPY)
    window.wait("plan B", lambda s: "B" in json.dumps(s.get("plans", {})))
    command(window, "object-remove resection 1")
    window.wait("no resection", lambda s: not s.get("resections"))
    click(window, SHEET)
    status = window.wait("the tool", lambda s: s["tool"] == "resect-sheet")
    drag(window, across(status, 0.36, 12))
    status = window.wait("the sheet", lambda s: len(s.get("resections", [])) == 1)
    window.xdotool("key", "Escape")
    check(status["resections"][0]["kind"] == "sheet", "plan B begins as a copy, and a stroke becomes its sheet")
    window.shot("organ plans")
    other = figures(window, "B")
    check(abs(other["Removed"] - found["Removed"]) > 1, f"which removes {other['Removed']:.0f} ml")
    check_close(figures(window, "A")["Removed"], found["Removed"], "plan A is as it was")

    choose(window, BESIDE, "A")
    status = window.wait("both plans", lambda s: len(s["viewports"]) == 2)
    click(window, MAP)
    window.wait("the flat map", lambda s: any(words.startswith("The cut surface laid flat") for words in s["controls"]))
    window.shot("organ plans side by side")
    # A tool makes the plan of its viewport the current one.
    click(window, PLANE)
    window.wait("the tool", lambda s: s["tool"] == "resect-plane")
    x, y, width, height = status["viewports"][0]
    drag(window, [(x + width // 3, y + height // 2), (x + width // 3, y + height - 40)])
    status = window.wait("a second plane", lambda s: len(s["resections"]) == 2)
    check(status["plans"]["name"] == "A", "a tool acts on the plan that it is used in")
    window.xdotool("key", "Escape")
    command(window, "object-remove resection 2")
    command(window, "plan-compare off")
    window.wait("one plan", lambda s: len(s["viewports"]) == 1)


def ball(path, centre, radius):
    """A mask of a ball (mm) on the grid of the organ's, whose axes are those of the patient."""
    mask = gzip.open(ORGAN).read()
    size, steps = struct.unpack_from("<3h", mask, 42), struct.unpack_from("<3f", mask, 80)
    origin = [struct.unpack_from("<4f", mask, 280 + 16 * axis)[3] for axis in range(3)]
    voxels = bytearray(size[0] * size[1] * size[2])
    ranges = [range(*(round((c + side * radius - o) / step) + (side > 0) for side in (-1, 1)))
              for c, o, step in zip(centre, origin, steps)]
    for k in ranges[2]:
        for j in ranges[1]:
            for i in ranges[0]:
                if math.dist([o + n * step for o, n, step in zip(origin, (i, j, k), steps)], centre) <= radius:
                    voxels[i + size[0] * (j + size[1] * k)] = 1
    with gzip.open(path, "wb") as file:
        file.write(mask[:352] + voxels)


def wedge(window, program, vessels):
    """A lesion of a mask and a margin, in plan B alone."""
    command(window, "plan-use B")
    window.wait("plan B", lambda s: s["plans"]["name"] == "B")
    command(window, "object-remove resection 1")
    window.wait("no resection", lambda s: not s.get("resections"))
    lesion = window.folder / "lesion.nii.gz"
    ball(lesion, (-110.0, -205.0, 130.0), 15.0)
    command(window, f"lesion-mask {lesion}")
    window.wait("the lesion", lambda s: len(s["lesion_meshes"]) == 1)
    click(window, AROUND)
    window.wait("the wedge", lambda s: len(s.get("resections", [])) == 1)
    found = figures(window, "B")
    expected = answer(program, "resect", "--organ", ORGAN, "--tree", vessels, "--drains", VEINS, "--lesion", lesion, "--margin", 10)
    check_close(found["Removed"], expected["removed_ml"], "a lesion and 10 mm around it")
    window.shot("organ wedge")


def report(window):
    path = window.folder / "report.html"
    command(window, f"report {path}")
    window.wait("the report", lambda s: path.exists() and "</html>" in path.read_text())
    text = html.unescape(re.sub("<[^>]*>", " ", path.read_text()))
    for words in ("Plan A", "Plan B", "Removed", "Remnant", "Keeps supply", "Cut surface", "Before", "After"):
        check(words in text, f"the report has: {words}")


def planning(program, screen, folder):
    vessels = folder / "vessels.json"
    subprocess.run([program, "skeletonize", VESSELS, "-o", vessels], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    (folder / "organ.nii.gz").symlink_to(ORGAN)
    tree = json.loads(vessels.read_text())
    window = Window(program, screen, folder, [vessels, "--size", "1100x1560"])
    try:
        window.wait("the surface", lambda s: s["surface_ready"])
        organ(window)
        cut(window, program, tree, vessels)
        names(window, program, tree, vessels)
        resections(window, program, vessels)
        wedge(window, program, vessels)
        report(window)
        saved = json.loads(saved_session(window).read_text())
        check(len(saved["plans"]["others"]) == 1 if "others" in saved["plans"] else saved["plans"], "the session has both plans")
        check(window.quit() == 0, "the window closes")
    finally:
        window.end()


if __name__ == "__main__":
    if not ORGAN.exists() or not VESSELS.exists():
        print("SKIPPED: there is no shared data")
        sys.exit(0)
    sys.exit(run_journeys(planning, size=(1150, 1600)))
