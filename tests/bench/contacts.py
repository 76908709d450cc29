"""What keeping vessels apart costs: `ramus mesh` with the defaults and with --blend paper, in pairs of runs, as the table
in docs/SPEED.md has it. Radii too large by a factor make contacts, false loops and intersections.

Usage: contacts.py PROGRAM TREE[*FACTOR][@DETAIL]... [--runs N]; trees are SWC files.
"""

import argparse
import json
import statistics
import tempfile
from pathlib import Path

from measured import measured


def scaled(tree, factor, folder):
    """A copy of an SWC file with its radii times `factor`."""
    path = folder / tree.name
    with open(tree, encoding="utf-8") as lines, open(path, "w", encoding="utf-8") as out:
        for line in lines:
            words = line.split()
            if words and not line.startswith("#"):
                words[5] = repr(float(words[5]) * factor)
                line = " ".join(words) + "\n"
            out.write(line)
    return path


def row(program, argument, runs, folder):
    name, _, detail = argument.partition("@")
    name, _, factor = name.partition("*")
    tree = scaled(Path(name), float(factor or 1), folder)
    command = [program, "mesh", tree, "-o", folder / "surface.stl", "--json", "--detail", detail or "16"]
    ours, plain = [], []
    for _ in range(runs):
        ours.append(measured(command))
        plain.append(measured([*command, "--blend", "paper"]))
    apart, paper = (statistics.median(result[1] for result in results) for results in (ours, plain))
    report, before = json.loads(ours[0][3]), json.loads(plain[0][3])
    asked = report["tree"]
    differs = [report[what] - asked[what] for what in ("components", "loops")]
    title = tree.stem.replace("_", " ") + (f", radii x {factor}" if factor else "")
    print(f"| {title} | {detail or 16} "
          f"| {report['triangles'] / 1e6:.2f} | {apart:.1f} | {apart / paper:.2f}x | {ours[0][2]:.0f} "
          f"| {ours[0][2] / plain[0][2]:.2f}x | {before['loops'] - asked['loops']} | {report['cut_loops']} "
          f"| {report['intersections']['found']:,} | {differs[0]} {differs[1]} {report['intersections']['left']} |",
          flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("trees", nargs="+")
    parser.add_argument("--runs", type=int, default=3)
    arguments = parser.parse_args()
    print("| tree | detail | million triang. | s | of the plain sum's | MB | of the plain sum's "
          "| false loops of the plain sum | cut | intersections | left: pieces, loops, intersections |")
    print("|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|")
    for argument in arguments.trees:
        with tempfile.TemporaryDirectory() as folder:
            row(arguments.program, argument, arguments.runs, Path(folder))


if __name__ == "__main__":
    main()
