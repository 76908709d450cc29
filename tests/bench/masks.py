"""How fast masks become trees, beside scikit-image's thinning of the same masks (Debian: python3-skimage, which does no
more than that: no centerlines, no radii, no graph); what a mask of 2048 x 2048 x 1024 voxels takes within --memory 4G;
and how soon a series of 512 x 512 x 400 DICOM files is open. Medians and the least.

Usage: masks.py PROGRAM [MASK...] [--runs N] [--large] [--series]; masks are NIfTI files.
"""

import argparse
import json
import os
import statistics
import struct
import subprocess
import tempfile
import time
from pathlib import Path

import numpy

from measured import measured


def several(runs, command):
    results = [measured(command) for _ in range(runs)]
    seconds, processor, peak = (statistics.median(result[n] for result in results) for n in range(3))
    print(f"  {seconds:.2f} s (best {min(result[0] for result in results):.2f}), {processor:.2f} s of processor time, "
          f"{peak:.0f} MB", flush=True)
    return seconds, results[-1][3]


def thinning_seconds(mask, runs):
    """Of skeletonize_3d alone, the mask read before; None where it is not installed."""
    try:
        import nibabel
        from skimage.morphology import skeletonize_3d
    except ImportError:
        return None
    voxels = numpy.asarray(nibabel.load(mask).dataobj) > 0.5
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        skeletonize_3d(voxels)
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def bench_mask(program, mask, runs, folder):
    print(f"{Path(mask).name}: ramus skeletonize, from file to file", flush=True)
    _, text = several(runs, [program, "skeletonize", mask, "-o", folder / "tree.json", "--json"])
    report = json.loads(text)
    print(f"  of which the skeleton {report['skeleton_s']:.2f} s; {report['branches']} branches of "
          f"{report['mask']['voxels']} voxels")
    thinning = thinning_seconds(mask, min(runs, 3))
    if thinning is None:
        print("  scikit-image or nibabel is not installed")
    else:
        print(f"  scikit-image's thinning alone: {thinning:.2f} s, {thinning / report['skeleton_s']:.1f} times the skeleton")


def large_mask(program, folder):
    """A grown tree drawn into 2048 x 2048 x 1024 voxels, as a NIfTI file that is not compressed and sparse on disk."""
    subprocess.run([program, "grow", "-o", folder / "tree.swc", "--branches", "1504"], check=True)
    rows = numpy.loadtxt(folder / "tree.swc", comments="#")
    points, radii = rows[:, 2:5], rows[:, 5]
    parents = {int(row[0]): n for n, row in enumerate(rows)}
    low, high = points.min(axis=0) - radii.max(), points.max(axis=0) + radii.max()
    size = numpy.array([2048, 2048, 1024])
    scale = ((size - 4) / (high - low)).min()
    head = bytearray(352)
    struct.pack_into("<i", head, 0, 348)
    struct.pack_into("<8h", head, 40, 3, *map(int, size), 1, 1, 1, 1)
    struct.pack_into("<2h", head, 70, 2, 8)
    struct.pack_into("<8f", head, 76, 1, 1, 1, 1, 1, 1, 1, 1)
    struct.pack_into("<f", head, 108, 352)
    head[123] = 2
    head[344:348] = b"n+1\0"
    file = folder / "large.nii"
    file.write_bytes(head)
    os.truncate(file, 352 + int(size.prod()))
    voxels = numpy.memmap(file, dtype=numpy.uint8, mode="r+", offset=352, shape=tuple(size), order="F")
    for n, row in enumerate(rows):
        if int(row[6]) < 0:
            continue
        a, b = (points[n] - low) * scale + 2, (points[parents[int(row[6])]] - low) * scale + 2
        ra, rb = radii[n] * scale, radii[parents[int(row[6])]] * scale
        for t in numpy.linspace(0, 1, 2 + int(numpy.linalg.norm(b - a) / max(1.0, 0.3 * min(ra, rb)))):
            draw_ball(voxels, a + t * (b - a), ra + t * (rb - ra))
    voxels.flush()
    return file


def draw_ball(voxels, centre, radius):
    first = numpy.maximum(numpy.ceil(centre - radius).astype(int), 0)
    last = numpy.minimum(numpy.floor(centre + radius).astype(int) + 1, voxels.shape)
    grid = numpy.ogrid[tuple(slice(f, e) for f, e in zip(first, last))]
    inside = sum((g - c) ** 2 for g, c in zip(grid, centre)) <= radius ** 2
    part = voxels[tuple(slice(f, e) for f, e in zip(first, last))]
    part[inside] = 1


def element(tag, kind, value):
    value += b"\0" if len(value) % 2 and kind == b"UI" else b" " if len(value) % 2 else b""
    head = struct.pack("<HH", tag >> 16, tag & 0xFFFF) + kind
    if kind in (b"OW", b"OB"):
        return head + struct.pack("<HI", 0, len(value)) + value
    return head + struct.pack("<H", len(value)) + value


def dicom_series(folder, slices=400, rows=512):
    """One CT series, a file a slice, explicit little endian (PS3.5)."""
    random = numpy.random.default_rng(1)
    for n in range(slices):
        pixels = random.integers(-200, 200, (rows, rows)).astype("<i2").tobytes()
        uid = f"1.2.826.0.1.{n + 1}".encode()
        us = lambda value: struct.pack("<H", value)  # noqa: E731
        body = b"".join(element(*one) for one in (
            (0x00080016, b"UI", b"1.2.840.10008.5.1.4.1.1.2"), (0x00080018, b"UI", uid), (0x00080060, b"CS", b"CT"),
            (0x00180050, b"DS", b"0.7"), (0x0020000D, b"UI", b"1.2.826.0.2"), (0x0020000E, b"UI", b"1.2.826.0.3"),
            (0x00200013, b"IS", str(n + 1).encode()), (0x00200032, b"DS", f"0\\0\\{0.7 * n:.4f}".encode()),
            (0x00200037, b"DS", b"1\\0\\0\\0\\1\\0"), (0x00280002, b"US", us(1)), (0x00280004, b"CS", b"MONOCHROME2"),
            (0x00280010, b"US", us(rows)), (0x00280011, b"US", us(rows)), (0x00280030, b"DS", b"0.7\\0.7"),
            (0x00280100, b"US", us(16)), (0x00280101, b"US", us(16)), (0x00280102, b"US", us(15)),
            (0x00280103, b"US", us(1)), (0x00281052, b"DS", b"0"), (0x00281053, b"DS", b"1"),
            (0x7FE00010, b"OW", pixels)))
        meta = b"".join(element(*one) for one in (
            (0x00020002, b"UI", b"1.2.840.10008.5.1.4.1.1.2"), (0x00020003, b"UI", uid),
            (0x00020010, b"UI", b"1.2.840.10008.1.2.1")))
        head = b"\0" * 128 + b"DICM" + element(0x00020000, b"UL", struct.pack("<I", len(meta)))
        (folder / f"slice{n:04}.dcm").write_bytes(head + meta + body)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("masks", nargs="*")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--large", action="store_true")
    parser.add_argument("--series", action="store_true")
    flags = parser.parse_args()
    program = str(Path(flags.program).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for mask in flags.masks:
            bench_mask(program, mask, flags.runs, folder)
        if flags.large:
            file = large_mask(program, folder)
            print("2048 x 2048 x 1024 voxels, --memory 4G: ramus skeletonize", flush=True)
            _, text = several(1, [program, "skeletonize", file, "-o", folder / "tree.json", "--memory", "4G", "--json"])
            report = json.loads(text)
            print(f"  {report['mask']['voxels']} voxels, {report['branches']} branches, {report['loops']} loops, "
                  f"{report['mask']['tunnels']} tunnels")
            file.unlink()
        if flags.series:
            dicom_series(folder)
            print("DICOM series of 512 x 512 x 400: ramus info", flush=True)
            several(flags.runs, [program, "info", folder])


main()
