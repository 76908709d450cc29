"""What masks cost that hardly fit into a program: a sparse one of 2048 x 2048 x 2048 voxels, of which 6 million are set,
thinly spread like vessels (or each alone: --scattered), and masks of 256 x 256 x 256 voxels full of noise. Seconds, peak
memory, what the tree has.

Usage: sparse_masks.py PROGRAM [--scattered] [--noise PERCENT...] [--onto MASK] [--keep FOLDER]
"""

import argparse
import gzip
import json
import sys
import tempfile
from pathlib import Path

import numpy

from measured import measured

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
from nifti import nifti  # noqa: E402

SIDE, SET = 2048, 6_000_000


def vessels(random):
    """Places of the voxels of many curved vessels, 3 voxels thick, all over the volume; sorted."""
    cross = numpy.array([(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1) if x * x + y * y + z * z < 3])
    strides = numpy.array([1, SIDE, SIDE * SIDE])
    found = numpy.zeros(0, dtype=numpy.int64)
    while len(found) < SET:
        parts = [found]
        for _ in range(50):
            at, way = random.uniform(2, SIDE - 2, 3), random.normal(size=3)
            turns = random.normal(scale=0.02, size=(3000, 3)).cumsum(axis=0) + way / numpy.linalg.norm(way)
            line = at + (turns / numpy.linalg.norm(turns, axis=1)[:, None] * 0.7).cumsum(axis=0)
            outside = ((line < 2) | (line > SIDE - 3)).any(axis=1)
            line = line[: outside.argmax()] if outside.any() else line
            parts.append(((numpy.rint(line).astype(numpy.int64)[:, None, :] + cross) @ strides).ravel())
        found = numpy.unique(numpy.concatenate(parts))
    return found[:SET]


def write_sparse(file, places):
    """NIfTI, uint8, gzip; one slice at a time."""
    slice_size = SIDE * SIDE
    firsts = numpy.searchsorted(places, numpy.arange(SIDE + 1, dtype=numpy.int64) * slice_size)
    with gzip.open(file, "wb", compresslevel=1) as out:
        out.write(nifti((SIDE,) * 3, ()))
        for k in range(SIDE):
            plane = numpy.zeros(slice_size, dtype=numpy.uint8)
            plane[places[firsts[k] : firsts[k + 1]] - k * slice_size] = 1
            out.write(plane.tobytes())


def bench(program, file, folder, *flags):
    seconds, processor, peak, text = measured([program, "skeletonize", file, "-o", folder / "tree.json", "--json", *flags])
    report = json.loads(text)
    print(f"{file.name}: {seconds:.1f} s, {processor:.1f} s of processor time, {peak:.0f} MB; {report['mask']['voxels']:,} "
          f"voxels, {report['branches']:,} branches, {report['loops']:,} loops, {report['roots']:,} pieces, "
          f"{len(report['notes']):,} notes", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--scattered", action="store_true")
    parser.add_argument("--noise", type=float, nargs="*")
    parser.add_argument("--onto", type=Path, help="a NIfTI mask that the noise is added to")
    parser.add_argument("--keep", type=Path, help="where the masks are left, and found again")
    flags = parser.parse_args()
    program = str(Path(flags.program).resolve())
    random = numpy.random.default_rng(51)
    with tempfile.TemporaryDirectory() as made:
        folder = flags.keep or Path(made)
        if flags.noise is None:
            file = folder / ("scattered.nii.gz" if flags.scattered else "vessels.nii.gz")
            if not file.exists():
                places = random.integers(0, SIDE**3, SET) if flags.scattered else vessels(random)
                write_sparse(file, numpy.unique(places))
            bench(program, file, folder, *(("--islands", "2") if flags.scattered else ()))
        for percent in flags.noise or []:
            if flags.onto:
                import nibabel

                image = nibabel.load(flags.onto)
                voxels = (numpy.asarray(image.dataobj) > 0.5).astype(numpy.uint8)
            else:
                voxels = numpy.zeros((256,) * 3, dtype=numpy.uint8)
            voxels[random.random(voxels.shape) < percent / 100] = 1
            file = folder / f"noise_{percent:g}{'_onto' if flags.onto else ''}.nii"
            file.write_bytes(nifti(voxels.shape, ()) + voxels.tobytes(order="F"))
            bench(program, file, folder)


if __name__ == "__main__":
    main()
