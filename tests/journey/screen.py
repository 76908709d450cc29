"""A virtual screen with one ramus window on it, driven with xdotool and watched through --status. Standard library only.

Nothing sleeps for a fixed time: every step waits until the window says that it happened.
"""

import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

# A trunk that forks twice. Branches: the trunk, its two children, and the two children of the right one.
SMALL_TREE = """\
# id type x y z radius parent (mm, RAS)
1 3 0 0 -40 5 -1
2 3 0 0 -20 5 1
3 3 0 0 0 5 2
4 3 -20 0 15 3.5 3
5 3 -40 0 25 3 4
6 3 20 5 15 3.5 3
7 3 30 8 25 3 6
8 3 35 10 45 2 7
9 3 55 10 30 2 7
"""

PATIENCE = float(os.environ.get("RAMUS_JOURNEY_PATIENCE", 120.0))  # seconds; software rendering on a busy machine is slow


class Failure(Exception):
    pass


def check(truth, what):
    if not truth:
        raise Failure(what)
    print("ok:", what, flush=True)


def missing_tools():
    return [tool for tool in ("Xvfb", "icewm", "xdotool", "import", "convert") if shutil.which(tool) is None]


FRAME = (60, 80)  # what a window manager puts around a window, in pixels, and a little more
# No pictures, sounds or task bar; what remains is what a person has: title bars, Alt with the mouse moves windows.
MANAGER_PREFERENCES = """\
ShowTaskBar=0
ShowAboutDialog=0
SupportSystemSound=0
DesktopBackgroundColor="rgb:40/40/40"
"""


class Screen:
    """Xvfb at 24 bit with GLX, on a number that it chooses itself, and a window manager on it. There is room for a window
    of this size and its frame."""

    def __init__(self, width, height):
        read, write = os.pipe()
        self.process = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{width + FRAME[0]}x{height + FRAME[1]}x24", "-nolisten", "tcp",
             "+extension", "GLX", "-noreset"],
            pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as answer:
            number = answer.readline().strip()
        if not number:
            raise Failure("Xvfb did not start")
        self.display = ":" + number
        self.folder = tempfile.TemporaryDirectory()
        (Path(self.folder.name) / "preferences").write_text(MANAGER_PREFERENCES)
        self.manager = subprocess.Popen(["icewm", "--replace"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                        env=dict(os.environ, DISPLAY=self.display, ICEWM_PRIVCFG=self.folder.name,
                                                 HOME=self.folder.name))

    def close(self):
        for process in (self.manager, self.process):
            process.terminate()
            process.wait()
        self.folder.cleanup()


class Window:
    def __init__(self, program, screen, folder, arguments, state=None):
        self.folder = Path(folder)
        self.status_file = self.folder / "status.json"
        self.status_file.unlink(missing_ok=True)
        self.questions = self.folder / "status.json.ask"
        self.questions.unlink(missing_ok=True)
        self.asked = 0
        self.input_since = False  # since the last question
        self.environment = dict(os.environ, DISPLAY=screen.display, XDG_STATE_HOME=str(state or self.folder / "state"),
                                XDG_CONFIG_HOME=str(self.folder / "config"), HOME=str(self.folder), LIBGL_ALWAYS_SOFTWARE="1")
        self.environment.pop("WAYLAND_DISPLAY", None)
        self.process = subprocess.Popen([program, "--status", str(self.status_file), *map(str, arguments)],
                                        cwd=self.folder, env=self.environment)
        self.number = None  # of the X window
        self.has_keyboard = False

    def written_status(self):
        """What the window wrote last: it may not know the input that it got since. None before it wrote anything."""
        try:
            return json.loads(self.status_file.read_text())
        except FileNotFoundError:
            return None

    def ask(self):
        """Asks for a status that knows all input so far, if there was any since the last question."""
        if self.input_since:
            self.asked += 1
            written = self.questions.with_suffix(".new")
            written.write_text(str(self.asked))
            written.replace(self.questions)  # whole or not at all
            self.input_since = False

    def answered(self, status):
        return status is not None and status["answered"] >= self.asked

    def status(self):
        """What the window shows after all input so far, whether or not it rests."""
        self.ask()
        end = time.monotonic() + PATIENCE
        while self.process.poll() is None and not self.answered(status := self.written_status()):
            if time.monotonic() > end:
                raise Failure(f"waited {PATIENCE} s for a status")
            time.sleep(0.005)
        return self.written_status()

    def wait(self, what, condition):
        """Until the window knows all input so far, rests, and `condition(status)` holds; returns the status."""
        self.ask()
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            if self.process.poll() is not None:
                raise Failure(f"ramus ended with {self.process.returncode} while waiting for: {what}")
            status = self.written_status()
            if self.answered(status) and status["resting"] and condition(status):
                return status
            time.sleep(0.02)
        self.shot("failed", rests=False)
        raise Failure(f"waited {PATIENCE} s for: {what}\n{json.dumps(self.written_status())}")

    def window(self):
        """The X window, once the window manager has put it on the screen."""
        end = time.monotonic() + PATIENCE
        while self.number is None:  # xdotool fails where it meets a window that goes away meanwhile
            found = subprocess.run(["xdotool", "search", "--onlyvisible", "--pid", str(self.process.pid)],
                                   env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
            numbers = found.stdout.split()
            if found.returncode == 0 and numbers:
                self.number = numbers[-1]
            elif time.monotonic() > end:
                raise Failure("no window came")
            else:
                time.sleep(0.05)
        return self.number

    def await_keyboard(self):
        """Until the window manager has given the window the keyboard: a key before that goes to nobody."""
        end = time.monotonic() + PATIENCE
        while not self.has_keyboard:
            found = subprocess.run(["xdotool", "getwindowfocus"], env=self.environment, stdout=subprocess.PIPE,
                                   stderr=subprocess.DEVNULL, text=True)
            self.has_keyboard = found.stdout.strip() == self.window()
            if not self.has_keyboard:
                if time.monotonic() > end:
                    raise Failure("the window has not got the keyboard")
                time.sleep(0.02)

    def xdotool(self, *words):
        """Places are in the window. All of it has reached the window's connection when this returns."""
        self.await_keyboard()
        placed = []
        for word in words:
            placed += [word, "--window", self.window()] if word == "mousemove" else [str(word)]
        subprocess.run(["xdotool", *placed], env=self.environment, check=True, stdout=subprocess.DEVNULL)
        self.input_since = True

    def pixels(self, x, y, width, height):
        """A part of the window as bytes, three a pixel, once the picture is as fine as it gets."""
        self.wait("the finest picture", lambda s: s["picture"]["refined"])
        return subprocess.run(["import", "-window", self.window(), "-crop", f"{width}x{height}+{x}+{y}", "-depth", "8", "rgb:-"],
                              env=self.environment, check=True, stdout=subprocess.PIPE).stdout

    def shot(self, name, rests=True):
        """A picture of the window in the folder RAMUS_JOURNEY_PICTURES, for who wants to look; without it, none.
        As fine as it gets, or, if the window does not rest, as it is."""
        folder = os.environ.get("RAMUS_JOURNEY_PICTURES")
        if folder:
            if rests:
                self.wait("the finest picture", lambda s: s["picture"]["refined"])
            subprocess.run(["import", "-window", self.window(), str(Path(folder) / f"{name}.png")], env=self.environment, check=True)

    def quit(self):
        """Ctrl+Q, and what is not saved is discarded."""
        self.xdotool("key", "ctrl+q")
        end = time.monotonic() + PATIENCE
        while self.process.poll() is None and time.monotonic() < end:
            status = self.status()
            if status and status["unsaved_dialog"]:
                self.xdotool("key", "d")
            time.sleep(0.02)
        return self.process.poll()

    def end(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()


def middle_of(status, words):
    """Of the control that these words explain."""
    x, y, width, height = status["controls"][words]
    return x + width // 2, y + height // 2


def click(window, words):
    status = window.wait(f"the control: {words}", lambda s: words in s["controls"])
    window.xdotool("mousemove", *middle_of(status, words), "click", 1)


def choose(window, words, entry):
    """An entry of the list that opens there. A list is pressed again where a panel moved it under the pointer."""
    for _ in range(5):
        click(window, words)
        end = time.monotonic() + PATIENCE / 10
        while time.monotonic() < end and entry not in (window.status() or {"controls": {}})["controls"]:
            time.sleep(0.05)
        if entry in window.status()["controls"]:
            break
    click(window, entry)


def accept_dialog(window):
    """Enter, in the dialog that asks where a file goes: the place and the name that it suggests."""
    window.wait("the field for the name", lambda s: s["open_dialog"] and s["typing"])
    window.xdotool("key", "Return")
    window.wait("no dialog", lambda s: not s["open_dialog"])


def saved_session(window):
    """Saves the session with Ctrl+S, the first time where the dialog suggests; its file."""
    known = window.status()["session_file"]
    window.xdotool("key", "ctrl+s")
    if not known:
        accept_dialog(window)
    status = window.wait("the session's name", lambda s: "Session saved: " in s["notice"])
    return Path(status["notice"].split("Session saved: ")[1])


def saved_picture(window):
    """Saves the picture with F12, as the dialog suggests it: that of the window; its file."""
    window.xdotool("key", "F12")
    accept_dialog(window)
    status = window.wait("the picture's name", lambda s: "Picture saved: " in s["notice"])
    return Path(status["notice"].split("Picture saved: ")[1])


def command(window, words):
    """Typed into the palette."""
    window.xdotool("key", "ctrl+k")
    window.wait("the palette", lambda s: s["palette"]["open"] and s["typing"])
    window.xdotool("type", words)
    window.xdotool("key", "Return")
    window.wait("no palette", lambda s: not s["palette"]["open"])


PAGES = {"explore": "Systems, selection and branches", "surface": "Surface, glass, context and comparison",
         "slices": "Scans, and slices through them",
         "plan": "Lesions, cuts and measurements"}


def page(window, name):
    """Opens a page of the side panel."""
    click(window, PAGES[name])
    window.wait(f"the page {name}", lambda s: s["page"] == name)


def slide(window, words, share):
    """A slider to this share of its length."""
    left, top, width, height = window.status()["controls"][words]
    window.xdotool("mousemove", left + round(share * width), top + height // 2, "click", 1)


def drag(window, way, end=True):
    window.xdotool("mousemove", *way[0])
    window.xdotool("mousedown", 1)
    for at in way[1:]:
        window.xdotool("mousemove", *at)
    if end:
        window.xdotool("mouseup", 1)


def picture_pixels(path):
    return subprocess.run(["convert", str(path), "-alpha", "off", "-depth", "8", "rgb:-"], check=True,
                          stdout=subprocess.PIPE).stdout


def differing(first, second, threshold=8):
    """The share of pixels with a channel that differs by more than `threshold`."""
    if len(first) != len(second) or not first:
        raise Failure(f"pictures of {len(first)} and {len(second)} bytes")
    if first == second:
        return 0.0
    apart = [abs(a - b) > threshold for a, b in zip(first, second)]
    return sum(map(any, zip(apart[0::3], apart[1::3], apart[2::3]))) / (len(first) // 3)


def cropped(pixels, width, part):
    """A part (x, y, width, height) of a picture of this width."""
    x, y, part_width, part_height = part
    return b"".join(pixels[3 * (row * width + x):3 * (row * width + x + part_width)] for row in range(y, y + part_height))


def below_tools(pixels, view):
    """A picture of the viewport (x, y, width, height) without its upper edge, where the tools lie over it."""
    return pixels[3 * view[2] * 60:]


def project(status, point):
    """Where the status's camera (perspective) shows a point, in pixels of the screen: in the first viewport."""
    def minus(a, b): return [p - q for p, q in zip(a, b)]
    def dot(a, b): return sum(p * q for p, q in zip(a, b))
    def cross(a, b): return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    def unit(a): return [p / math.sqrt(dot(a, a)) for p in a]

    camera = status["camera"]
    forward = unit(minus(camera["focal_point"], camera["position"]))
    right = unit(cross(forward, camera["view_up"]))
    up = cross(right, forward)
    to_point = minus(point, camera["position"])
    left, top, width, height = status["viewports"][0]
    per_unit = height / 2 / math.tan(math.radians(camera["view_angle"] / 2)) / dot(to_point, forward)
    return (round(left + width / 2 + dot(to_point, right) * per_unit),
            round(top + height / 2 - dot(to_point, up) * per_unit))


def looks_along(status):
    camera = status["camera"]
    way = [f - p for f, p in zip(camera["focal_point"], camera["position"])]
    length = math.sqrt(sum(w * w for w in way))
    return [round(w / length, 6) + 0.0 for w in way]


def info_of(program, tree):
    return json.loads(subprocess.run([program, "info", tree, "--json", "--branches"], check=True,
                                     stdout=subprocess.PIPE).stdout)


def run_journeys(*journeys, size=(1200, 800)):
    """Each as journey(program, screen, folder), with the program named on the command line; the exit status."""
    program = str(Path(sys.argv[1]).resolve())
    missing = missing_tools()
    if missing:
        print("SKIPPED: not installed:", ", ".join(missing))
        return 0
    with tempfile.TemporaryDirectory() as name:
        screen = Screen(*size)
        try:
            for journey in journeys:
                journey(program, screen, Path(name))
        except Failure as failure:
            print("FAILED:", failure, flush=True)
            return 1
        finally:
            screen.close()
    return 0
