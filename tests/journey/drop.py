"""Drops files on a window, as a file manager does: version 5 of the protocol Xdnd. Needs python3-xlib."""

from pathlib import Path

try:
    from Xlib import X, display
    from Xlib.protocol import event
    MISSING = None
except ImportError as problem:
    MISSING = problem


class Source:
    """A window that offers files, on the display of the window that they are dropped on."""

    def __init__(self, name, target):
        self.display = display.Display(name)
        self.target = self.display.create_resource_object("window", target)
        self.own = self.display.screen().root.create_window(0, 0, 1, 1, 0, X.CopyFromParent)

    def atom(self, name):
        return self.display.intern_atom(name)

    def say(self, kind, words):
        message = event.ClientMessage(window=self.target, client_type=self.atom(kind),
                                      data=(32, ([self.own.id, *words] + [0] * 5)[:5]))
        self.target.send_event(message)
        self.display.flush()

    def await_message(self, kind):
        """Until the window sends it; answers its questions for the files meanwhile."""
        while True:
            got = self.display.next_event()
            if got.type == X.ClientMessage and got.client_type == self.atom(kind):
                return got.data[1]
            if got.type == X.SelectionRequest:
                self.answer(got)

    def answer(self, question):
        """Gives the files, as a list of addresses."""
        question.requestor.change_property(question.property, question.target, 8, self.addresses)
        question.requestor.send_event(event.SelectionNotify(
            time=question.time, requestor=question.requestor, selection=question.selection, target=question.target,
            property=question.property))
        self.display.flush()

    def drop(self, files, at):
        """`at`: on the screen."""
        self.addresses = "".join(Path(file).resolve().as_uri() + "\r\n" for file in files).encode()
        self.own.set_selection_owner(self.atom("XdndSelection"), X.CurrentTime)
        self.say("XdndEnter", [5 << 24, self.atom("text/uri-list")])
        self.say("XdndPosition", [0, at[0] << 16 | at[1], X.CurrentTime, self.atom("XdndActionCopy")])
        accepted = self.await_message("XdndStatus")[1] & 1
        if accepted:
            self.say("XdndDrop", [0, X.CurrentTime])
            self.await_message("XdndFinished")
        return bool(accepted)


def drop(window, files):
    """On the middle of the window. Whether it took them."""
    source = Source(window.environment["DISPLAY"], int(window.window()))
    place = source.target.translate_coords(source.display.screen().root, 0, 0)
    size = source.target.get_geometry()
    accepted = source.drop(files, (size.width // 2 - place.x, size.height // 2 - place.y))
    source.display.close()
    window.input_since = True
    return accepted
