"""Writes segmentations for tests, byte by byte after the standards: DICOM SEG, and NRRD as 3D Slicer writes it."""

import gzip
import struct


def element(tag, vr, value):
    """In explicit little endian; the value of a sequence is a list of dictionaries."""
    if vr == "SQ":
        value = b"".join(struct.pack("<HHI", 0xfffe, 0xe000, len(item)) + item for item in map(elements, value))
    elif vr == "US":
        value = struct.pack(f"<{len(value)}H", *value)
    elif isinstance(value, str):
        value = value.encode()
        value += (b"\0" if vr == "UI" else b" ") * (len(value) % 2)
    head = struct.pack("<HH", tag >> 16, tag & 0xffff) + vr.encode()
    if vr in ("SQ", "OB", "OW"):
        return head + struct.pack("<HI", 0, len(value)) + value
    return head + struct.pack("<H", len(value)) + value


def elements(values):
    return b"".join(element(tag, *values[tag]) for tag in sorted(values))


def dicom_seg(size, segments, frames, kind="BINARY"):
    """`segments`: number to (name, L*a*b* of 16 bits or None). `frames`: (segment, z, values along x first)."""
    listed = []
    for number, (name, lab) in segments.items():
        listed.append({0x00620004: ("US", [number]), 0x00620005: ("LO", name)})
        if lab is not None:
            listed[-1][0x0062000d] = ("US", lab)
    bits = 1 if kind == "BINARY" else 8
    values = [value for _, _, frame in frames for value in frame]
    if bits == 1:
        values += [0] * (-len(values) % 16)
        pixels = bytes(sum(values[i + n] << n for n in range(8)) for i in range(0, len(values), 8))
    else:
        pixels = bytes(values) + bytes(len(values) % 2)
    data = {
        0x00080016: ("UI", "1.2.840.10008.5.1.4.1.1.66.4"), 0x00080018: ("UI", "1.2.3.1"), 0x00080060: ("CS", "SEG"),
        0x0020000e: ("UI", "1.2.3"), 0x00280002: ("US", [1]), 0x00280004: ("CS", "MONOCHROME2"),
        0x00280008: ("IS", str(len(frames))), 0x00280010: ("US", [size[1]]), 0x00280011: ("US", [size[0]]),
        0x00280100: ("US", [bits]), 0x00280101: ("US", [bits]), 0x00280102: ("US", [bits - 1]),
        0x00280103: ("US", [0]), 0x00620001: ("CS", kind), 0x00620002: ("SQ", listed),
        0x52009229: ("SQ", [{
            0x00209116: ("SQ", [{0x00200037: ("DS", "1\\0\\0\\0\\1\\0")}]),
            0x00289110: ("SQ", [{0x00180050: ("DS", "1"), 0x00180088: ("DS", "1"), 0x00280030: ("DS", "1\\1")}])}]),
        0x52009230: ("SQ", [{
            0x00209113: ("SQ", [{0x00200032: ("DS", f"0\\0\\{z}")}]),
            0x0062000a: ("SQ", [{0x0062000b: ("US", [segment])}])} for segment, z, _ in frames]),
        0x7fe00010: ("OB" if bits == 8 else "OW", pixels)}
    if kind == "FRACTIONAL":
        data[0x0062000e] = ("US", [100])
    syntax = element(0x00020010, "UI", "1.2.840.10008.1.2.1")
    return bytes(128) + b"DICM" + element(0x00020000, "UL", struct.pack("<I", len(syntax))) + syntax + elements(data)


def seg_nrrd(size, layers, fields, encoding="gzip", space="left-posterior-superior", kind="list", type_of="uint8"):
    """`layers`: the values of each, along x first; `fields`: lines as "Segment0_Name:=vein". One layer has no axis."""
    many = len(layers) > 1
    code = {"uint8": "B", "int16": "h", "float": "f"}[type_of]
    values = [layer[n] for n in range(len(layers[0])) for layer in layers]
    head = ["NRRD0005", f"type: {type_of}", f"dimension: {3 + many}", f"space: {space}",
            "sizes: " + (f"{len(layers)} " if many else "") + "%d %d %d" % size,
            "space directions: " + ("none " if many else "") + "(1,0,0) (0,1,0) (0,0,1)",
            "kinds: " + (kind + " " if many else "") + "domain domain domain", "endian: little",
            "space origin: (0,0,0)", "encoding: " + encoding, *fields]
    content = struct.pack(f"<{len(values)}{code}", *values)
    if encoding == "gzip":
        content = gzip.compress(content, mtime=0)
    elif encoding == "text":
        content = " ".join(map(str, values)).encode()
    return "\n".join(head).encode() + b"\n\n" + content
