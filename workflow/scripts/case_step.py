"""Runs one step of one case, and leaves its record.

Usage: case_step.py STEP CASE KEY THREADS, in the folder of the cohort.

The exit status is 0 whenever there is a record, also of a failure. An interrupt leaves none, so the step runs again.
"""

import ctypes
import fcntl
import json
import shlex
import signal
import subprocess
import sys
from pathlib import Path

import cohort

END_WITH_PARENT = 1  # PR_SET_PDEATHSIG of prctl(2)
LIBC = ctypes.CDLL(None)


def end_with_parent():
    LIBC.prctl(END_WITH_PARENT, signal.SIGTERM)


def words_of(config, case, step):
    """The command line of the step. Paths are absolute or begin with "cases/", so that no name is taken for an option."""
    folder = f"cases/{case['folder']}"
    tree = f"{folder}/tree.json" if case["kind"] == "mask" else case["file"]
    words = {
        "skeletonize": ["skeletonize", case["file"], "-o", f"{folder}/tree.json", "--json"],
        "measure": ["info", tree, "--json", "--branches"],
        "validate": ["validate", tree, "--json"],
        "picture": ["render", tree, "-o", f"{folder}/picture.png", "--size", config["size"], "--json"],
    }[step]
    if step == "validate" and case["kind"] == "mask" and config["compares_masks"]:
        words += ["--mask", case["file"]]
    return [config["program"], *words, *cohort.options_of(config, case, step)]


def limits_of(config, step, threads):
    """How much of the machine the step may use. No part of the record, because results do not depend on it."""
    memory = ["--memory", str(config["memory_bytes"])] if config["memory_bytes"] and step != "measure" else []
    return memory + (["--threads", str(threads)] if step in ("validate", "picture") else [])


def complaint(text):
    """The error of a command: its last line; lines before it are warnings."""
    lines = [line for line in text.splitlines() if line.strip()]
    return lines[-1].removeprefix("ramus: ") if lines else "ramus failed without a message"


def run(words):
    """The state, message and result of a command."""
    done = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, preexec_fn=end_with_parent, check=False)
    said = done.stderr.decode("utf-8", "replace")
    if done.returncode < 0:
        name = signal.Signals(-done.returncode).name
        return {"state": "killed", "message": f"ramus was ended by {name}; where memory was short, give fewer --cores"}
    if done.returncode != 0:
        message = complaint(said)
        return {"state": "killed" if message.startswith("cancelled") else "failed", "message": message}
    return {"state": "done", "result": json.loads(done.stdout)}


def write_branches(case, result):
    """cases/CASE/branches.csv, a row for each branch."""
    columns = ("case", "branch", "parent", "generation", "strahler", "length", "diameter_min", "diameter_mean",
               "diameter_max", "first_x", "first_y", "first_z", "last_x", "last_y", "last_z", "unit")
    rows = [
        [case["name"], branch["id"], branch["parent"], branch.get("generation"), branch.get("strahler"), branch["length"],
         *(branch["diameter"][name] for name in ("min", "mean", "max")), *branch["first"], *branch["last"], result["unit"]]
        for branch in result["branch_list"]
    ]
    cohort.write_whole(f"cases/{case['folder']}/branches.csv", cohort.csv_text(columns, rows))


def record_of(config, case, step, threads):
    words = words_of(config, case, step)
    record = {"command": shlex.join(words)}
    before = cohort.step_before(case, step)
    if before and cohort.read_record(case, before)["state"] != "done":
        return record | {"state": "left out", "message": f"there is no result of the step before, {before}"}
    record |= run(words + limits_of(config, step, threads))
    if step == "measure" and record["state"] == "done":
        write_branches(case, record["result"])
    return record


def main():
    step, folder, key, threads = sys.argv[1:]
    config = cohort.load_config()
    case = next(case for case in config["cases"] if case["folder"] == folder)
    Path("cases", folder).mkdir(parents=True, exist_ok=True)
    # A step that outlived a killed run may still be at work on this case.
    with open(Path("cases", folder, ".lock"), "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        made = {"skeletonize": ["tree.json"], "measure": ["branches.csv"], "picture": ["picture.png"]}
        for name in made.get(step, []):
            Path("cases", folder, name).unlink(missing_ok=True)  # of another input
        record = {"key": key} | record_of(config, case, step, int(threads))
        cohort.write_whole(cohort.record_path(case, step), json.dumps(record, indent=1) + "\n")


if __name__ == "__main__":
    main()
