#!/usr/bin/env python3
"""`ramus render` through the command line: render_test.py RAMUS FOLDER. Pictures, exit status, messages."""
import json
import os
import struct
import subprocess
import sys

ramus, folder = sys.argv[1:3]
os.makedirs(folder, exist_ok=True)
os.chdir(folder)
for name in os.listdir("."):
    os.remove(name)
with open("tree.swc", "w") as file:
    file.write("1 1 0 0 -20 3 -1\n2 1 0 0 0 2.5 1\n3 1 -15 3 12 1.5 2\n4 1 14 -2 15 1.2 2\n")


def run(*arguments, status=0):
    done = subprocess.run([ramus, "render", *arguments], capture_output=True, text=True)
    assert done.returncode == status, f"{arguments}: exit status {done.returncode}, not {status}\n{done.stderr}"
    return done


def size_of(png):
    with open(png, "rb") as picture:
        head = picture.read(24)
    assert head[:8] == b"\x89PNG\r\n\x1a\n", png
    return struct.unpack(">II", head[16:24])


done = run("tree.swc", "-o", "a.png", "--size", "320x240")
assert size_of("a.png") == (320, 240) and done.stdout == ""
# The same picture again, whatever the number of threads; the camera that it reports makes it once more.
report = json.loads(run("tree.swc", "-o", "b.png", "--size", "320x240", "--threads", "1", "--json").stdout)
assert open("a.png", "rb").read() == open("b.png", "rb").read()
with open("camera.json", "w") as file:
    json.dump(report["camera"], file)
for camera in ("camera.json", json.dumps(report["camera"])):
    run("tree.swc", "-o", "c.png", "--size", "320x240", "--camera", camera, "--reference", "a.png", "--tolerance", "0")
# Another view is another picture: status 3, and the difference beside it.
done = run("tree.swc", "-o", "left.png", "--size", "320x240", "--view", "left", "--reference", "a.png", status=3)
assert size_of("left.difference.png") == (320, 240) and "left.difference.png" in done.stderr
run("tree.swc", "-o", "left.png", "--size", "320x240", "--view", "left", "--reference", "a.png", "--tolerance", "1")
run("tree.swc", "-o", "small.png", "--size", "100x80", "--reference", "a.png", status=3)
for more in (["--method", "cones"], ["--orthographic"], ["--transparent"], ["--view", "superior"]):
    run("tree.swc", "-o", "other.png", "--size", "320x240", *more, "--reference", "a.png", "--tolerance", "0", status=3)
report = json.loads(run("tree.swc", "--size", "160x120", "--benchmark", "3", "--json").stdout)
assert report["frames"] == 3 and report["fps"] > 0
# A machine that is slow at the moment turns it in a hurry: along its centerlines.
assert report["triangles"] > 100 if report["quality"] == "full" else report["cones"] > 0, report
assert report["quality"] in ("full", "interactive") and 0 <= report["difference"] < 20
# While it moves, the picture is hardly another one, of whichever surface: creases of cones and cut ends would be, and
# what is opaque where it sticks out into glass.
subprocess.run([ramus, "grow", "-o", "grown.swc", "--branches", "151"], check=True)
with open("glass.txt", "w") as file:
    file.write("select " + " ".join(str(branch) for branch in range(40)) + "\ndefocus\nselect-none\n")
for most, more in ((0.5, []), (0.5, ["--method", "cones"]), (0.5, ["--width", "2"]), (1.2, ["--commands", "glass.txt"])):
    moving = json.loads(run("grown.swc", "--size", "1280x800", "--benchmark", "2", "--json", *more).stdout)
    print("moving", *more, moving["quality"], "%.2f of 255 from rest" % moving["difference"])
    assert moving["quality"] == "full" or moving["difference"] < most, moving
full = json.loads(run("tree.swc", "--size", "160x120", "--benchmark", "3", "--benchmark-full", "--json").stdout)
assert full["quality"] == "full" and full["difference"] == 0

# Figures: reduced from larger, four views on one sheet, once around.
run("tree.swc", "-o", "fine.png", "--size", "90x60", "--supersample", "3", "--caption", "Küste", "--overlays", "letters,scale")
assert size_of("fine.png") == (90, 60)
run("tree.swc", "-o", "sheet.png", "--size", "161x121", "--sheet", "--overlays", "none")
assert size_of("sheet.png") == (161, 121)
report = json.loads(run("tree.swc", "-o", "turn.png", "--size", "80x60", "--turntable", "4", "--json").stdout)
assert report["pictures"] == [f"turn_00{i}.png" for i in (1, 2, 3, 4)] and not os.path.exists("turn.png")
turns = {open(name, "rb").read() for name in report["pictures"]}
assert len(turns) == 4 and all(size_of(name) == (80, 60) for name in report["pictures"])
assert "too large" in run("tree.swc", "-o", "huge.png", "--size", "9000x3000", "--supersample", "8", status=1).stderr
assert not os.path.exists("huge.png")
for wrong in (["--supersample", "0"], ["--overlays", "cube,hat"], ["--turntable", "1"], ["--turntable", "4", "--sheet"],
              ["--turntable", "4", "--ui"], ["--sheet", "--ui"]):
    run("tree.swc", "-o", "wrong.png", *wrong, status=2)

# Wrong usage.
for wrong in (["--size", "0x10"], ["--size", "100"], ["--size", "99999x99999"], ["--size", "10x10x10"], ["--view", "front"],
              ["--tolerance", "0.1"], ["--camera", "{}", "--view", "left"], ["--method", "magic"]):
    run("tree.swc", "-o", "wrong.png", *wrong, status=2)
run("tree.swc", status=2)
# Failures say where, and leave nothing behind.
for failing, word in ((["missing.swc", "-o", "f.png"], "missing.swc"), (["tree.swc", "-o", "no/such/f.png"], "no/such"),
                      (["tree.swc", "-o", "f.png", "--camera", "{\"position\": 3}"], "position"),
                      (["tree.swc", "-o", "f.png", "--camera", "none.json"], "none.json"),
                      (["tree.swc", "-o", "f.png", "--reference", "tree.swc"], "tree.swc")):
    assert word in run(*failing, status=1).stderr
assert not os.path.exists("f.png") and not os.path.exists("wrong.png")
