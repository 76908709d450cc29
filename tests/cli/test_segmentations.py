"""Segmentations: lists of named segments that may overlap, in DICOM and NRRD, and names of labels next to a mask."""

import gzip
import json
import os
import pathlib
import struct
import unittest

from nifti import nifti, voxels
from ramus import GOOD, CommandLineTest
from segmentations import dicom_seg, seg_nrrd

SHARED = pathlib.Path(os.environ.get("RAMUS_SHARED_DATA", "")) / "reports"
SIZE = (24, 9, 8)
ALL = list(voxels(SIZE))


def box(low, high):
    return {at for at in ALL if all(a <= b < c for a, b, c in zip(low, at, high))}


# A vessel in an organ, and a lesion that reaches into both: some voxels are in all three.
ORGAN, VESSEL, LESION = box((2, 1, 1), (22, 8, 7)), box((1, 3, 3), (23, 6, 5)), box((8, 2, 2), (12, 5, 8))
# L*a*b* of sRGB red and of (0, 151, 206) under D50, as LittleCMS has them, in DICOM's 16 bits.
RED, BLUE = [35580, 53664, 50856], [37989, 27961, 23038]


def frames_of(number, segment, one=1):
    """Those slices that have a voxel, as programs write them."""
    for z in range(SIZE[2]):
        values = [one * ((x, y, z) in segment) for y in range(SIZE[1]) for x in range(SIZE[0])]
        if any(values):
            yield number, z, values


def layer(*segments):
    return [next((value for value, segment in segments if at in segment), 0) for at in ALL]


def slicer(n, name, value, of_layer=0, colour="1 0 0"):
    return [f"Segment{n}_ID:=Segment_{n}", f"Segment{n}_Name:={name}", f"Segment{n}_LabelValue:={value}",
            f"Segment{n}_Layer:={of_layer}", f"Segment{n}_Color:={colour}"]


class Segmentations(CommandLineTest):
    def dicom(self, name="seg.dcm"):
        """Numbers with gaps, a segment without voxels, and one whose colour the file does not give."""
        frames = [*frames_of(1, ORGAN), *frames_of(300, LESION), *frames_of(5, VESSEL)]
        return self.write(name, dicom_seg(SIZE, {1: ("liver", RED), 5: ("portal vein", BLUE), 300: ("lesion", None),
                                                 7: ("thrombus", None)}, frames))

    def layers(self, name="layers.seg.nrrd", **how):
        fields = slicer(0, "liver", 1) + slicer(1, "portal vein", 1, 1, "0 0.6 1") + slicer(2, "lesion", 2, 2)
        return self.write(name, seg_nrrd(SIZE, [layer((1, ORGAN)), layer((1, VESSEL)), layer((2, LESION))], fields,
                                         **how))

    def counts(self, path):
        report = self.json("info", path, "--json")
        return ({each["label"]: (each["voxels"], each.get("name")) for each in report["labels"]},
                {tuple(each["labels"]): each["voxels"] for each in report.get("overlaps", [])})

    def assert_surface(self, path, label, segment, mirrored=False):
        """The surface of a label is that of a mask which has nothing else."""
        rows = ((-1, 0, 0, 0), (0, -1, 0, 0), (0, 0, 1, 0)) if mirrored else ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0))
        self.write("alone.nii", nifti(SIZE, [int(at in segment) for at in ALL], rows=rows))
        self.expect_done("mesh", "alone.nii", "--method", "iso", "-o", "alone.stl")
        self.expect_done("mesh", path, "--method", "iso", "--label", label, "-o", "label.stl")
        self.assertEqual((self.folder / "label.stl").read_bytes()[80:], (self.folder / "alone.stl").read_bytes()[80:])

    def test_segments_of_dicom_overlap(self):
        path = self.dicom()
        labels, overlaps = self.counts(path)
        self.assertEqual(labels, {1: (len(ORGAN), "liver"), 5: (len(VESSEL), "portal vein"), 7: (0, "thrombus"),
                                  300: (len(LESION), "lesion")})
        self.assertEqual(overlaps, {(1, 5): len(ORGAN & VESSEL), (1, 300): len(ORGAN & LESION),
                                    (5, 300): len(VESSEL & LESION)})
        self.assertTrue(ORGAN & VESSEL & LESION)
        report = self.json("info", path, "--json")
        self.assertEqual([each.get("colour") for each in report["labels"]], ["#ff0000", "#0097ce", None, None])
        self.assertEqual(report["values"], {"min": 0, "max": 300})
        text = self.expect_done("info", path).stdout
        self.assertIn(f"labels 1 and 5 share {len(ORGAN & VESSEL)} voxels", text)
        self.assertIn("label 7       0 voxels, 0 ml, thrombus", text)
        for label, segment in (("1", ORGAN), ("liver", ORGAN), ("portal_vein", VESSEL), ("5", VESSEL),
                               ("LESION", LESION), ("portal vein,300", VESSEL | LESION)):
            with self.subTest(label):
                self.assert_surface(path, label, segment, mirrored=True)
        self.expect_done("mesh", path, "--method", "iso", "-o", "all.stl")

    def test_names_are_checked(self):
        path = self.dicom()
        mesh = ("mesh", path, "--method", "iso", "-o", "a.stl", "--label")
        self.expect_failure(*mesh, "spleen", says=["seg.dcm", 'no label is called "spleen"', "liver (1)",
                                                   "portal vein (5)", "thrombus (7)"])
        self.expect_failure(*mesh, "thrombus", says=["thrombus", "has no voxels"])
        self.expect_failure(*mesh, "9", says=["no voxel has label 9"])
        self.expect_failure(*mesh, "1,,2", status=2, says=["numbers other than 0 and names"])
        self.expect_failure(*mesh[:-1], "--isovalue", "2", says=["overlap", "choose labels"])
        twins = self.write("twins.dcm", dicom_seg(SIZE, {1: ("vein", None), 2: ("vein", None)},
                                                  [*frames_of(1, VESSEL), *frames_of(2, LESION)]))
        self.expect_failure("mesh", twins, "--method", "iso", "-o", "a.stl", "--label", "vein",
                            says=['several labels are called "vein": 1, 2', "number"])
        self.write("plain.nii", nifti(SIZE, [int(at in VESSEL) for at in ALL]))
        self.expect_failure("mesh", "plain.nii", "--method", "iso", "-o", "a.stl", "--label", "vein",
                            says=["its labels have no names"])
        # A name that looks like a list, like a number, and one that would steer a terminal.
        odd = self.write("odd.dcm", dicom_seg(SIZE, {1: ("vein, left", None), 2: ("1", None), 3: ("a\x1b[31m", None)},
                                              [*frames_of(1, VESSEL), *frames_of(2, LESION), *frames_of(3, ORGAN)]))
        self.assert_surface(odd, '"vein, left"', VESSEL, mirrored=True)
        self.assert_surface(odd, '"1"', LESION, mirrored=True)
        self.assertNotIn("\x1b", self.expect_done("info", odd).stdout)

    def test_fractions_of_dicom_overlap(self):
        path = self.write("f.dcm", dicom_seg(
            SIZE, {1: ("liver", None), 2: ("vein", None)},
            [*frames_of(1, ORGAN, 50), *frames_of(2, VESSEL, 100), *frames_of(2, LESION - VESSEL, 49)], "FRACTIONAL"))
        labels, overlaps = self.counts(path)
        self.assertEqual(labels, {1: (len(ORGAN), "liver"), 2: (len(VESSEL), "vein")})
        self.assertEqual(overlaps, {(1, 2): len(ORGAN & VESSEL)})

    def test_each_segment_becomes_a_system(self):
        for path in (self.dicom(), self.layers()):
            with self.subTest(path.name):
                self.expect_done("skeletonize", path, "-o", "t.json", "--label", "portal_vein,lesion")
                systems = self.json("info", "t.json", "--json")["system_list"]
                self.assertEqual([each["name"] for each in systems], ["portal vein", "lesion"])
                self.assertEqual(systems[0]["colour"], "#0097ce" if path.suffix == ".dcm" else "#0099ff")
                self.expect_done("skeletonize", path, "-o", "all.json", "--label", "all")
                self.assertEqual(len(self.json("info", "all.json", "--json")["systems"]), 3)
                self.expect_done("convert", path, "--labels", "liver+lesion,portal_vein", "-o", "two.json")
                self.assertEqual(self.json("info", "two.json", "--json")["systems"], ["liver + lesion", "portal vein"])
                self.expect_failure("convert", path, "--labels", "aorta", "-o", "x.json", says=["portal vein"])

    def test_layers_of_nrrd(self):
        for space, mirrored in (("left-posterior-superior", True), ("right-anterior-superior", False)):
            for encoding in ("gzip", "raw", "text"):
                for type_of in ("uint8", "int16"):
                    with self.subTest(space=space, encoding=encoding, type_of=type_of):
                        path = self.layers(encoding=encoding, space=space, type_of=type_of)
                        labels, overlaps = self.counts(path)
                        self.assertEqual(labels, {1: (len(ORGAN), "liver"), 2: (len(VESSEL), "portal vein"),
                                                  3: (len(LESION), "lesion")})
                        self.assertEqual(overlaps[1, 2], len(ORGAN & VESSEL))
            self.assert_surface(path, "portal vein", VESSEL, mirrored)
        self.assertIn("numbered in the order of the file", self.json("info", path, "--json")["notes"][0])

    def test_values_of_layers_that_differ_are_labels(self):
        vein = VESSEL - LESION
        fields = slicer(0, "lesion", 2) + slicer(1, "vein", 4) + slicer(2, "liver", 9, 1)
        path = self.write("a.seg.nrrd", seg_nrrd(SIZE, [layer((2, LESION), (4, vein)), layer((9, ORGAN))], fields))
        labels, overlaps = self.counts(path)
        self.assertEqual(labels, {2: (len(LESION), "lesion"), 4: (len(vein), "vein"), 9: (len(ORGAN), "liver")})
        self.assertEqual(overlaps, {(2, 9): len(LESION & ORGAN), (4, 9): len(vein & ORGAN)})
        # Values that no segment has stay visible.
        path = self.write("b.seg.nrrd", seg_nrrd(SIZE, [layer((2, LESION), (77, vein)), layer((9, ORGAN))],
                                                 slicer(0, "lesion", 2) + slicer(1, "liver", 9, 1)))
        self.assertEqual(self.counts(path)[0],
                         {2: (len(LESION), "lesion"), 9: (len(ORGAN), "liver"), 10: (len(vein), None)})

    def test_nrrd_with_one_layer(self):
        path = self.write("one.seg.nrrd", seg_nrrd(SIZE, [layer((3, VESSEL))], slicer(0, "vein", 3) +
                                                   slicer(1, "empty", 4)))
        self.assertEqual(self.counts(path), ({3: (len(VESSEL), "vein"), 4: (0, "empty")}, {}))
        # Not a segmentation: two values of each voxel, or two volumes.
        values = [layer((1, ORGAN)), layer((1, VESSEL))]
        self.expect_failure("info", self.write("dwi.nrrd", seg_nrrd(SIZE, values, [])),
                            says=["each of its voxels holds 2 values"])
        self.expect_failure("info", self.write("f.seg.nrrd", seg_nrrd(SIZE, values, slicer(0, "a", 1), type_of="float")),
                            says=['the field "type"'])

    def test_claims_are_checked(self):
        layers = [layer((1, ORGAN)), layer((1, VESSEL))]
        good = seg_nrrd(SIZE, layers, slicer(0, "a", 1) + slicer(1, "b", 1, 1), encoding="raw")
        self.expect_failure("info", self.write("cut.seg.nrrd", good[:-10]), says=["more than the file can hold"])
        for sizes in (b"sizes: 4096 2000000 2000000 2000000", b"sizes: 999999999999 24 9 8", b"sizes: 5000 24 9 8"):
            with self.subTest(sizes):
                self.expect_failure("info", self.write("big.seg.nrrd", good.replace(b"sizes: 2 24 9 8", sizes)),
                                    says=["big.seg.nrrd"])
        negative = [[-1 if value else 0 for value in layers[0]], layers[1]]
        self.expect_failure("info", self.write("n.seg.nrrd", seg_nrrd(SIZE, negative, slicer(0, "a", 1),
                                                                     type_of="int16")), says=["negative numbers"])
        many = [[1] * len(ALL)] * 65
        self.expect_failure("info", self.write("m.seg.nrrd", seg_nrrd(SIZE, many, slicer(0, "a", 1))),
                            says=["more than 64", "share a voxel"])
        values = [list(range(len(ALL))), [0] * len(ALL)]
        self.expect_failure("info", self.write("v.seg.nrrd", seg_nrrd(SIZE, values, slicer(0, "a", 1), type_of="int16")),
                            says=["more than 1024 values"])
        thirteen = [[n >> bit & 1 for n in range(8192)] for bit in range(13)]
        self.expect_failure("info", self.write("w.seg.nrrd", seg_nrrd((64, 16, 8), thirteen, slicer(0, "a", 1))),
                            says=["more than 4096 different ways"])

    def test_contexts_and_comparisons_take_names(self):
        tree, path = self.write("tree.swc", GOOD), self.layers(space="right-anterior-superior")
        script = 'context layers.seg.nrrd --label "portal vein",3\ncompare-mask layers.seg.nrrd "portal vein",lesion\n'
        self.write("c.txt", script + "save s.json\n")
        self.expect_done("render", tree, "-o", "a.png", "--size", "80x60", "--commands", "c.txt")
        session = json.loads((self.folder / "s.json").read_text())
        self.assertEqual([(each["label"], each["colour"]) for each in session["context"]],
                         [("portal vein", "#0099ff"), (3, "#ff0000")])
        self.assertEqual(session["comparison"]["labels"], ["lesion", "portal vein"])
        self.expect_done("render", "--session", "s.json", "-o", "b.png", "--size", "80x60", "--reference", "a.png",
                         "--tolerance", "0")
        self.write("all.txt", "context layers.seg.nrrd --label all\nsave all.json\n")
        self.expect_done("render", tree, "-o", "a.png", "--size", "80x60", "--commands", "all.txt")
        session = json.loads((self.folder / "all.json").read_text())
        self.assertEqual([each["label"] for each in session["context"]], [1, 2, 3])
        self.write("no.txt", "context layers.seg.nrrd --label aorta\n")
        result = self.run_ramus("render", tree, "-o", "a.png", "--size", "80x60", "--commands", "no.txt")
        self.assertEqual(result.returncode, 1)
        self.assertIn("portal vein (2)", result.stderr)
        self.expect_done("skeletonize", path, "-o", "near.json", "--label", "portal vein")
        self.expect_done("render", "near.json", "-o", "c.png", "--size", "80x60", "--compare", "side-by-side", "--methods",
                         "cs,iso", "--mask", path, "--label", "portal_vein")
        self.assertTrue(json.loads(self.expect_done("validate", "near.json", "--mask", path, "--label", "portal vein",
                                                    "--json").stdout))

    def test_files_of_other_programs(self):
        if not SHARED.is_dir():
            self.skipTest("SKIPPED: no shared/data")
        labels, overlaps = self.counts(SHARED / "seg_vessel_in_organ.dcm")
        self.assertEqual(sorted(voxel for voxel, _ in labels.values()), [322, 6340])
        self.assertEqual(list(overlaps.values()), [322])
        labels, _ = self.counts(SHARED / "layers_shared.seg.nrrd")
        self.assertEqual([name for _, name in labels.values()], ["artery", "vein"])
        labels, _ = self.counts(SHARED / "label_names.nii.gz")
        self.assertEqual({label: name for label, (_, name) in labels.items()}, {1: "true lumen", 2: "false lumen"})


TABLE = ('<?xml version="1.0" encoding="UTF-8"?><CaretExtension><VolumeInformation Index="0"><LabelTable>'
         '<Label Key="0" Red="0" Green="0" Blue="0" Alpha="0"><![CDATA[background]]></Label>'
         '<Label Key="1" Red="1" Green="0" Blue="0" Alpha="1"><![CDATA[true lumen]]></Label>'
         '<Label Key="2" Red="0.2" Green="0.4" Blue="1" Alpha="1">false &amp; lumen</Label>'
         '</LabelTable></VolumeInformation></CaretExtension>').encode()

SNAP = """################################################
# ITK-SnAP Label Description File
# File format:
# IDX   -R-  -G-  -B-  -A--  VIS MSH  LABEL
################################################
    0     0    0    0        0  0  0    "Clear Label"
    1   255    0    0        1  1  1    "true lumen"
    2    51  102  255        1  1  1    "false & lumen"
"""


class Names(CommandLineTest):
    values = layer((1, VESSEL), (2, LESION))

    def named(self, path):
        report = self.json("info", path, "--json")
        self.notes = report["notes"]
        return [(each["label"], each.get("name"), each.get("colour")) for each in report["labels"]]

    EXPECTED = [(1, "true lumen", "#ff0000"), (2, "false & lumen", "#3366ff")]
    NONE = [(1, None, None), (2, None, None)]

    def mask(self, *extensions, order="<", version=1, flag=1):
        """A NIfTI file whose header has these extensions: (code, bytes), or bytes as they are."""
        plain = nifti(SIZE, self.values, "h", order=order)
        region = bytes([flag, 0, 0, 0])
        for extension in extensions:
            if isinstance(extension, bytes):
                region += extension
                continue
            code, content = extension
            content += bytes(-(len(content) + 8) % 16)
            region += struct.pack(order + "ii", len(content) + 8, code) + content
        if version == 1:
            head = bytearray(plain[:348])
            struct.pack_into(order + "f", head, 108, 348 + len(region))
        else:
            head = bytearray(540)
            struct.pack_into(order + "i8shh8q", head, 0, 540, b"n+2\0\r\n\x1a\n", 4, 16, 3, *SIZE, 1, 1, 1, 1)
            struct.pack_into(order + "8d", head, 104, 1, 1, 1, 1, 1, 1, 1, 1)
            struct.pack_into(order + "q", head, 168, 540 + len(region))
            struct.pack_into(order + "ii", head, 344, 0, 1)
            for n in range(3):
                struct.pack_into(order + "4d", head, 400 + 32 * n, *[float(n == i) for i in range(4)])
            struct.pack_into(order + "i", head, 500, 2)
        return bytes(head) + region + plain[352:]

    def test_label_tables_of_nifti(self):
        for order in "<>":
            for version in (1, 2):
                for code in (0, 30):
                    for before in ((), ((6, b"a comment"), (4, b"<not/><xml"))):
                        with self.subTest(order=order, version=version, code=code, before=before):
                            content = self.mask(*before, (code, TABLE), (6, b"more"), order=order, version=version)
                            self.assertEqual(self.named(self.write("a.nii", content)), self.EXPECTED)
                            self.assertIn("the names of labels are those of its header's extension", self.notes)
                            self.assertEqual(self.named(self.write("b.nii.gz", gzip.compress(content))), self.EXPECTED)

    def test_damaged_extensions_do_not_affect_the_voxels(self):
        damaged = "an extension of its header is damaged, and was left out"
        for extension, note in (((0, TABLE[:200]), "the names of labels in its header's extension are damaged, and "
                                 "were left out"),
                                (struct.pack("<ii", 1 << 30, 0) + bytes(16), damaged),
                                (struct.pack("<ii", -16, 0) + bytes(16), damaged),
                                (struct.pack("<ii", 4, 0) + bytes(16), damaged), (bytes(24), None),
                                ((0, b"<LabelTable>" + b"<a>" * 300000), "the names of labels in its header's "
                                 "extension are damaged, and were left out"), (bytes(20 << 20), None)):
            with self.subTest(extension=extension[:40]):
                self.assertEqual(self.named(self.write("a.nii", self.mask(extension))), self.NONE)
                self.assertEqual(note in self.notes, note is not None)
        self.assertEqual(self.named(self.write("a.nii", self.mask((0, TABLE), flag=0))), self.NONE)
        # Here the voxels themselves are not where the header has them.
        content = bytearray(self.mask((0, TABLE)))
        struct.pack_into("<f", content, 108, 1e12)
        self.expect_failure("info", self.write("a.nii", bytes(content)), says=["more than the file can hold"])

    def test_label_descriptions_next_to_the_mask(self):
        content = nifti(SIZE, self.values)
        for mask in ("liver.nii", "liver.nii.gz"):
            self.write(mask, gzip.compress(content) if mask.endswith("gz") else content)
            for name in ("liver.label", "liver.txt", "liver_labels.txt", "liver-labels.label"):
                with self.subTest(mask=mask, name=name):
                    path = self.write(name, SNAP)
                    self.assertEqual(self.named(mask), self.EXPECTED)
                    self.assertIn(f"the names of labels are those of {name}, next to the mask", self.notes)
                    path.unlink()
                    self.assertEqual(self.named(mask), self.NONE)
        table = self.write("liver.ctbl", "# Color table file liver.ctbl\n# 3 values\n0 background 0 0 0 0\n"
                           "1 true lumen 255 0 0 255\n2 false & lumen 51 102 255 255\n")
        self.assertEqual(self.named("liver.nii"), self.EXPECTED)
        table.unlink()
        # Other texts of that name, and what is none.
        for text in ("", "# nothing\n", "The liver of the patient\n", SNAP + "and more\n", "1 2 3\n4 5 6\n",
                     SNAP.replace("255", "256"), "1 1 1 1 1 1 \"\n", b"\xff\xfe\0\0", SNAP + " " * (2 << 20)):
            with self.subTest(text=text[:40]):
                self.write("liver.txt", text)
                self.assertEqual(self.named("liver.nii"), self.NONE)
        (self.folder / "liver.txt").unlink()
        os.mkfifo(self.folder / "liver.txt")
        self.assertEqual(self.named("liver.nii"), self.NONE)

    def test_named_labels_are_chosen_and_become_systems(self):
        self.write("m.nii", nifti(SIZE, self.values))
        self.write("m.label", SNAP)
        self.expect_done("skeletonize", "m.nii", "-o", "t.json", "--label", "all")
        systems = self.json("info", "t.json", "--json")["system_list"]
        self.assertEqual([(each["name"], each["colour"]) for each in systems],
                         [("true lumen", "#ff0000"), ("false & lumen", "#3366ff")])
        one = self.json("mesh", "m.nii", "--method", "iso", "-o", "a.stl", "--label", "TRUE_LUMEN", "--json")
        self.assertEqual(one["triangles"],
                         self.json("mesh", "m.nii", "--method", "iso", "-o", "b.stl", "--label", "1",
                                   "--json")["triangles"])
        self.expect_failure("mesh", "m.nii", "--method", "iso", "-o", "a.stl", "--label", "lumen",
                            says=["true lumen (1), false & lumen (2)"])


if __name__ == "__main__":
    unittest.main()
