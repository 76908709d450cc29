"""Reads the meshes that ramus writes."""

import struct


def read_ply(path):
    """Header lines, vertices as tuples and triangles of a binary PLY of floats and, last, whole numbers."""
    header, body = path.read_bytes().split(b"end_header\n", 1)
    lines = header.decode().splitlines()
    count = {words[1]: int(words[2]) for words in map(str.split, lines) if words[0] == "element"}
    floats, ints = (sum(line.startswith(f"property {kind}") for line in lines) for kind in ("float", "int"))
    width = floats + ints
    vertices = list(struct.iter_unpack(f"<{floats}f{ints}i", body[: 4 * width * count["vertex"]]))
    faces = [face[1:] for face in struct.iter_unpack("<B3i", body[4 * width * count["vertex"]:])]
    return lines, vertices, faces


def volume_of(vertices, faces):
    def six_times(a, b, c):
        return (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                a[2] * (b[0] * c[1] - b[1] * c[0]))

    return sum(six_times(*(vertices[n] for n in face)) for face in faces) / 6
