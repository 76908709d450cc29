"""Installs ramus into a folder of its own, moves that elsewhere, and runs what is there: it must find its files from
where it is, and the desktop's files must be right.

Usage: install_test.py CMAKE BUILD_FOLDER
"""

import json
import os
import shutil
import sys
import tempfile
import xml.etree.ElementTree
from pathlib import Path

from checks import check, run

sys.path.insert(0, str(Path(__file__).parent.parent / "journey"))
from screen import Screen, Window, missing_tools


def main():
    cmake, build = sys.argv[1:]
    with tempfile.TemporaryDirectory(prefix="ramus-install-") as name:
        folder = Path(name)
        installed = run(cmake, "--install", build, "--prefix", folder / "first")
        check(installed.returncode == 0, "it installs " + installed.stderr.strip())
        prefix = folder / "moved to here"
        shutil.move(folder / "first", prefix)

        # No HOME, no XDG folders, no display; a sanitizer is told what it is told in other tests.
        environment = {"PATH": "/usr/bin:/bin"}
        environment |= {name: value for name, value in os.environ.items() if name.endswith("SAN_OPTIONS")}
        program = prefix / "bin" / "ramus"
        tree = prefix / "share" / "ramus" / "liver_portal_vein.swc"
        info = run(program, "info", tree, "--json", env=environment)
        check(info.returncode == 0 and json.loads(info.stdout)["branches"] > 1000, "the installed program reads the demo tree")
        picture = folder / "demo.png"
        drawn = run(program, "render", tree, "-o", picture, "--size", "160x120", "--method", "cones", env=environment)
        check(drawn.returncode == 0 and picture.stat().st_size > 1000, "and draws it " + drawn.stderr.strip())
        window = run(program, env=environment)
        check(window.returncode == 1 and "display" in window.stderr, "without a display and a home folder it says so")

        # What it opens without a file is the tree beside it, not the one in the sources.
        missing = missing_tools()
        if missing:
            print("not checked which demo tree a window opens; not installed:", ", ".join(missing))
        else:
            screen = Screen(900, 700)
            window = Window(program, screen, folder, ["--size", "800x600"])
            try:
                status = window.wait("the demo tree", lambda s: s["shown"] != "nothing")
                check("/" + status["tree"]["path"].lstrip("/") == str(tree), "the window opens the demo tree beside it")
            finally:
                window.end()
                screen.close()

        share = prefix / "share"
        entry = share / "applications" / "org.ramus.Ramus.desktop"
        check(entry.is_file(), "there is a desktop entry")
        if shutil.which("desktop-file-validate") is None:
            print("not validated: desktop-file-validate is not installed")
        else:
            verdict = run("desktop-file-validate", entry)
            check(verdict.returncode == 0, "it is valid " + verdict.stdout.strip())
        keys = dict(line.split("=", 1) for line in entry.read_text().splitlines() if "=" in line)
        types = xml.etree.ElementTree.parse(share / "mime" / "packages" / "org.ramus.Ramus.xml").getroot()
        space = "{http://www.freedesktop.org/standards/shared-mime-info}"
        named = {kind.get("type"): kind.find(space + "glob").get("pattern") for kind in types.iter(space + "mime-type")}
        known = {"application/x-swc": "*.swc", "application/x-ramus-session": "*.ramus.json"}
        check(known.items() <= named.items() and all(named.values()), "file types have patterns")
        check(set(named) <= set(filter(None, keys["MimeType"].split(";"))), "and the entry opens them")
        icons = share / "icons" / "hicolor"
        for icon in ("scalable/apps/org.ramus.Ramus.svg", "48x48/apps/org.ramus.Ramus.png", "128x128/apps/org.ramus.Ramus.png"):
            check((icons / icon).is_file() and keys["Icon"] == Path(icon).stem, "the icon " + icon)
        check("ramus" in (share / "man" / "man1" / "ramus.1").read_text(), "there is a manual page")
    return 0


if __name__ == "__main__":
    sys.exit(main())
