"""From the surface benchmark's table of values to the table and plot of docs/SPEED.md.

    report.py surfaces.tsv FOLDER      writes FOLDER/table.md and FOLDER/speed.svg
"""

import csv
import pathlib
import subprocess
import sys

COLUMNS = (
    ("tree", None),
    ("cells", None),
    ("segments", lambda r: f"{r['segments']:,.0f}"),
    ("million triang.", lambda r: f"{r['triangles'] / 1e6:.2f}"),
    ("s", lambda r: f"{r['seconds']:.3g}"),
    ("million / s", lambda r: f"{r['triangles'] / r['seconds'] / 1e6:.1f}"),
    ("best", lambda r: f"{r['triangles'] / r['best'] / 1e6:.1f}"),
    ("one core", lambda r: f"{r['triangles'] / r['one_thread'] / 1e6:.1f}" if r["one_thread"] else ""),
    ("octree, cells, join, ms", lambda r: " ".join(f"{1e3 * r[step]:.0f}" for step in ("bricks", "cells", "join"))),
    ("eval. / vertex", lambda r: f"{r['evaluations'] / r['vertices']:.0f}"),
    ("B / triang. beyond mesh", lambda r: f"{r['beyond_mesh'] / r['triangles']:.0f}"),
    ("all segments: eval., time", lambda r: "{:.0f}x {:.0f}x".format(
        r["all_evaluations"] / r["evaluations"], r["all_seconds"] / r["seconds"]) if r["all_seconds"] else ""),
    ("whole, s", lambda r: f"{r['whole']:.3g}" if r["whole"] else ""),
    ("of the plain sum's", lambda r: f"{r['whole'] / r['whole_plain']:.2f}x" if r["whole"] else ""),
)

PLOT = """
set terminal svg size 760,420 font "sans-serif,13" background "white"
set output "{svg}"
set logscale xy
set xlabel "million triangles"
set ylabel "seconds"
set key right bottom reverse Left
set grid
set pointsize 0.8
set xrange [0.1:300]
set yrange [0.01:100]
plot 0.1 * x with lines dashtype 2 linecolor "#999999" title "10 million triangles a second", \\
  "+" using (1.1):(53) every ::::0 with points pointtype 2 linecolor "black" title "the paper's largest tree", \\
{curves}
"""
COLOURS = ("#009e73", "#0072b2", "#d55e00", "#7f3f98")


def read(file):
    with open(file, encoding="ascii", newline="") as lines:
        for row in csv.DictReader(lines, delimiter="\t"):
            yield {name: text if name == "name" else float(text) for name, text in row.items()}


def cells(row):
    return "one size" if row["one_cell"] else f"detail {row['detail']:.0f}"


def table(rows):
    yield "| " + " | ".join(name for name, _ in COLUMNS) + " |"
    yield "|---|---" + "|--:" * (len(COLUMNS) - 2) + "|"
    for row in rows:
        shown = [row["name"].replace("_", " "), cells(row)] + [show(row) for _, show in COLUMNS[2:]]
        yield "| " + " | ".join(shown) + " |"


def plot(rows, folder):
    kinds = {}
    for row in rows:
        kind = "grown, " + cells(row) if row["name"].startswith("grown") else "read from files, " + cells(row)
        kinds.setdefault(kind, []).append((row["triangles"] / 1e6, row["seconds"]))
    curves = []
    for number, (kind, points) in enumerate(kinds.items()):
        data = folder / f"speed-{number}.dat"
        data.write_text("".join(f"{x} {y}\n" for x, y in sorted(points)), encoding="ascii")
        style = "points" if kind.startswith("read") else "linespoints"
        colour = COLOURS[number % len(COLOURS)]
        curves.append(f'  "{data}" with {style} pointtype {5 + 2 * number} linecolor "{colour}" title "{kind}"')
    script = PLOT.format(svg=folder / "speed.svg", curves=", \\\n".join(curves))
    subprocess.run(["gnuplot"], input=script, text=True, check=True)


def main():
    rows = list(read(sys.argv[1]))
    folder = pathlib.Path(sys.argv[2])
    (folder / "table.md").write_text("\n".join(table(rows)) + "\n", encoding="ascii")
    plot(rows, folder)


if __name__ == "__main__":
    main()
