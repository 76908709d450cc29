"""Masks of real organs from the shared data, for ramus_bench_territories --organ. Needs numpy, scipy and nibabel.

    organ_masks.py DATA/volumes FOLDER

lung.nii.gz: the larger lung of aorta_dissection_ct as far as that scan shows it: below -500 HU, vessels filled by a closing
of 6 mm, and parted from the other lung where it is thinnest. kidney.nii.gz: a rat's kidney as the closing of its vessels
(kidney.nii.gz of the data) by 1.6 mm, with voxels of six. The liver (liver_002_organ.nii.gz) needs no work.
"""

import pathlib
import sys

import nibabel
import numpy
from scipy import ndimage

data, folder = map(pathlib.Path, sys.argv[1:])


def closed(mask, radius):
    """The closing by a ball of so many voxels."""
    wide = numpy.pad(mask, radius + 2)
    near = ndimage.distance_transform_edt(~wide) <= radius
    inner = (slice(radius + 2, -radius - 2),) * 3
    return ndimage.binary_fill_holes((ndimage.distance_transform_edt(near) > radius)[inner])


def parts(mask, count):
    """The largest parts, by faces."""
    labels, _ = ndimage.label(mask)
    sizes = numpy.bincount(labels.ravel())
    sizes[0] = 0
    return [labels == label for label in numpy.argsort(sizes)[::-1][:count]]


def write(mask, affine, name):
    image = nibabel.Nifti1Image(mask.astype(numpy.uint8), affine)
    image.header.set_xyzt_units("mm")
    nibabel.save(image, folder / name)
    print(f"{name}: {mask.sum()} voxels, {mask.sum() * abs(numpy.linalg.det(affine[:3, :3])) / 1000:.2f} ml")


scan = nibabel.load(data / "aorta_dissection_ct.nii.gz")
lungs = closed(parts(numpy.asarray(scan.dataobj) < -500, 1)[0], 4)
depth = ndimage.distance_transform_edt(numpy.pad(lungs, 1))[1:-1, 1:-1, 1:-1]
larger, other = (ndimage.distance_transform_edt(~core) for core in parts(depth > 3, 2))
write(parts(lungs & (larger < other), 1)[0], scan.affine, "lung.nii.gz")

image = nibabel.load(data / "kidney.nii.gz")
vessels = numpy.asarray(image.dataobj) > 0
side = 6
counts = [n // side for n in vessels.shape]
vessels = vessels[tuple(slice(n * side) for n in counts)]
coarse = vessels.reshape(counts[0], side, counts[1], side, counts[2], side).any(axis=(1, 3, 5))
affine = image.affine.copy()
affine[:3, 3] += affine[:3, :3] @ numpy.full(3, (side - 1) / 2)
affine[:3, :3] *= side
write(parts(closed(coarse, 12), 1)[0], affine, "kidney.nii.gz")
