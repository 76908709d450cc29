"""How long hovering takes: from a motion of the pointer to the swapped frame that shows the branch under it, on a grown
tree in software rendering, on a virtual screen. Motions come through XTest; the window's status file, written after a
frame is swapped, says that it happened. Exit status 1 when the median is over the limit.

Usage: hover.py PROGRAM [BRANCHES [MOTIONS]]
"""

import ctypes
import ctypes.util
import os
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "journey"))
from screen import Screen, Window, info_of, project  # noqa: E402

LIMIT_MS = 50.0


class Pointer:
    """The pointer of a screen, moved without starting a program for each motion."""

    def __init__(self, screen):
        self.x11 = ctypes.CDLL(ctypes.util.find_library("X11"))
        self.xtst = ctypes.CDLL(ctypes.util.find_library("Xtst"))
        self.x11.XOpenDisplay.restype = ctypes.c_void_p
        self.display = ctypes.c_void_p(self.x11.XOpenDisplay(screen.display.encode()))

    def move(self, x, y):
        self.xtst.XTestFakeMotionEvent(self.display, -1, x, y, ctypes.c_ulong(0))
        self.x11.XFlush(self.display)


def processor_seconds(process):
    """What a process has used of all processors so far: tells the work from waiting for a busy machine."""
    words = Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def hovers(window, pointer, places, motions):
    """Milliseconds of motions that changed what is hovered."""
    times = []
    for _ in range(20 * motions):
        if len(times) == motions:
            break
        before = window.wait("rest", lambda s: True)["hovered"]
        at = random.choice(places)
        start = time.perf_counter()
        pointer.move(*at)
        while time.perf_counter() - start < 2.0:
            if window.status()["hovered"] != before:
                times.append(1e3 * (time.perf_counter() - start))
                break
            time.sleep(0.0005)
    return sorted(times)


def main():
    program = str(Path(sys.argv[1]).resolve())
    branches = int(sys.argv[2]) if len(sys.argv) > 2 else 3461
    motions = int(sys.argv[3]) if len(sys.argv) > 3 else 60
    random.seed(1)
    with tempfile.TemporaryDirectory() as name:
        tree = Path(name) / "grown.swc"
        subprocess.run([program, "grow", "-o", tree, "--branches", str(branches)], check=True)
        ends = [branch["last"][:3] for branch in info_of(program, tree)["branch_list"]]
        screen = Screen(1440, 900)
        window = Window(program, screen, name, [tree])
        try:
            status = window.wait("the surface", lambda s: s["surface_ready"])
            x, y, width, height = status["viewport"]
            places = [p for p in (project(status, end) for end in ends)
                      if x <= p[0] < x + width and y + 60 <= p[1] < y + height]
            used = processor_seconds(window.process)
            times = hovers(window, Pointer(screen), places, motions)
            used = processor_seconds(window.process) - used
        finally:
            window.end()
            screen.close()
    median = times[len(times) // 2]
    print(f"hover on {branches} branches, {len(times)} motions: median {median:.1f} ms, "
          f"95 % within {times[int(0.95 * (len(times) - 1))]:.1f} ms, limit {LIMIT_MS:.0f} ms; "
          f"{1e3 * used / len(times):.0f} ms of processor time a motion")
    return 0 if median <= LIMIT_MS else 1


if __name__ == "__main__":
    sys.exit(main())
