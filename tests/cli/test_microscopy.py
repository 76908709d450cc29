"""TIFF and OME-Zarr against tifffile, Pillow and zarr of Python: every voxel of every kind of file, its distances, its channels; as
scans (slices) and as masks (trees, surfaces). What is no volume is refused with the reason.
"""

import json
import os
import shutil
import unittest

try:
    import nibabel
    import numcodecs
    import numpy as np
    import tifffile
    import zarr
    from PIL import Image
    MISSING = None
except ImportError as problem:
    MISSING = problem

from ramus import CommandLineTest

SHAPE = (3, 21, 34)  # z, y, x
PLAIN = {"photometric": "minisblack", "metadata": None}


def numbers(kind, shape=SHAPE, seed=1):
    dice = np.random.default_rng(seed)
    kind = np.dtype(kind)
    if kind.kind == "f":
        return dice.normal(0, 1000, shape).astype(np.float32).astype(kind)
    if kind.kind == "b":
        return dice.random(shape) > 0.5
    info = np.iinfo(kind)
    return dice.integers(max(info.min, -2**24), min(info.max, 2**24), shape).astype(kind)


class Microscopy(CommandLineTest):
    def check_values(self, path, values, *words):
        """`values` run along z, y, x. Every voxel is under a pixel of an axial slice, which has its value."""
        info = self.json("info", path, "--json", *words)
        self.assertEqual(info["size"], list(reversed(values.shape)))
        affine = np.vstack([np.array(info["to_patient"]), [0, 0, 0, 1]])
        self.assertEqual(info["orientation"], "LPS")
        self.assertTrue(any("axes taken as left, posterior, superior" in note for note in info["notes"]))
        for k in range(values.shape[0]):
            at = affine @ [values.shape[2] // 2, values.shape[1] // 2, k, 1]
            self.expect_done("slice", path, "-o", "s.nii", "--nearest", f"--at={at[0]:.12g},{at[1]:.12g},{at[2]:.12g}", *words)
            image = nibabel.load(self.folder / "s.nii")
            i, j = np.meshgrid(*(np.arange(n) for n in image.shape[:2]), indexing="ij")
            places = np.stack([i, j, 0 * i, 0 * i + 1], axis=-1) @ image.affine.T
            index = (places @ np.linalg.inv(affine).T)[..., :3]
            whole = np.round(index).astype(int)
            inside = ((whole >= 0) & (whole < values.shape[::-1])).all(-1) & (np.abs(index - whole).max(-1) < 0.4)
            self.assertEqual(len(np.unique(whole[inside][:, :2], axis=0)), values.shape[1] * values.shape[2])
            self.assertTrue((whole[inside][:, 2] == k).all())
            expected = values.astype(np.float32)[tuple(whole[inside][:, ::-1].T)]
            self.assertTrue((image.get_fdata(dtype=np.float32)[..., 0][inside] == expected).all(), path)
        return info

    def spacing(self, path, *words):
        return self.json("info", path, "--json", *words)["spacing_mm"]

    def assert_spacing(self, path, expected, *words):
        for got, mm in zip(self.spacing(path, *words), expected):
            self.assertAlmostEqual(got / mm, 1.0, 5)


class Tiff(Microscopy):
    def test_types_orders_and_layouts(self):
        for kind in ("u1", "i1", "u2", "i2", "u4", "i4", "f4", "f8"):
            values = numbers(kind)
            for name, how in {"little": {}, "big-endian": {"byteorder": ">"}, "bigtiff": {"bigtiff": True},
                              "tiles": {"tile": (16, 32)}, "strips": {"rowsperstrip": 4},
                              "deflate": {"compression": "zlib", "predictor": kind[0] != "f", "rowsperstrip": 4},
                              "tiles-deflate": {"compression": "zlib", "tile": (16, 16), "byteorder": ">"}}.items():
                with self.subTest(kind=kind, how=name):
                    tifffile.imwrite(self.folder / "a.tif", values, **PLAIN, **how)
                    self.check_values("a.tif", values)

    def test_single_bits(self):
        values = numbers("?")
        tifffile.imwrite(self.folder / "a.tif", values, **PLAIN)
        self.check_values("a.tif", values.astype(np.uint8))
        self.assertEqual(self.json("info", "a.tif", "--json")["labels"][0]["voxels"], int(values.sum()))

    def test_compressions_of_libtiff(self):
        """Pillow writes with libtiff, of this or another version."""
        for kind, mode, compressions in (("u1", "L", ("tiff_lzw", "packbits", "tiff_adobe_deflate", "tiff_deflate")),
                                         ("u2", "I;16", ("tiff_lzw", "packbits", "tiff_adobe_deflate")),
                                         ("f4", "F", ("tiff_lzw", "tiff_adobe_deflate")),
                                         ("?", "1", ("group3", "group4", "tiff_ccitt", "tiff_lzw"))):
            values = numbers(kind)
            pages = [Image.fromarray(page) for page in values]
            self.assertEqual(pages[0].mode, mode)
            for compression in compressions:
                with self.subTest(kind=kind, compression=compression):
                    pages[0].save(self.folder / "a.tif", save_all=True, append_images=pages[1:], compression=compression)
                    self.check_values("a.tif", values.astype(np.uint8) if kind == "?" else values)

    def test_jpeg(self):
        smooth = np.add.outer(np.arange(64), np.arange(64)).astype(np.uint8)
        Image.fromarray(smooth).save(self.folder / "a.tif", compression="jpeg", quality=100)
        report = self.json("info", "a.tif", "--json")
        self.assertLess(abs(report["values"]["max"] - 126), 4)

    def test_imagej(self):
        values = numbers("u2", (2, 3, 2, 11, 13))  # t, z, c, y, x
        tifffile.imwrite(self.folder / "a.tif", values, imagej=True, resolution=(1 / 0.3, 1 / 0.3),
                         metadata={"axes": "TZCYX", "spacing": 2.5, "unit": "micron"})
        self.expect_failure("info", "a.tif", says=["2 channels: 1, 2", "--channel"])
        self.expect_failure("info", "a.tif", "--channel", "2", says=["2 time points", "--time"])
        self.expect_failure("info", "a.tif", "--channel", "3", "--time", "1", says=["no channel 3"])
        for time in (0, 1):
            for channel in (0, 1):
                words = ("--channel", str(channel + 1), "--time", str(time + 1))
                self.check_values("a.tif", values[time, :, channel], *words)
        self.assert_spacing("a.tif", (0.3e-3, 0.3e-3, 2.5e-3), *words)

    def test_imagej_without_pages(self):
        """Files of more than 4 GB have one page; the other planes follow it."""
        values = numbers("u2", (5, 9, 8))
        tifffile.imwrite(self.folder / "a.tif", values[0], byteorder=">", photometric="minisblack", metadata=None,
                         description="ImageJ=1.53t\nimages=5\nslices=5\nunit=mm\nspacing=2.0\n")
        with tifffile.TiffFile(self.folder / "a.tif") as file:
            offset = file.pages[0].dataoffsets[0]
        head = (self.folder / "a.tif").read_bytes()[:offset]
        whole = head + values.astype(">u2").tobytes()
        self.write("a.tif", whole)
        self.check_values("a.tif", values)
        self.write("a.tif", whole[:-2])
        self.expect_failure("info", "a.tif", says=["end of the file"])

    def test_ome(self):
        values = numbers("u2", (2, 3, 2, 11, 13))  # t, c, z, y, x
        for axes, turn in (("TCZYX", (0, 1, 2, 3, 4)), ("TZCYX", (0, 2, 1, 3, 4)), ("CTZYX", (1, 0, 2, 3, 4)),
                           ("ZCTYX", (2, 1, 0, 3, 4))):
            with self.subTest(axes=axes):
                tifffile.imwrite(self.folder / "a.ome.tif", np.ascontiguousarray(values.transpose(turn)), metadata={
                    "axes": axes, "PhysicalSizeX": 0.7, "PhysicalSizeXUnit": "µm", "PhysicalSizeY": 700,
                    "PhysicalSizeYUnit": "nm", "PhysicalSizeZ": 3, "PhysicalSizeZUnit": "µm",
                    "Channel": {"Name": ["DAPI", "CD31", "none"]}})
                for time, channel in ((0, 0), (1, 1), (1, 2)):
                    words = ("--channel", str(channel + 1), "--time", str(time + 1))
                    self.check_values("a.ome.tif", values[time, channel], *words)
                self.assert_spacing("a.ome.tif", (0.7e-3, 0.7e-3, 3e-3), *words)
        self.expect_failure("info", "a.ome.tif", says=["1 (DAPI), 2 (CD31), 3 (none)"])

    def test_stacks(self):
        values = numbers("u1", (12, 6, 7))
        (self.folder / "stack").mkdir()
        for n, page in enumerate(values):
            tifffile.imwrite(self.folder / "stack" / f"brain_{n + 3}.tif", page, **PLAIN)
        self.check_values("stack", values)
        self.check_values("stack/brain_9.tif", values)
        os.remove(self.folder / "stack" / "brain_10.tif")
        for name in ("stack", "stack/brain_3.tif"):
            self.expect_failure("info", name, says=["slice 10 is missing between brain_9.tif and brain_11.tif"])
        tifffile.imwrite(self.folder / "stack" / "brain_10.tif", values[0][:5], **PLAIN)
        self.expect_failure("info", "stack", says=["brain_10.tif", "differ"])

    def test_what_is_no_volume(self):
        for name, values, how, words in (
                ("rgb", np.zeros((5, 6, 3), "u1"), {"photometric": "rgb"}, "colour"),
                ("palette", np.zeros((5, 6), "u1"), {"photometric": "palette", "colormap": np.zeros((3, 256), "u2")}, "palette"),
                ("half", np.zeros((5, 6), "f2"), {}, "16 bits")):
            tifffile.imwrite(self.folder / f"{name}.tif", values, **how)
            self.expect_failure("info", f"{name}.tif", says=[words])
        self.write("zip.zarr", b"PK\3\4")
        self.expect_failure("info", "zip.zarr", says=["this is a file", "folder"])

    def test_cut_files_are_refused(self):
        tifffile.imwrite(self.folder / "a.tif", numbers("u2"), compression="zlib", **PLAIN)
        whole = (self.folder / "a.tif").read_bytes()
        for part in range(1, 10):
            self.write("cut.tif", whole[:len(whole) * part // 10])
            self.expect_failure("info", "cut.tif", says=["cut.tif"])


class Zarr(Microscopy):
    def test_types_orders_compressors_and_chunks(self):
        blosc = numcodecs.Blosc
        kinds = [("|b1", "C", None), ("|u1", "F", numcodecs.Zlib(1)), ("|i1", "C", numcodecs.GZip(1)),
                 ("<u2", "C", blosc("lz4", 5, blosc.SHUFFLE)), (">u2", "F", blosc("zstd", 3, blosc.BITSHUFFLE)),
                 ("<i2", "C", blosc("zlib", 3, blosc.NOSHUFFLE)), (">i4", "C", None), ("<u4", "F", blosc("blosclz")),
                 ("<f4", "C", blosc("lz4hc")), (">f8", "F", None), ("<f8", "C", blosc("zstd"))]
        for kind, order, compressor in kinds:
            for chunks, separator in (((2, 8, 9), "."), ((2, 8, 9), "/"), (SHAPE, "."), ((1, 64, 64), "/")):
                with self.subTest(kind=kind, order=order, chunks=chunks):
                    values = numbers(kind)
                    shutil.rmtree(self.folder / "a.zarr", ignore_errors=True)
                    array = zarr.open(str(self.folder / "a.zarr"), mode="w", shape=values.shape, chunks=chunks, dtype=kind,
                                      order=order, compressor=compressor, dimension_separator=separator)
                    array[:] = values
                    self.check_values("a.zarr", values.astype(np.uint8) if kind == "|b1" else values)

    def test_missing_chunks(self):
        for fill in (0, 9):
            values = np.full((6, 20, 20), fill, np.uint16)
            values[3:5, 4:9, 12:] = 7
            shutil.rmtree(self.folder / "a.zarr", ignore_errors=True)
            array = zarr.open(str(self.folder / "a.zarr"), mode="w", shape=values.shape, chunks=(2, 4, 4), dtype="u2",
                              fill_value=fill, write_empty_chunks=False)
            array[:] = values
            self.assertLess(len(self.names_in("a.zarr")), 30)
            self.check_values("a.zarr", values)

    def names_in(self, folder):
        return list((self.folder / folder).iterdir())

    def ome(self, values, chunks, axes=None, version="0.4", scales=(0.7, 0.7, 3.0)):
        """An image of two levels; `values` run along t, c, z, y, x, or the last of these."""
        shutil.rmtree(self.folder / "i.zarr", ignore_errors=True)
        group = zarr.open_group(str(self.folder / "i.zarr"), mode="w")
        levels = [values, values[..., ::2, ::2]]
        for n, level in enumerate(levels):
            group.create_dataset(str(n), data=level, chunks=chunks, dimension_separator="/", overwrite=True)
        image = {"version": version, "datasets": [{"path": str(n)} for n in range(2)]}
        names = "tczyx"[5 - values.ndim:]
        if version == "0.3":
            image["axes"] = list(names)
        if version == "0.4":
            image["axes"] = [{"name": name, "type": {"t": "time", "c": "channel"}.get(name, "space"),
                              **({"unit": "micrometer"} if name in "xyz" else {})} for name in names]
            for n in range(2):
                x, y, z = scales
                scale = {"t": 1.0, "c": 1.0, "z": z, "y": y * 2**n, "x": x * 2**n}
                image["datasets"][n]["coordinateTransformations"] = [
                    {"type": "scale", "scale": [scale[name] for name in names]}]
        group.attrs["multiscales"] = [image]
        group.attrs["omero"] = {"channels": [{"label": "DAPI"}, {"label": "CD31"}]}

    def test_ome_images(self):
        values = numbers("u2", (2, 2, 3, 12, 14))
        for version in ("0.4", "0.3", "0.1"):
            with self.subTest(version=version):
                self.ome(values, (1, 1, 2, 8, 8), version=version)
                self.expect_failure("info", "i.zarr", says=["1 (DAPI), 2 (CD31)", "--channel"])
                for time in (0, 1):
                    for channel in (0, 1):
                        words = ("--channel", str(channel + 1), "--time", str(time + 1))
                        info = self.check_values("i.zarr", values[time, channel], *words)
                        self.check_values("i.zarr/1", values[time, channel][:, ::2, ::2], *words)
                self.assertTrue(any("2 levels of detail, 0, 1: read 0" in note for note in info["notes"]))
                if version == "0.4":
                    self.assert_spacing("i.zarr", (0.7e-3, 0.7e-3, 3e-3), *words)
                    self.assert_spacing("i.zarr/1", (1.4e-3, 1.4e-3, 3e-3), *words)
        self.ome(values, (2, 2, 3, 5, 5))  # several channels and times in a chunk
        self.check_values("i.zarr", values[1, 0], "--channel", "1", "--time", "2")

    def test_version_3_is_refused(self):
        (self.folder / "a.zarr").mkdir()
        self.write("a.zarr/zarr.json", json.dumps({"zarr_format": 3, "node_type": "array"}))
        self.expect_failure("info", "a.zarr", says=["version 3"])

    def test_lying_chunks_are_refused(self):
        array = zarr.open(str(self.folder / "a.zarr"), mode="w", shape=(4, 8, 8), chunks=(4, 8, 8), dtype="u2",
                          compressor=numcodecs.Blosc("lz4"))
        array[:] = 5
        good = (self.folder / "a.zarr" / "0.0.0").read_bytes()
        for at in (4, 5, 6, 7, 8, 9, 10, 11, 12, 13):
            self.write("a.zarr/0.0.0", good[:at] + bytes([good[at] ^ 0x55]) + good[at + 1:])
            self.expect_failure("info", "a.zarr", says=["a.zarr", "chunk"])
        for bytes_ in (good[:-1], good[:10], good + b"x" * 100_000, b""):
            self.write("a.zarr/0.0.0", bytes_)
            self.expect_failure("info", "a.zarr", says=["a.zarr", "chunk"])
        text = json.loads((self.folder / "a.zarr" / ".zarray").read_text())
        text["shape"] = [1 << 20, 1 << 20, 1 << 10]
        self.write("a.zarr/.zarray", json.dumps(text))
        self.expect_failure("mesh", "a.zarr", "--method", "iso", "-o", "x.ply", "--memory", "1G", says=["a.zarr", "of memory"])


class Masks(Microscopy):
    """A mask gives the same tree and the same surface in every format."""

    def setUp(self):
        super().setUp()
        z, y, x = np.meshgrid(*(np.arange(n) for n in (60, 32, 32)), indexing="ij")
        self.distance = np.hypot(x - 15.5 - 6 * np.sin(z / 20), y - 15.5)
        self.mask = (self.distance < 4).astype(np.uint8)
        self.grey = np.clip(3000 - 500 * self.distance, 0, 65535).astype(np.uint16)

    def write_all(self, values):
        affine = np.diag([-0.5, -0.5, 2.0, 1.0])
        nibabel.save(nibabel.Nifti1Image(values.transpose(2, 1, 0), affine), self.folder / "a.nii")
        tifffile.imwrite(self.folder / "a.tif", values, imagej=True, resolution=(2, 2),
                         metadata={"axes": "ZYX", "spacing": 2, "unit": "mm"})
        group = zarr.open_group(str(self.folder / "a.zarr"), mode="w")
        group.create_dataset("0", data=values, chunks=(16, 16, 16), overwrite=True)
        group.attrs["multiscales"] = [{"version": "0.4", "axes": [
            {"name": name, "type": "space", "unit": "millimeter"} for name in "zyx"], "datasets": [
                {"path": "0", "coordinateTransformations": [{"type": "scale", "scale": [2.0, 0.5, 0.5]}]}]}]

    def test_trees_and_surfaces(self):
        for values, words in ((self.mask, ()), (self.grey, ("--isovalue", "1000"))):
            self.write_all(values)
            results = []
            for name in ("a.nii", "a.tif", "a.zarr"):
                self.expect_done("skeletonize", name, "-o", "t.swc", *words)
                rows = [line for line in (self.folder / "t.swc").read_text().splitlines() if not line.startswith("#")]
                surface = self.json("mesh", name, "--method", "iso", "-o", "s.ply", "--json", *words)
                results.append((rows, surface["vertices"], surface["triangles"]))
            self.assertGreater(len(results[0][0]), 10)
            self.assertEqual(results[0], results[1])
            self.assertEqual(results[0], results[2])

    def test_channels_in_sessions(self):
        both = np.stack([np.zeros_like(self.mask), self.mask], axis=1)
        tifffile.imwrite(self.folder / "a.tif", both, imagej=True, resolution=(2, 2), metadata={"axes": "ZCYX", "spacing": 2, "unit": "mm"})
        self.write("do", "save s.ramus.json\n")
        self.expect_done("render", "a.tif", "--channel", "2", "--commands", "do", "--size", "64x64", "-o", "a.png")
        saved = json.loads((self.folder / "s.ramus.json").read_text())
        self.assertEqual(saved["reading"]["channel"], 2)
        self.expect_done("render", "--session", "s.ramus.json", "--size", "64x64", "-o", "b.png")
        self.write("scan", "scan a.tif --channel 2\nsave t.ramus.json\n")
        self.expect_done("render", "a.tif", "--channel", "2", "--commands", "scan", "--size", "64x64", "-o", "c.png")
        self.assertEqual(json.loads((self.folder / "t.ramus.json").read_text())["scans"][0]["channel"], 2)

    def test_memory(self):
        """A mask of 512 MB in chunks takes a small part of that."""
        array = zarr.open(str(self.folder / "large.zarr"), mode="w", shape=(512, 1024, 1024), chunks=(64, 128, 128), dtype="u1",
                          write_empty_chunks=False)
        array[100:400, 500:516, 500:516] = 1
        self.expect_done("skeletonize", "large.zarr", "-o", "t.swc", "--memory", "300M")

    def test_memory_of_a_scan(self):
        """Of a scan of 256 MB, only what is at least the isovalue takes memory."""
        shape = (128, 1024, 1024)
        values = np.random.default_rng(3).integers(100, 1000, shape, np.uint16)
        values[20:100, 500:516, 500:516] += 1000
        for name, kept in (("grey.zarr", values), ("mask.zarr", (values >= 1000).astype(np.uint8))):
            zarr.open(str(self.folder / name), mode="w", shape=shape, chunks=(16, 256, 256), dtype=kept.dtype, compressor=None)[:] = kept
        self.expect_done("skeletonize", "mask.zarr", "-o", "mask.swc")
        little = ("--isovalue", "1000", "--memory", "200M")
        self.expect_done("skeletonize", "grey.zarr", "-o", "grey.swc", *little)
        self.assertEqual(*([line for line in (self.folder / f"{name}.swc").read_text().splitlines()
                            if not line.startswith("#")] for name in ("mask", "grey")))
        self.expect_done("mesh", "grey.zarr", "-o", "grey.ply", *little)
        self.expect_failure("mesh", "grey.zarr", "--method", "iso", "-o", "iso.ply", *little, says=["grey.zarr", "MB of memory", "--memory"])


if __name__ == "__main__":
    if MISSING:
        print(f"SKIPPED: nothing to compare with ({MISSING}); Debian has python3-tifffile, python3-zarr, python3-pil and "
              "python3-nibabel")
    else:
        unittest.main()
