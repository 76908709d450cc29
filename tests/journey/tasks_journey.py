"""Ten tasks, each within five actions: a click, a drag, a key or a text that is typed. Prints the count of each.

Usage: tasks_journey.py PROGRAM
"""

import sys

from screen import SMALL_TREE, Window, check, middle_of, project, run_journeys

MOST = 5  # actions a task may take
PRINTING = "Makes sure that the surface is closed and in mm, and says how thin it is at its thinnest place"


class Hands:
    """What a person does, counted."""

    def __init__(self, window):
        self.window, self.count, self.task, self.counts = window, 0, "", []

    def begin(self, task):
        self.task, self.count = task, 0

    def end(self):
        check(self.count <= MOST, f"{self.task}: {self.count} actions")
        self.counts.append((self.task, self.count))

    def key(self, name):
        self.count += 1
        self.window.xdotool("key", name)

    def type(self, text):
        self.count += 1
        self.window.xdotool("type", text)

    def click(self, at, modifiers=()):
        self.count += 1
        self.window.xdotool("mousemove", *at)
        held = [word for key in modifiers for word in ("keydown", key)]
        self.window.xdotool(*held, "click", 1, *[word for key in modifiers for word in ("keyup", key)])

    def press(self, words):
        """The control that these words explain."""
        status = self.window.wait(f"the control: {words}", lambda s: words in s["controls"])
        self.click(middle_of(status, words))

    def drag(self, way):
        self.count += 1
        self.window.xdotool("mousemove", *way[0], "mousedown", 1)
        for at in way[1:]:
            self.window.xdotool("mousemove", *at)
        self.window.xdotool("mouseup", 1)


def open_a_file(hands):
    hands.begin("open a tree")
    hands.key("ctrl+o")
    hands.window.wait("the dialog", lambda s: s["open_dialog"])
    hands.type("tree.swc")
    hands.key("Return")
    hands.window.wait("the tree", lambda s: s["surface_ready"] and s["branch_count"] == 5)
    hands.end()


def what_depends(hands):
    hands.begin("what depends on a vessel")
    hands.click(project(hands.window.status(), [25, 6.5, 20]), modifiers=("ctrl", "shift"))
    hands.window.wait("it and what depends on it", lambda s: len(s["selection"]) == 3)
    hands.end()


def lasso_and_defocus(hands):
    hands.begin("lasso vessels and put them out of focus")
    status = hands.window.status()
    hands.key("w")
    corners = [project(status, place) for place in ([-45, 0, 8], [-10, 0, 8], [-10, 0, 40], [-45, 0, 40], [-45, 0, 8])]
    hands.drag(corners)
    hands.window.wait("what is inside", lambda s: len(s["selection"]) == 1)
    hands.key("g")
    hands.window.wait("it is glass", lambda s: len(s["states"]["defocused"]) == 1)
    hands.end()


def remove_and_bring_back(hands):
    hands.begin("remove vessels and bring them back")
    hands.key("x")
    hands.window.wait("gone", lambda s: len(s["states"]["hidden"]) == 1)
    hands.press("Shows the hidden branches again")
    hands.window.wait("back", lambda s: s["states"]["hidden"] == [])
    hands.end()


def lesion_and_bands(hands):
    hands.begin("place a lesion and read what lies near it")
    hands.key("shift+l")
    at = project(hands.window.status(), [40, 9, 30])
    hands.drag([at, (at[0] + 20, at[1]), (at[0] + 45, at[1])])
    hands.window.wait("the lesion", lambda s: len(s["lesions"]) == 1)
    hands.key("b")
    hands.window.wait("the list of margins", lambda s: s["planning"])
    hands.press("Distances to lesions as colours")
    hands.window.wait("the colours", lambda s: s["options"]["colour_by"] == "lesion")
    hands.end()


def cut_list(hands):
    hands.begin("cut a vessel and read what is lost")
    hands.key("shift+c")
    hands.click(project(hands.window.status(), [20, 8.5, 15]))
    hands.window.wait("the cut", lambda s: len(s["cuts"]) == 1)
    hands.end()


def measure(hands):
    hands.begin("measure a distance")
    status = hands.window.status()
    hands.key("m")
    ends = [project(status, place) for place in ([0, 5, -35], [0, 5, -15])]
    hands.drag([ends[0], ((ends[0][0] + ends[1][0]) // 2, (ends[0][1] + ends[1][1]) // 2), ends[1]])
    hands.window.wait("its value", lambda s: len(s["measured"]) == 1)
    hands.end()


def compare(hands):
    hands.begin("compare with truncated cones")
    hands.key("ctrl+k")
    hands.window.wait("the palette", lambda s: s["palette"]["open"] and s["typing"])
    hands.type("side by side")
    hands.key("Return")
    hands.window.wait("two pictures", lambda s: len(s["viewports"]) == 2)
    hands.end()


def picture_for_a_talk(hands, folder):
    hands.begin("a picture for a talk")
    hands.key("F12")
    picture = folder / "tree.png"
    status = hands.window.wait("the picture, or its dialog", lambda s: s["export"].startswith("picture") or picture.exists())
    if status["export"]:
        if "What is behind the tree" in status["controls"]:
            hands.press("What is behind the tree")
            hands.press("White")
        hands.press("Write it")
    hands.window.wait("the picture", lambda s: picture.exists() and not s["open_dialog"])
    hands.end()


def export_for_print(hands, folder):
    hands.begin("a surface for a printer")
    hands.key("ctrl+e")
    hands.window.wait("the dialog", lambda s: s["export"] and s["typing"])
    hands.type("print.stl")
    hands.press(PRINTING)
    hands.press("Write it")
    hands.window.wait("the surface", lambda s: (folder / "print.stl").exists() and not s["open_dialog"])
    hands.end()


def journey(program, screen, folder):
    (folder / "tree.swc").write_text(SMALL_TREE)
    (folder / "other.swc").write_text("1 3 0 0 0 5 -1\n2 3 0 0 30 5 1\n")
    window = Window(program, screen, folder, ["other.swc", "--size", "1180x780"])
    try:
        window.wait("a tree", lambda s: s["surface_ready"])
        hands = Hands(window)
        open_a_file(hands)
        what_depends(hands)
        lasso_and_defocus(hands)
        remove_and_bring_back(hands)
        lesion_and_bands(hands)
        cut_list(hands)
        measure(hands)
        compare(hands)
        picture_for_a_talk(hands, folder)
        export_for_print(hands, folder)
        window.shot("tasks")
        check(len(hands.counts) == 10, "that were ten tasks")
        for task, count in hands.counts:
            print(f"{count}  {task}")
        check(window.quit() == 0, "it quits")
    finally:
        window.end()


if __name__ == "__main__":
    sys.exit(run_journeys(journey))
