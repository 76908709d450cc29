"""Looks at programs and object files for what a compiler and a linker do against misuse (cmake/RamusHardening.cmake).

Usage: hardened_test.py FILE [FILE ...]   programs, and archives of object files (.a)
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from checks import check, run

ENDBR64 = b"\xf3\x0f\x1e\xfa"  # where indirect calls may land


def read_elf(what, file):
    return run("readelf", "--wide", what, file).stdout


def needed_libraries(program):
    return re.findall(r"\(NEEDED\).*\[(.+)\]", read_elf("--dynamic", program))


def check_program(program):
    dynamic, symbols = read_elf("--dynamic", program), read_elf("--dyn-syms", program)
    name = program.name
    check("RPATH" not in dynamic and "RUNPATH" not in dynamic, name + " takes libraries from the system alone")
    check(re.search(r"FLAGS_1.*\bPIE\b", dynamic) is not None, name + " is position-independent")
    check("GNU_RELRO" in read_elf("--segments", program) and re.search(r"FLAGS_1.*\bNOW\b", dynamic) is not None,
          name + " has nothing of the linker that can be written")
    check(re.search(r"GNU_STACK.* RW ", read_elf("--segments", program)) is not None, name + " runs no code on its stack")
    check("__stack_chk_fail" in symbols, name + " guards its stack")
    check(re.search(r"\b__\w+_chk\b", symbols) is not None, name + " calls functions that know the size of a buffer")
    if is_x86_64(program):
        check(program.read_bytes().count(ENDBR64) > 1000, name + " marks where indirect calls may land")


def is_x86_64(program):
    return "X86-64" in read_elf("--file-header", program)


def check_archive(archive):
    """What the linker says of a whole program, it says only where all of it has the property; some of Debian's has not."""
    objects = read_elf("--notes", archive).split("\nFile: ")[1:]
    check(objects, archive.name + " has object files")
    unmarked = [one.split("\n")[0] for one in objects if "IBT" not in one or "SHSTK" not in one]
    check(not unmarked, archive.name + " has the processor watch calls and returns " + " ".join(unmarked[:3]))


def check_planted_libraries(program):
    """A folder that somebody else has filled, and the program started in it."""
    with tempfile.TemporaryDirectory(prefix="ramus-planted-") as folder:
        for library in needed_libraries(program):
            (Path(folder) / library).write_text("not a library")
        started = subprocess.run([program.resolve(), "--version"], cwd=folder, capture_output=True, text=True, timeout=60)
        check(started.returncode == 0 and started.stdout.startswith("ramus "),
              "it loads nothing from the folder that it is started in " + started.stderr)


def main():
    if shutil.which("readelf") is None:
        print("SKIPPED: not installed: readelf")
        return 77
    files = [Path(name) for name in sys.argv[1:]]
    programs = [file for file in files if file.suffix != ".a"]
    for program in programs:
        check_program(program)
        if program.name == "ramus":
            check_planted_libraries(program)
    for archive in (file for file in files if file.suffix == ".a"):
        if is_x86_64(programs[0]):
            check_archive(archive)
    return 0


if __name__ == "__main__":
    sys.exit(main())
