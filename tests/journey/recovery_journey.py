"""A window is killed in the middle of work, and the next one brings everything back. And what a window does before work
is lost, saves it to, and remembers.

Usage: recovery_journey.py PROGRAM
"""

import json
import signal
import sys
import time

from screen import PATIENCE, SMALL_TREE, Failure, Window, check, differing, run_journeys, saved_session

# What a session is, of what the status says.
KEPT = ("tree", "selection", "states", "lesions", "lesion_meshes", "cuts", "measurements", "names", "camera", "options")


def until(what, condition):
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            raise Failure("waited for: " + what)
        time.sleep(0.05)


def kept(folder):
    return sorted((folder / "state" / "ramus" / "autosave").glob("*.json"))


def kill(window):
    window.process.send_signal(signal.SIGKILL)
    window.process.wait()


def work(program, screen, folder, tree):
    """Some changes by hand, kept by themselves; then kill -9."""
    script = folder / "work.txt"
    script.write_text('select 3\nhighlight\nname 2 "to segment VII"\nlesion 10,0,20,6\nview left\n')
    window = Window(program, screen, folder, [tree, "--size", "1000x700", "--commands", script])
    try:
        window.wait("the script", lambda s: s["states"]["highlighted"] == [3] and s["surface_ready"])
        window.xdotool("key", "ctrl+i")
        window.wait("inverted", lambda s: len(s["selection"]) == 4)
        window.xdotool("key", "g")
        window.wait("glass", lambda s: len(s["states"]["defocused"]) == 4)
        window.xdotool("key", "ctrl+z")
        status = window.wait("undo", lambda s: s["states"]["defocused"] == [] and s["redo"])
        check(status["redo"] == "defocus 4 branches" and status["undo"] == "select invert: 4 branches",
              "undo and redo say what they are about")
        window.xdotool("key", "ctrl+y")
        status = window.wait("redo", lambda s: len(s["states"]["defocused"]) == 4 and s["surface_ready"])
        # The file follows within seconds, without anybody asking for it.
        until("the work on the disk", lambda: kept(folder) and
              len(json.loads(kept(folder)[0].read_text())["session"]["states"]["defocused"]) == 4)
        check(status["modified"] and not (folder / "tree.ramus.json").exists(), "what is not saved is kept for recovery")
        x, y, width, height = status["viewport"]
        window.xdotool("mousemove", x + width // 2, y + height + 10)
        window.wait("nothing under the pointer", lambda s: s["hovered"] == -1)
        seen = window.pixels(x, y, width, height)
        return status, seen
    finally:
        kill(window)


def recover(program, screen, folder, tree):
    before, seen = work(program, screen, folder, tree)
    check(len(kept(folder)) == 1, "the killed window leaves its work behind")
    window = Window(program, screen, folder, [tree, "--size", "1000x700"])
    try:
        status = window.wait("the offer", lambda s: s["recovery_dialog"])
        check(status["recoveries"] == 1, "the next one offers to recover it")
        # While it asks, another window does not offer the same.
        aside = folder / "aside"
        aside.mkdir()
        second = Window(program, screen, aside, [tree, "--size", "600x500"], state=folder / "state")
        try:
            status = second.wait("the other window", lambda s: s["surface_ready"])
            check(status["recoveries"] == 0, "a window that starts meanwhile does not offer it, too")
        finally:
            second.end()
        window.xdotool("key", "Return")
        status = window.wait("the work", lambda s: s["surface_ready"] and not s["recovery_dialog"] and s["modified"])
        for name in KEPT:
            check(status[name] == before[name], "it is as it was: " + name)
        x, y, width, height = status["viewport"]
        window.xdotool("mousemove", x + width // 2, y + height + 10)
        window.wait("nothing under the pointer", lambda s: s["hovered"] == -1)
        share = differing(seen, window.pixels(x, y, width, height))
        check(share <= 0.001, f"and it looks as it did ({100 * share:.4f} % of the pixels differ)")
        check(len(kept(folder)) == 1, "until it is saved, the work stays on the disk")
        saved_session(window)
        saved = folder / "tree.ramus.json"
        window.wait("the session file", lambda s: saved.exists() and not s["modified"])
        session = json.loads(saved.read_text())
        check(all(session[name] == before[name] for name in KEPT if name not in ("tree", "camera")),
              "saved, it holds what was made before the window was killed")
        until("nothing to recover", lambda: not kept(folder))
        check(window.quit() == 0, "and then nothing is left to recover")
    finally:
        window.end()


def changed_tree(program, screen, folder, tree):
    """The tree is another one now: nothing is guessed, and nothing is lost."""
    (folder / "tree.ramus.json").unlink(missing_ok=True)
    work(program, screen, folder, tree)
    tree.write_text(SMALL_TREE.replace("9 3 55", "9 3 56"))
    window = Window(program, screen, folder, [tree, "--size", "1000x700"])
    try:
        window.wait("the offer", lambda s: s["recovery_dialog"] and s["recoveries"] == 1)
        window.xdotool("key", "Return")
        status = window.wait("the message", lambda s: s["error"])
        check("tree.swc has changed" in status["error"] and "kept until you discard it" in status["error"],
              "a tree that changed meanwhile is named")
        window.xdotool("key", "Escape")
        window.wait("the offer again", lambda s: s["recovery_dialog"] and not s["error"])
        check(len(kept(folder)) == 1, "and the work is kept")
        window.xdotool("key", "Escape")
        window.wait("no dialog", lambda s: not s["recovery_dialog"])
        check(window.quit() == 0 and len(kept(folder)) == 1, "until somebody discards it")
    finally:
        window.end()
    discard = folder / "discard.txt"
    discard.write_text("discard-recovery 1\nquit\n")
    window = Window(program, screen, folder, [tree, "--commands", discard])
    try:
        check(window.process.wait(timeout=PATIENCE) == 1 and len(kept(folder)) == 1, "somebody else's commands do not")
    finally:
        window.end()
    window = Window(program, screen, folder, [tree, "--commands", discard, "--overwrite"])
    try:
        check(window.process.wait(timeout=PATIENCE) == 0 and not kept(folder), "which is a command, too")
    finally:
        window.end()
    tree.write_text(SMALL_TREE)


def unsaved(program, screen, folder, tree):
    """Nothing is lost by closing."""
    window = Window(program, screen, folder, [tree, "--size", "1000x700"])
    try:
        window.wait("the surface", lambda s: s["surface_ready"])
        window.xdotool("key", "ctrl+i", "h")
        window.wait("the highlight", lambda s: len(s["states"]["highlighted"]) == 5)
        window.xdotool("key", "ctrl+q")
        window.wait("the question", lambda s: s["unsaved_dialog"])
        window.xdotool("key", "Escape")
        window.wait("no question", lambda s: not s["unsaved_dialog"])
        check(window.process.poll() is None, "before work is lost ramus asks, and Escape stays")
        window.xdotool("key", "ctrl+shift+s")
        window.wait("where to save", lambda s: s["save_dialog"])
        window.xdotool("key", "ctrl+a")
        window.xdotool("type", "my plan")
        window.xdotool("key", "Return")
        status = window.wait("saved", lambda s: not s["save_dialog"] and not s["modified"])
        plan = folder / "my plan.ramus.json"
        check(plan.exists() and str(plan) in status["notice"], "Ctrl+Shift+S asks for a name, and says where it went")
        window.xdotool("key", "x")
        window.wait("hidden", lambda s: len(s["states"]["hidden"]) == 5)
        window.xdotool("key", "ctrl+q")
        window.wait("the question", lambda s: s["unsaved_dialog"])
        window.xdotool("key", "Return")
        check(window.process.wait(timeout=PATIENCE) == 0, "Return saves, and closes")
        check(len(json.loads(plan.read_text())["states"]["hidden"]) == 5, "to the file that the session has")
    finally:
        window.end()


def camera_as_text(program, screen, folder, tree):
    window = Window(program, screen, folder, [tree, "--size", "1000x700"])
    try:
        window.wait("the surface", lambda s: s["surface_ready"])
        window.xdotool("key", "l")
        left = window.wait("left", lambda s: s["camera"]["position"][0] < -10)["camera"]
        window.xdotool("key", "ctrl+c")
        window.wait("copied", lambda s: "copied" in s["notice"])
        window.xdotool("key", "s")
        window.wait("superior", lambda s: s["camera"]["position"][2] > 10)
        window.xdotool("key", "ctrl+v")
        window.wait("left again", lambda s: s["camera"] == left)
        check(True, "the camera is copied and pasted as text")
        window.xdotool("key", "Tab")
        window.wait("no panel", lambda s: s["viewport"][2] == s["window"][0])
        check(window.quit() == 0, "a camera is nothing to ask about")
    finally:
        window.end()
    settings = json.loads((folder / "config" / "ramus" / "settings.json").read_text())
    check(settings["panel_open"] is False and settings["window"] == [1000, 700], "settings are kept")
    recent = (folder / "state" / "ramus" / "recent").read_text().splitlines()
    check(recent[0] == str(tree), "and so are the recent files")
    (folder / "config" / "ramus" / "settings.json").write_text("{ this is none")
    window = Window(program, screen, folder, [tree])
    try:
        status = window.wait("the tree", lambda s: s["surface_ready"])
        check(status["viewport"][2] < status["window"][0] and "settings.json.bad" in status["notice"],
              "settings that cannot be read are told of and kept aside")
        window.quit()
    finally:
        window.end()


def nowhere_to_write(program, screen, folder, tree):
    """A state folder that cannot be made is said, and nothing else happens."""
    aside = folder / "blocked"
    aside.mkdir()
    (aside / "file").write_text("in the way")
    window = Window(program, screen, aside, [tree, "--size", "800x600"], state=aside / "file" / "state")
    try:
        window.wait("the surface", lambda s: s["surface_ready"])
        window.xdotool("key", "ctrl+i", "h")
        status = window.wait("the notice", lambda s: "recovery" in s["notice"])
        check(len(status["states"]["highlighted"]) == 5, "work goes on where nothing can be kept: " + status["notice"])
        check(window.quit() == 0, "and closing it works")
    finally:
        window.end()


def lives_while_commands_run(program, screen, folder, tree):
    """A line of a commands file a frame: what the window shows is told and kept meanwhile."""
    aside = folder / "long"
    aside.mkdir()
    script = aside / "long.txt"
    script.write_text("".join(f'name 2 "vessel {i}"\n' for i in range(20_000)) + "quit\n")
    window = Window(program, screen, aside, [tree, "--size", "600x500", "--commands", script])
    try:
        names, seen = set(), set()

        def lived():
            status = window.written_status()
            if status and status["names"]:
                seen.add((status["script_left"], status["resting"]))
                names.add(status["names"]["2"])
            return len(names) > 3 and kept(aside)

        until("what is done so far, in the status and on the disk", lived)
        check(seen == {(True, False)}, "a window with lines to run says so, and does not rest")
        window.xdotool("key", "ctrl+q")
        until("the question", lambda: window.written_status()["unsaved_dialog"])
        window.xdotool("key", "d")
        check(window.process.wait(timeout=PATIENCE) == 0, "the window closes when it is asked to")
    finally:
        window.end()


def recovery(program, screen, folder):
    tree = folder / "tree.swc"
    tree.write_text(SMALL_TREE)
    for part in (recover, changed_tree, unsaved, camera_as_text, nowhere_to_write, lives_while_commands_run):
        part(program, screen, folder, tree)


if __name__ == "__main__":
    sys.exit(run_journeys(recovery))
