"""Writes index.html, the summary of a cohort: one file without scripts that loads nothing. Its links lead to the pictures
and tables next to it. Names and messages come from files, and are escaped."""

import base64
import html
import json
from pathlib import Path

import box_plots
import cohort
from quantities import FINDINGS, QUANTITIES

PLOTTED = ("branches", "generations", "length", "volume", "radius_mean", "radius_min", "to_cones_percentile_95",
           "axis_offset_median", "radius_error_p95", "to_mask_mean", "from_mask_percentile_95", "dice")
LISTED = ("branches", "loops", "length", "volume", "radius_mean", "to_cones_percentile_95", "radius_error_p95", "dice",
          "findings")
# Figures by which cases are the worst: name, words, whether small values are the worst.
WORST = (("to_cones_percentile_95", "distance to cones, 95th percentile", False),
         ("radius_error_p95", "radius error, 95th percentile of shares", False),
         ("findings", "number of places found by the validation", False),
         ("from_mask_percentile_95", "distance from the mask, 95th percentile", False),
         ("dice", "Dice coefficient", True))
WORST_OF_EACH = 3
MOST_LISTED = 2000
HEADINGS = {quantity.name: quantity.heading for quantity in QUANTITIES} | {"findings": "Places found"}
POWERS = {quantity.name: quantity.power for quantity in QUANTITIES}
POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'"


def text(words):
    """Escaped; letters that cannot be seen, or that turn the direction of text, become U+FFFD."""
    return html.escape("".join(letter if letter.isprintable() else "\ufffd" for letter in words))


def number(value):
    """Four digits for people; the tables have nine."""
    if value is None:
        return ""
    if isinstance(value, int) or float(value).is_integer() and abs(value) < 1e9:
        return f"{int(value):,}"
    return format(value, ",.0f") if abs(value) >= 1e4 else format(value, ".4g")


def unit_text(unit, power):
    name = {"mm": "mm", "unknown": "units"}.get(unit, unit)
    return name + {2: "²", 3: "³"}.get(power, "") if power else ""


def with_unit(value, name, unit):
    return f"{number(value)} {unit_text(unit, POWERS.get(name, 0))}".strip()


def table(headings, rows, numeric, attributes=None):
    """Rows are lists of HTML. `numeric`: whether a column has numbers."""
    classes = [' class="number"' if is_number else "" for is_number in numeric]
    head = "".join(f"<th{kind}>{heading}</th>" for kind, heading in zip(classes, headings))
    lines = []
    for index, row in enumerate(rows):
        cells = "".join(f"<td{kind}>{cell}</td>" for kind, cell in zip(classes, row))
        lines.append(f"<tr{attributes[index] if attributes else ''}>{cells}</tr>")
    return (f'<div class="scroll"><table><thead><tr>{head}</tr></thead><tbody>\n' + "\n".join(lines)
            + "\n</tbody></table></div>\n")


def links_of(case):
    folder = Path("cases", case["folder"])
    files = (("picture", "picture.png"), ("branches", "branches.csv"), ("figures", "measure.json"),
             ("validation", "validate.json"))
    return " · ".join(f'<a href="{folder / name}">{words}</a>' for words, name in files if (folder / name).exists())


def failed_section(failed):
    if not failed:
        return ""
    rows = [[f'<a href="#case-{one["folder"]}">{text(one["case"])}</a>', one["step"],
             f'{text(one["message"])}<details><summary>Command</summary><code>{text(one["command"])}</code></details>']
            for one in failed]
    note = ("<p class=quiet>A failed case is computed again when its file or the options change, and with "
            "<code>ramus cohort --retry</code>. One that a signal ended is computed again in the next run.</p>\n")
    return '<h2 id="failed">Failed cases</h2>\n' + note + table(["Case", "Step", "Message"], rows, [False] * 3)


def statistics_section(found):
    columns = ("n", "mean", "standard_deviation", "min", "lower_quartile", "median", "upper_quartile", "max")
    headings = ("Quantity", "Unit", "n", "Mean", "Standard deviation", "Least", "Lower quartile", "Median", "Upper quartile",
                "Largest")
    rows = [[HEADINGS[row["quantity"]], unit_text(row["unit"], POWERS[row["quantity"]]),
             *(number(row[column]) for column in columns)] for row in found]
    note = ("<p class=quiet>Over cases, each with equal weight, whatever its number of branches. n: the cases that have the "
            "figure. The standard deviation is of a sample (n − 1). Lengths of different units are never put together.</p>\n")
    return '<h2 id="statistics">Statistics</h2>\n' + note + table(headings, rows, [False, False] + [True] * 8)


def plots_section(rows, found):
    heading = '<h2 id="plots">Box plots</h2>\n'
    if not box_plots.available():
        return heading + "<p class=quiet>matplotlib is not installed (Debian: python3-matplotlib), so there are none.</p>\n"
    figures = []
    for row in found:
        name = row["quantity"]
        if name not in PLOTTED or row["n"] < 2:
            continue
        values = [(case[name], case["folder"]) for case in rows
                  if case[name] is not None and (not POWERS[name] or case["unit"] == row["unit"])]
        unit = unit_text(row["unit"], POWERS[name])
        figures.append(f"<figure><figcaption>{HEADINGS[name]}{', ' + unit if unit else ''} <span>n = {row['n']}</span>"
                       f"</figcaption>{box_plots.box_plot(values)}</figure>\n")
    note = ("<p class=quiet>Box: quartiles; bar: median; whiskers: within 1.5 quartile distances; diamond: mean; dots: cases "
            "beyond the whiskers, each a link to its row.</p>\n")
    return heading + note + '<div class="plots">\n' + "".join(figures) + "</div>\n" if figures else ""


def worst_cases(rows):
    """The folders of the worst cases, and for each the words of what it is the worst in."""
    reasons = {}
    for name, words, small in WORST:
        ranked = [row for row in rows if row[name] is not None and not (name == "findings" and row[name] == 0)]
        ranked.sort(key=lambda row: (row[name] if small else -row[name], row["case"]))
        for place, row in enumerate(ranked[:WORST_OF_EACH]):
            words_of_place = ("", "second ", "third ")[place] + ("least" if small else "largest")
            value = with_unit(row[name], name, row["unit"])
            reasons.setdefault(row["folder"], []).append(f"{words_of_place} {words}: {value}")
    return reasons


def worst_section(rows):
    reasons = worst_cases(rows)
    if not reasons:
        return ""
    by_folder = {row["folder"]: row for row in rows}
    cards = []
    for folder, words in reasons.items():
        picture = Path("cases", folder, "picture.png")
        image = ""
        if picture.exists():
            data = base64.b64encode(picture.read_bytes()).decode()
            image = f'<a href="{picture}"><img alt="Picture of the case" src="data:image/png;base64,{data}"></a>'
        items = "".join(f"<li>{text(word)}</li>" for word in words)
        case = by_folder[folder]
        cards.append(f'<figure>{image}<b>{text(case["case"])}</b><ul>{items}</ul>'
                     f"<figcaption>{links_of(case)}</figcaption></figure>\n")
    note = (f"<p class=quiet>The {WORST_OF_EACH} cases at the far end of each figure of the validation. Numbers, not "
            "verdicts: a cohort of good surfaces has such cases, too.</p>\n")
    return '<h2 id="worst">Cases at the far end</h2>\n' + note + '<div class="cards">\n' + "".join(cards) + "</div>\n"


def cases_section(rows):
    headings = ["Case", "Kind", "Unit", *(HEADINGS[name] for name in LISTED), "Files"]
    lines, attributes = [], []
    for row in rows[:MOST_LISTED]:
        attributes.append(f' id="case-{row["folder"]}"' + (' class="failed"' if row["error"] else ""))
        lines.append([text(row["case"]), row["kind"], unit_text(row["unit"] or "", 1),
                      *(number(row[name]) for name in LISTED), links_of(row)])
    more = "" if len(rows) <= MOST_LISTED else (
        f"<p class=quiet>The first {MOST_LISTED:,} of {len(rows):,} cases; all are in tables/cases.csv.</p>\n")
    return '<h2 id="cases">All cases</h2>\n' + more + table(headings, lines, [False] * 3 + [True] * len(LISTED) + [False],
                                                            attributes)


def rows_of(outcome, config):
    folders = {case["name"]: case["folder"] for case in config["cases"]}
    for row in outcome["rows"]:
        known = [row[name] for name in FINDINGS if row[name] is not None]
        yield row | {"folder": folders[row["case"]], "findings": sum(known) if known else None}


def head_section(config, outcome):
    given = " ".join(f"{name} {' '.join(values)}".strip() for name, values in config["given"].items())
    failed = len(outcome["failed"])
    figures = [("Cases", len(outcome["rows"]), ""), ("Complete", outcome["done"], ""),
               ("Failed", failed, " class=failed" if failed else "")]
    boxes = "".join(f"<div{kind}><dt>{words}</dt><dd>{count:,}</dd></div>" for words, count, kind in figures)
    tables = " ".join(f'<a href="tables/{name}.csv">{name}.csv</a>' for name in ("cases", "branches", "statistics", "failed"))
    return (f'<h1>Cohort {text(Path(config["root"]).name)}</h1>\n'
            f'<p class="quiet">ramus {text(config["version"])} · options: {text(given or "as usual")}</p>\n'
            f'<dl class="figures">{boxes}</dl>\n<nav>{tables}</nav>\n')


def main():
    config = cohort.load_config()
    outcome = json.loads(Path("tables/outcome.json").read_text(encoding="utf-8"))
    rows = list(rows_of(outcome, config))
    style = Path(__file__).with_name("page.css").read_text(encoding="utf-8")
    body = (head_section(config, outcome) + failed_section(outcome["failed"]) + plots_section(rows, outcome["statistics"])
            + worst_section(rows) + statistics_section(outcome["statistics"]) + cases_section(rows))
    cohort.write_whole("index.html", (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f'<title>Cohort {text(Path(config["root"]).name)}</title>\n<style>\n{style}</style></head><body>\n{body}</body></html>\n'))


if __name__ == "__main__":
    main()
