"""How long a window does not look at its events while a person works with a large tree, as the window itself tells it
(--status, gaps): a table of what was done, the longest time that its thread was on a processor in between, at what, and
the longest time by the clock, which has the software rasteriser's threads and all else that runs on the machine in it.
A measurement, no test: of a grown tree of 30,000 branches and, with RAMUS_SHARED_DATA, the kidney.

Usage: gaps.py PROGRAM [PART]    PART: only steps with it in their name, and opening
"""

import os
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "journey"))
from screen import Failure, Window, drag, run_journeys  # noqa: E402

KIDNEY = Path(os.environ.get("RAMUS_SHARED_DATA", "")) / "trees" / "kidney_77922_segments.swc"
PROMISED = 0.1  # seconds
PART = sys.argv[2] if len(sys.argv) > 2 else ""


def rested(status):
    return status["surface_ready"] and status["picture"]["refined"]


class Explorer:
    """Takes steps in a window, each until it rests again, and prints a row for each."""

    def __init__(self, program, screen, folder, tree):
        self.folder = folder
        self.rows = []
        started = time.monotonic()
        self.window = Window(program, screen, folder, [tree])
        self.rest("opened")
        self.row("open", started)

    def rest(self, what):
        return self.window.wait(what, rested)

    # The last gap is in the next status: a key that does nothing brings it.
    def row(self, name, since):
        self.window.xdotool("key", "shift")
        gaps = [gap for gap in self.rest("the gaps")["gaps"] if gap["ended"] >= since]
        nothing = {"processor_seconds": 0.0, "seconds": 0.0, "doing": "", "ended": 0.0}
        thread = max(gaps, key=lambda gap: gap["processor_seconds"], default=nothing)
        clock = max(gaps, key=lambda gap: gap["seconds"], default=nothing)
        mark = " <<" if thread["processor_seconds"] > PROMISED else ""
        print(f"  {name:32} {thread['processor_seconds']:7.3f} {thread['doing']:8} {clock['seconds']:7.3f}{mark}",
              flush=True)
        self.rows.append((name, thread["processor_seconds"]))

    def step(self, name, act):
        if PART not in name:
            return
        since = time.monotonic()
        try:
            act()
            self.rest(f"rest after {name}")
        except Failure as failure:
            print(f"  {name}: {str(failure).splitlines()[0]}")
            self.window.xdotool("key", "Escape")
        self.row(name, since)

    def key(self, name, *keys):
        self.step(name, lambda: self.window.xdotool("key", *keys))

    def palette(self, line):
        """Runs a command as the palette takes it: its name, then its arguments."""
        name, _, arguments = line.partition(" ")
        self.window.xdotool("key", "ctrl+k")
        self.window.wait("the palette", lambda s: s["palette"]["open"] and s["typing"])
        self.window.xdotool("type", name)
        self.window.xdotool("key", "Return")
        if arguments:
            self.window.wait("it asks", lambda s: s["palette"]["open"] and s["typing"])
            self.window.xdotool("type", arguments)
            self.window.xdotool("key", "Return")
        self.window.wait("the palette gone", lambda s: not s["palette"]["open"])

    def command(self, line):
        self.step(line, lambda: self.palette(line))


def turn_and_zoom(explorer):
    window = explorer.window
    x, y, width, height = window.status()["viewport"]
    middle = (x + width // 2, y + height // 2)
    explorer.step("turn", lambda: drag(window, [middle, *[(middle[0] + 12 * i, middle[1] + 4 * i) for i in range(1, 12)]]))
    explorer.step("zoom in", lambda: window.xdotool("mousemove", *middle, "click", "--repeat", 4, 4))
    explorer.step("point", lambda: [window.xdotool("mousemove", middle[0] + 9 * i, middle[1]) for i in range(8)])
    explorer.step("select by a click", lambda: window.xdotool("mousemove", *middle, "click", 1))
    explorer.step("zoom out", lambda: window.xdotool("click", "--repeat", 4, 5))


def mark(explorer):
    explorer.command("select 3")
    explorer.key("hide", "x")
    explorer.key("undo hide", "ctrl+z")
    explorer.command("select-dependents")
    explorer.key("highlight", "h")
    explorer.key("defocus", "g")
    explorer.key("defocus others", "shift+g")
    explorer.key("select all", "ctrl+a")
    explorer.key("defocus all", "g")
    explorer.key("undo defocus all", "ctrl+z")
    explorer.key("redo defocus all", "ctrl+shift+z")
    explorer.key("hide all", "x")
    explorer.key("show all", "shift+n")
    explorer.command("filter-diameter 0.5 hide")
    explorer.key("undo filter", "ctrl+z")
    explorer.command("select-diameter 0 1")
    explorer.command("select-invert")
    explorer.key("select nothing", "Escape")


def colour_and_view(explorer):
    for quantity in ("generation", "diameter", "strahler", "branch", "none"):
        explorer.command(f"colour-by {quantity}")
    for key in "135":
        explorer.key(f"view {key}", key)
    explorer.key("fit", "f")
    explorer.command("orthographic")
    explorer.command("skeleton")
    explorer.command("skeleton")
    explorer.command("overview")
    explorer.command("overview distance")
    explorer.command("overview")


def plan(explorer):
    explorer.command("lesion 10,0,0,8")
    explorer.command("bands 5 10")
    explorer.command("cut 3 0.5")
    explorer.command("cut-clear")
    explorer.command("lesion-clear")
    explorer.command("measure path 0 30")
    explorer.command("panel plan")
    explorer.command("panel explore")


def look_up(explorer):
    explorer.step("palette, typing", lambda: explorer.window.xdotool("key", "ctrl+k", "d", "i", "a", "m", "Escape"))
    explorer.command("contacts")
    explorer.command("contacts")
    explorer.command("validation")
    explorer.step("validation done", lambda: explorer.window.wait("findings", lambda s: s["validation"]["count"] >= 0))
    explorer.command("validation")
    explorer.command("doctor")
    explorer.key("no doctor", "Escape")
    explorer.command("branches")
    explorer.command("branches")


def change_surface(explorer):
    explorer.command("surface width 2")
    explorer.key("undo width", "ctrl+z")
    explorer.command("surface detail 8")
    explorer.key("undo detail", "ctrl+z")
    explorer.command("surface method cones")
    explorer.key("undo cones", "ctrl+z")
    explorer.command("compare side-by-side")
    explorer.command("compare off")


def edit(explorer):
    explorer.command("disconnect 20 0.5")
    explorer.key("undo disconnect", "ctrl+z")
    explorer.command("name 3 renal subtree")


def put_out(explorer):
    folder = explorer.folder
    explorer.step("export dialog", lambda: explorer.window.xdotool("key", "F12"))
    explorer.key("close it", "Escape")
    explorer.command(f"export surface {folder}/out.stl")
    explorer.command(f"export picture {folder}/large.png --size 4000x3000 --supersample 2")
    explorer.command(f"export report {folder}/report.html")
    explorer.command(f"export table {folder}/table.csv")
    explorer.command(f"export tree {folder}/tree.swc")
    explorer.command(f"save {folder}/session.ramus.json")


def resize(explorer):
    window = explorer.window
    for size in ((1300, 900), (1500, 960), (1200, 800)):
        explorer.step(f"resize to {size[0]} x {size[1]}",
                      lambda: window.xdotool("search", "--name", "ramus", "windowsize", *size))


def explore(program, screen, folder, tree, name):
    print(f"{name}: step, longest gap in s of the thread, at what, longest by the clock")
    explorer = Explorer(program, screen, folder, tree)
    try:
        if explorer.window.status()["unsaid"]:
            explorer.key("answer about units", "Escape")
        for part in (turn_and_zoom, mark, colour_and_view, plan, look_up, change_surface, edit, put_out, resize):
            part(explorer)
        longest = max(explorer.rows, key=lambda row: row[1])
        beyond = sum(row[1] > PROMISED for row in explorer.rows)
        print(f"{name}: longest {longest[1]:.3f} s ({longest[0]}); {beyond} of {len(explorer.rows)} steps beyond {PROMISED} s")
    finally:
        explorer.window.end()


def grown(program, screen, folder):
    tree = folder / "grown.swc"
    subprocess.run([program, "grow", "-o", tree, "--branches", "30000"], check=True)
    explore(program, screen, folder, tree, "30,000 branches")


def kidney(program, screen, folder):
    if not KIDNEY.is_file():
        print("without the kidney: it is not here")
        return
    explore(program, screen, folder, KIDNEY, "kidney")


sys.exit(run_journeys(grown, kidney, size=(1600, 1000)))
