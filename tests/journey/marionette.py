"""A page in Firefox on a virtual screen, through its own remote protocol, for Debian has no geckodriver. Firefox without a
window has no WebGL by software. Standard library only."""

import base64
import itertools
import json
import os
import shutil
import socket
import subprocess
import tempfile
import sys
import time
from pathlib import Path

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from screen import Screen  # noqa: E402

PREFERENCES = """\
user_pref("marionette.port", {port});
user_pref("webgl.force-enabled", true);
user_pref("browser.shell.checkDefaultBrowser", false);
user_pref("datareporting.policy.dataSubmissionEnabled", false);
user_pref("network.proxy.type", 1);
user_pref("network.proxy.http", "127.0.0.1");
user_pref("network.proxy.http_port", 9);
user_pref("network.proxy.ssl", "127.0.0.1");
user_pref("network.proxy.ssl_port", 9);
user_pref("browser.startup.page", 0);
"""


def missing_firefox():
    return [tool for tool in ("firefox-esr", "Xvfb", "icewm") if shutil.which(tool) is None]


class Firefox:
    """No network: every address goes to a proxy that is not there."""

    def __init__(self, size=(1200, 800)):
        self.screen = Screen(*size)
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.profile = tempfile.TemporaryDirectory(prefix="ramus-firefox-", ignore_cleanup_errors=True)
        (Path(self.profile.name) / "user.js").write_text(PREFERENCES.format(port=port))
        self.process = subprocess.Popen(
            ["firefox-esr", "--marionette", "--no-remote", "--profile", self.profile.name, f"--width={size[0]}", f"--height={size[1]}"],
            env=dict(os.environ, DISPLAY=self.screen.display, LIBGL_ALWAYS_SOFTWARE="1", HOME=self.profile.name), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.numbers = itertools.count(1)
        deadline = time.monotonic() + 90
        while True:
            try:
                self.socket = socket.create_connection(("127.0.0.1", port), timeout=120)
                break
            except OSError:
                if time.monotonic() > deadline or self.process.poll() is not None:
                    self.close()
                    raise
                time.sleep(0.2)
        self.buffer = b""
        self._read()
        self("WebDriver:NewSession", {})
        self("WebDriver:SetTimeouts", {"script": 120000, "pageLoad": 120000})

    def _read(self):
        while b":" not in self.buffer:
            self.buffer += self.socket.recv(65536)
        size, rest = self.buffer.split(b":", 1)
        while len(rest) < int(size):
            rest += self.socket.recv(1 << 20)
        self.buffer = rest[int(size):]
        return json.loads(rest[:int(size)])

    def __call__(self, name, arguments):
        text = json.dumps([0, next(self.numbers), name, arguments]).encode()
        self.socket.sendall(b"%d:%s" % (len(text), text))
        _, _, error, value = self._read()
        if error:
            raise RuntimeError(f"{name}: {error.get('message')}")
        return value

    def open(self, page):
        self("WebDriver:Navigate", {"url": page.as_uri()})

    def asked(self, script):
        """What a script answers; it may wait."""
        value = self("WebDriver:ExecuteAsyncScript", {"script": "const done = arguments[0]; const ramus = window.wrappedJSObject ? window.wrappedJSObject.ramus : window.ramus;"
                     f"(async () => {{ {script} }})().then((v) => done([v === undefined ? null : v]), (e) => done(String(e)));", "args": [], "sandbox": None})["value"]
        if not isinstance(value, list):
            raise RuntimeError(value)
        return value[0]

    def picture(self):
        return base64.b64decode(self("WebDriver:TakeScreenshot", {"full": False})["value"])

    def close(self):
        self.process.terminate()
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
        self.screen.close()
        self.profile.cleanup()
