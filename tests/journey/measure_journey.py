"""Measures what is clicked: a distance, a path, an angle and a diameter between the very places; the value before the
click; an end that is dragged, and undone in one step; the size of a lesion typed.

Usage: measure_journey.py PROGRAM
"""

import math
import re
import sys

from screen import SMALL_TREE, Window, check, click, drag, project, run_journeys

PIXEL = 0.3  # mm, about what one is at this zoom; a click cannot be surer


def value(words):
    return float(re.search(r": ([0-9.,]+)", words).group(1).replace(",", ""))


def press(window, at):
    window.xdotool("mousemove", *at)
    window.xdotool("click", 1)


def tool(window, name, key=None):
    if key:
        window.xdotool("key", key)
    else:
        click(window, name)
    wanted = name if key else name.lower()
    return window.wait(f"the tool {name}", lambda s: wanted in s["tool"])


def distance(window):
    tool(window, "measure-distance", "m")
    status = window.status()
    # Along the trunk, whose surface is a straight tube of 10 mm.
    ends = [project(status, place) for place in ([0, 5, -35], [0, 5, -15])]
    press(window, ends[0])
    window.xdotool("mousemove", *ends[1])
    status = window.wait("the value before the click", lambda s: s["tool_texts"])
    before = status["tool_texts"][0]
    press(window, ends[1])
    status = window.wait("the distance", lambda s: len(s["measured"]) == 1)
    found = value(status["measured"][0])
    check(abs(found - 20.0) < 3 * PIXEL, f"a distance is from point to point: {found} of 20 mm")
    check(before == f"Distance {found:.1f} mm", f"and was told before the click: {before}")
    points = status["measurements"][0]["points"]
    check(abs(points[0][2] + 35) < 2 * PIXEL and abs(points[1][2] + 15) < 2 * PIXEL, "its ends are what was clicked")


def path(window):
    tool(window, "measure-path", "shift+m")
    status = window.status()
    press(window, project(status, [0, 5, -30]))
    press(window, project(status, [-30, 3, 20]))
    status = window.wait("the path", lambda s: len(s["measured"]) == 2)
    # Up the trunk, along the first half of the left branch, and half of its second piece.
    length = 30 + math.hypot(20, 15) + math.hypot(10, 5)
    found = value(status["measured"][1])
    check(abs(found - length) < 6 * PIXEL, f"a path runs from foot to foot: {found} of {length:.1f} mm")
    return length


def drag_an_end(window, length):
    status = window.status()
    before = status["measurements"]
    start, end = project(status, [0, 0, -30]), project(status, [0, 5, -20])
    drag(window, [start, ((start[0] + end[0]) // 2, (start[1] + end[1]) // 2), end], end=False)
    status = window.wait("the value on the way", lambda s: s["tool_texts"])
    told = status["tool_texts"][0]
    window.xdotool("mouseup", 1)
    status = window.wait("the path from elsewhere", lambda s: s["measurements"] != before)
    found = value(status["measured"][1])
    check(told == f"Path {found:.1f} mm", f"while an end is dragged its value is told: {told}")
    check(abs(found - (length - 10)) < 6 * PIXEL, f"the path is as much shorter as the end was moved: {found} mm")
    check(len(status["measured"]) == 2 and status["undo"].startswith("measure"), "it is one step")
    window.xdotool("key", "ctrl+z")
    window.wait("the path as it was", lambda s: s["measurements"] == before)
    window.xdotool("key", "ctrl+shift+z")
    window.wait("the path from elsewhere again", lambda s: s["measurements"] != before)
    check(True, "undo and redo cover it")


def diameter_and_angle(window):
    window.xdotool("key", "b")
    window.wait("the planning half", lambda s: s["planning"])
    click(window, "Diameter at a place")
    window.wait("the tool", lambda s: s["tool"] == "measure-diameter")
    status = window.status()
    at = project(status, [-10, 4, 7.5])
    window.xdotool("mousemove", *at)
    status = window.wait("the diameter under the pointer", lambda s: s["tool_texts"])
    told = status["tool_texts"][0]
    window.xdotool("click", 1)
    status = window.wait("the diameter", lambda s: len(s["measured"]) == 3)
    found = value(status["measured"][2])
    check(abs(found - 8.5) < 0.2 and told == f"Diameter {found:.2f} mm", f"a diameter is that of its place: {found} mm")
    click(window, "Angle between three places")
    window.wait("the tool", lambda s: s["tool"] == "measure-angle")
    for place in ([0, 5, -20], [0, 5, 0], [-16, 4, 12]):
        press(window, project(window.status(), place))
    status = window.wait("the angle", lambda s: len(s["measured"]) == 4)
    wanted = 180 - math.degrees(math.atan2(20, 15))
    found = value(status["measured"][3])
    check(abs(found - wanted) < 6, f"an angle is at the second of three places: {found} of {wanted:.0f} degrees")


def typed(window):
    x, y, width, height = window.status()["viewport"]
    window.xdotool("key", "shift+l")
    window.wait("the tool for lesions", lambda s: s["tool"] == "lesion")
    press(window, project(window.status(), [40, 6, 27]))
    window.wait("a lesion", lambda s: len(s["lesions"]) == 1)
    click(window, "Diameter of lesion 1; Enter takes it")
    window.wait("the field", lambda s: s["typing"])
    window.xdotool("key", "ctrl+a")
    window.xdotool("type", "12.5")
    window.xdotool("key", "Return")
    status = window.wait("the typed size", lambda s: s["lesions"] and s["lesions"][0][3] == 6.25)
    check(True, "the diameter of a lesion is typed")
    click(window, "Vessels of a smaller mean diameter")
    window.wait("the field", lambda s: s["typing"])
    window.xdotool("key", "ctrl+a")
    window.xdotool("type", "5.5")
    window.xdotool("key", "Return")
    click(window, "Makes the vessels below this diameter grey glass")
    status = window.wait("thin vessels of glass", lambda s: s["states"]["defocused"])
    check(sorted(status["states"]["defocused"]) == [3, 4], "so is the diameter below which vessels become glass")


def journey(program, screen, folder):
    (folder / "small tree.swc").write_text(SMALL_TREE)
    window = Window(program, screen, folder, ["small tree.swc", "--units", "mm", "--orientation", "RAS",
                                              "--size", "1200x1180"])
    try:
        window.wait("the surface", lambda s: s["surface_ready"])
        distance(window)
        length = path(window)
        drag_an_end(window, length)
        diameter_and_angle(window)
        typed(window)
        window.shot("measure")
    finally:
        window.end()


if __name__ == "__main__":
    sys.exit(run_journeys(journey, size=(1240, 1220)))
