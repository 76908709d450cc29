"""What a person measures by eye: the scale bar holds for what the pointer is on, at every zoom and depth, and says so; the
wheel comes near what is under the pointer and never passes it; turning and moving keep hold of it; and where nothing is in
view the window leads back.

Usage: scale_journey.py PROGRAM
"""

import json
import math
import sys
import time

from screen import PATIENCE, Failure, Window, check, click, project, run_journeys

DIAMETER = 2.0  # mm
# Straight vessels across the picture, at three depths (y is toward the eye) and three heights.
DEPTHS = {6: -60, 0: 0, -6: 60}  # by height
PIECES = list(DEPTHS.items())
TREE = "".join(f"{2 * i + 1} 0 -50 {y} {z} 1 -1\n{2 * i + 2} 0 50 {y} {z} 1 {2 * i + 1}\n" for i, (z, y) in enumerate(PIECES))
BACKGROUND = 45  # of 255: nothing behind the vessels is brighter
# A mesh is narrower than its vessel by up to 2 % at the usual detail, and by a thousandth at 72.
# So far away that the side of a vessel that is seen is hardly nearer than its middle (a hundredth at most).
CAMERA = {"position": [0, 900, 0], "focal_point": [0, 0, 0], "view_up": [0, 0, 1], "view_angle": 1.7}


def rows_of(pixels, width):
    return [pixels[at:at + 3 * width] for at in range(0, len(pixels), 3 * width)]


def thickness(window, at, reach):
    """Of the vessel under a pixel of the screen, up and down, in pixels: the middle one of some columns beside the pointer,
    whose tooltip lies at its other side."""
    columns = 15
    rows = rows_of(window.pixels(at[0] - columns, at[1] - reach, columns, 2 * reach + 1), columns)
    found = []
    for column in range(columns):
        ink = [max(row[3 * column:3 * column + 3]) for row in rows]
        way_up, way_down = length_of(ink[reach::-1]), length_of(ink[reach:])
        found.append(way_up + way_down - 1)
    return sorted(found)[columns // 2]


def length_of(ink):
    """From the first on, as far as it is brighter than the background; the last one is covered in part."""
    end = next((i for i, value in enumerate(ink) if value <= BACKGROUND), len(ink))
    if not 2 <= end < len(ink):
        return end
    ground = ink[end]
    return end - 1 + min(1.0, (ink[end - 1] - ground) / max(1, ink[end - 2] - ground))


def bar_in_picture(window, status):
    """The scale bar's length in pixels of the screen: the longest run of white in the lower left corner."""
    x, y, width, height = status["viewport"]
    rows = rows_of(window.pixels(x, y + height - 90, 260, 90), 260)
    longest = 0
    for row in rows:
        run = 0
        for at in range(0, len(row), 3):
            run = run + 1 if min(row[at:at + 3]) > 200 else 0
            longest = max(longest, run)
    return longest


def point(window, status, place):
    """At a place on the vessel of its height."""
    at = project(status, place)
    window.xdotool("mousemove", *at)
    window.wait("the vessel under the pointer", lambda s: s["hovered"] == list(DEPTHS).index(place[2]) and s["scale_bar"] and
                s["scale_bar"]["at"] == "pointer")
    return at


def measure(window, height):
    """The bar against the vessel at this height, at five zooms about it."""
    y = DEPTHS[height]
    status = window.status()
    at = point(window, status, [0, y, height])
    ratios = []
    for zoom in range(5):
        if zoom:
            before = window.status()["scale_bar"]
            for _ in range(3):
                window.xdotool("click", 4)
            window.wait("the wheel", lambda s: s["scale_bar"] and s["scale_bar"] != before)
        status = window.wait("the bar", lambda s: s["scale_bar"] and s["scale_bar"]["at"] == "pointer")
        bar = status["scale_bar"]
        drawn = bar_in_picture(window, status)
        check(abs(drawn - bar["pixels"]) <= 1.0, f"the bar of {bar['mm']:g} mm is drawn {drawn} pixels long, as it should")
        seen = thickness(window, at, 190)
        ratios.append(seen * bar["mm"] / bar["pixels"] / DIAMETER)
        check(abs(ratios[-1] - 1.0) <= 0.02,
              f"zoom {zoom}, {-y} mm behind the middle: {seen:.1f} pixels measure {ratios[-1] * DIAMETER:.3f} mm of 2")


def known_vessels(program, screen, folder):
    tree = folder / "vessels.swc"
    tree.write_text(TREE)
    session = folder / "vessels.ramus.json"
    session.write_text(json.dumps({"version": 1, "tree": {"path": "vessels.swc"}, "camera": CAMERA,
                                   "options": {"detail": 72}}))
    window = Window(program, screen, folder, ["--session", session, "--size", "1200x800"])
    try:
        window.wait("the surface", lambda s: s["surface_ready"] and s["scale_bar"])
        for height in DEPTHS:
            measure(window, height)
            for _ in range(12):
                window.xdotool("click", 5)
            window.wait("all of it again", lambda s: s["camera"]["position"][1] > 800)
    finally:
        window.end()


def while_held(window, what, condition):
    """As Window.wait(), of a window that does not rest because a button is down."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        status = window.status()
        if condition(status):
            return status
        time.sleep(0.02)
    raise Failure(f"waited {PATIENCE} s for: {what}\n{json.dumps(window.status())}")


def depth_to(status, place):
    camera = status["camera"]
    way = [f - p for f, p in zip(camera["focal_point"], camera["position"])]
    length = math.sqrt(sum(w * w for w in way))
    return sum(w * (a - p) for w, a, p in zip(way, place, camera["position"])) / length


def reaching(program, screen, folder):
    tree = folder / "vessels.swc"
    tree.write_text(TREE.replace(" 1 -1", " 4 -1").replace(" 1 1\n", " 4 1\n").replace(" 1 3\n", " 4 3\n").replace(" 1 5\n", " 4 5\n"))
    window = Window(program, screen, folder, [tree, "--size", "1100x760"])
    try:
        status = window.wait("the surface", lambda s: s["surface_ready"] and s["scale_bar"])
        check(status["scale_bar"]["at"] == "middle", "with the pointer elsewhere the bar is of the middle")
        whole = status["camera"]
        front = [10, DEPTHS[-6] + 4, -6]  # where the thick vessel is nearest to the eye
        at = point(window, status, front)

        for _ in range(60):
            window.xdotool("click", 4)
        status = window.wait("the end of the way", lambda s: depth_to(s, front) < 2.0)
        check(status["camera"]["position"][1] > front[1] + 0.5, "sixty notches of the wheel end before the vessel")
        check(status["scale_bar"]["at"] == "pointer" and not status["nothing_in_view"], "and it is still under the pointer")
        x, y, width, height = status["viewport"]
        seen = window.pixels(x + 20, y + 310, 260, 260)  # below the panel, and beside the tooltip
        ground = sum(1 for i in range(0, len(seen), 3) if max(seen[i:i + 3]) < 40)
        check(ground == 0, "its wall has no hole though the eye is that near")

        for _ in range(60):
            window.xdotool("click", 5)
        status = window.wait("far away", lambda s: depth_to(s, front) > 500)
        window.xdotool("key", "f")
        status = window.wait("fit", lambda s: abs(s["camera"]["position"][1] - whole["position"][1]) < 1.0)

        at = point(window, status, front)
        window.xdotool("mousedown", 1, "mousemove", at[0] + 60, at[1] + 10, "mousemove", at[0] + 120, at[1] + 30)
        status = while_held(window, "the turn", lambda s: s["camera"]["position"][0] != whole["position"][0] and
                             s["scale_bar"] and s["scale_bar"]["at"] == "pivot")
        now = project(status, front)
        check(max(abs(a - b) for a, b in zip(now, at)) <= 2, "the view turns about what was pressed, and the bar is of it")
        window.xdotool("mouseup", 1)
        status = window.wait("no drag", lambda s: not s["scale_bar"] or s["scale_bar"]["at"] != "pivot")

        at = point(window, status, front)
        window.xdotool("mousedown", 2, "mousemove", at[0] - 50, at[1] + 20, "mousemove", at[0] - 150, at[1] + 70)
        status = while_held(window, "the move", lambda s: abs(project(s, front)[0] - at[0] + 150) <= 2 and s["scale_bar"])
        check(abs(project(status, front)[1] - at[1] - 70) <= 2, "what is pressed moves with the pointer")
        check(status["scale_bar"]["at"] == "pointer", "and the bar stays of it")
        window.xdotool("mouseup", 2)

        window.xdotool("key", "o")
        status = window.wait("parallel", lambda s: s["camera"]["orthographic"] and s["scale_bar"]["at"] == "everywhere")
        check(True, "in parallel projection the bar holds everywhere")
        window.xdotool("key", "o")
        window.wait("perspective", lambda s: not s["camera"]["orthographic"])

        empty = (x + width - 60, y + 120)
        window.xdotool("mousemove", *empty, "mousedown", 2)
        for step in range(1, 9):
            window.xdotool("mousemove", empty[0] - 80 * step, empty[1])
        window.xdotool("mouseup", 2, "mousemove", *empty, "mousedown", 2)
        for step in range(1, 9):
            window.xdotool("mousemove", empty[0] - 80 * step, empty[1])
        window.xdotool("mouseup", 2)
        status = window.wait("nothing in view", lambda s: s["nothing_in_view"])
        check(status["scale_bar"] is None, "where nothing is in view there is no bar")
        click(window, "Brings all of it back into the picture")
        status = window.wait("all in view", lambda s: not s["nothing_in_view"] and s["scale_bar"])
        check(True, "and a button that brings all of it back")
    finally:
        window.end()


if __name__ == "__main__":
    sys.exit(run_journeys(known_vessels, reaching, size=(1300, 900)))
