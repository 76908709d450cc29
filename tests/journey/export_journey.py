"""What a tree becomes outside: the dialog of File > Export offers every kind and format, writes what is visible,
selected or all, asks before it replaces, and says what went wrong. Pictures have any size and ground and are seen before
they are written; turntables and reports are made behind the window, which goes on, and can be cancelled.

Usage: export_journey.py PROGRAM
"""

import json
import os
import struct
import subprocess
import sys
import time

from screen import PATIENCE, SMALL_TREE, Failure, Window, check, choose, click, info_of, middle_of, run_journeys

PRINTING = "Makes sure that the surface is closed and in mm, and says how thin it is at its thinnest place"


def nodes_of(path):
    data = path.read_bytes()
    length, = struct.unpack_from("<I", data, 12)
    return [node for node in json.loads(data[20:20 + length])["nodes"] if "mesh" in node]


def write_as(window, name):
    """The name in the field, which is marked as a whole, and Enter."""
    window.wait("the field for the name", lambda s: s["typing"])
    window.xdotool("type", name)
    window.xdotool("key", "Return")


def dialog(window):
    window.xdotool("key", "ctrl+e")
    window.wait("the export dialog", lambda s: s["open_dialog"] and "Write it" in s["controls"])


def exported(window, path):
    window.wait(f"the file {path.name}", lambda s: path.exists() and not s["open_dialog"] and str(path) in s["notice"])


OPENER = """#!/bin/sh
echo "$1" >> "$HOME/opened"
"""
TURNTABLE = "Once around, as pictures or as a video."


def ground_of(path, x, y):
    """The colour of a pixel, three numbers."""
    return list(subprocess.run(["convert", str(path), "-crop", f"1x1+{x}+{y}", "-alpha", "off", "-depth", "8", "rgb:-"],
                               check=True, stdout=subprocess.PIPE).stdout)


def until(window, what, condition):
    """As Window.wait(), while work goes on."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        status = window.status()
        if status and condition(status):
            return status
        time.sleep(0.02)
    raise Failure(f"waited for: {what}\n{json.dumps(window.status())}")


def slides(window, folder):
    """A picture for a slide, on white with a caption; the folder opens by a button."""
    window.xdotool("key", "F12")
    window.wait("the picture's page", lambda s: s["export"] == "picture .png" and "Preview" in s["controls"])
    choose(window, "How many pixels the picture has", "Slide, 1920 x 1080")
    choose(window, "What is behind the tree", "White")
    click(window, "Words at the top left")
    window.xdotool("type", "Portal vein")
    window.wait("the caption", lambda s: s["typing"])
    window.shot("export-slide")
    click(window, "Write it")
    slide = folder / "small tree.png"
    exported(window, slide)
    check(subprocess.run(["identify", "-format", "%w %h", slide], check=True, stdout=subprocess.PIPE).stdout == b"1920 1080",
          "a picture has the size that was chosen, whatever the window's is")
    check(ground_of(slide, 0, 1079) == [255, 255, 255], "on white")
    status = window.wait("what was written", lambda s: s["written"] == str(slide))
    window.shot("export-written")
    click(window, "Shows the file's folder in the desktop's file manager")
    until(window, "the folder", lambda s: (folder / "opened").exists())
    check((folder / "opened").read_text() == f"{folder}\n", "a button opens the folder of what was written")
    window.xdotool("key", "Escape")
    window.wait("no word of it", lambda s: not s["written"])


def turning(window, folder):
    """A turntable of many pictures is made behind the window: help opens meanwhile, and cancelling stops it and leaves none."""
    dialog(window)
    click(window, TURNTABLE)
    window.wait("the turntable's page", lambda s: s["export"] == "turntable .png" and "Preview" in s["controls"])
    window.shot("export-turntable")
    write_as(window, "around")
    status = until(window, "the work", lambda s: not s["open_dialog"] and "Cancel what goes on" in s["controls"])
    window.xdotool("key", "F1")
    until(window, "help while it draws", lambda s: s["help"] and "Cancel what goes on" in s["controls"])
    window.shot("export-working", rests=False)
    window.xdotool("key", "Escape")
    until(window, "no help", lambda s: not s["help"])
    window.xdotool("mousemove", *middle_of(window.status(), "Cancel what goes on"), "click", 1)
    window.wait("the end of it", lambda s: "Cancel what goes on" not in s["controls"])
    check(not list(folder.glob("*around*")),
          "a turntable that is cancelled leaves none of its pictures, and the window went on meanwhile")


def reported(window, folder):
    dialog(window)
    click(window, "A page with pictures and tables of the plan.")
    window.wait("the report's page", lambda s: s["export"] == "report .html" and "Case line" in s["controls"])
    window.wait("the field for the name", lambda s: s["typing"])
    window.xdotool("type", "case.html")
    click(window, "Case line")
    window.xdotool("type", "Case 17")
    window.shot("export-report")
    click(window, "Write it")
    exported(window, folder / "case.html")
    page = (folder / "case.html").read_text()
    check(page.count("<img") == 3 and '<p class="case">Case 17</p>' in page,
          "a report is a page with three pictures and the case line that was typed")
    dialog(window)
    window.wait("the report's page again", lambda s: s["export"] == "report .html")
    write_as(window, "plan")
    exported(window, folder / "plan.html")
    check("Case 17" not in (folder / "plan.html").read_text(), "the next report has no case line until somebody types it")
    dialog(window)
    click(window, "Four views on one sheet, all at one scale.")
    window.wait("the sheet's page", lambda s: s["export"] == "sheet .png" and "Preview" in s["controls"])
    window.shot("export-sheet")
    write_as(window, "views")
    exported(window, folder / "views.png")
    check(ground_of(folder / "views.png", 0, 1079) == [255, 255, 255], "a sheet has the size and ground of the picture before")


def export(program, screen, folder):
    opener = folder / "bin" / "xdg-open"
    opener.parent.mkdir()
    opener.write_text(OPENER)
    opener.chmod(0o755)
    os.environ["PATH"] = f"{opener.parent}:{os.environ['PATH']}"
    tree = folder / "small tree.swc"
    tree.write_text(SMALL_TREE)
    window = Window(program, screen, folder, [tree, "--size", "1100x760"])
    try:
        window.wait("the surface", lambda s: s["surface_ready"])
        dialog(window)
        window.shot("export-surface")
        write_as(window, "all.stl")
        exported(window, folder / "all.stl")
        check((folder / "all.stl").stat().st_size > 100_000, "Ctrl+E asks, and an STL is written")
        subprocess.run([program, "mesh", tree, "-o", folder / "expected.stl"], check=True, stdout=subprocess.DEVNULL)
        check((folder / "all.stl").read_bytes() == (folder / "expected.stl").read_bytes(),
              "with the bytes that ramus mesh writes")

        dialog(window)
        choose(window, "How the file is written", "GLB (.glb)")
        status = window.wait("parts", lambda s: s["export"] == "surface .glb"
                             and "What is an object of its own" in s["controls"])
        check(PRINTING not in status["controls"], "GLB has objects, and is not for printing")
        window.shot("export-glb")
        click(window, "Write it")
        glb = folder / "small tree.glb"
        exported(window, glb)
        check(len(nodes_of(glb)) == info_of(program, tree)["branches"], "a GLB has a node for each branch")
        window.shot("export-done")

        dialog(window)
        click(window, "Centerlines and radii, as they were read.")
        window.wait("the tree's formats", lambda s: s["export"] == "tree .swc")
        window.shot("export-tree")
        write_as(window, "copy")
        exported(window, folder / "copy.swc")
        figures = ("branches", "segments", "length_mm")
        check([info_of(program, folder / "copy.swc")[f] for f in figures] == [info_of(program, tree)[f] for f in figures],
              "a tree is written with the ending of its format")

        dialog(window)
        write_as(window, "copy")
        window.wait("the question", lambda s: s["open_dialog"])
        window.shot("export-replace")
        before = (folder / "copy.swc").stat().st_mtime_ns
        click(window, "Write it")
        window.wait("no dialog", lambda s: not s["open_dialog"]
                    and (folder / "copy.swc").stat().st_mtime_ns != before)
        check(True, "a file that exists is replaced only after a question")

        dialog(window)
        click(window, "The figures of each branch.")
        window.wait("the table's format", lambda s: s["export"] == "table .csv")
        write_as(window, "figures.csv")
        exported(window, folder / "figures.csv")
        rows = (folder / "figures.csv").read_text().splitlines()
        check(len(rows) == 1 + info_of(program, tree)["branches"], "a table has a row for each branch")
        dialog(window)
        click(window, "What the window shows.")
        window.wait("the picture's format", lambda s: s["export"] == "picture .png")
        window.shot("export-picture")
        write_as(window, "seen.png")
        exported(window, folder / "seen.png")
        check((folder / "seen.png").read_bytes().startswith(b"\x89PNG"), "a picture is a PNG")

        slides(window, folder)
        turning(window, folder)
        reported(window, folder)

        dialog(window)
        write_as(window, "nowhere/x.png")
        window.wait("the refusal", lambda s: not s["open_dialog"] and s["notice"])
        window.shot("export-refused")
        check("nowhere" in window.status()["notice"], "what cannot be written is told")
        window.xdotool("key", "ctrl+q")
        check(window.process.wait(timeout=60) == 0, "nothing of this is unsaved work")
    finally:
        window.end()


if __name__ == "__main__":
    sys.exit(run_journeys(export))
