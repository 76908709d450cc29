"""What a tree becomes outside: the dialog of File > Export offers every kind and format, writes what is visible,
selected or all, asks before it replaces, and says what went wrong.

Usage: export_journey.py PROGRAM [FOLDER for pictures of the dialog]
"""

import json
import struct
import subprocess
import sys
from pathlib import Path

from screen import SMALL_TREE, Window, check, choose, click, info_of, run_journeys

PRINTING = "Makes sure that the surface is closed and in mm, and says how thin it is at its thinnest place"
PICTURES = Path(sys.argv[2]) if len(sys.argv) > 2 else None


def picture(window, name):
    """Of the whole screen, for the eye."""
    if PICTURES is not None:
        window.wait("the finest picture", lambda s: s["picture"]["refined"])
        subprocess.run(["import", "-window", "root", PICTURES / name], env=window.environment, check=True)


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
    window.wait("the export dialog", lambda s: s["open_dialog"] and "How the file is written" in s["controls"])


def exported(window, path):
    window.wait(f"the file {path.name}", lambda s: path.exists() and not s["open_dialog"] and str(path) in s["notice"])


def export(program, screen, folder):
    tree = folder / "small tree.swc"
    tree.write_text(SMALL_TREE)
    window = Window(program, screen, folder, [tree, "--size", "1100x760"])
    try:
        window.wait("the surface", lambda s: s["surface_ready"])
        dialog(window)
        picture(window, "export-surface.png")
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
        picture(window, "export-glb.png")
        click(window, "Write it")
        glb = folder / "small tree.glb"
        exported(window, glb)
        check(len(nodes_of(glb)) == info_of(program, tree)["branches"], "a GLB has a node for each branch")
        picture(window, "export-done.png")

        dialog(window)
        click(window, "Centerlines and radii, as they were read.")
        window.wait("the tree's formats", lambda s: s["export"] == "tree .swc")
        picture(window, "export-tree.png")
        write_as(window, "copy")
        exported(window, folder / "copy.swc")
        figures = ("branches", "segments", "length_mm")
        check([info_of(program, folder / "copy.swc")[f] for f in figures] == [info_of(program, tree)[f] for f in figures],
              "a tree is written with the ending of its format")

        dialog(window)
        write_as(window, "copy")
        window.wait("the question", lambda s: s["open_dialog"])
        picture(window, "export-replace.png")
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
        click(window, "What the window shows of the tree.")
        window.wait("the picture's format", lambda s: s["export"] == "picture .png")
        picture(window, "export-picture.png")
        write_as(window, "seen.png")
        exported(window, folder / "seen.png")
        check((folder / "seen.png").read_bytes().startswith(b"\x89PNG"), "a picture is a PNG")

        dialog(window)
        write_as(window, "nowhere/x.png")
        window.wait("the refusal", lambda s: not s["open_dialog"] and s["notice"])
        picture(window, "export-refused.png")
        check("nowhere" in window.status()["notice"], "what cannot be written is told")
        window.xdotool("key", "ctrl+q")
        check(window.process.wait(timeout=60) == 0, "nothing of this is unsaved work")
    finally:
        window.end()


if __name__ == "__main__":
    sys.exit(run_journeys(export))
