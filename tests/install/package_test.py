"""Makes the Debian package, unpacks it without installing it, and looks at what is in it.

Usage: package_test.py CPACK BUILD_FOLDER
"""

import gzip
import re
import shutil
import sys
import tempfile
from pathlib import Path

from checks import check, run
from hardened_test import check_program


def main():
    cpack, build = sys.argv[1:]
    missing = [tool for tool in ("dpkg-deb", "dpkg-shlibdeps", "file", "readelf") if shutil.which(tool) is None]
    if missing:
        print("SKIPPED: not installed:", ", ".join(missing))
        return 77
    with tempfile.TemporaryDirectory(prefix="ramus-package-") as name:
        folder = Path(name)
        packed = run(cpack, "--config", Path(build) / "CPackConfig.cmake", "-B", folder)
        check(packed.returncode == 0, "it is packed " + packed.stderr.strip()[-400:])
        (package,) = folder.glob("ramus_*.deb")
        fields = dict(line.split(": ", 1) for line in run("dpkg-deb", "--field", package).stdout.splitlines() if re.match(r"[A-Z]", line))
        check(fields["Package"] == "ramus" and "<" in fields["Maintainer"], "it says what it is, and whose")
        # Those that the program is linked with, and those that it opens by their names.
        for library in ("libc6", "libglfw3", "libtbb12", "libhdf5", "libosmesa6", "libgl1"):
            check(library in fields["Depends"], "it depends on " + library)
        check(re.search(r"\bg\+\+|-dev\b", fields["Depends"]) is None, "and on nothing to compile with")

        files = folder / "files"
        check(run("dpkg-deb", "--extract", package, files).returncode == 0, "it can be unpacked")
        program = files / "usr" / "bin" / "ramus"
        tree = files / "usr" / "share" / "ramus" / "liver_portal_vein.swc"
        info = run(program, "info", tree, "--json", env={"PATH": "/usr/bin:/bin"})
        check(info.returncode == 0 and '"branches"' in info.stdout, "the program in it reads the demo tree " + info.stderr)
        check_program(program)
        doc = files / "usr" / "share" / "doc" / "ramus"
        check("Permission is hereby granted" in (doc / "copyright").read_text(), "it has the licence")
        version = fields["Version"]
        check(gzip.open(doc / "changelog.Debian.gz", "rt").readline().startswith("ramus (" + version + ")"), "and its changes")
        manual = gzip.open(files / "usr" / "share" / "man" / "man1" / "ramus.1.gz", "rt").read().replace("\\", "")
        listed = run(program, "--help").stdout.split("Subcommands:")[1]
        commands = re.findall(r"^  ([a-z]+) ", listed, re.MULTILINE)
        unknown = [command for command in commands if f"ramus {command}" not in manual]
        check(len(commands) > 5 and not unknown, "the manual page names every command " + " ".join(unknown))
        writable = [path for path in files.rglob("*") if not path.is_symlink() and path.stat().st_mode & 0o022]
        check(not writable, "only its owner may change a file")
    return 0


if __name__ == "__main__":
    sys.exit(main())
