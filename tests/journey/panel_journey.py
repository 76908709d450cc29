"""What stands still under the pointer, and what is chosen where: the side panel keeps its places while branches are
selected, the table of branches comes into a window of its own, and the file dialog takes a click for a choice, a double
click for entering, lists what can be read, and remembers its folder for each kind of file.

Usage: panel_journey.py PROGRAM
"""

import sys

from screen import SMALL_TREE, Window, check, choose, click, middle_of, page, project, run_journeys

SELECT = "Selects the branches that are listed"
HIGHLIGHT = "Highlight"
SHOW = "Which files are listed"


def places(status):
    """Of the panel's controls, without those that lie elsewhere."""
    left = status["viewport"][0] + status["viewport"][2]
    return {words: at for words, at in status["controls"].items() if at[0] >= left and not words.startswith("Select")}


def still(window):
    """One branch, several, a named one, none: all controls of the panel stay where they are."""
    status = window.wait("the surface", lambda s: s["surface_ready"] and s["contacts"]["count"] >= 0)
    check(status["page"] == "explore" and SELECT in status["controls"], "the panel shows the table of branches")
    before, table = places(status), status["controls"][SELECT]
    at = project(status, [0, 0, -20])
    window.xdotool("mousemove", *at, "click", 1)
    status = window.wait("one branch", lambda s: len(s["selection"]) == 1)
    window.shot("panel-selection")
    check(places(status) == before, "nothing in the panel moves when a branch is selected")
    window.xdotool("key", "ctrl+i")
    status = window.wait("the others", lambda s: len(s["selection"]) == 4)
    check(places(status) == before, "nor when several are")
    check(status["controls"][SELECT][1] == table[1], "the table begins where it began")
    window.xdotool("key", "Escape")
    window.xdotool("mousemove", at[0] - 200, at[1], "click", 1)
    status = window.wait("none", lambda s: not s["selection"])
    check(places(status) == before, "nor when none is")


def table(window):
    click(window, "Shows the table of branches in a window of its own")
    status = window.wait("the window of branches", lambda s: s["branch_window"] and "The window of branches" in s["controls"])
    x, y, width, height = status["controls"]["The window of branches"]
    check(height > 15 * 18, f"the table has room for more than a dozen rows: {height} pixels")
    window.shot("panel-table")
    for _ in range(5):  # a grip is pressed again where the pointer was not seen on it yet
        x, y, width_now, height = window.status()["controls"]["The window of branches"]
        grip = (x + width_now - 4, y + height - 4)
        for step in (("mousemove", *grip), ("mousedown", 1), ("mousemove", grip[0] + 40, grip[1] - 60),
                     ("mousemove", grip[0] + 80, grip[1] - 90), ("mouseup", 1)):
            window.xdotool(*step)
            window.wait("it was seen", lambda s: True)
        if window.status()["controls"]["The window of branches"][2] > width:
            break
    window.wait("another size", lambda s: s["controls"]["The window of branches"][2] > width)
    click(window, "Shows the table of branches here again")
    window.wait("the table in the panel", lambda s: not s["branch_window"] and SELECT in s["controls"])
    check(True, "it takes another size, and goes back into the panel")


def dialog(window, folder):
    window.xdotool("key", "ctrl+o")
    status = window.wait("the dialog", lambda s: s["open_dialog"] and "trees/" in s["controls"])
    check("notes.txt" not in status["controls"] and "small tree.swc" in status["controls"],
          "files that cannot be opened are not listed")
    window.shot("panel-open")
    click(window, "trees/")
    window.wait("the choice", lambda s: s["open_dialog"] and "trees/" in s["controls"])
    check("Open what is chosen" in window.status()["controls"], "a click on a folder chooses it, and enters nothing")
    window.xdotool("mousemove", *middle_of(window.status(), "trees/"), "click", "--repeat", 2, "--delay", 60, 1)
    status = window.wait("the folder", lambda s: "other.swc" in s["controls"])
    check("small tree.swc" not in status["controls"], "a double click enters it")
    choose(window, SHOW, "All files")
    window.wait("all files", lambda s: "readme.txt" in s["controls"])
    choose(window, SHOW, "Trees")
    window.wait("trees", lambda s: "readme.txt" not in s["controls"] and "other.swc" in s["controls"])
    check(True, "the list of kinds chooses which files are listed")
    click(window, "other.swc")
    window.wait("the choice", lambda s: s["open_dialog"])
    click(window, "Open what is chosen")
    window.wait("the other tree", lambda s: s["tree"]["path"].endswith("other.swc") and s["surface_ready"])
    check(True, "Open opens what a click chose")


def folders(window, folder):
    """The mesh of a lesion comes from another folder; each kind is asked for where it was found last."""
    page(window, "plan")
    click(window, "Read a closed mesh from a file: STL, PLY or OBJ")
    status = window.wait("the dialog", lambda s: s["open_dialog"])
    check("other.swc" not in status["controls"], "a lesion's dialog lists meshes alone")
    window.xdotool("key", "Escape")
    window.wait("no dialog", lambda s: not s["open_dialog"])
    window.xdotool("key", "ctrl+e")
    window.wait("the export dialog", lambda s: s["open_dialog"] and s["typing"])
    window.xdotool("type", str(folder / "out" / "away"))
    window.xdotool("key", "Return")
    window.wait("the file", lambda s: not s["open_dialog"] and (folder / "out" / "away.ply").exists() and s["written"])
    window.shot("panel-written")
    window.xdotool("key", "Escape")
    window.wait("no word of it", lambda s: not s["written"])
    window.xdotool("key", "ctrl+e")
    status = window.wait("the export dialog", lambda s: s["open_dialog"] and s["typing"])
    check("away.ply" in status["controls"], "the export dialog opens where the last export went")
    window.xdotool("key", "Escape")
    window.wait("no dialog", lambda s: not s["open_dialog"])
    window.xdotool("key", "ctrl+o")
    status = window.wait("the dialog", lambda s: s["open_dialog"])
    check("other.swc" in status["controls"] and "away.ply" not in status["controls"],
          "and the one for trees where the last tree was")
    window.xdotool("key", "Escape")
    window.wait("no dialog", lambda s: not s["open_dialog"])


def journey(program, screen, folder):
    for name in ("trees", "out"):
        (folder / name).mkdir()
    (folder / "small tree.swc").write_text(SMALL_TREE)
    (folder / "trees" / "other.swc").write_text(SMALL_TREE)
    (folder / "trees" / "readme.txt").write_text("nothing\n")
    (folder / "notes.txt").write_text("nothing\n")
    window = Window(program, screen, folder, [folder / "small tree.swc", "--size", "1280x900"])
    try:
        still(window)
        table(window)
        dialog(window, folder)
        folders(window, folder)
        check(window.quit() == 0, "the window closes")
    finally:
        window.end()


if __name__ == "__main__":
    sys.exit(run_journeys(journey, size=(1300, 940)))
