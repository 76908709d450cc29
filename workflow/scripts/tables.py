"""Joins the records of all cases: tables/cases.csv, branches.csv, statistics.csv, failed.csv and outcome.json.

Cases are sorted by name and numbers have a fixed form, so the bytes do not depend on the order in which cases were done.
"""

import json
import math
import statistics
import sys
from pathlib import Path

import cohort
from quantities import QUANTITIES, figures_of


def failure_of(case, records):
    """The first step that has no result, as a row of failed.csv; none if the case is complete."""
    for step in cohort.steps_of(case):
        record = records[step]
        if record["state"] in ("failed", "killed"):
            return {"case": case["name"], "folder": case["folder"], "step": step, "state": record["state"],
                    "message": record["message"], "command": record["command"]}
    return None


def check_keys(config, case, records):
    for step, record in records.items():
        if record["key"] != cohort.key_of(config, case, step):
            sys.exit(f"{cohort.record_path(case, step)} is of another input or other options; remove it and run again")


def summary_of(values):
    """n, mean, standard deviation of a sample, minimum, quartiles, maximum. Quartiles as in R's type 7."""
    values = sorted(values)
    mean = statistics.fmean(values)
    deviation = None
    if len(values) > 1:
        deviation = math.sqrt(math.fsum((value - mean) ** 2 for value in values) / (len(values) - 1))
    quartiles = statistics.quantiles(values, n=4, method="inclusive") if len(values) > 1 else values * 3
    return {"n": len(values), "mean": mean, "standard_deviation": deviation, "min": values[0],
            "lower_quartile": quartiles[0], "median": quartiles[1], "upper_quartile": quartiles[2], "max": values[-1]}


def statistics_of(rows):
    """A row for each quantity, and for lengths, areas and volumes one for each unit: units are never mixed."""
    found = []
    for quantity in QUANTITIES:
        groups = {}
        for row in rows:
            if row[quantity.name] is not None:
                unit = row["unit"] if quantity.power else ""
                groups.setdefault(unit, []).append(row[quantity.name])
        for unit in sorted(groups, key=lambda unit: (unit != "mm", unit)):
            found.append({"quantity": quantity.name, "unit": unit} | summary_of(groups[unit]))
    return found


def write_table(name, rows, columns):
    cohort.write_whole(f"tables/{name}.csv", cohort.csv_text(columns, [[row[column] for column in columns] for row in rows]))


def write_branches(cases):
    """The tables of all cases below each other, without reading them into memory together."""
    parts = []
    for case in cases:
        path = Path("cases", case["folder"], "branches.csv")
        if path.exists():
            heading, _, rows = path.read_bytes().partition(b"\r\n")
            parts.append(rows if parts else heading + b"\r\n" + rows)
    cohort.write_whole("tables/branches.csv", b"".join(parts))


def main():
    config = cohort.load_config()
    cases = sorted(config["cases"], key=lambda case: case["name"])
    rows, failed = [], []
    for case in cases:
        records = {step: cohort.read_record(case, step) for step in cohort.steps_of(case)}
        check_keys(config, case, records)
        failure = failure_of(case, records)
        if failure:
            failed.append(failure)
        rows.append({"case": case["name"], "kind": case["kind"], "file": case["relative"]}
                    | figures_of(records) | {"error": failure["message"] if failure else None})
    found = statistics_of(rows)
    write_table("cases", rows, list(rows[0]))
    write_branches(cases)
    write_table("statistics", found, ["quantity", "unit", "n", "mean", "standard_deviation", "min", "lower_quartile",
                                      "median", "upper_quartile", "max"])
    write_table("failed", failed, ["case", "step", "state", "message", "command"])
    outcome = {"cases": len(cases), "done": len(cases) - len(failed), "failed": failed, "statistics": found, "rows": rows}
    cohort.write_whole("tables/outcome.json", json.dumps(outcome, indent=1) + "\n")


if __name__ == "__main__":
    main()
