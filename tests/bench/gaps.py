"""How long a window does not look at its events while a person works with a large tree, as the window itself tells it
(--status, gaps): a table of what was done, the longest time that its thread was on a processor in between, at what, and
the longest time by the clock, which has the software rasteriser's threads and all else that runs on the machine in it,
and at what that was. Where the machine itself stood still meanwhile (stalls.py), the row says for how long: both times
have that in them.
A measurement, no test: of a grown tree of 30,000 branches and, with RAMUS_SHARED_DATA, the kidney. What the graphics
driver compiles for the first time, 0.1 to 0.5 s for a shader of Mesa's rasteriser, is in it where the window draws alone
(RAMUS_ONE_THREAD=1) and XDG_CACHE_HOME does not name a folder that a run before has filled.

RAMUS_WATCHED is how many seconds an export may take before it is cancelled (90).

Usage: gaps.py PROGRAM [PART [TREE]]    PART: only steps whose name has it, a regular expression; "" for all
                                        TREE: only of grown, kidney
"""

import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "journey"))
import screen as journeys  # noqa: E402
from stalls import Stalls  # noqa: E402
from screen import Failure, Window, click, drag, middle_of, run_journeys, saved_session  # noqa: E402

journeys.PATIENCE = 600.0  # seconds: reports of large trees on a busy machine
SHARED = Path(os.environ.get("RAMUS_SHARED_DATA", ""))
KIDNEY = SHARED / "trees" / "kidney_77922_segments.swc"
ORGAN = SHARED / "volumes" / "kidney.nii.gz"
PROMISED = 0.1  # seconds
EXPORTS = {  # by what their pages are said to be
    "picture": "What the window shows.",
    "sheet": "Four views on one sheet, all at one scale.",
    "turntable": "Once around, as pictures or as a video.",
    "report": "A page with pictures and tables of the plan.",
    "table": "The figures of each branch.",
    "surface": "The smooth surface, as triangles.",
    "tree": "Centerlines and radii, as they were read.",
}
CANCEL = "Cancel what goes on"
WATCHED = float(os.environ.get("RAMUS_WATCHED", "90"))  # seconds
BESIDE = 300  # pixels from the button that writes a file to the field for its name, left of Cancel
FILTER = "Conditions, all of which hold: "  # and examples
PART = sys.argv[2] if len(sys.argv) > 2 else ""


def rested(status):
    return status["surface_ready"] and status["picture"]["refined"]


class Explorer:
    """Takes steps in a window, each until it rests again, and prints a row for each."""

    def __init__(self, program, screen, folder, tree):
        self.folder = folder
        self.rows = []
        self.stalls = Stalls(folder)
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
        nothing = {"processor_seconds": 0.0, "seconds": 0.0, "doing": "", "waiting": "", "ended": 0.0}
        thread = max(gaps, key=lambda gap: gap["processor_seconds"], default=nothing)
        clock = max(gaps, key=lambda gap: gap["seconds"], default=nothing)
        mark = " <<" if thread["processor_seconds"] > PROMISED else ""
        print(f"  {name:32} {thread['processor_seconds']:7.3f} {thread['doing']:9} {clock['seconds']:7.3f} "
              f"{clock['waiting']:9}{self.stalled(thread, clock)}{mark}", flush=True)
        self.rows.append((name, thread["processor_seconds"], clock["seconds"]))

    def stalled(self, thread, clock):
        stood = [self.stalls.within(gap["ended"] - gap["seconds"], gap["ended"]) for gap in (thread, clock)]
        return f" stood still {stood[0]:.3f} {stood[1]:.3f}" if max(stood) > 0.0 else ""

    def step(self, name, act):
        if not re.search(PART, name):
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

    def soon(self, what, condition):
        """As rest(), for what takes no work."""
        usual, journeys.PATIENCE = journeys.PATIENCE, 180.0
        try:
            return self.window.wait(what, condition)
        finally:
            journeys.PATIENCE = usual

    def palette(self, title, arguments=""):
        """Runs a command by its row in the palette, which has this title ("Menu › Label", or a name)."""
        window = self.window
        window.xdotool("key", "ctrl+k")
        self.soon("the palette", lambda s: s["palette"]["open"] and s["typing"])
        words = re.sub("›|…|[0-9, ]* mm", "", title)
        window.xdotool("type", words)
        row = re.compile(re.escape(title).replace(r"\ mm", " [a-z]+"))  # of a file that says no unit: units
        controls = self.soon("its row", lambda s: s["palette"]["typed"] == words
                             and any(map(row.fullmatch, s["controls"])))["controls"]
        left, top, width, _ = next(at for words, at in controls.items() if row.fullmatch(words))
        above = sum(at[0] == left and at[2] == width and at[1] < top for at in controls.values())
        window.xdotool("key", *["Down"] * above, "Return")
        if arguments:
            self.soon("what it asks", lambda s: s["palette"]["open"] and s["typing"])
            window.xdotool("type", arguments)
            window.xdotool("key", "Return")
        self.soon("no palette", lambda s: not s["palette"]["open"])

    def file(self, name, title, path):
        """A command that asks for a file."""
        def act():
            self.palette(title)
            self.soon("the dialog", lambda s: s["open_dialog"] and s["typing"])
            self.window.xdotool("key", "shift+Tab", "ctrl+a")  # from the filter to the path
            self.window.xdotool("type", str(path))
            self.window.xdotool("key", "Return")
            self.soon("no dialog", lambda s: not s["open_dialog"])
        self.step(name, act)

    def command(self, title, arguments=""):
        self.step(f"{title} {arguments}".strip(), lambda: self.palette(title, arguments))

    def exported(self, what, kind):
        """By the dialog, as it suggests but for the kind and the name: it asks before it replaces a file, such as the
        tree that is open."""
        def act():
            self.window.xdotool("key", "ctrl+e")
            self.soon("the dialog", lambda s: s["open_dialog"] and "Write it" in s["controls"])
            click(self.window, kind)
            status = self.soon("its page", lambda s: s["export"].startswith(what))
            left, top, _, height = status["controls"]["Write it"]
            self.window.xdotool("mousemove", left - BESIDE, top + height // 2, "click", 1)
            self.soon("the field for the name", lambda s: s["typing"])
            self.window.xdotool("key", "Home")
            self.window.xdotool("type", f"{what}-of-")
            click(self.window, "Write it")
            self.end_or_cancel()
        self.step(f"export: {what}", act)

    def end_or_cancel(self):
        """What is worked on elsewhere is cancelled where it takes longer than the window can be watched."""
        window = self.window
        end = time.monotonic() + WATCHED
        while (status := window.status())["open_dialog"] or CANCEL in status["controls"]:  # it does not rest meanwhile
            if time.monotonic() > end and CANCEL in status["controls"]:
                window.xdotool("mousemove", *middle_of(status, CANCEL), "click", 1)
                print(f"    cancelled after {WATCHED} s", flush=True)
                break
            time.sleep(0.5)
        window.wait("nothing going on", lambda s: not s["open_dialog"] and CANCEL not in s["controls"])


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
    explorer.command("select", "3")
    explorer.key("hide", "x")
    explorer.key("undo hide", "ctrl+z")
    explorer.key("select dependents", "d")
    explorer.key("highlight", "h")
    explorer.key("defocus", "g")
    explorer.key("turn with glass", "Left", "Left", "Left")
    explorer.key("defocus others", "shift+g")
    explorer.key("select all", "Escape", "ctrl+i")
    explorer.key("undo select all", "ctrl+z")
    explorer.key("redo select all", "ctrl+shift+z")
    explorer.key("defocus all", "g")
    explorer.key("undo defocus all", "ctrl+z")
    explorer.key("redo defocus all", "ctrl+shift+z")
    explorer.key("hide all", "x")
    explorer.key("show all", "shift+n")
    explorer.command("Plan › Hide vessels below 1 mm")
    explorer.key("undo filter", "ctrl+z")
    explorer.command("select diameter", "0 1")
    explorer.key("select the others", "ctrl+i")
    explorer.key("select nothing", "Escape")


def hide_subtrees(explorer):
    for branch in (1, 2):
        explorer.command("select", branch)
        explorer.key(f"dependents of {branch}", "d")
        explorer.key(f"hide the subtree {branch}", "x")
    explorer.key("undo hide the subtree", "ctrl+z")
    explorer.key("redo hide the subtree", "ctrl+shift+z")
    explorer.key("show the subtrees", "shift+n")


def use_tools(explorer):
    window = explorer.window
    x, y, width, height = window.status()["viewport"]
    middle = (x + width // 2, y + height // 2)
    inner = [(x + width // 10 + i * width * 8 // 100, y + height // 10) for i in range(10)]
    outer = [(at, y + height * 9 // 10) for at, _ in reversed(inner)]

    def tool(name, key):
        window.xdotool("key", key)
        explorer.soon("the tool", lambda s: s["tool"] == name)

    def measure(name, key):
        tool(name, key)
        for i in (-8, 8):
            window.xdotool("mousemove", middle[0] + i, middle[1], "click", 1)
            explorer.rest("a place")

    explorer.step("measure a distance", lambda: measure("measure-distance", "m"))
    explorer.step("measure a path", lambda: measure("measure-path", "shift+m"))
    explorer.key("no tool", "Escape", "Escape")
    if window.status()["measured"]:  # the row is grey else
        explorer.command("Plan › Remove all measurements")
    explorer.step("take the lasso", lambda: tool("lasso", "w"))
    explorer.step("lasso nearly all", lambda: drag(window, [*inner, *outer, inner[0]]))
    explorer.key("hide what was lassoed", "x")
    explorer.key("undo hide what was lassoed", "ctrl+z")
    explorer.key("undo the lasso", "ctrl+z")
    explorer.key("redo the lasso", "ctrl+shift+z")
    explorer.key("no lasso", "Escape", "Escape")
    explorer.step("menu of a branch", lambda: window.xdotool("mousemove", *middle, "click", 3))
    explorer.key("no menu", "Escape")


def colour_and_view(explorer):
    for quantity in ("Generation", "Diameter", "Branch", "State"):
        explorer.command(f"Colour › {quantity}")
    for view, key in (("left", "l"), ("superior", "s"), ("anterior", "a")):
        explorer.key(f"view from {view}", key)
    explorer.key("fit", "f")
    explorer.key("orthographic", "o")
    explorer.key("perspective", "o")
    explorer.command("View › Skeleton with radii")
    explorer.command("View › Skeleton with radii")
    explorer.key("overview", "t")
    explorer.key("no overview", "t")


def plan(explorer):
    explorer.command("lesion", "10,0,0,8")
    explorer.command("Plan › Margins 5, 10, 20 mm")
    explorer.command("Colour › Distance to lesion")
    explorer.command("lesion change", "1 12,4,0,9")
    explorer.command("Colour › State")
    explorer.command("select within", "20")
    explorer.command("select", "3")
    explorer.key("cut", "c")
    explorer.command("select", "0")
    explorer.key("cut the root", "c")
    explorer.command("Plan › Remove all cuts")
    explorer.command("Plan › Remove all lesions")
    explorer.command("measure", "path 0 30")
    explorer.key("page plan", "b")
    explorer.key("page explore", "b")


def look_up(explorer):
    window = explorer.window
    explorer.step("palette, typing", lambda: window.xdotool("key", "ctrl+k", "d", "i", "a", "m", "Escape"))
    explorer.key("list of contacts", "shift+t")
    explorer.key("no contacts", "shift+t")

    def validate():
        window.xdotool("key", "shift+v")
        window.wait("findings", lambda s: s["validation"]["count"] >= 0)
    explorer.step("validation", validate)
    explorer.key("no validation", "shift+v")
    explorer.key("doctor", "shift+d")
    explorer.key("no doctor", "shift+d")
    explorer.command("View › Branches in a window")
    explorer.command("View › Branches in a window")

    def find():
        click(window, next(words for words in window.status()["controls"] if words.startswith(FILTER)))
        window.xdotool("type", "d>3")
        window.xdotool("key", "Return")
    explorer.step("find in the list", find)
    explorer.key("select nothing again", "Escape", "Escape")


def sort_the_list(explorer):
    window = explorer.window
    for words in sorted(words for words in window.status()["controls"] if words.startswith("Sort by "))[:3]:
        explorer.step(words, lambda words=words: click(window, words))
        explorer.step(f"{words}, the other way", lambda words=words: click(window, words))


def compare(explorer):
    explorer.command("compare", "side-by-side cs,cones")
    explorer.key("turn both", "Left", "Left", "Left")
    explorer.command("compare", "wipe cs,paper")
    explorer.command("compare", "off")
    explorer.command("Colour › Deviation")
    explorer.key("turn with deviation", "Left", "Left", "Left")
    explorer.command("Colour › State")


def add_context(explorer):
    if not ORGAN.is_file():
        return
    explorer.file("add context", "File › Add context...", ORGAN)
    explorer.key("turn with context", "Left", "Left", "Left")
    explorer.command("context clear")
    mesh = explorer.folder / "organ.obj"  # a library of others reads it in a process of its own
    corners = [f"v {x} {y} {z}" for x in (0, 50) for y in (0, 50) for z in (0, 50)]
    mesh.write_text("\n".join([*corners, "f 1 2 4 3", "f 5 7 8 6", "f 1 5 6 2", "f 3 4 8 7", "f 1 3 7 5", "f 2 6 8 4\n"]))
    explorer.file("add a mesh as context", "File › Add context...", mesh)
    explorer.command("context clear")


def travel(explorer):
    explorer.command("select", "5")
    explorer.key("fly along", "j")
    explorer.key("stop flying", "j")
    explorer.command("View › Warnings")
    explorer.command("View › Warnings")
    explorer.command("View › Light theme")
    explorer.command("View › Light theme")


def change_surface(explorer):
    for change in ("width 2", "detail 8", "smooth 3", "prune 1", "blend paper", "method cones"):
        explorer.command("surface", change)
        explorer.key(f"undo {change}", "ctrl+z")


def edit(explorer):
    explorer.command("select", "20")
    explorer.command("Edit › Disconnect the selected")
    explorer.key("undo disconnect", "ctrl+z")
    explorer.command("name", "3 renal subtree")
    explorer.key("undo the name", "ctrl+z")
    explorer.key("redo the name", "ctrl+shift+z")
    explorer.command("select", "30")
    explorer.command("Edit › Root at the selected")
    explorer.key("undo the root", "ctrl+z")


def put_out(explorer):
    explorer.key("export dialog", "F12")
    explorer.key("close it", "Escape")
    for what, kind in EXPORTS.items():
        explorer.exported(what, kind)
    explorer.step("save", lambda: saved_session(explorer.window))

    explorer.file("open the session", "File › Open...", explorer.window.status()["session_file"])


def resize(explorer):
    window = explorer.window
    for size in ((1300, 900), (1500, 960), (1200, 800)):
        explorer.step(f"resize to {size[0]} x {size[1]}",
                      lambda: window.xdotool("search", "--name", "ramus", "windowsize", *size))


def explore(program, screen, folder, tree, name):
    print(f"{name}: step, longest gap in s of the thread, at what, longest by the clock, at what")
    explorer = Explorer(program, screen, folder, tree)
    try:
        if explorer.window.status()["units_panel"]:
            explorer.key("answer about units", "Escape")
        for part in (turn_and_zoom, mark, hide_subtrees, use_tools, colour_and_view, plan, look_up, sort_the_list, travel,
                     change_surface, compare, add_context, edit, put_out, resize):
            part(explorer)
        longest = max(explorer.rows, key=lambda row: row[1])
        by_clock = max(explorer.rows, key=lambda row: row[2])
        beyond = [sum(row[i] > PROMISED for row in explorer.rows) for i in (1, 2)]
        print(f"{name}: longest {longest[1]:.3f} s ({longest[0]}), by the clock {by_clock[2]:.3f} s ({by_clock[0]}); "
              f"{beyond[0]} and {beyond[1]} of {len(explorer.rows)} steps beyond {PROMISED} s")
        if not explorer.stalls.seen:
            print("whether the machine stood still meanwhile was not seen: that needs the right to real-time priority")
    finally:
        explorer.stalls.end()
        explorer.window.end()


def grown(program, screen, folder):
    tree = folder / "grown.swc"
    subprocess.run([program, "grow", "-o", tree, "--branches", "30000"], check=True)
    explore(program, screen, folder, tree, "30,000 branches")


def kidney(program, screen, folder):
    if not KIDNEY.is_file():
        print("without the kidney: it is not here")
        return
    # What is exported goes beside the tree.
    tree = Path(shutil.copy(KIDNEY, folder))
    explore(program, screen, folder, tree, "kidney")


if __name__ == "__main__":
    trees = [tree for tree in (grown, kidney) if len(sys.argv) < 4 or tree.__name__ == sys.argv[3]]
    sys.exit(run_journeys(*trees, size=(1600, 1000)))
