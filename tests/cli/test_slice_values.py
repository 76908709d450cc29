"""Values of slices against nibabel, numpy, scipy and pydicom: every voxel centre of a slice exactly, other places by interpolation,
for the real volumes and for DICOM series in several directions.
"""

import ast
import math
import os
import random
import unittest
import zlib

try:
    import nibabel
    import numpy as np
    from scipy.ndimage import map_coordinates
    MISSING = None
except ImportError as problem:
    MISSING = problem

from dicom import write_series
from ramus import CommandLineTest

SHARED = os.environ.get("RAMUS_SHARED_DATA", "")
CENTRES = int(os.environ.get("RAMUS_SLICE_VALUES", "1500"))  # compared of each volume


def places(image):
    """Where the pixels of a slice lie, mm."""
    columns, rows = image.shape[:2]
    i, j = np.meshgrid(np.arange(columns), np.arange(rows), indexing="ij")
    return np.stack([i, j, np.zeros_like(i), np.ones_like(i)], axis=-1) @ image.affine.T


def nifti_volume(path):
    image = nibabel.load(path)
    return np.asanyarray(image.dataobj).astype(np.float64), image.affine


def metaimage_volume(path):
    """A compressed MetaImage of 16 bits with its own axes; those are LPS."""
    with open(path, "rb") as file:
        head, body = file.read().split(b"ElementDataFile = LOCAL\n", 1)
    fields = dict(line.split(" = ", 1) for line in head.decode().splitlines())
    assert (fields["ElementType"], fields["CompressedData"]) == ("MET_SHORT", "True")
    size, spacing, turn, offset = ([float(n) for n in fields[name].split()]
                                   for name in ("DimSize", "ElementSpacing", "TransformMatrix", "Offset"))
    values = np.frombuffer(zlib.decompress(body), "<i2").reshape([int(n) for n in size], order="F")
    affine = np.eye(4)
    affine[:3, :3] = np.array(turn).reshape(3, 3).T * spacing
    affine[:3, 3] = offset
    return values.astype(np.float64), np.diag([-1, -1, 1, 1]) @ affine


def nrrd_volume(path):
    """A compressed NRRD of bytes in RAS."""
    with open(path, "rb") as file:
        head, body = file.read().split(b"\n\n", 1)
    fields = dict(line.split(": ", 1) for line in head.decode().splitlines() if ": " in line and line[0] != "#")
    assert (fields["type"], fields["encoding"], fields["space"]) == ("unsigned char", "gzip", "right-anterior-superior")
    size = [int(n) for n in fields["sizes"].split()]
    values = np.frombuffer(zlib.decompress(body, wbits=31), np.uint8).reshape(size, order="F")
    affine = np.eye(4)
    affine[:3, :3] = np.array([ast.literal_eval(axis) for axis in fields["space directions"].split()]).T
    affine[:3, 3] = ast.literal_eval(fields["space origin"])
    return values.astype(np.float64), affine


READERS = {".nii.gz": nifti_volume, ".mha": metaimage_volume, ".nrrd": nrrd_volume}


class SliceValues(CommandLineTest):
    def slice(self, volume, *words):
        self.expect_done("slice", volume, "-o", "s.nii", *words)
        return nibabel.load(self.folder / "s.nii")

    def check_volume(self, path, values, affine):
        """Slices through voxels: at voxel centres the nearest value is the file's; elsewhere the linear one is scipy's."""
        to_index = np.linalg.inv(affine)
        spread = float(values.max()) - float(values.min())
        dice = random.Random(4)
        exact = 0
        while exact < CENTRES:
            voxel = np.array([dice.randrange(n) for n in values.shape[:3]] + [1.0])
            at = affine @ voxel
            plane = dice.choice(("axial", "coronal", "sagittal"))
            words = (f"--at={at[0]:.9g},{at[1]:.9g},{at[2]:.9g}", "--plane", plane)
            nearest = self.slice(path, *words, "--nearest")
            index = places(nearest) @ to_index.T
            found = nearest.get_fdata()[..., 0]
            # Pixels near voxel centres: halfway between two voxels both are nearest.
            off = np.abs(index[..., :3] - np.round(index[..., :3])).max(axis=-1)
            whole = np.round(index[..., :3]).astype(int)
            inside = ((whole >= 0) & (whole < np.array(values.shape[:3]))).all(axis=-1) & (off < 0.4)
            self.assertGreater(inside.sum(), 0)
            chosen = np.argwhere(inside)
            chosen = chosen[np.random.default_rng(5).permutation(len(chosen))[:500]]
            for x, y in chosen:
                self.assertEqual(found[x, y], values[tuple(whole[x, y])])
            exact += len(chosen)
            linear = self.slice(path, *words)
            expected = map_coordinates(values, np.moveaxis(places(linear) @ to_index.T, -1, 0)[:3], order=1, mode="nearest",
                                       output=np.float64)
            got = linear.get_fdata()[..., 0]
            known = ~np.isnan(got)
            self.assertGreater(known.sum(), 0)
            self.assertLess(np.abs(got - expected)[known].max(), 1e-3 * spread)
        return exact

    def test_real_volumes(self):
        folder = os.path.join(SHARED, "volumes")
        if not os.path.isdir(folder):
            self.skipTest("without the real volumes")
        for name in sorted(os.listdir(folder)):
            path = os.path.join(folder, name)
            for ending, reader in READERS.items():
                if name.endswith(ending):
                    with self.subTest(name=name):
                        print(f"{name}: {self.check_volume(path, *reader(path))} voxels")

    def test_oblique_slices(self):
        values = np.random.default_rng(1).integers(-1000, 3000, (21, 17, 13)).astype(np.int16)
        turn = nibabel.eulerangles.euler2mat(0.4, -0.3, 0.9)
        affine = np.eye(4)
        affine[:3, :3] = turn @ np.diag([0.8, -1.1, 2.5])
        affine[:3, 3] = (-12, 40, 7)
        nibabel.save(nibabel.Nifti1Image(values, affine), self.folder / "v.nii")
        stored = nibabel.load(self.folder / "v.nii").affine
        centre = stored @ np.array([10, 8, 6, 1])
        for normal in ((1, 2, 3), (-1, 0.2, 0.4), (0.1, 1, -0.3)):
            image = self.slice("v.nii", f"--at={centre[0]:.9g},{centre[1]:.9g},{centre[2]:.9g}", "--plane", "oblique",
                               "--normal=" + ",".join(map(str, normal)))
            index = places(image) @ np.linalg.inv(stored).T
            expected = map_coordinates(values.astype(float), np.moveaxis(index, -1, 0)[:3], order=1, mode="nearest")
            got = image.get_fdata()[..., 0]
            known = ~np.isnan(got)
            self.assertGreater(known.sum(), 100)
            self.assertLess(np.abs(got - expected)[known].max(), 1e-3 * 4000)
            length = math.sqrt(sum(n * n for n in normal))
            across = (places(image)[..., :3] - centre[:3]) @ np.array(normal) / length
            self.assertLess(np.abs(across).max(), 1e-3)


class DicomSlices(CommandLineTest):
    def check_series(self, right, down, slices=9, order=1.0, tilt=0.0):
        """`tilt`: of the gantry, in mm along `down` from image to image."""
        right, down = np.array(right, float), np.array(down, float)
        step = order * 2.5 * np.cross(right, down) + tilt * down
        values = np.random.default_rng(2).integers(0, 4000, (14, 18, slices)).astype(np.uint16)  # column, row, image
        (self.folder / "series").mkdir()
        write_series(self.folder / "series", values, right, down, step)
        values = values.astype(float) - 1024
        affine = np.eye(4)
        affine[:3, 0], affine[:3, 1], affine[:3, 2] = 0.7 * right, 0.9 * down, step
        affine[:3, 3] = (5, -7, 11)
        affine = np.diag([-1, -1, 1, 1]) @ affine  # LPS to RAS
        exact = SliceValues.check_volume(self, "series", values, affine)
        report = self.json("slice", "series", "--json")
        self.assertEqual((report["unit"], report["orientation"], report["value_unit"]), ("mm", "RAS", "HU"))
        return exact

    slice = SliceValues.slice

    def setUp(self):
        super().setUp()
        try:
            import pydicom  # noqa: F401
        except ImportError:
            self.skipTest("no pydicom")

    def test_axial(self):
        self.check_series((1, 0, 0), (0, 1, 0))

    def test_reversed(self):
        self.check_series((1, 0, 0), (0, 1, 0), order=-1.0)

    def test_coronal(self):
        self.check_series((1, 0, 0), (0, 0, -1))

    def test_sagittal(self):
        self.check_series((0, 1, 0), (0, 0, -1))

    def test_tilted_gantry(self):
        self.check_series((1, 0, 0), (0, 1, 0), tilt=0.8)

    def test_oblique(self):
        c, s = math.cos(0.5), math.sin(0.5)
        self.check_series((c, s, 0), (-s * c, c * c, -s))


if __name__ == "__main__":
    if MISSING is not None:
        print(f"SKIPPED: nothing to compare with ({MISSING}); Debian has python3-nibabel and python3-scipy")
    else:
        unittest.main()
