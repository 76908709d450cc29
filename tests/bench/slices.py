"""A large scan in the real window, on a virtual screen with software rendering: how long it takes to open, how long the
window's thread is away meanwhile, and how many pictures a second there are while the crosshair is dragged over a slice, with
the vessels next to three slices.

Usage: slices.py PROGRAM [BRANCHES [SECONDS]]
"""

import gzip
import math
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "journey"))
sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
from hover import Pointer, processor_seconds  # noqa: E402
from nifti import nifti  # noqa: E402
from screen import Screen, Window, command, info_of  # noqa: E402

SIZE = (512, 512, 800)
MOTIONS = 60  # a second


def write_scan(path, info):
    """Values like those of a CT, with noise, over the box of the tree."""
    ends = np.array([branch[end][:3] for branch in info["branch_list"] for end in ("first", "last")])
    low, high = ends.min(axis=0) - 5, ends.max(axis=0) + 5
    spacing = (high - low) / (np.array(SIZE) - 1)
    generator = np.random.default_rng(1)
    noise = generator.normal(0, 12, (1 << 20)).astype(np.int16)
    x, y = np.meshgrid(np.arange(SIZE[0]), np.arange(SIZE[1]), indexing="ij")
    body = np.where(np.hypot(x - 256, y - 256) < 220, 40, -1000).astype(np.int16)
    with gzip.open(path, "wb", compresslevel=1) as file:
        file.write(nifti(SIZE, [], "h", [(*row, corner) for row, corner in zip(np.diag(spacing), low)]))
        for k in range(SIZE[2]):
            slice = body.T + np.resize(np.roll(noise, 977 * k), body.shape) + np.int16(40 * math.sin(k / 30))
            file.write(slice.astype("<i2").tobytes())


def opened(window, scan):
    """Seconds until the scan is shown in slices, and the gaps of the window's thread meanwhile."""
    begun = time.monotonic()
    command(window, f"scan {scan}")
    window.wait("the scan", lambda s: len(s["slices_at"]) == 3 and s["resting"])
    spent = time.monotonic() - begun
    return spent, [gap for gap in window.status()["gaps"] if gap["ended"] > begun]


def dragged(window, pointer, seconds):
    """Pictures a second while the crosshair is dragged in circles."""
    x, y, width, height = window.status()["slices_at"]["axial"]
    window.xdotool("mousemove", x + width // 2, y + height // 2, "mousedown", 1)
    first, begun = window.wait("rest", lambda s: True)["picture"]["shown"], time.monotonic()
    used = processor_seconds(window.process)
    n = 0
    while (now := time.monotonic()) < begun + seconds:
        angle = 2 * math.pi * (now - begun) / 2
        pointer.move(int(x + width * (0.5 + 0.3 * math.cos(angle))), int(y + height * (0.5 + 0.3 * math.sin(angle))))
        n += 1
        time.sleep(max(0.0, begun + n / MOTIONS - time.monotonic()))
    spent = time.monotonic() - begun
    used = processor_seconds(window.process) - used
    shown = window.written_status()["picture"]["shown"] - first
    window.xdotool("mouseup", 1)
    return shown / spent, used / max(1, shown)


def main():
    program = str(Path(sys.argv[1]).resolve())
    branches = int(sys.argv[2]) if len(sys.argv) > 2 else 1504
    seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 6.0
    with tempfile.TemporaryDirectory() as name:
        tree = Path(name) / "grown.swc"
        subprocess.run([program, "grow", "-o", tree, "--branches", str(branches)], check=True)
        scan = Path(name) / "scan.nii.gz"
        write_scan(scan, info_of(program, tree))
        screen = Screen(1440, 900)
        window = Window(program, screen, name, [tree, "--size", "1440x860"])
        try:
            window.wait("the surface", lambda s: s["surface_ready"] and s["resting"])
            took, gaps = opened(window, scan)
            felt = max(gaps, key=lambda gap: gap["seconds"], default={"seconds": 0.0, "waiting": "nothing"})
            print(f"opening {scan.stat().st_size / 1e6:.0f} MB: {took:.1f} s; the window's thread away for at most "
                  f"{1e3 * felt['seconds']:.0f} ms ({felt['waiting']})")
            for planes in ((), ("axial",), ("axial", "coronal", "sagittal")):
                for name in planes:
                    command(window, f"slice-plane {name} on")
                rate, cpu = dragged(window, Pointer(screen), seconds)
                print(f"{len(planes)} planes among {window.status()['triangles']} triangles: {rate:.1f} pictures a second, "
                      f"{1e3 * cpu:.0f} ms of processor time each")
        finally:
            window.end()
            screen.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
