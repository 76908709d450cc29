"""Which format a file has: the same answer whatever the file is called, compressed or not, for every command."""

import gzip
import hashlib
import json
import os
import pathlib
import shutil
import struct
import unittest

from ramus import GOOD, CommandLineTest

CORPUS = pathlib.Path(__file__).resolve().parent.parent / "fuzz" / "corpus"
SHARED = pathlib.Path(os.environ.get("RAMUS_SHARED_DATA", ""))
LARGEST = 1_500_000  # bytes of a file of shared/data: larger ones take long
SMALL_TREE = 300_000  # of those one of each extension also goes through every command

TREES = ("am", "gxl", "graphml", "h5", "json", "mrk.json", "swc", "tre", "vmv", "vtk", "vtp", "vtu", "vvg")
PAIRS = ("csv",)
VOLUMES = ("dcm", "mha", "nii", "nrrd")
DETACHED = ("mhd", "nhdr")
MESHES = ("obj", "ply", "stl")
NO_MARK = ("swc", "stl", "obj")  # a name says more than the content of these

EVERY_COMMAND = 2  # files of a kind that go through every command; the others go through info alone

# Findings of the fuzzer that begin as nothing that a program writes: their names alone say what they are.
NAMELESS = {"obj/assimp-crash", "obj/material-of-itself", "tre/ends_at_points_place.tre",
            "tre/end_with_joined_ends.tre"}


class Recognition(CommandLineTest):
    def check_same(self, plain, extension, ask):
        """`ask(path)` answers alike of the file under its usual name, without an extension, and compressed."""
        usual = self.write("usual." + extension, plain)
        expected = ask(usual)
        usual.unlink()  # DICOM reads all images of a folder
        names = {"bare": plain, "packed." + extension + ".gz": gzip.compress(plain), "packed": gzip.compress(plain)}
        if extension not in NO_MARK:
            names["wrong.stl"] = plain
        for name, content in names.items():
            path = self.write(name, content)
            self.assertEqual(ask(path), expected, name)
            path.unlink()
        return expected

    def answer(self, path, *arguments, output=None):
        """Status, what was said but for the file's name, and what was written."""
        result = self.run_ramus(*arguments)
        said = (result.stdout + result.stderr).replace(str(path), "FILE").replace(path.name, "NAME")
        lines = [line for line in said.splitlines() if "seconds" not in line and " s" != line[-2:]]
        written = None
        if output is not None and (self.folder / output).exists():
            content = (self.folder / output).read_bytes().replace(path.name.encode(), b"NAME")
            written = hashlib.sha256(content).hexdigest()
            (self.folder / output).unlink()
        return result.returncode, lines, written

    def ask_tree(self, path):
        info = self.answer(path, "info", path, "--json")
        if info[0] != 0:
            return [info]
        return [info, self.answer(path, "convert", path, "-o", "out.vmv", output="out.vmv"),
                self.answer(path, "mesh", path, "-o", "out.ply", "--method", "cones", output="out.ply")]

    def ask_volume(self, path):
        info = self.answer(path, "info", path, "--json")
        if info[0] != 0:
            return [info]
        return [info, self.answer(path, "mesh", path, "-o", "out.ply", "--method", "iso", output="out.ply"),
                self.answer(path, "skeletonize", path, "-o", "out.vmv", output="out.vmv")]

    def ask_mesh(self, path):
        return [self.answer(path, "compare", path, path), self.answer(path, "info", path)]

    def corpus(self, kinds):
        for kind in kinds:
            for path in sorted((CORPUS / kind).iterdir()):
                if f"{kind}/{path.name}" not in NAMELESS:
                    yield kind, path

    def ask_info(self, path):
        return [self.answer(path, "info", path, "--json")]

    def check_corpus(self, kinds, ask):
        seen = dict.fromkeys(kinds, 0)
        for extension, path in self.corpus(kinds):
            with self.subTest(path=path):
                plain = path.read_bytes()
                plain = gzip.decompress(plain) if plain[:2] == b"\x1f\x8b" else plain
                answers = self.check_same(plain, extension, ask if seen[extension] < EVERY_COMMAND else self.ask_info)
                seen[extension] += len(answers) > 1  # a file that is refused has one answer

    def test_trees(self):
        self.check_corpus(TREES, self.ask_tree)

    def test_volumes(self):
        self.check_corpus(VOLUMES, self.ask_volume)

    def test_meshes(self):
        self.check_corpus(MESHES, self.ask_mesh)

    def test_headers_with_values_in_another_file(self):
        for extension, path in self.corpus(DETACHED):
            with self.subTest(path=path):
                header, values = path.read_bytes().split(b"====\n", 1)
                self.write("values.raw", values)
                self.check_same(header, extension, self.ask_volume)

    def test_pairs_of_tables(self):
        for _, path in self.corpus(PAIRS):
            with self.subTest(path=path):
                nodes, edges = path.read_bytes().split(b"====\n", 1)
                answers = []
                for ending, pack in ((".csv", bytes), ("", bytes), (".csv.gz", gzip.compress), (".gz", gzip.compress)):
                    files = {name: self.write(name + ending, pack(content))
                             for name, content in (("t_nodes", nodes), ("t_edges", edges))}
                    for file in files.values():
                        info = self.run_ramus("info", file, "--json")
                        self.assertEqual(info.returncode, 0, info.stderr)
                        report = json.loads(info.stdout)
                        answers.append([report[key] for key in ("branches", "segments", "roots", "loops", "length_mm")])
                    for file in files.values():
                        file.unlink()
                self.assertEqual(answers, answers[:1] * len(answers))

    def test_the_real_files(self):
        if not SHARED.is_dir():
            self.skipTest("SKIPPED: no shared/data")
        kinds = {**dict.fromkeys(TREES, "tree"), "xml": "tree", "nii": "volume", "nrrd": "volume", "mha": "volume",
                 "dcm": "volume", "stl": "mesh", "ply": "mesh"}
        seen = 0
        asked = set()
        for path in sorted(file for folder in ("formats", "reports", "trees", "volumes", "surfaces")
                           for file in (SHARED / folder).iterdir()):
            plain_name = path.name.removesuffix(".gz")
            extension = plain_name.split(".", 1)[1] if plain_name.endswith(".mrk.json") else plain_name.split(".")[-1]
            if path.stat().st_size > LARGEST or extension not in kinds:
                continue
            with self.subTest(path=path.name):
                plain = path.read_bytes()
                plain = gzip.decompress(plain) if path.name.endswith(".gz") else plain
                # One file of an extension goes through every command; the corpus has more of each.
                small = len(plain) < SMALL_TREE and extension not in asked
                asked.update([extension] if small else [])
                ask = {"tree": self.ask_tree if small else self.ask_info, "mesh": self.ask_mesh,
                       "volume": self.ask_volume if small else lambda file: [self.answer(file, "info", file)]}
                self.check_same(plain, extension, ask[kinds[extension]])
                seen += 1
        self.assertGreater(seen, 20)


class Kinds(CommandLineTest):
    """Files that begin as another format does."""

    def branches(self, path):
        report = self.json("info", path, "--json")
        return report["branches"], report["segments"]

    def test_a_tubetk_scene_is_not_an_image(self):
        tube = ("ObjectType = Tube\nNDims = 3\nID = {}\nParentID = {}\nRoot = {}\nPointDim = x y z r\nNPoints = 4\n"
                "Points = \n{}\n")
        rows = ["\n".join(f"{x} 0 {z + step} 1" for step in range(4)) for x, z in ((0, 0), (5, 9))]
        scene = (tube.format(1, -1, "True", rows[0]) + tube.format(2, -1, "True", rows[1]))
        # MetaIO's own order of the fields, that of TubeTK, and one that begins with the number of dimensions.
        for head in ("ObjectType = Scene\nNDims = 3\nNObjects = 2\n", "Comment = made\nObjectType = Scene\n",
                     "NDims = 3\nObjectType = Scene\nNObjects = 2\n"):
            for name in ("scene.tre", "scene", "scene.mha"):
                with self.subTest(head=head, name=name):
                    path = self.write(name, head + scene)
                    self.assertEqual(self.branches(path), (2, 6))
                    self.expect_done("mesh", path, "-o", "a.stl")
                    self.expect_done("convert", path, "-o", "a.vtp")
        image = self.write("image.tre", "ObjectType = Image\nNDims = 3\nDimSize = 2 2 2\nElementType = MET_UCHAR\n"
                           "ElementDataFile = LOCAL\n".encode() + bytes(8))
        self.assertEqual(self.json("info", image, "--json")["size"], [2, 2, 2])
        self.expect_failure("info", self.write("mark.mha", "ObjectType = Landmark\nNDims = 3\n"),
                            says=["mark.mha", "ElementDataFile"])

    def test_dicom_is_recognised_by_its_mark_after_any_preamble(self):
        plain = (CORPUS / "dcm" / "bits").read_bytes()
        self.assertEqual(plain[128:132], b"DICM")
        expected = None
        # Nothing, the size of the headers of ANALYZE and of NIfTI-2, and what TIFF begins with.
        for start in (b"", struct.pack("<i", 348), struct.pack(">i", 348), struct.pack("<i", 540), b"II*\0", b"solid "):
            with self.subTest(start):
                path = self.write("seg.dcm", start + plain[len(start):])
                report = self.json("info", path, "--json")
                report.pop("file", None)
                expected = expected or report
                self.assertEqual(report, expected)

    def test_the_content_takes_precedence_over_the_name(self):
        tree = self.write("tree.swc", GOOD)
        expected = self.branches(tree)
        for extension in ("vtp", "json", "vmv", "mrk.json", "graphml"):
            self.expect_done("convert", tree, "-o", "other." + extension)
            for name in ("a.nii", "a.stl", "a.swc", "a.dcm"):
                with self.subTest(extension=extension, name=name):
                    shutil.copy(self.folder / ("other." + extension), self.folder / name)
                    self.assertEqual(self.branches(self.folder / name), expected)
                    self.expect_done("mesh", name, "-o", "a.ply", "--method", "cones")
                    (self.folder / name).unlink()

    def test_the_name_takes_precedence_over_a_similarity(self):
        # The columns of a table of nodes look like those of SWC.
        table = self.write("tree.csv", "id type x y z radius parent\n1 2 0 0 0 1 -1\n")
        self.expect_failure("info", table, says=["tree.csv: the first line names neither"])

    def test_every_command_says_what_the_file_is(self):
        self.write("tree.swc", GOOD)
        self.expect_done("mesh", "tree.swc", "-o", "ball.ply", "--method", "cones")
        (self.folder / "ball.ply").rename(self.folder / "ball")
        for command in (["info", "ball"], ["convert", "ball", "-o", "a.swc"], ["render", "ball", "-o", "a.png"]):
            with self.subTest(command):
                self.expect_failure(*command, says=["this is a surface mesh, not a tree"])
        self.expect_failure("skeletonize", "ball", "-o", "a.swc", says=["where a segmentation mask is needed"])
        self.expect_done("compare", "ball", "tree.swc")
        self.expect_done("render", "tree.swc", "--context", "ball", "-o", "a.png", "--size", "80x60")


if __name__ == "__main__":
    unittest.main()
