"""What the scripts of the workflow share: the configuration, the records of steps, and how files are written.

A case is a tree or a mask of config.json. Its steps run in the order of STEPS; each leaves a record, cases/CASE/STEP.json:

    key      digest of what the step depends on
    state    "done"; "failed": ramus refused the case; "killed": a signal ended ramus; "left out": an earlier step has no result
    command  the command line, to repeat the step by hand
    message  what ramus said of a failure
    result   what the command printed with --json
"""

import hashlib
import json
import os
from pathlib import Path

STEPS = ("skeletonize", "measure", "validate", "picture")


def digest(value):
    """The same for equal values on every machine."""
    return hashlib.sha256(json.dumps(value, sort_keys=True).encode()).hexdigest()[:16]


def load_config():
    return json.loads(Path("config.json").read_text(encoding="utf-8"))


def steps_of(case):
    return STEPS if case["kind"] == "mask" else STEPS[1:]


def step_before(case, step):
    """The step whose result this one needs; none for the first."""
    steps = steps_of(case)
    if step == steps[0]:
        return None
    return "skeletonize" if step == "measure" else "measure"


def record_path(case, step):
    return f"cases/{case['folder']}/{step}.json"


def options_of(config, case, step):
    return config["options"][case["kind"]][step]


def key_of(config, case, step):
    """Changes with everything that changes the result of a step. A mask's skeleton is part of its later steps."""
    parts = [config["version"], case["sha256"], case["relative"], options_of(config, case, step)]
    if case["kind"] == "mask" and step != "skeletonize":
        parts.append(options_of(config, case, "skeletonize"))
    if step == "picture":
        parts.append(config["size"])
    return digest(parts)


def read_record(case, step):
    return json.loads(Path(record_path(case, step)).read_text(encoding="utf-8"))


def write_whole(path, content):
    """Writes the bytes or the text completely, or leaves what was there."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        with open(part, "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode("utf-8"))
            file.flush()
            os.fsync(file.fileno())
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


def number_text(value):
    """Nine digits, as in all tables of ramus; empty for what is not known."""
    if value is None:
        return ""
    return str(value) if isinstance(value, int) else format(value, ".9g")


def csv_text(columns, rows):
    """CSV by RFC 4180. Words that spreadsheets would take for formulas get an apostrophe, which marks text."""

    def field(value):
        if value is None or isinstance(value, (int, float)):
            return number_text(value)
        formula = len(value) > 1 and value[0] in "=+-@\t\r\n"
        if not formula and not any(letter in value for letter in ',;\t"\r\n'):
            return value
        return '"' + ("'" if formula else "") + value.replace('"', '""') + '"'

    lines = [",".join(field(value) for value in row) for row in [columns, *rows]]
    return "".join(line + "\r\n" for line in lines)
