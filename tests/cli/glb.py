"""Reads GLB and holds it to what glTF 2.0 demands of the container, the buffer views and the accessors."""

import ctypes
import json
import struct

SIZES = {5120: 1, 5121: 1, 5123: 2, 5125: 4, 5126: 4}
PARTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


def chunks(path):
    """The JSON and the binary chunk, after a look at header, lengths, padding and order."""
    data = path.read_bytes()
    magic, version, length = struct.unpack_from("<III", data)
    assert (magic, version, length) == (0x46546C67, 2, len(data)), (magic, version, length)
    found, at = [], 12
    while at < len(data):
        size, kind = struct.unpack_from("<II", data, at)
        assert size % 4 == 0 and at + 8 + size <= len(data)
        found.append((kind, data[at + 8:at + 8 + size]))
        at += 8 + size
    assert [kind for kind, _ in found] == [0x4E4F534A, 0x004E4942]
    return json.loads(found[0][1].decode("utf-8")), found[1][1]


def values(gltf, binary, number):
    """The tuples of an accessor, which lies whole within its view and has the right alignment."""
    accessor = gltf["accessors"][number]
    view = gltf["bufferViews"][accessor["bufferView"]]
    size, parts = SIZES[accessor["componentType"]], PARTS[accessor["type"]]
    start = accessor.get("byteOffset", 0)
    stride = view.get("byteStride", size * parts)
    assert accessor["count"] >= 1
    assert start % size == 0 and (view.get("byteOffset", 0) + start) % size == 0
    assert start + stride * (accessor["count"] - 1) + size * parts <= view["byteLength"]
    letter = {5120: "b", 5121: "B", 5123: "H", 5125: "I", 5126: "f"}[accessor["componentType"]]
    first = view.get("byteOffset", 0) + start
    if stride == size * parts:
        return list(struct.iter_unpack(f"<{parts}{letter}", binary[first:first + stride * accessor["count"]]))
    return [struct.unpack_from(f"<{parts}{letter}", binary, first + stride * n) for n in range(accessor["count"])]


def unpacked(view, binary, library):
    """The bytes of a view that EXT_meshopt_compression has packed, by the functions of meshoptimizer."""
    how = view["extensions"]["EXT_meshopt_compression"]
    count, stride = how["count"], how["byteStride"]
    assert count * stride == view["byteLength"] and how["byteOffset"] % 4 == 0
    packed = binary[how["byteOffset"]:how["byteOffset"] + how["byteLength"]]
    out = ctypes.create_string_buffer(count * stride)
    sizes = ctypes.c_size_t(count), ctypes.c_size_t(stride)
    decode = library.meshopt_decodeIndexBuffer if how["mode"] == "TRIANGLES" else library.meshopt_decodeVertexBuffer
    assert decode(out, *sizes, packed, ctypes.c_size_t(len(packed))) == 0
    filters = {"EXPONENTIAL": library.meshopt_decodeFilterExp, "OCTAHEDRAL": library.meshopt_decodeFilterOct}
    if "filter" in how:
        filters[how["filter"]](out, *sizes)
    return out.raw


def check(path):
    """Fails on what a validator would; returns (gltf, [(node name, positions, triangles)])."""
    gltf, binary = chunks(path)
    assert gltf["asset"]["version"] == "2.0"
    assert len(gltf["buffers"]) == 1 and "uri" not in gltf["buffers"][0]
    assert 0 <= len(binary) - gltf["buffers"][0]["byteLength"] <= 3
    users = {}
    for view in gltf["bufferViews"]:
        assert view["byteOffset"] % 4 == 0 and view["byteLength"] >= 1
        assert view["byteOffset"] + view["byteLength"] <= gltf["buffers"][0]["byteLength"]
        assert view["target"] in (34962, 34963)
        assert ("byteStride" in view) == (view["target"] == 34962)
        assert view.get("byteStride", 4) % 4 == 0 and 4 <= view.get("byteStride", 4) <= 252
    parents = {}
    for number, node in enumerate(gltf["nodes"]):
        for child in node.get("children", ()):
            assert child not in parents, "a node has two parents"
            parents[child] = number
    roots = [number for number in range(len(gltf["nodes"])) if number not in parents]
    assert gltf["scenes"][gltf["scene"]]["nodes"] == roots
    meshes = [node["mesh"] for node in gltf["nodes"] if "mesh" in node]
    assert sorted(meshes) == list(range(len(gltf["meshes"]))), "each mesh is in one place"
    for material in gltf["materials"]:
        factor = material["pbrMetallicRoughness"]["baseColorFactor"]
        assert len(factor) == 4 and all(0.0 <= part <= 1.0 for part in factor)
    parts = []
    for node in gltf["nodes"]:
        if "mesh" not in node:
            continue
        for primitive in gltf["meshes"][node["mesh"]]["primitives"]:
            assert primitive.get("mode", 4) == 4
            assert 0 <= primitive["material"] < len(gltf["materials"])
            for name, number in {**primitive["attributes"], "indices": primitive["indices"]}.items():
                assert users.setdefault(number, name) == name
                target = gltf["bufferViews"][gltf["accessors"][number]["bufferView"]]["target"]
                assert target == (34963 if name == "indices" else 34962)
            positions = values(gltf, binary, primitive["attributes"]["POSITION"])
            accessor = gltf["accessors"][primitive["attributes"]["POSITION"]]
            assert accessor["min"] == [min(p[k] for p in positions) for k in range(3)]
            assert accessor["max"] == [max(p[k] for p in positions) for k in range(3)]
            for x, y, z in values(gltf, binary, primitive["attributes"]["NORMAL"]):
                assert abs(x * x + y * y + z * z - 1.0) < 1e-3
            for name, number in primitive["attributes"].items():
                assert gltf["accessors"][number]["count"] == len(positions), name
            indices = [index for index, in values(gltf, binary, primitive["indices"])]
            assert len(indices) % 3 == 0 and set(indices) == set(range(len(positions)))
            parts.append((node["name"], positions, list(zip(*[iter(indices)] * 3))))
    assert len(users) == len(gltf["accessors"]), "an accessor that nobody uses"
    return gltf, parts
