#!/usr/bin/env python3
"""Runs clang-tidy on every source that a build with clang++ compiles, and prints what it finds.

    scripts/lint/tidy.py BUILD [PART]     only sources whose path has PART in it

A source that was clean is left out until it, a file of ours that it includes, the rules or clang-tidy change. Exit status
1 when anything was found.
"""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import shlex
import subprocess
import sys

TOP = pathlib.Path(__file__).resolve().parents[2]
# SIMD sources compile themselves once for each instruction set; one will do.
ONE_INSTRUCTION_SET = ["-march=haswell", "-DHWY_COMPILE_ONLY_STATIC"]
# A test says all of its story; a benchmark ends by an exception, and its loops have a variable for nothing.
TESTS_LEFT_OUT = ("-readability-function-size,-bugprone-unchecked-optional-access,-bugprone-exception-escape,"
                  "-clang-analyzer-deadcode.DeadStores")


def output_of(command, folder):
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True).stdout


def digest(paths, salt):
    text = hashlib.sha256(salt.encode())
    for path in sorted(paths):
        text.update(path.encode() + pathlib.Path(path).read_bytes())
    return text.hexdigest()


def our_files(entry):
    """What the source includes that is no system header, itself too."""
    command = [word for word in shlex.split(entry["command"]) if not word.endswith("ccache")]
    del command[command.index("-o"):command.index("-o") + 2]
    rule = output_of(command + ["-MM"], entry["directory"])
    paths = shlex.split(rule.replace("\\\n", " "))[1:]
    return [os.path.normpath(os.path.join(entry["directory"], path)) for path in paths]


def check(build, entry, salt):
    """What clang-tidy has to say of one source; nothing when that is known to be clean."""
    source = entry["file"]
    stamp = build / "tidy" / hashlib.sha256(source.encode()).hexdigest()
    salt += entry["command"]
    if stamp.exists():
        known = json.loads(stamp.read_text())
        if all(map(os.path.exists, known["files"])) and digest(known["files"], salt) == known["digest"]:
            return ""
    command = ["clang-tidy", "-p", str(build), "--quiet", source]
    command += [f"--extra-arg={flag}" for flag in ONE_INSTRUCTION_SET]
    if "_tests.dir/" in entry["command"] or "/tests/" in source:
        command.append(f"--checks={TESTS_LEFT_OUT}")
    run = subprocess.run(command, cwd=TOP, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        return run.stdout or run.stderr
    files = our_files(entry)
    stamp.parent.mkdir(exist_ok=True)
    stamp.write_text(json.dumps({"files": files, "digest": digest(files, salt)}))
    return ""


def concerns(entry, part):
    """Whether the source, or one of the group that it is, has `part` in its path; generated ones are not there yet."""
    source = pathlib.Path(entry["file"])
    if source.suffix not in (".cpp", ".cxx") or not source.exists():
        return False
    return part in (source.read_text() if source.parent.name == "Unity" else str(source.relative_to(TOP)))


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    part = sys.argv[2] if len(sys.argv) > 2 else ""
    entries = [entry for entry in json.loads((build / "compile_commands.json").read_text()) if concerns(entry, part)]
    salt = output_of(["clang-tidy", "--version"], TOP)
    salt += (TOP / ".clang-tidy").read_text() + pathlib.Path(__file__).read_text()
    status = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for findings in concurrent.futures.as_completed([pool.submit(check, build, entry, salt) for entry in entries]):
            if findings.result():
                print(findings.result(), flush=True)
                status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
