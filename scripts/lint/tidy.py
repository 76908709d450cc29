#!/usr/bin/env python3
"""Runs clang-tidy on every source that a build with clang++ compiles, and prints what it finds.

    scripts/lint/tidy.py BUILD [PART]     only sources whose path has PART in it

A source that was clean is left out until it, a file of ours that it includes, the rules or clang-tidy change. The others
are checked several at a time: the headers of the system take most of the time of a source, 6 of 8 seconds for a small one,
and clang-tidy looks at all of them. What is found in a batch is looked for in each of its sources, and reported of these
alone. Exit status 1 when anything was found.
"""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

TOP = pathlib.Path(__file__).resolve().parents[2]
# SIMD sources compile themselves once for each instruction set; one will do.
ONE_INSTRUCTION_SET = ["-march=haswell", "-DHWY_COMPILE_ONLY_STATIC"]
# A test says all of its story; a benchmark ends by an exception, and its loops have a variable for nothing.
TESTS_LEFT_OUT = ("-readability-function-size,-bugprone-unchecked-optional-access,-bugprone-exception-escape,"
                  "-clang-analyzer-deadcode.DeadStores")
LARGEST_BATCH = 400_000  # bytes of source: larger ones would be the last to end


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


def is_group(source):
    """Whether CMake wrote the source, which then includes files of one folder."""
    return pathlib.Path(source).parent.name == "Unity"


def text_of(source):
    text = pathlib.Path(source).read_text()
    if not is_group(source):
        return text
    return "".join(pathlib.Path(path).read_text() for path in re.findall('#include "(.*)"', text))


def own_names(text):
    """Names that the files keep for themselves, in namespaces without a name: two files with one of them do not go together."""
    names, inside = set(re.findall(r"constexpr .*?\b(k[A-Z]\w*)\s*[={]", text)), False  # a local constant would shadow
    for line in text.splitlines():
        if line.startswith("namespace {"):
            inside = True
        elif line.startswith("} // namespace"):
            inside = False
        elif inside and line[:1].isalpha():
            kind = re.match(r"(?:template\s*<.*?>\s*)?(?:struct|class|enum class|enum|using)\s+(\w+)", line)
            other = kind or re.match(r".*?\b(\w+)\s*(?:\(|=|\{|;)", line)
            names.update([other[1]] if other else [])
    return names


def flags_of(entry):
    """The command without what is of this source alone."""
    command = [word for word in shlex.split(entry["command"]) if word not in (entry["file"], entry.get("output"))]
    return tuple(re.sub(r"\.o(\.d)?$", "", word) if "Unity" not in word else "" for word in command)


def batches_of(entries):
    """Entries in lists that clang-tidy can take as one source; those with most to read first."""
    batches = []
    for entry in sorted(entries, key=lambda entry: -len(text_of(entry["file"]))):
        text = text_of(entry["file"])
        names = own_names(text)
        for batch in batches:
            if (is_group(entry["file"]) and batch["flags"] == flags_of(entry) and names.isdisjoint(batch["names"])
                    and batch["bytes"] + len(text) <= LARGEST_BATCH):
                batch["entries"].append(entry)
                batch["names"] |= names
                batch["bytes"] += len(text)
                break
        else:
            batches.append({"entries": [entry], "names": names, "bytes": len(text),
                            "flags": flags_of(entry) if is_group(entry["file"]) else None})
    return [batch["entries"] for batch in batches]


def stamp_of(build, entry):
    return build / "tidy" / hashlib.sha256(entry["file"].encode()).hexdigest()


def is_clean(build, entry, salt):
    stamp = stamp_of(build, entry)
    if not stamp.exists():
        return False
    known = json.loads(stamp.read_text())
    return (all(map(os.path.exists, known["files"])) and
            digest(known["files"], salt + entry["command"]) == known["digest"])


def findings_in(build, source, command):
    """What clang-tidy says of a source that is compiled by this command."""
    words = ["clang-tidy", "-p", str(build), "--quiet", source]
    words += [f"--extra-arg={flag}" for flag in ONE_INSTRUCTION_SET]
    if "_tests.dir/" in command or "/tests/" in source:
        words.append(f"--checks={TESTS_LEFT_OUT}")
    run = subprocess.run(words, cwd=TOP, capture_output=True, text=True, check=False)
    return "" if run.returncode == 0 else run.stdout or run.stderr


def check(build, entry, salt):
    """What clang-tidy has to say of one source."""
    found = findings_in(build, entry["file"], entry["command"])
    if not found:
        remember(build, entry, salt)
    return found


def remember(build, entry, salt):
    files = our_files(entry)
    stamp_of(build, entry).write_text(
        json.dumps({"files": files, "digest": digest(files, salt + entry["command"])}))


def check_batch(build, entries, salt):
    """What clang-tidy has to say of some sources."""
    if len(entries) > 1:
        name = hashlib.sha256("\n".join(entry["file"] for entry in entries).encode()).hexdigest()
        folder = build / "tidy" / f"batch-{name[:16]}"
        folder.mkdir(exist_ok=True)
        source = folder / "batch.cxx"
        source.write_text("".join(f'#include "{entry["file"]}"\n' for entry in entries))
        command = entries[0]["command"].replace(entries[0]["file"], str(source))
        (folder / "compile_commands.json").write_text(json.dumps(
            [{"directory": entries[0]["directory"], "file": str(source), "command": command}]))
        if not findings_in(folder, str(source), command):
            for entry in entries:
                remember(build, entry, salt)
            return ""
    return "".join(check(build, entry, salt) for entry in entries)


def concerns(entry, part):
    """Whether the source, or one of the group that it is, has `part` in its path; generated ones are not there yet."""
    source = pathlib.Path(entry["file"])
    if source.suffix not in (".cpp", ".cxx") or not source.exists():
        return False
    return part in (source.read_text() if is_group(source) else str(source.relative_to(TOP)))


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    part = sys.argv[2] if len(sys.argv) > 2 else ""
    entries = [entry for entry in json.loads((build / "compile_commands.json").read_text()) if concerns(entry, part)]
    salt = output_of(["clang-tidy", "--version"], TOP)
    salt += (TOP / ".clang-tidy").read_text() + pathlib.Path(__file__).read_text()
    (build / "tidy").mkdir(exist_ok=True)
    batches = batches_of([entry for entry in entries if not is_clean(build, entry, salt)])
    status = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for findings in concurrent.futures.as_completed([pool.submit(check_batch, build, batch, salt) for batch in batches]):
            if findings.result():
                print(findings.result(), flush=True)
                status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
