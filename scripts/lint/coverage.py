#!/usr/bin/env python3
"""Line coverage by layer and by file, from what gcov says of a build with --coverage whose tests have run."""
import collections
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys

TOP = pathlib.Path(__file__).resolve().parents[2]


def lines_of(notes):
    """(file, line, times) of each line of ours that one object has code for."""
    run = subprocess.run(["gcov", "--json-format", "--stdout", str(notes)], capture_output=True, text=True, check=False)
    for document in run.stdout.splitlines():
        for file in json.loads(document)["files"]:
            path = os.path.relpath(os.path.join(TOP, file["file"]), TOP)
            if path.startswith(("core/", "render/", "app/")):
                yield from ((path, line["line_number"], line["count"]) for line in file["lines"])


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    reached = collections.defaultdict(dict)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for lines in pool.map(lambda notes: list(lines_of(notes)), sorted(build.rglob("*.gcno"))):
            for path, line, times in lines:
                reached[path][line] = reached[path].get(line, False) or times > 0
    layers = collections.defaultdict(lambda: [0, 0])
    rows = []
    for path, lines in reached.items():
        for sums in (layers[path.split("/")[0]], layers["all"]):
            sums[0] += sum(lines.values())
            sums[1] += len(lines)
        rows.append((sum(lines.values()) / len(lines), len(lines), path))
    text = "".join(f"{100 * share:5.1f} % of {count:4} {path}\n" for share, count, path in sorted(rows))
    (build / "files.txt").write_text(text)
    for layer in ("core", "render", "app", "all"):
        hit, count = layers[layer]
        print(f"{layer:7} {100 * hit / max(count, 1):5.1f} % of {count:6} lines")
    print(f"by file, least first: {build / 'files.txt'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
