"""What is selected, defocused and hidden is counted in the status bar, with the way back; what is selected behind other
vessels is seen through them; glass is no brighter than what is in focus; "Defocus" and then "Defocus others" leave something
in focus; a name is its branch's alone unless it is given to what depends on it.

Usage: states_journey.py PROGRAM
"""

import subprocess
import sys

from screen import SMALL_TREE, Window, check, click, cropped, picture_pixels, project, run_journeys

# A thick vessel in front of a thin one that crosses it; y leads to the front.
CROSSING = """\
1 3 -60 0 0 8 -1
2 3 60 0 0 8 1
3 3 0 -40 -50 4 -1
4 3 0 -40 50 4 3
"""
HIDDEN, FOCUS, NOTHING = ("Shows the hidden branches again", "Brings the defocused branches back into focus",
                          "Selects nothing")


def crossing_tree(count):
    """One vessel in focus, and beside it many, one behind the other."""
    lines, number = ["1 3 -60 0 -40 6 -1", "2 3 -60 0 40 6 1"], 3
    for i in range(count):
        y = -14 * i
        lines += [f"{number} 3 30 {y} -40 6 -1", f"{number + 1} 3 30 {y} 40 6 {number}"]
        number += 2
    return "\n".join(lines) + "\n"


def marks(window):
    window.wait("the tree", lambda s: s["surface_ready"])
    status = window.status()
    check(not any(words in status["controls"] for words in (HIDDEN, FOCUS, NOTHING)), "nothing to say, no marks")
    at = project(status, [-30, 3, 20])
    window.xdotool("mousemove", *at, "click", 1)
    status = window.wait("the left branch", lambda s: len(s["selection"]) == 1 and NOTHING in s["controls"])
    chosen = status["selection"]
    window.xdotool("key", "x")
    window.wait("it is hidden", lambda s: s["states"]["hidden"] == chosen and HIDDEN in s["controls"])
    click(window, NOTHING)
    window.wait("nothing selected", lambda s: s["selection"] == [] and NOTHING not in s["controls"])
    check(True, "what is selected and hidden is counted, and a click deselects")
    window.shot("marks")
    click(window, HIDDEN)
    window.wait("all shown", lambda s: s["states"]["hidden"] == [] and HIDDEN not in s["controls"])
    check(True, "a click brings the hidden back")

    window.xdotool("mousemove", *at, "click", 1)
    window.wait("the left branch", lambda s: s["selection"] == chosen)
    window.xdotool("key", "g")
    window.wait("it is glass", lambda s: s["states"]["defocused"] == chosen and FOCUS in s["controls"])
    window.xdotool("key", "shift+g")
    status = window.wait("the others are glass", lambda s: len(s["states"]["defocused"]) == 4)
    check(chosen[0] not in status["states"]["defocused"], "defocus, then defocus others: what is selected is in focus")
    click(window, FOCUS)
    window.wait("no glass", lambda s: s["states"]["defocused"] == [])
    check(True, "a click brings all of it back into focus")


def names(window):
    window.xdotool("key", "Escape")
    window.wait("nothing selected", lambda s: s["selection"] == [])
    window.xdotool("mousemove", *project(window.status(), [25, 6.5, 20]), "click", 1)
    branch = window.wait("the right branch", lambda s: len(s["selection"]) == 1)["selection"][0]
    window.xdotool("key", "F2")
    window.wait("the field", lambda s: s["rename"] and s["typing"])
    window.xdotool("type", "right")
    window.xdotool("key", "Return")
    status = window.wait("the name", lambda s: s["names"] == {str(branch): "right"})
    check(status["subtree_names"] == [], "a name is its branch's alone")
    window.xdotool("key", "F2")
    window.wait("the field", lambda s: s["rename"])
    click(window, "Branches without a name of their own that depend on it are called so too")
    click(window, "Gives it this name")
    window.wait("the name of the subtree", lambda s: s["subtree_names"] == [branch])
    check(True, "or its subtree's, where that is wanted")


def journey(program, screen, folder):
    (folder / "tree.swc").write_text(SMALL_TREE)
    window = Window(program, screen, folder, ["tree.swc", "--units", "mm", "--orientation", "RAS", "--size", "1180x780"])
    try:
        marks(window)
        names(window)
        check(window.quit() == 0, "it quits")
    finally:
        window.end()


def blue(pixels):
    """How many pixels have the colour of selection."""
    return sum(b > 150 and b > r + 60 for r, b in zip(pixels[0::3], pixels[2::3]))


def behind(program, screen, folder):
    (folder / "crossing.swc").write_text(CROSSING)
    window = Window(program, screen, folder, ["crossing.swc", "--units", "mm", "--orientation", "RAS", "--size", "1180x780"])
    try:
        status = window.wait("the tree", lambda s: s["surface_ready"])
        middle = project(status, [0, 8, 0])
        window.xdotool("mousemove", *project(status, [0, -36, 40]), "click", 1)
        window.wait("the vessel behind", lambda s: s["selection"] == [1])
        window.xdotool("mousemove", middle[0], status["viewport"][1] + status["viewport"][3] + 8)
        window.wait("nothing under the pointer", lambda s: s["hovered"] == -1)
        seen = window.pixels(middle[0] - 40, middle[1] - 12, 80, 24)
        window.shot("behind")
        check(blue(seen) > 20, f"the outline of what is selected is seen through what hides it: {blue(seen)} pixels")
        window.xdotool("key", "Escape")
        window.wait("nothing selected", lambda s: s["selection"] == [])
        check(blue(window.pixels(middle[0] - 40, middle[1] - 12, 80, 24)) == 0, "and only that")
    finally:
        window.end()


def luminances(pixels):
    """Relative, of pixels in sRGB, ascending."""
    linear = [(v / 255 / 12.92 if v / 255 <= 0.04045 else ((v / 255 + 0.055) / 1.055) ** 2.4) for v in range(256)]
    return sorted(0.2126 * linear[r] + 0.7152 * linear[g] + 0.0722 * linear[b]
                  for r, g, b in zip(pixels[0::3], pixels[1::3], pixels[2::3]))


def glass(program, screen, folder):
    (folder / "fan.swc").write_text(crossing_tree(14))
    (folder / "glass.txt").write_text("select 0\ndefocus-others\nselect-none\n")
    picture = folder / "glass.png"
    subprocess.run([program, "render", folder / "fan.swc", "--commands", folder / "glass.txt", "--size", "600x500",
                    "--orthographic", "-o", picture], check=True)
    pixels = picture_pixels(picture)
    # The patient's right, where the vessel in focus is, is at the left of the picture or at its right: it is red.
    left, right = cropped(pixels, 600, (0, 120, 300, 260)), cropped(pixels, 600, (300, 120, 300, 260))
    def red(part): return sum(r > 2 * b + 40 for r, b in zip(part[0::3], part[2::3]))
    focus, veils = (left, right) if red(left) > red(right) else (right, left)
    vessel = [value for value in luminances(focus) if value > 0.05]
    bright = luminances(veils)
    median, most = vessel[len(vessel) // 2], bright[int(0.99 * len(bright))]
    check(most < median, f"fourteen veils of glass are no brighter than what is in focus: {most:.3f} below {median:.3f}")


if __name__ == "__main__":
    sys.exit(run_journeys(journey, behind, glass))
