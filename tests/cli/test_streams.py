"""Standard input and output: `-` as the input of every command that reads trees, masks and meshes, and as its output."""

import gzip
import json
import os
import signal
import struct
import subprocess
import time
import unittest

from nifti import nifti, voxels
from png import Picture
from ramus import GOOD, RAMUS, CommandLineTest

SIZE = ("--size", "96x64")
TABLES = {"nodes.csv": "id;pos_x;pos_y;pos_z;radius\n0;0;0;0;1\n1;0;0;9;1\n",
          "edges.csv": "id;node1id;node2id\n0;0;1\n"}


def tube_mask():
    size = (9, 9, 20)
    return nifti(size, [1 if (x - 4) ** 2 + (y - 4) ** 2 <= 9 else 0 for x, y, z in voxels(size)])


class Streams(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.temporary = self.folder / "tmp"
        self.temporary.mkdir()
        self.environment = {**os.environ, "TMPDIR": str(self.temporary)}

    def piped(self, content, *arguments, **options):
        """Runs with these bytes in a pipe; returns the result, whose standard output is bytes."""
        content = content if isinstance(content, bytes) else content.encode()
        result = subprocess.run([RAMUS, *map(str, arguments)], cwd=self.folder, input=content, capture_output=True,
                                env=self.environment, timeout=300, **options)
        self.assertEqual(list(self.temporary.iterdir()), [], "what is left behind")
        return result

    def passed(self, content, *arguments):
        result = self.piped(content, *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def refused(self, content, *arguments, says=(), status=1):
        result = self.piped(content, *arguments)
        self.assertEqual((result.returncode, result.stdout), (status, b""), result.stderr)
        for words in says:
            self.assertIn(words, result.stderr.decode())
        return result.stderr.decode()


class Input(Streams):
    def test_a_tree_of_any_format_is_recognised_by_its_bytes(self):
        self.write("tree.swc", GOOD)
        expected = self.json("info", "tree.swc", "--json")
        for extension in ("swc", "json", "vtp", "vmv", "mrk.json", "graphml"):
            self.expect_done("convert", "tree.swc", "-o", "out." + extension)
            plain = (self.folder / ("out." + extension)).read_bytes()
            for content in (plain, gzip.compress(plain)):
                for name in ("-", "/dev/stdin"):
                    found = json.loads(self.passed(content, "info", name, "--json"))
                    for key in ("branches", "segments", "length", "volume"):
                        self.assertAlmostEqual(found[key], expected[key], places=5, msg=extension)

    def test_results_are_the_same_as_from_a_file(self):
        self.write("tree.swc", GOOD)
        self.expect_done("mesh", "tree.swc", "-o", "file.ply")
        self.passed(GOOD, "mesh", "-", "-o", "pipe.ply")
        self.assertEqual((self.folder / "pipe.ply").read_bytes(), (self.folder / "file.ply").read_bytes())
        self.expect_done("convert", "tree.swc", "-o", "file.vtp")
        self.passed(GOOD, "convert", "-", "-o", "pipe.vtp")
        points = [(self.folder / name).read_bytes().split(b"<Points>")[1].split(b"</Points>")[0]
                  for name in ("file.vtp", "pipe.vtp")]
        self.assertEqual(*points)
        self.passed(GOOD, "render", "-", "-o", "pipe.png", *SIZE)
        self.expect_done("render", "tree.swc", "-o", "file.png", "--reference", "pipe.png", "--tolerance", "0", *SIZE)
        text = self.passed(GOOD, "info", "-").decode()
        self.assertEqual(text.splitlines()[0], "standard input")
        self.assertIn("source: standard input", self.passed(GOOD, "convert", "-", "-o", "-", "--format", "swc").decode())

    def test_masks_and_meshes(self):
        mask = tube_mask()
        self.write("mask.nii", mask)
        self.write("tree.swc", GOOD)
        self.expect_done("mesh", "tree.swc", "-o", "mesh.stl")
        mesh = (self.folder / "mesh.stl").read_bytes()
        for content in (mask, gzip.compress(mask)):
            self.assertEqual(json.loads(self.passed(content, "info", "-", "--json"))["size"], [9, 9, 20])
            self.assertGreaterEqual(json.loads(self.passed(content, "skeletonize", "-", "-o", "a.swc", "--json"))["branches"], 1)
            self.passed(content, "mesh", "-", "--method", "iso", "-o", "iso.stl")
        found = json.loads(self.passed(mesh, "compare", "-", "mesh.stl", "--json"))
        self.assertEqual((found["a"]["file"], found["hausdorff"]), ("standard input", 0))
        found = json.loads(self.passed(mesh, "validate", "tree.swc", "--surface", "-", "--json"))
        self.assertEqual(found["surface"], "standard input")
        self.passed(mask, "paper", "--tree", "a.swc", "--mask", "-", "-o", "paper", "--figures", "10")
        found = json.loads(self.passed(mask, "validate", "tree.swc", "--mask", "/dev/stdin", "--json"))
        self.assertGreater(found["volumes"]["mask_mm3"], 0)
        self.passed(mesh, "render", "tree.swc", "--context", "-", "-o", "context.png", *SIZE)

    def test_a_file_behind_standard_input_is_read_in_its_place_and_kept(self):
        self.write("tree.swc", GOOD)
        with open(self.folder / "tree.swc", "rb") as file:
            done = self.expect_done("info", "-", "--json", stdin=file)
        self.assertEqual(json.loads(done.stdout)["branches"], 3)
        with open(self.folder / "tree.swc", "rb") as file:
            self.expect_failure("convert", "-", "-o", "tree.swc", stdin=file, says=["would be lost"])
        self.assertEqual((self.folder / "tree.swc").read_text(), GOOD)

    def test_messages_name_standard_input(self):
        bad = GOOD.replace("0.9 2", "oops 2")
        for arguments in (["info", "-"], ["mesh", "-", "-o", "a.stl"], ["convert", "-", "-o", "a.swc"],
                          ["render", "-", "-o", "a.png"], ["validate", "/dev/fd/0"]):
            said = self.refused(bad, *arguments, says=["standard input:3: the radius"])
            self.assertNotIn("/dev", said)
        self.refused(b"", "info", "-", says=["standard input: is empty"])
        self.refused("neither this nor that\n" * 9, "info", "-", says=["standard input: its format is not recognised"])
        self.refused(gzip.compress(GOOD.encode())[:40], "info", "-", says=["standard input"])
        self.refused(tube_mask()[:500], "info", "-", says=["standard input: "])
        self.refused(GOOD, "skeletonize", "-", "-o", "a.swc", says=["standard input: "])
        self.assertNotIn("a.swc", self.names())

    def test_formats_of_several_files_cannot_be_piped(self):
        for name, content in TABLES.items():
            self.write(name, content)
            self.refused(content, "info", "-", says=["standard input", "stands in another file", "name its file"])
        header = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\ndata file: values.raw\n\n"
        self.write("values.raw", bytes(8))
        self.refused(header, "info", "-", says=["standard input", "in another file, values.raw"])
        self.write("c.txt", "save s.ramus.json\n")
        self.refused(GOOD, "render", "-", "-o", "a.png", "--commands", "c.txt", *SIZE, says=["standard input", "session"])
        self.assertNotIn("s.ramus.json", self.names())

    def test_one_input_only(self):
        self.write("tree.swc", GOOD)
        for arguments in (["compare", "-", "-"], ["validate", "-", "/dev/stdin"], ["validate", "-", "--mask", "-"],
                          ["paper", "-o", "p", "--tree", "-", "--mask", "-"],
                          ["info", "-", "tree.swc", "/dev/fd/0"]):
            self.refused(GOOD, *arguments, status=2, says=["standard input can be one input only"])
        self.refused(GOOD, "mesh", "--session", "-", "-o", "a.stl", says=["only for trees, masks and meshes"])
        self.refused(GOOD, "-", status=2, says=["the window opens files"])

    def test_missing_standard_input(self):
        closed = subprocess.run(["sh", "-c", f"exec {RAMUS} info - <&-"], capture_output=True, text=True, timeout=60)
        self.assertEqual(closed.returncode, 1)
        self.assertIn("standard input: is closed", closed.stderr)

    def test_a_terminal_is_waited_for(self):
        main, side = self.terminal()
        process = subprocess.Popen([RAMUS, "info", "-"], stdin=side, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   env=self.environment)
        os.close(side)
        self.assertIn(b"waiting for standard input", process.stderr.readline())
        os.write(main, GOOD.encode() + b"\x04")
        output, _ = process.communicate(timeout=60)
        os.close(main)
        self.assertEqual(process.returncode, 0)
        self.assertIn(b"branches      3", output)

    def test_an_interrupt_while_it_waits_leaves_nothing(self):
        process = subprocess.Popen([RAMUS, "info", "-"], stdin=subprocess.PIPE, stderr=subprocess.PIPE,
                                   env=self.environment)
        process.stdin.write(GOOD.encode())
        process.stdin.flush()
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, -signal.SIGINT)
        self.assertEqual(list(self.temporary.iterdir()), [])

    def test_a_full_disk(self):
        big = "1 2 0 0 0 1 -1\n" + "".join(f"{i} 2 0 0 {i} 1 {i - 1}\n" for i in range(2, 40_000))
        result = subprocess.run(["sh", "-c", f"ulimit -f 100; exec {RAMUS} info -"], input=big.encode(),
                                capture_output=True, env=self.environment, timeout=60)
        self.assertEqual(result.returncode, 1)
        self.assertIn(b"standard input: has no room in", result.stderr)
        self.assertIn(b"TMPDIR", result.stderr)


class Output(Streams):
    def test_every_format_has_the_same_bytes_as_a_file(self):
        self.write("tree.swc", GOOD)
        for extension in ("swc", "json", "vtp", "vmv", "mrk.json", "graphml"):
            self.expect_done("convert", "tree.swc", "-o", "file." + extension)
            for word in (extension, "." + extension):
                self.assertEqual(self.passed(b"", "convert", "tree.swc", "-o", "-", "--format", word),
                                 (self.folder / ("file." + extension)).read_bytes(), extension)
        for extension in ("ply", "stl", "obj", "vtp", "glb"):
            self.expect_done("mesh", "tree.swc", "-o", "file." + extension)
            result = self.piped(b"", "mesh", "tree.swc", "-o", "-", "--format", extension)
            self.assertEqual(result.stdout, (self.folder / ("file." + extension)).read_bytes(), extension)
            self.assertIn("standard output: ", result.stderr.decode())
        self.expect_done("render", "tree.swc", "-o", "file.png", *SIZE)
        picture = self.passed(b"", "render", "tree.swc", "-o", "-", *SIZE)
        self.assertEqual(Picture(picture).part(0, 0, 96, 64), Picture((self.folder / "file.png").read_bytes()).part(0, 0, 96, 64))
        self.assertEqual(self.passed(b"", "grow", "--branches", "5", "-o", "/dev/stdout", "--format", "swc").count(b"grow"), 1)
        mask = self.write("mask.nii", tube_mask())
        self.assertIn(b"standard output", self.piped(b"", "skeletonize", mask, "-o", "-", "--format", "swc").stderr)

    def test_pipe_between_two_commands(self):
        stl = self.passed(gzip.compress(GOOD.encode()), "mesh", "-", "-o", "-", "--format", "stl")
        self.assertEqual(len(stl), 84 + 50 * struct.unpack_from("<I", stl, 80)[0])
        found = json.loads(self.passed(stl, "compare", "-", self.write("tree.swc", GOOD), "--json"))
        self.assertLess(found["hausdorff"], 1e-5)

    def test_wrong_usage(self):
        self.write("tree.swc", GOOD)
        mesh = ["mesh", "tree.swc", "-o"]
        for arguments, words in (([*mesh, "-"], "--format"), ([*mesh, "-", "--format", "xyz"], "xyz is not .ply"),
                                 ([*mesh, "a.stl", "--format", "stl"], "only with -o -"),
                                 ([*mesh, "-", "--format", "stl", "--json"], "--json"),
                                 (["convert", "tree.swc", "-o", "-", "--format", "csv"], "csv is not"),
                                 (["render", "tree.swc", "-o", "-", "--json"], "--json"),
                                 (["render", "tree.swc", "-o", "-", "--turntable", "3"], "--turntable")):
            self.refused(b"", *arguments, status=2, says=[words])
        self.assertEqual([name for name in self.names() if name != "tmp"], ["tree.swc"])

    def test_a_terminal_gets_no_bytes(self):
        self.write("tree.swc", GOOD)
        main, side = self.terminal()
        result = subprocess.run([RAMUS, "mesh", "tree.swc", "-o", "-", "--format", "stl"], cwd=self.folder, stdout=side,
                                stderr=subprocess.PIPE, text=True, timeout=60)
        os.close(side)
        os.close(main)
        self.assertEqual(result.returncode, 1)
        self.assertIn("standard output: is a terminal", result.stderr)

    def test_a_closed_pipe_leaves_nothing(self):
        self.write("tree.swc", GOOD)
        for arguments in (["mesh", "tree.swc", "--detail", "64", "-o", "-", "--format", "stl"],
                          ["info", "tree.swc", "--branches", "--json"]):
            reading, writing = os.pipe()
            os.close(reading)
            process = subprocess.Popen([RAMUS, *arguments], cwd=self.folder, stdout=writing, stderr=subprocess.PIPE,
                                       env=self.environment)
            os.close(writing)
            _, said = process.communicate(timeout=60)
            self.assertIn(process.returncode, (-signal.SIGPIPE, 1))
            self.assertNotIn(b"rror", said)
            self.assertEqual(list(self.temporary.iterdir()), [])

    def test_a_failure_writes_nothing(self):
        self.assertEqual(self.refused(GOOD.replace("0.9", "x"), "mesh", "-", "-o", "-", "--format", "stl").count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
