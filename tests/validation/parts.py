"""The parts of docs/VALIDATION.md: each makes its data, its figures and its text anew."""

import csv
import json
import pathlib
import resource
import subprocess

import plots
import sections
import support
import trees

ROOT = pathlib.Path(__file__).resolve().parents[2]
OUT = ROOT / "build" / "validation"
FIGURES = ROOT / "docs" / "validation"
SHARED = ROOT.parent / "shared" / "data"
RAMUS = ROOT / "build" / "release" / "app" / "ramus"
MASKS = (  # name, options
    ("liver_002_vessels.nii.gz", ("--label", "1")), ("liver_002_vessels.nii.gz", ("--label", "2")),
    ("airways_lumen.nii.gz", ()), ("airways_flipped.nrrd", ()), ("aorta_0066_mask.mha", ("--units", "cm")),
    ("circle_of_willis_mr_003.nii.gz", ()), ("kidney.nii.gz", ()))
GROWN = ((61, 1), (121, 2), (121, 3))  # branches, seed
VOXEL = (0.7, 0.7, 1.5)
MISSING = "*left out: there is no ../shared/data*"


def ramus(*words):
    """Standard output, and the CPU seconds of all cores together."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([RAMUS, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        raise SystemExit(f"validation: ramus {' '.join(map(str, words))}: {done.stderr.strip()}")
    return done.stdout, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def ramus_json(*words):
    return json.loads(ramus(*words, "--json")[0])


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---" + "|--:" * (len(head) - 1) + "|"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def figure(name, svg):
    FIGURES.mkdir(parents=True, exist_ok=True)
    (FIGURES / name).write_text(svg, encoding="utf-8")
    return f"![{name[:-4].replace('_', ' ')}](validation/{name})\n"


def swc(name, rows):
    path = OUT / (name + ".swc")
    trees.write_swc(path, rows)
    return path


def grown(branches, seed):
    path = OUT / f"grown_{branches}_{seed}.swc"
    ramus("grow", "-o", path, "--branches", branches, "--seed", seed)
    return path


def cones_of(tree):
    path = tree.with_suffix(".cones.ply")
    ramus("mesh", tree, "-o", path, "--method", "cones", "--smooth", 0)
    return path


def shapes():
    """Artificial trees (paper, Figs. 1 to 3): how far the surface is from truncated cones, at width 1 and 5."""
    boxes, rows = [], []
    for label, tree in (("trifurcation", swc("trifurcation", trees.trifurcation())),
                        ("S-shape", swc("s_shape", trees.s_shape()))):
        cones = cones_of(tree)
        for width in (1, 5):
            found = ramus_json("compare", tree, cones, "--smooth", 0, "--width", width)
            boxes.append(plots.box_of(f"{label}, width {width}", found))
            rows.append((f"{label}, width {width}", *(f"{found[key]:.4f}" for key in ("mean", "sigma", "median", "max"))))
    text = table(("radius 2 mm", "mean, mm", "sigma", "median", "largest"), rows)
    return text + "\n" + figure("shapes.svg", plots.box_plots("Convolution surface to truncated cones", "mm", boxes))


def joints():
    """Height of the surface over the joints of figure 1 of the paper, next to the closed form."""
    found = ramus_json("paper", "-o", OUT / "paper", "--figures", "1")["figures"][0]["measured"]
    rows = [(one["what"], f"{one['value']:.4f}", f"{one['formula']:.4f}") for one in found]
    return table(("branches in a plane", "height / radius", "by the formula"), rows)


def bounds():
    """Bounding volumes (paper, Fig. 4): what leaving segments out beyond them does to the radius of the S-shape."""
    rows = [(name, f"{100.0 * mean:.4f}", f"{100.0 * most:.4f}")
            for name, mean, most in support.radius_changes(trees.s_shape())]
    return table(("segments are left out", "mean change of the radius, %", "largest, %"), rows)


def radii():
    """How true the radius is along branches, without smoothing."""
    inputs = [(f"grown, {b} branches, seed {s}", grown(b, s)) for b, s in GROWN]
    brains = sorted((SHARED / "trees").glob("brain_BG*.swc"))
    inputs += [(path.stem.replace("_", " "), path) for path in brains]
    rows = []
    for name, tree in inputs:
        smooth, lines = (ramus_json("validate", tree, "--smooth", 0, "--centerline", way)["radius_error"]
                         for way in ("smooth", "lines"))
        figures = (smooth["at_points"]["median"], smooth["median"], smooth["p95"], lines["median"], lines["p95"])
        rows.append((name, *(f"{100.0 * figure:.4f}" for figure in figures)))
    text = table(("tree", "round centerlines, points that were read: median, %", "all along: median, %", "95th percentile",
                  "lines: median, %", "95th percentile"), rows)
    return text + ("" if brains else "\n" + MISSING + "\n")


FORMATS = ("airways_human.vtu", "aorta_0066_centerline.vtp", "carotid_centerline.vtp", "coronary_227A.vtk", "penetrating_artery.vtk",
           "cortex_slab.h5", "cortex_sample.vmv", "mesentery.am", "opencco_3D.xml", "vascusynth.xml", "vesselvio_vertices.csv")


def fidelity():
    """How well the surface of all defaults follows the tree as its file has it, beside one without smoothing."""
    inputs = [(f"grown, {b} branches, seed {s}", grown(b, s)) for b, s in GROWN]
    real = sorted((SHARED / "trees").glob("*.swc"))
    inputs += [(path.stem.replace("_", " "), path) for path in real]
    inputs += [(name, SHARED / "formats" / name) for name in FORMATS if real]
    rows = []
    for name, tree in inputs:
        smoothing = ramus_json("info", tree)["smoothing"]
        default, raw = (ramus_json("validate", tree, *options) for options in ((), ("--smooth", 0)))
        points, offset, raw_offset = default["fidelity"], default["fidelity"]["axis_offset_mm"], raw["fidelity"]["axis_offset_mm"]
        error, raw_error = default["radius_error"], raw["radius_error"]
        voxel = "none" if smoothing["voxel_mm"] is None else f"{smoothing['voxel_mm'][0]:.3g}"
        rows.append((name, voxel, f"{smoothing['displacement_radii']['max']:.2f}",
                     f"{points['points_outside']} of {points['points']:,}",
                     *(f"{offset[key]:.4f} ({raw_offset[key]:.4f})" for key in ("median", "p95")),
                     *(f"{100.0 * error[key]:.2f} ({100.0 * raw_error[key]:.2f})" for key in ("median", "p95")),
                     " ".join(str(len(found)) for found in default["questions"].values())))
        print(f"    {name}", flush=True)
    text = table(("tree", "voxels", "largest displacement, radii", "points outside", "axis off, median", "95th percentile",
                  "radius off, median, %", "95th percentile", "lost, false, merged, constrictions, width, position"), rows)
    return text + ("" if real else "\n" + MISSING + "\n")


def stenoses():
    """The narrowest radius of stenoses: how much wider the surface is than the tree, and how far off it is beside that."""
    rows = []
    for radii in ("plain", "exact"):
        for share in (0.2, 0.5, 0.8):
            row = [f"{100 * share:.0f} %, `--radii {radii}`"]
            for diameters in (1, 2, 3, 5):
                tree = swc("stenosis", trees.stenosis(share, diameters))
                ramus("validate", tree, "--smooth", 0, "--detail", 32, "--radii", radii, "--report", OUT / "stenosis")
                with open(OUT / "stenosis" / "radii.csv", encoding="ascii", newline="") as file:
                    alone = [line for line in csv.DictReader(file) if line["alone"] == "yes"]
                narrowest = min(float(line["surface_radius"]) for line in alone)
                errors = [100.0 * (float(line["surface_radius"]) / float(line["input_radius"]) - 1.0) for line in alone]
                row.append(f"{100.0 * (narrowest / (2.0 * (1.0 - share)) - 1.0):+.2f} ({min(errors):+.1f} to {max(errors):+.1f})")
            rows.append(row)
    return table(("stenosis", *(f"over {n} diameter{'s' if n > 1 else ''}, %" for n in (1, 2, 3, 5))), rows)


def table1():
    """Table I: the surface against truncated cones and against the isosurface of the mask."""
    inputs = []
    for branches, seed in GROWN:
        mask = OUT / f"grown_{branches}_{seed}.nii.gz"
        trees.write_mask(mask, trees.read_swc(grown(branches, seed)), VOXEL)
        inputs.append((f"grown, {branches} branches, seed {seed}", mask, ()))
    missing = not (SHARED / "volumes").is_dir()
    if not missing:
        inputs += [(" ".join([name.split(".")[0].replace("_", " "), *(f"label {o}" for o in options[1:] if o.isdigit())]),
                    SHARED / "volumes" / name, options) for name, options in MASKS]
    rows, boxes = [], []
    for n, (name, mask, options) in enumerate(inputs):
        tree = OUT / f"table1_{n}.json"
        ramus("skeletonize", mask, "-o", tree, *options)
        found = ramus_json("validate", tree, "--mask", mask, *(word.replace("--units", "--mask-units") for word in options))
        cones, to_mask, from_mask = (found["distances"][other] for other in ("to_cones", "to_mask", "from_mask"))
        volumes, questions = found["volumes"], found["questions"]
        boxes.append(plots.box_of(name, to_mask))
        rows.append((name, f"{cones['mean']:.4f}", f"{cones['sigma']:.4f}", f"{cones['max']:.3f}", f"{cones['but_for_free_ends']['max']:.3f}",
                     f"{to_mask['mean']:.4f}",
                     f"{to_mask['sigma']:.4f}", f"{to_mask['max']:.3f}", f"{to_mask['threshold_mm']:.3f}",
                     f"{100.0 - to_mask['above_percent']:.2f}",
                     f"{from_mask['mean']:.4f}", f"{100.0 - from_mask['above_percent']:.2f}",
                     f"{100.0 * volumes['surface_mm3'] / volumes['mask_mm3']:.1f}", f"{volumes['dice']:.3f}",
                     " ".join(str(len(found)) for found in questions.values())))
        print(f"    {name}", flush=True)
    text = table(("mask", "to cones: mean, mm", "sigma", "largest", "but for free ends", "to isosurface: mean, mm", "sigma", "largest",
                  "half a voxel's diagonal, mm", "below it, %", "from isosurface: mean, mm", "below half a voxel, %", "volume, % of the mask's",
                  "Dice", "lost, false, merged, constrictions, width, position"), rows)
    text += "\n" + MISSING + "\n" if missing else ""
    return text + "\n" + figure("table1.svg", plots.box_plots("Surface to isosurface of the mask", "mm", boxes))


def roundness():
    """What of the distance to the isosurface is that of sections that are not round."""
    if not (SHARED / "volumes").is_dir():
        return MISSING
    rows = []
    for name, options in MASKS:
        if "liver" not in name:
            continue
        tree, iso, report = OUT / "roundness.json", OUT / "roundness.obj", OUT / "roundness"
        ramus("skeletonize", SHARED / "volumes" / name, "-o", tree, *options)
        ramus("validate", tree, "--report", report)
        ramus("mesh", SHARED / "volumes" / name, "-o", iso, "--method", "iso", *options)
        count, *found = sections.distances(sections.Surface(iso), sections.read_places(report / "radii.csv"))
        rows.append((" ".join((name.split(".")[0].replace("_", " "), "label", options[1])), str(count), *(f"{mm:.3f}" for mm in found)))
    return table(("mask", "sections", "to the surface's circle: mean, mm", "to the circle of their own area", "to the nearest circle"),
                 rows)


def table3():
    """Table III: CPU seconds of all cores together, reading and writing included."""
    inputs = [(f"grown, {b} branches, seed {s}", grown(b, s)) for b, s in (*GROWN, (1504, 1))]
    real = sorted((SHARED / "trees").glob("*.swc"))
    inputs += [(path.stem.replace("_", " "), path) for path in real]
    rows = []
    for name, tree in inputs:
        row = [name]
        for method in ("cones", "cs"):
            mesh = OUT / "timed.ply"
            text, seconds = ramus("mesh", tree, "-o", mesh, "--method", method, "--json")
            row += [f"{json.loads(text)['triangles']:,}", f"{seconds:.2f}"]
            mesh.unlink()
        rows.append(row)
    text = table(("tree", "cones: triangles", "CPU s", "convolution surface: triangles", "CPU s"), rows)
    return text + ("" if real else "\n" + MISSING + "\n")


def study():
    """The pictures of the paper's study, in build/validation/study."""
    text, _ = ramus("study", grown(121, 2), "-o", OUT / "study", "--voxel", 0.7)
    return text.replace(str(ROOT) + "/", "")


PARTS = {"shapes": shapes, "joints": joints, "bounds": bounds, "radii": radii, "fidelity": fidelity, "stenoses": stenoses, "table1": table1,
         "roundness": roundness, "table3": table3, "study": study}
