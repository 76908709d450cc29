"""A mask with two labels opens in the window: a tree is made of it, each label a system. One system is hidden and one
recoloured, a false connection is cut, surface and tree are exported; the session has all of it when it opens again. The
panel makes the tree in other ways, and refuses to while it is edited. Who opens a mask is asked what becomes of it.

Usage: mask_journey.py PROGRAM
"""

import json
import struct
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
from nifti import nifti, voxels
from screen import Window, check, choose, click, differing, info_of, project, run_journeys, saved_session, slide

SIZE, VOXEL_MM = (46, 36, 44), 2.0

# Centerlines in mm with their radius. A portal vein that forks, with an artery beside it under the same label.
PORTAL = [((46, 36, 6), (46, 36, 30), 5), ((46, 36, 30), (26, 30, 48), 4), ((46, 36, 30), (64, 42, 46), 4),
          ((26, 30, 48), (14, 40, 66), 3), ((26, 30, 48), (34, 18, 68), 3)]
ARTERY = [((24, 54, 8), (28, 54, 46), 3.5)]
BRIDGE = ((25, 52, 17), (44, 38, 20), 2)  # where both touch in the picture, and not in the patient
HEPATIC = [((76, 58, 80), (70, 50, 56), 4), ((70, 50, 56), (50, 60, 34), 3), ((70, 50, 56), (78, 30, 36), 3)]

LABELS = "Which labels of the mask become which systems"
ISLANDS = "Pieces that are nowhere longer than this are left out"
LOOPS = "Vessels that touch, and holes in the mask, make loops; each is closed where it is thinnest"
ROOT = "Where the blood enters: the end that all others depend on"
LINE = "Shows what reading the file assumed, repaired and finds strange"


def within(place, segment):
    a, b, radius = segment
    along = [q - p for p, q in zip(a, b)]
    t = sum((c - p) * d for c, p, d in zip(place, a, along)) / sum(d * d for d in along)
    t = min(1.0, max(0.0, t))
    return sum((c - p - t * d) ** 2 for c, p, d in zip(place, a, along)) <= radius * radius


def mask():
    """The bytes of the file: 1 portal vein and artery, 2 hepatic vein. Each has an isolated speck."""
    first, second = PORTAL + ARTERY + [BRIDGE], HEPATIC
    values = []
    for voxel in voxels(SIZE):
        place = [VOXEL_MM * v for v in voxel]
        speck = voxel[0] in (40, 41) and voxel[1] == 4 and voxel[2] in (6, 7, 8)
        values.append(1 if speck or any(within(place, s) for s in first) else
                      2 if any(within(place, s) for s in second) else 0)
    rows = [[VOXEL_MM if i == j else 0 for j in range(3)] + [0] for i in range(3)]
    return nifti(SIZE, values, rows=rows)


def names(status):
    return {words[len("Hide "):] for words in status["controls"] if words.startswith("Hide ")}


def away(window):
    x, y, width, height = window.status()["viewport"]
    window.xdotool("mousemove", x + width // 2, y + height + 10)
    return window.wait("the surface", lambda s: s["surface_ready"] and s["hovered"] == -1)


def glb_nodes(path):
    data = path.read_bytes()
    length, = struct.unpack_from("<I", data, 12)
    return json.loads(data[20:20 + length])


def systems(window):
    """Two at once, one hidden by its eye. Returns the hidden branches."""
    status = window.wait("the tree", lambda s: s["surface_ready"] and "Hide portal vein" in s["controls"])
    check(names(status) >= {"portal vein", "label 2"}, "each label is a system")
    check(status["options"]["colour_by"] == "system" and status["comparison"]["mode"] == "side-by-side",
          "coloured as such, with the mask's own surface beside the tree")
    away(window)
    window.shot("mask-opened")
    click(window, "Hide label 2")
    status = window.wait("it hidden", lambda s: s["states"]["hidden"] and s["surface_ready"])
    return status["states"]["hidden"]


def options(window, hidden):
    """Other ways to make the tree of the mask; each is a step of undo, and what is hidden stays."""
    before = window.status()
    if not before["doctor"]["open"]:
        click(window, LINE)
    window.wait("the panel", lambda s: LABELS in s["controls"])
    window.shot("mask-panel")
    slide(window, ISLANDS, 0.12)
    status = window.wait("fewer pieces", lambda s: s["pieces"] == before["pieces"] - 1 and s["surface_ready"])
    check(status["reading"]["islands"] > 5 and status["undo"].startswith("read as islands"),
          f"islands go, as one step of undo: {status['reading']}, {status['undo']}")
    check(len(status["states"]["hidden"]) == len(hidden), "a hidden system stays hidden")
    choose(window, LABELS, "All together one tree")
    status = window.wait("one tree", lambda s: s["reading"].get("labels") == "together" and s["surface_ready"])
    check(not names(status) & {"portal vein", "label 2"} and status["options"]["colour_by"] == "nothing",
          "labels together have no systems")
    window.shot("mask-together")
    window.xdotool("key", "ctrl+z")
    status = window.wait("systems again", lambda s: "labels" not in s["reading"] and s["surface_ready"]
                         and "Show label 2" in s["controls"])
    check(len(status["states"]["hidden"]) == len(hidden) and "Hide portal vein" in status["controls"],
          "undo brings back systems, the hidden one hidden, the named one named")
    roots = status["branch_count"]
    click(window, LOOPS)
    status = window.wait("closed loops", lambda s: s["reading"].get("fill_holes") is True and s["surface_ready"])
    check(status["branch_count"] == roots, "there are no loops to close here")
    return status["branch_count"]


def cut(window):
    """The connection that is none: a click in its middle."""
    pieces = window.status()["pieces"]
    click(window, "Disconnect")
    window.wait("the tool", lambda s: s["tool"] == "disconnect")
    window.xdotool("key", "Escape")  # the panel lies over a part of the picture
    window.wait("no panel", lambda s: not s["doctor"]["open"])
    if window.status()["tool"] != "disconnect":
        click(window, "Disconnect")
    away(window)
    middle = [(a + b) / 2 for a, b in zip(BRIDGE[0], BRIDGE[1])]
    at = project(window.status(), middle)
    window.xdotool("mousemove", *at)
    window.xdotool("mousemove", at[0] + 1, at[1])
    window.xdotool("click", 1)
    status = window.wait("one piece more", lambda s: s["pieces"] == pieces + 1 and s["surface_ready"])
    check([edit["edit"] for edit in status["edits"]] == ["cut"],
          f"the bridge is cut, the artery is a piece of its own: {status['notice']}")
    click(window, "Navigate")
    away(window)
    window.shot("mask-cut")
    click(window, LINE)
    window.wait("the panel", lambda s: LOOPS in s["controls"])
    click(window, LOOPS)
    status = window.wait("a word", lambda s: "edited" in s["notice"])
    check(status["reading"].get("fill_holes") is True, "an edited tree is not made again: " + status["notice"])
    window.xdotool("key", "Escape")
    window.wait("no panel", lambda s: not s["doctor"]["open"])
    return window.status()


def exports(program, window, folder):
    """GLB of what is visible, SWC of what is visible: neither has the hidden system."""
    status = window.status()
    visible = status["branch_count"] - len(status["states"]["hidden"])
    for name, choice in (("seen.glb", None), ("seen.swc", "Centerlines and radii, as they were read.")):
        window.xdotool("key", "ctrl+e")
        window.wait("the dialog", lambda s: s["open_dialog"] and "How the file is written" in s["controls"])
        if choice:
            click(window, choice)
        window.wait("the field", lambda s: s["typing"])
        window.xdotool("key", "ctrl+a")
        window.xdotool("type", name)
        window.shot(f"mask-export-{name[-3:]}")
        window.xdotool("key", "Return")
        window.wait(name, lambda s: (folder / name).exists() and not s["open_dialog"] and name in s["notice"])
    window.xdotool("key", "Escape")  # what was written is told over the picture
    window.wait("no word of it", lambda s: not s["written"])
    written = info_of(program, folder / "seen.swc")
    check(written["branches"] == visible, f"the SWC has the {visible} branches that are seen")
    check(written["roots"] == 2, "in two pieces: portal vein and artery")
    scene = glb_nodes(folder / "seen.glb")
    shown = [node["name"] for node in scene["nodes"] if "mesh" in node]
    check(shown == ["portal vein"], f"the GLB has one object, with the name of the session: {shown}")
    colour = scene["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"]
    check(scene["materials"][0]["name"] == "portal vein" and colour[1] > colour[0] and colour[1] > colour[2],
          f"and its colour: {colour}")


def kept(status):
    return {key: status[key] for key in ("edits", "systems", "states", "reading", "options", "comparison")}


def asked(program, screen, folder):
    """A mask on the command line, one from the menu: one dialog says what it holds and asks what becomes of it."""
    (folder / "vessels.nii").write_bytes(mask())
    window = Window(program, screen, folder, [folder / "vessels.nii", "--size", "1100x860"])
    try:
        status = window.wait("what the mask holds", lambda s: s["volume_dialog"] == {"open": True, "read": True})
        check({"Label 1", "Label 2", "Labels together"} <= set(status["controls"]), "the dialog lists the labels")
        window.shot("mask-asked")
        click(window, "Label 2")
        window.xdotool("key", "Return")
        status = window.wait("the tree", lambda s: s["surface_ready"] and s["branch_count"] > 0)
        check(status["reading"].get("labels") in ("1", [[1]]), f"a tree is made of the label that is chosen: {status['reading']}")
        window.shot("mask-one-label")
        window.xdotool("key", "ctrl+o")
        window.wait("the file dialog", lambda s: s["open_dialog"])
        window.xdotool("type", "vessels.nii")
        window.xdotool("key", "Return")
        window.wait("the dialog", lambda s: s["volume_dialog"] == {"open": True, "read": True})
        click(window, "Label 1")
        window.shot("mask-asked-again")
        click(window, "Show as the surface it is")
        status = window.wait("the surface", lambda s: len(s.get("context", [])) == 1 and s["surface_ready"])
        item = status["context"][0]
        check(item["label"] == 2 and item["opacity"] == 1.0 and item["exact"],
              f"the other label stands beside it as the surface it is: {item}")
        window.shot("mask-surface")
        check(window.quit() == 0, "the window closes")
    finally:
        window.end()
    window = Window(program, screen, folder, [folder / "vessels.nii", "--size", "1100x860", "--isovalue", "2"])
    try:
        status = window.wait("the tree", lambda s: s["surface_ready"] and s["branch_count"] > 0)
        check(status["reading"].get("isovalue") == 2 and not status["volume_dialog"]["open"],
              f"with a threshold of the command line nothing is asked: {status['reading']}")
        check(window.quit() == 0, "the window closes")
    finally:
        window.end()
    (folder / "opens.txt").write_text(f'open "{folder / "vessels.nii"}" --tree --isovalue 2\n')
    window = Window(program, screen, folder, ["--size", "1100x860", "--commands", folder / "opens.txt"])
    try:
        window.wait("the tree", lambda s: s["surface_ready"] and s["reading"].get("isovalue") == 2)
        check(window.quit() == 0, "a script opens a mask with options, too")
    finally:
        window.end()


def journey(program, screen, folder):
    (folder / "vessels.nii").write_bytes(mask())
    (folder / "commands.txt").write_text('name-system 1 "portal vein"\ncolour-system 1 30b060\n')
    window = Window(program, screen, folder, [folder / "vessels.nii", "--size", "1200x900", "--commands",
                                              folder / "commands.txt"])
    try:
        hidden = systems(window)
        options(window, hidden)
        cut(window)
        exports(program, window, folder)
        session = saved_session(window)
        status = window.status()
        before = kept(status)
        away(window)
        seen = window.pixels(*status["viewport"])
        check(window.quit() == 0, "the window closes")
    finally:
        window.end()
    window = Window(program, screen, folder, [session, "--size", "1200x900"])
    try:
        status = window.wait("the session", lambda s: s["surface_ready"])
        check(kept(status) == before, "the session opens with all of it: hidden, edited, named, read as before")
        away(window)
        window.shot("mask-again")
        check(differing(seen, window.pixels(*status["viewport"])) < 0.002, "and looks as before")
        check(window.quit() == 0, "and closes again")
    finally:
        window.end()


if __name__ == "__main__":
    sys.exit(run_journeys(asked, journey, size=(1240, 940)))
