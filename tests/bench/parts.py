"""Parts of one surface, made one after the other: how even the work is, what a process takes, and which speed-up that predicts.

    tests/bench/parts.py RAMUS TREE [--parts 1,2,4,8,16,64] [--options "--detail 8"]

A simulation: one machine makes the parts in turn, as the processes of `mpirun -n N ramus-mpi mesh` make them at once. The
work of a part is its octree, cells and triangles, with what it computes of its neighbours. The time of such a job is
predicted as the longest part without its writing, plus what `ramus mesh` takes beyond the one part that is all: repairs
and writing. A part by itself finds the subtrees of the whole octree, which processes divide: so much is taken off. Times
are of the processor, on one thread each; of two runs the shorter. Prints a table in Markdown.
"""

import argparse
import json
import pathlib
import shlex
import statistics
import tempfile

from measured import measured


def numbers(text):
    return [int(word) for word in text.split(",")]


def made(command, index, count):
    """Of one part: its work (s), evaluations of its own and of others, time (s), memory (MB)."""
    _, part_s, part_mb, text = measured([*command, "--part", f"{index + 1}/{count}"])
    report = json.loads(text)
    part = report["part"]
    spared = part["find_s"] * (1.0 - 1.0 / count)
    return (part["octree_s"] - spared + part["cells_s"] + part["join_s"],
            report["evaluations"], part["border_evaluations"], part_s - report["write_s"] - spared, part_mb)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("ramus")
    parser.add_argument("tree")
    parser.add_argument("--parts", type=numbers, default=[2, 4, 8, 16, 64])
    parser.add_argument("--most", type=int, default=16, help="of so many parts, evenly chosen, the figures are taken")
    parser.add_argument("--options", type=shlex.split, default=[])
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        surface = pathlib.Path(name) / "surface.ply"
        command = [arguments.ramus, "mesh", arguments.tree, "-o", str(surface), "--json", "--threads", "1", *arguments.options]
        _, all_s, all_mb, text = measured(command)
        report = json.loads(text)
        print(f"{pathlib.Path(arguments.tree).name}: {report['triangles']:,} triangles; one process: {all_s:.1f} s, {all_mb:.0f} MB\n")
        print("| parts | work, largest over mean | made twice | longest part | most memory | predicted speed-up |")
        print("|---|---|---|---|---|---|")
        after = None  # repairs and writing
        for count in [1, *arguments.parts]:
            chosen = min(count, arguments.most)
            work, own, others, seconds, memory = [], [], [], [], []
            for index in sorted({round(n * (count - 1) / max(chosen - 1, 1)) for n in range(chosen)}):
                one = min((made(command, index, count) for _ in range(2)), key=lambda figures: figures[0])
                for figures, figure in zip((work, own, others, seconds, memory), one):
                    figures.append(figure)
            after = after if after is not None else max(all_s - seconds[0], 0.0)
            print(f"| {count} | {max(work) / statistics.mean(work):.2f} | {100 * sum(others) / sum(own):.0f} % | {max(seconds):.1f} s | "
                  f"{max(memory):.0f} MB | {all_s / (max(seconds) + after):.1f} |", flush=True)


if __name__ == "__main__":
    main()
