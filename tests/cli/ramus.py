"""Drives the built program for the tests of its command line. The binary comes from the environment (RAMUS), as ctest sets it."""

import json
import os
import pathlib
import pty
import resource
import subprocess
import tempfile
import unittest

RAMUS = os.environ.get("RAMUS", "ramus")

# Bytes that a process of this build has besides ramus's own: a sanitizer's tables and the code that it adds. 155 MiB are
# there before a command begins, and 209 MiB when a surface of 7 million triangles is streamed.
SANITIZER_MEMORY = 224 << 20 if os.environ.get("RAMUS_SANITIZED") == "ON" else 0

# A stem that forks: two branches hang on it.
GOOD = """1 2 0 0 0 1.0 -1
2 2 0 0 5 1.0 1
3 2 0 0 10 0.9 2
4 2 3 0 15 0.6 3
5 2 -3 0 15 0.7 3
"""

# One thick, long tube: a second of work and millions of triangles at --detail 512.
TUBE = "1 0 0 0 0 1 -1\n2 0 0 0 100 1 1\n"


class CommandLineTest(unittest.TestCase):
    """Every test has a folder of its own and works in it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="ramus-cli-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def run_ramus(self, *arguments, largest_file=None, **options):
        """Runs to the end; `largest_file` is what `ulimit -f` would set, in bytes."""

        def limit():
            if largest_file is not None:
                resource.setrlimit(resource.RLIMIT_FSIZE, (largest_file, largest_file))

        options.setdefault("stdout", subprocess.PIPE)
        return subprocess.run(
            [RAMUS, *map(str, arguments)], cwd=self.folder, stderr=subprocess.PIPE, text=True,
            errors="replace", timeout=300, preexec_fn=limit, **options)

    def expect_done(self, *arguments, **options):
        result = self.run_ramus(*arguments, **options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def expect_failure(self, *arguments, says=(), status=1, **options):
        """Fails with one line on standard error that holds all of `says`, and with nothing on standard output."""
        result = self.run_ramus(*arguments, **options)
        self.assertEqual(result.returncode, status, result.stderr)
        if result.stdout is not None:
            self.assertEqual(result.stdout, "")
        for words in says:
            self.assertIn(words, result.stderr)
        if status == 1:
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        return result

    def terminal(self):
        """Both ends of a terminal; a container may have no /dev/pts."""
        try:
            return pty.openpty()
        except OSError as error:
            self.skipTest(f"no terminals: {error}")

    def json(self, *arguments):
        """Standard output holds one JSON object and nothing else."""
        value = json.loads(self.expect_done(*arguments).stdout)
        self.assertIsInstance(value, dict)
        return value
