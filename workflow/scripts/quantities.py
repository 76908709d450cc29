"""The figures of a case: their names in tables, their headings on the page, and where the records have them."""

from typing import NamedTuple


class Quantity(NamedTuple):
    name: str  # column of cases.csv
    heading: str
    power: int  # of the unit of length: 1 lengths, 3 volumes; 0: a count or a share
    step: str
    path: tuple  # in the result of the step


def _distances(prefix, key, words):
    figures = (("mean", "mean"), ("sigma", "standard deviation"), ("median", "median"), ("percentile_95", "95th percentile"),
               ("max", "largest"))
    return [Quantity(f"{prefix}_{name}", f"{words}, {heading}", 1, "validate", ("distances", key, name))
            for name, heading in figures]


QUANTITIES = [
    Quantity("branches", "Branches", 0, "measure", ("branches",)),
    Quantity("leaves", "Leaves", 0, "measure", ("leaves",)),
    Quantity("roots", "Roots", 0, "measure", ("roots",)),
    Quantity("loops", "Loops", 0, "measure", ("loops",)),
    Quantity("generations", "Generations", 0, "measure", ("generations",)),
    Quantity("length", "Length of all branches", 1, "measure", ("length",)),
    Quantity("volume", "Volume of all branches", 3, "measure", ("volume",)),
    Quantity("radius_min", "Least radius", 1, "measure", ("radius", "min")),
    Quantity("radius_mean", "Mean radius", 1, "measure", ("radius", "mean")),
    Quantity("radius_max", "Largest radius", 1, "measure", ("radius", "max")),
    Quantity("repairs", "Repairs", 0, "measure", ("repairs",)),
    Quantity("suspicions", "Suspicions", 0, "measure", ("suspicions",)),
    *_distances("to_cones", "to_cones", "Distance to cones"),
    *_distances("to_mask", "to_mask", "Distance to the mask"),
    *_distances("from_mask", "from_mask", "Distance from the mask"),
    Quantity("dice", "Dice coefficient", 0, "validate", ("volumes", "dice")),
    Quantity("surface_volume", "Volume in the surface", 3, "validate", ("volumes", "surface")),
    Quantity("mask_volume", "Volume of the mask", 3, "validate", ("volumes", "mask")),
    Quantity("points_outside_percent", "Points outside, %", 0, "validate", ("fidelity", "points_outside_percent")),
    Quantity("axis_offset_median", "Offset of the axis, median", 1, "validate", ("fidelity", "axis_offset", "median")),
    Quantity("axis_offset_p95", "Offset of the axis, 95th percentile", 1, "validate", ("fidelity", "axis_offset", "p95")),
    Quantity("axis_offset_max", "Offset of the axis, largest", 1, "validate", ("fidelity", "axis_offset", "max")),
    Quantity("radius_error_median", "Radius error, share, median", 0, "validate", ("radius_error", "median")),
    Quantity("radius_error_p95", "Radius error, share, 95th percentile", 0, "validate", ("radius_error", "p95")),
    *(Quantity(name, heading, 0, "validate", ("questions", name)) for name, heading in (
        ("lost", "Lost branches"), ("false", "False parts"), ("merged", "Merged branches"),
        ("constrictions", "Constrictions"), ("width", "Places of another width"), ("position", "Places beside the axis"))),
    Quantity("surface_components", "Pieces of the surface", 0, "validate", ("shape", "components")),
    Quantity("surface_loops", "Loops of the surface", 0, "validate", ("shape", "loops")),
]

FINDINGS = ("lost", "false", "merged", "constrictions", "width", "position")


def _figure(result, path):
    for name in path:
        result = result.get(name) if isinstance(result, dict) else None
    return len(result) if isinstance(result, list) else result


def figures_of(records):
    """All quantities of a case by name, and `unit` and `orientation`; None where a step has no result."""
    results = {step: dict(record.get("result") or {}) for step, record in records.items()}
    measured = results["measure"]
    if "branch_list" in measured:
        measured["leaves"] = sum(not branch["children"] for branch in measured["branch_list"])
    figures = {quantity.name: _figure(results[quantity.step], quantity.path) for quantity in QUANTITIES}
    return figures | {"unit": measured.get("unit"), "orientation": measured.get("orientation")}
