"""What takes a window longest between two looks at its events while a person explores a large tree, as the window itself
tells it (--status, longest_gap), in time that its own thread is on a processor. A measurement, no test: of a grown tree of
30,000 branches and, with RAMUS_SHARED_DATA, the kidney.

Usage: gaps.py PROGRAM
"""

import os
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "journey"))
from screen import Window, drag, run_journeys  # noqa: E402

KIDNEY = Path(os.environ.get("RAMUS_SHARED_DATA", "")) / "trees" / "kidney_77922_segments.swc"


def explore(program, screen, folder, tree, name):
    window = Window(program, screen, folder, [tree])
    try:
        status = window.wait("the surface", lambda s: s["surface_ready"])
        if status["unsaid"]:
            window.xdotool("key", "Escape")
        x, y, width, height = status["viewport"]
        middle = (x + width // 2, y + height // 2)
        drag(window, [middle, *[(middle[0] + 12 * i, middle[1] + 4 * i) for i in range(1, 12)]])
        window.xdotool("mousemove", *middle, "click", "--repeat", 4, 4)
        window.wait("rest", lambda s: s["surface_ready"])
        window.xdotool("click", 1)
        for key in ("g", "ctrl+z", "ctrl+shift+z", "1", "3", "5", "f"):
            window.xdotool("key", key)
            window.wait(f"rest after {key}", lambda s: s["surface_ready"])
        gap = window.status()["longest_gap"]
        print(f"{name}: longest gap {gap['processor_seconds']:.3f} s of the thread ({gap['seconds']:.3f} s by the clock), "
              f"in {gap['doing']}, after {gap['command']!r}")
    finally:
        window.end()


def grown(program, screen, folder):
    tree = folder / "grown.swc"
    subprocess.run([program, "grow", "-o", tree, "--branches", "30000"], check=True)
    explore(program, screen, folder, tree, "30,000 branches")


def kidney(program, screen, folder):
    if not KIDNEY.is_file():
        print("without the kidney: it is not here")
        return
    explore(program, screen, folder, KIDNEY, "kidney")


sys.exit(run_journeys(grown, kidney))
