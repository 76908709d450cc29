"""How soon the window answers, in software rendering on a virtual screen: from the start of the process to the first
picture of the tree and to its surface, and from a press on the slider of the kernel's width to a picture with that
width and to the surface itself. Medians and the least. The window's status file, written after a frame is swapped,
says that it happened.

Usage: answers.py PROGRAM [TREE [RUNS]]; without a tree, the program's own.
"""

import random
import statistics
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "journey"))
from screen import Failure, Screen, Window, middle_of, slide  # noqa: E402

WIDTH = "Kernel width: 5 follows the vessels closely, 1 blends them broadly"


def seconds_until(window, start, *conditions):
    """From `start` to each of the conditions, which hold one after the other."""
    times = []
    while len(times) < len(conditions):
        status = window.status()
        while status and len(times) < len(conditions) and conditions[len(times)](status):
            times.append(time.perf_counter() - start)
        if time.perf_counter() - start > 60.0:
            raise Failure("nothing happened for a minute")
        time.sleep(0.001)
    return times


def report(what, times):
    for name, column in zip(what, zip(*times)):
        print(f"{name}: {statistics.median(column):.3f} s (best {min(column):.3f})", flush=True)


def main():
    program = str(Path(sys.argv[1]).resolve())
    files = sys.argv[2:3]
    runs = int(sys.argv[3]) if len(sys.argv) > 3 else 9
    random.seed(1)
    screen = Screen(1440, 900)
    try:
        with tempfile.TemporaryDirectory() as name:
            starts = []
            for _ in range(runs + 1):  # the first warms up
                start = time.perf_counter()
                window = Window(program, screen, name, files)
                starts.append(seconds_until(window, start, lambda s: s["shown"] != "nothing",
                                            lambda s: s["surface_ready"] and s["resting"]))
                window.end()
            report(["start to the first picture", "start to the surface at rest"], starts[1:])

            window = Window(program, screen, name, files)
            window.wait("the surface", lambda s: s["surface_ready"])
            presses = []
            share = 0.4
            for _ in range(runs + 1):
                before = window.wait("rest", lambda s: s["surface_ready"])["picture"]["width"]
                share = random.choice([s / 20 for s in range(2, 19) if abs(s / 20 - share) > 0.1])
                window.xdotool("mousemove", *middle_of(window.status(), WIDTH))
                start = time.perf_counter()
                slide(window, WIDTH, share)
                presses.append(seconds_until(window, start, lambda s: s["picture"]["width"] != before,
                                             lambda s: s["surface_ready"] and s["resting"]))
            report(["width: press to a picture", "width: press to the surface at rest"], presses[1:])
            window.end()
    finally:
        screen.close()


main()
