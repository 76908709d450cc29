"""A page in chromium without a window, driven by Debian's python3-selenium. `scripts/setup --browser` installs both."""

import json
import os
import shutil
import subprocess
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from screen import PATIENCE, Failure, check  # noqa: E402

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
except ImportError:
    webdriver = None


def missing_tools():
    tools = [tool for tool in ("chromium", "chromedriver") if shutil.which(tool) is None]
    return tools + (["python3-selenium"] if webdriver is None else [])


class Browser:
    """A profile of its own, kept from one start to the next, and a folder for downloads. `phone`: with touch instead of a
    mouse. `drawing`: with WebGL, by software."""

    def __init__(self, folder, size=(1280, 690), phone=False, drawing=False):
        self.downloads = folder / "downloads"
        self.downloads.mkdir(exist_ok=True)
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        graphics = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader") if drawing else ("--disable-gpu",)
        for argument in ("--headless=new", "--no-sandbox", *graphics, "--disable-dev-shm-usage", "--no-first-run",
                         f"--user-data-dir={folder / 'profile'}", f"--window-size={size[0]},{size[1]}"):
            options.add_argument(argument)
        options.add_experimental_option("prefs", {"download.default_directory": str(self.downloads)})
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
        self.driver.set_page_load_timeout(PATIENCE)
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": size[0], "height": size[1], "deviceScaleFactor": 1, "mobile": phone})
        self.driver.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": phone, "maxTouchPoints": 2})

    def open(self, page):
        self.driver.get(page.as_uri())

    def by(self, name):
        return self.driver.find_element(By.ID, name)

    def all(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def click(self, name):
        self.by(name).click()

    def texts(self, selector):
        return [element.text for element in self.all(selector)]

    def downloaded(self):
        """The file that was saved. chromium takes its name with an empty file first, which goes away again if the browser
        is closed before the content is there."""
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline:
            files = list(self.downloads.iterdir())
            if len(files) == 1 and files[0].suffix == ".json" and files[0].stat().st_size > 0:
                return files[0]
            time.sleep(0.05)
        raise Failure(f"no file was saved: {files}")

    def close(self):
        self.driver.quit()


def becomes(truth, what):
    """As `check`, of what the page does after an input: chromium may answer the driver before the page is done."""
    deadline = time.monotonic() + PATIENCE
    while not truth() and time.monotonic() < deadline:
        time.sleep(0.05)
    check(truth(), what)


def ramus(program, *arguments, status=0):
    result = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, timeout=600)
    if result.returncode != status:
        raise Failure(f"ramus {' '.join(map(str, arguments))}: {result.returncode}, {result.stderr}")
    return result


def requests_of(browser):
    """Everything that was asked for but the page, what it has inside, and the file that it gives."""
    events = [json.loads(entry["message"])["message"] for entry in browser.driver.get_log("performance")]
    addresses = [event["params"]["request"]["url"] for event in events if event["method"] == "Network.requestWillBeSent"]
    return [address for address in addresses if not address.startswith(("file:", "data:", "blob:", "chrome:"))]
