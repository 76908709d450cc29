"""Vessel trees for the validation, made here: the paper's artificial ones, stenoses, and masks of trees.

A tree is a list of rows (x, y, z, radius, parent), parents counted from 0, -1 at a root; mm.
"""

import gzip
import math
import struct


def line(rows, parent, begin, end, spacing, radius):
    """Adds points from the row `parent`, which lies at `begin`, straight to `end`; `radius` of mm along. The last row."""
    length = math.dist(begin, end)
    steps = max(1, math.ceil(length / spacing))
    for i in range(1, steps + 1):
        place = [b + (e - b) * i / steps for b, e in zip(begin, end)]
        rows.append((*place, radius(length * i / steps), parent if i == 1 else len(rows) - 1))
    return len(rows) - 1


def trifurcation(radius=2.0, length=40.0):
    """Three equal branches that meet in a plane."""
    rows = [(0.0, 0.0, 0.0, radius, -1)]
    for k in range(3):
        angle = 2.0 * math.pi * k / 3.0
        line(rows, 0, (0, 0, 0), (length * math.cos(angle), length * math.sin(angle), 0), 1.0, lambda _: radius)
    return rows


def s_shape(radius=2.0, bend=8.0, spacing=1.0):
    """Two half circles, one after the other."""
    steps = math.ceil(math.pi * bend / spacing)
    places = [(bend * (1.0 - math.cos(math.pi * i / steps)), bend * math.sin(math.pi * i / steps), 0.0)
              for i in range(steps + 1)]
    places += [(2.0 * bend + x, -y, z) for x, y, z in places[1:]]
    return [(*place, radius, i - 1) for i, place in enumerate(places)]


def stenosis(share, diameters, radius=2.0, length=60.0):
    """A straight vessel with a cosine-shaped stenosis of `share` over so many diameters in its middle."""
    half = diameters * radius

    def at(along):
        off = (along - 0.5 * length) / half
        return radius * (1.0 - share * 0.5 * (1.0 + math.cos(math.pi * off))) if abs(off) < 1.0 else radius

    rows = [(0.0, 0.0, 0.0, radius, -1)]
    line(rows, 0, (0, 0, 0), (0, 0, length), 0.1, at)
    return rows


def write_swc(path, rows):
    with open(path, "w", encoding="ascii") as file:
        for n, (x, y, z, radius, parent) in enumerate(rows, 1):
            file.write(f"{n} 2 {x:.6f} {y:.6f} {z:.6f} {radius:.6f} {parent + 1 if parent >= 0 else -1}\n")


def read_swc(path):
    rows, number = [], {}
    with open(path, encoding="utf-8") as file:
        for text in file:
            words = text.split("#")[0].split()
            if len(words) >= 7:
                number[words[0]] = len(rows)
                rows.append((*map(float, words[2:6]), words[6]))
    return [(*row[:4], number.get(row[4], -1)) for row in rows]


def write_mask(path, rows, voxel):
    """NIfTI (gzip) of the voxels whose middle is in a truncated cone of the tree; `voxel` is the size along x, y, z."""
    margin = max(row[3] for row in rows) + 2.0 * max(voxel)
    least = [min(row[k] for row in rows) - margin for k in range(3)]
    size = [math.ceil((max(row[k] for row in rows) + margin - least[k]) / voxel[k]) for k in range(3)]
    inside = bytearray(size[0] * size[1] * size[2])
    for row in rows:
        other = rows[row[4]] if row[4] >= 0 else row
        way = [other[k] - row[k] for k in range(3)]
        squared = sum(w * w for w in way) or 1.0
        reach = max(row[3], other[3])
        spans = [range(max(0, math.floor((min(row[k], other[k]) - reach - least[k]) / voxel[k])),
                       min(size[k], math.ceil((max(row[k], other[k]) + reach - least[k]) / voxel[k]) + 1))
                 for k in range(3)]
        for k in spans[2]:
            z = least[2] + k * voxel[2] - row[2]
            for j in spans[1]:
                y = least[1] + j * voxel[1] - row[1]
                at = (k * size[1] + j) * size[0]
                for i in spans[0]:
                    x = least[0] + i * voxel[0] - row[0]
                    share = min(1.0, max(0.0, (x * way[0] + y * way[1] + z * way[2]) / squared))
                    radius = row[3] + share * (other[3] - row[3])
                    if ((x - share * way[0]) ** 2 + (y - share * way[1]) ** 2 + (z - share * way[2]) ** 2
                            <= radius * radius):
                        inside[at + i] = 1
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, *size, 1, 1, 1, 1)
    struct.pack_into("<2h", header, 70, 2, 8)  # unsigned bytes
    struct.pack_into("<8f", header, 76, 1, *voxel, 1, 1, 1, 1)
    struct.pack_into("<f", header, 108, 352)
    struct.pack_into("<b", header, 123, 2)  # mm
    struct.pack_into("<2h", header, 252, 0, 1)
    for k in range(3):
        matrix_row = [0.0, 0.0, 0.0, least[k]]
        matrix_row[k] = voxel[k]
        struct.pack_into("<4f", header, 280 + 16 * k, *matrix_row)
    header[344:348] = b"n+1\0"
    with gzip.GzipFile(path, "wb", mtime=0) as file:
        file.write(header)
        file.write(inside)
