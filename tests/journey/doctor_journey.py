"""The import doctor: a VMTK centerline in centimetres opens, the doctor says so by itself, leads to the place where a
repeated trunk was merged, reads the file in cm so that the radii are right, and mends less when asked; undo, redo and the
session keep all of it.

Usage: doctor_journey.py PROGRAM
"""

import json
import subprocess
import sys

from screen import Window, check, choose, click, info_of, project, run_journeys, saved_session

UNIT = "What one unit of the file's coordinates is"
REPAIRS = "What may be repaired when the file is read"
TRUNKS = "What several centerlines trace alike becomes one vessel"
LINE = "Shows what reading the file assumed, repaired and finds strange"
TRUNK_CM, LEG_CM, STEP_CM = 8.0, 5.0, 0.25


def centerlines():
    """Two polylines from the inlet to each outlet, as vmtkcenterlines writes them: the trunk is there twice. In cm."""
    points, radii, lines = [], [], []
    for side in (-1.0, 1.0):
        line = []
        for i in range(int(TRUNK_CM / STEP_CM) + 1):
            line.append(len(points))
            points.append((0.0, 0.0, i * STEP_CM))
            radii.append(0.5)
        for i in range(1, int(LEG_CM / STEP_CM) + 1):
            line.append(len(points))
            points.append((side * 0.6 * i * STEP_CM, 0.0, TRUNK_CM + 0.8 * i * STEP_CM))
            radii.append(0.5 - 0.2 * i * STEP_CM / LEG_CM)
        lines.append(line)

    def array(name, kind, values, components=1):
        return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">'
                + " ".join(map(str, values)) + "</DataArray>")

    ends, total = [], 0
    for line in lines:
        total += len(line)
        ends.append(total)
    return "\n".join([
        '<?xml version="1.0"?>', '<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">', "<PolyData>",
        f'<Piece NumberOfPoints="{len(points)}" NumberOfLines="{len(lines)}">',
        "<PointData>", array("MaximumInscribedSphereRadius", "Float64", radii), "</PointData>",
        "<CellData>", array("CenterlineIds", "Int32", [0, 1]), "</CellData>",
        "<Points>", array("Points", "Float64", [c for p in points for c in p], 3), "</Points>",
        "<Lines>", array("connectivity", "Int32", [i for line in lines for i in line]), array("offsets", "Int32", ends),
        "</Lines>", "</Piece>", "</PolyData>", "</VTKFile>", ""])


def thickest(status):
    return status["radius_mm"][1]


def near(a, b, tolerance=1e-6):
    return abs(a - b) <= tolerance * max(1.0, abs(b))


def units(window):
    """The doctor's panel is there by itself; cm make the radii right, and what is seen stays."""
    window.wait("the question for the unit", lambda s: s["surface_ready"] and s["units_panel"])
    click(window, "Leave open")
    status = window.wait("the doctor", lambda s: not s["units_panel"])
    check(status["doctor"]["open"], "the doctor comes by itself: sizes are those of cm")
    check(near(thickest(status), 0.5), "the radii are taken as mm")
    before = project(status, (0, 0, 4))
    choose(window, UNIT, "Centimetres (cm)")
    status = window.wait("radii in mm", lambda s: near(thickest(s), 5.0) and s["surface_ready"])
    check(status["undo"] == "read as units cm" and status["reading"] == {"units": "cm"},
          "cm are chosen in the panel, as one step of undo")
    after = project(status, (0, 0, 40))
    check(all(abs(a - b) <= 1 for a, b in zip(before, after)), f"the same is seen: {before} and {after}")
    window.xdotool("key", "ctrl+z")
    window.wait("the tree before", lambda s: near(thickest(s), 0.5) and s["surface_ready"])
    window.xdotool("key", "ctrl+shift+z")
    window.wait("the tree in cm", lambda s: near(thickest(s), 5.0) and s["surface_ready"])
    check(True, "undo and redo change the tree")


def places(window, notes):
    """A click on the note of the merged trunk leads there."""
    number = [note["topic"] for note in notes].index("repeated-trunks") + 1
    click(window, f"Note {number}")
    status = window.wait("the place", lambda s: s["doctor"]["note"] == number)
    at = notes[number - 1]["at"]
    check(all(near(a, b, 1e-3) for a, b in zip(status["camera"]["focal_point"], at)), f"a click looks at {at}")
    x, y, width, height = status["viewport"]
    seen = project(status, at)
    check(abs(seen[0] - x - width / 2) <= 2 and abs(seen[1] - y - height / 2) <= 2, "in the middle of the picture")


def repairs(window):
    """A repair that is switched off leaves what it mended; switched on again, it mends."""
    click(window, REPAIRS)
    click(window, TRUNKS)
    status = window.wait("both trunks", lambda s: "repair" in s.get("reading", {}) and s["surface_ready"])
    check("repeated-trunks" not in status["reading"]["repair"] and status["reading"]["units"] == "cm",
          "trunks are left alone, and the unit stays")
    click(window, TRUNKS)
    status = window.wait("one trunk", lambda s: s["reading"] == {"units": "cm"} and s["surface_ready"])
    check(near(thickest(status), 5.0), "and merged again")


def panel(window):
    """Escape closes the panel, the line in the side panel opens it."""
    window.xdotool("key", "Escape")
    window.wait("no doctor", lambda s: not s["doctor"]["open"])
    click(window, LINE)
    window.wait("the doctor", lambda s: s["doctor"]["open"])
    check(True, "Escape closes the panel, the line in the side panel opens it again")


def doctor(program, screen, folder):
    tree = folder / "aorta.vtp"
    tree.write_text(centerlines())
    notes = json.loads(subprocess.run([program, "info", tree, "--json", "--units", "cm"], check=True,
                                      stdout=subprocess.PIPE).stdout)["notes"]
    window = Window(program, screen, folder, [tree, "--size", "1200x800"])
    try:
        units(window)
        places(window, notes)
        repairs(window)
        panel(window)
        session = saved_session(window)
        check(json.loads(session.read_text())["reading"] == {"units": "cm"}, "the session keeps the unit")
        subprocess.run([program, "convert", "--session", session, "-o", folder / "mm.swc"], check=True)
        written = info_of(program, folder / "mm.swc")
        check(near(written["radius_mm"]["max"], 5.0) and written["branches"] == 3, "what is written of it is in mm")
        check(window.quit() == 0, "Ctrl+Q closes the window")
    finally:
        window.end()
    window = Window(program, screen, folder, [session, "--size", "1200x800"])
    try:
        status = window.wait("the session", lambda s: s["surface_ready"])
        check(near(thickest(status), 5.0) and status["reading"] == {"units": "cm"}, "and opens with it")
        check(window.quit() == 0, "and closes again")
    finally:
        window.end()


RADIUS = "The radius of all points, in mm; Enter opens the file with it"
MISSING = ("The radius in mm of points whose radius the file does not give; Enter takes it, and an empty field takes it "
           "back")


def without_radii(program, screen, folder):
    """A file without radii opens with one that is typed into the message; the doctor has a row to change it."""
    tree = folder / "bare.swc"
    tree.write_text("id type x y z parent\n1 2 0 0 0 -1\n2 2 0 0 30 1\n3 2 9 0 45 2\n4 2 -9 0 45 2\n")
    window = Window(program, screen, folder, [tree, "--size", "1200x800"])
    try:
        status = window.wait("the message", lambda s: s["error"])
        check("no point has a positive radius" in status["error"], "a file without radii says what it lacks")
        click(window, RADIUS)
        window.wait("the field", lambda s: s["typing"])
        window.xdotool("type", "2.5")
        window.xdotool("key", "Return")
        status = window.wait("the tree", lambda s: s["surface_ready"] and not s["error"])
        check(near(thickest(status), 2.5) and status["reading"] == {"radius_mm": 2.5}, "it opens with the radius that was typed")
        if status["units_panel"]:
            click(window, "Leave open")
        status = window.wait("the doctor", lambda s: not s["units_panel"] and s["doctor"]["open"])
        check(status["doctor"]["open"], "the doctor comes by itself: nobody measured the radii")
        click(window, MISSING)
        window.wait("the row's field", lambda s: s["typing"])
        window.xdotool("type", "4")
        window.xdotool("key", "Return")
        status = window.wait("another radius", lambda s: near(thickest(s), 4) and s["surface_ready"])
        check(status["undo"] == "read as radius 4", "the row takes another radius, as one step of undo")
        check(window.quit() == 0, "Ctrl+Q closes the window")
    finally:
        window.end()


if __name__ == "__main__":
    sys.exit(run_journeys(doctor, without_radii, size=(1300, 900)))
