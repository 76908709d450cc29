"""Writes NIfTI masks for tests, byte by byte after the standard."""

import gzip
import struct

UNITS_MM = 2
CODES = {"B": 2, "h": 4, "i": 8, "f": 16, "d": 64, "b": 256, "H": 512, "I": 768}


def nifti(size, values, kind="B", rows=((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0)), order="<", units=UNITS_MM):
    """The bytes of a NIfTI-1 file; `values` run along x first, `kind` is a letter of struct's."""
    head = bytearray(352)
    struct.pack_into(order + "i", head, 0, 348)
    struct.pack_into(order + "8h", head, 40, 3, *size, 1, 1, 1, 1)
    struct.pack_into(order + "2h", head, 70, CODES[kind], 8 * struct.calcsize(kind))
    struct.pack_into(order + "8f", head, 76, 1, 1, 1, 1, 1, 1, 1, 1)
    struct.pack_into(order + "f", head, 108, 352)
    head[123] = units
    struct.pack_into(order + "2h", head, 252, 0, 1)
    for n, row in enumerate(rows):
        struct.pack_into(order + "4f", head, 280 + 16 * n, *row)
    head[344:348] = b"n+1\0"
    return bytes(head) + struct.pack(f"{order}{len(values)}{kind}", *values)


def compressed(content):
    return gzip.compress(content, mtime=0)


def voxels(size):
    """All voxels as (x, y, z), in the order of the file."""
    for z in range(size[2]):
        for y in range(size[1]):
            for x in range(size[0]):
                yield x, y, z
