#!/usr/bin/env python3
"""Raters fill in rating pages in a browser: chromium without a window, driven by Debian's python3-selenium.

    rating_journey.py RAMUS

`scripts/setup --browser` installs both. Where they are missing the journey is skipped and says so.
"""

import base64
import json
import os
import re
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from browser import Browser, becomes, missing_tools, ramus, requests_of  # noqa: E402
from screen import PATIENCE, SMALL_TREE, Failure, check  # noqa: E402

try:
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    pass

CRITERIA = ("appearance", "spatial_shape", "transitions", "overall")
SCORES = {"isosurface": 2, "cones": 3, "convolution": 4}  # the mean of a rater's answers about each


class RatingBrowser(Browser):
    def shown(self):
        """The codes of the pictures that a rater sees in the scene that is open, from left to right."""
        groups = self.all(".scene:not([hidden]) fieldset")
        codes = [group.get_attribute("id").split("-")[0] for group in groups]
        return codes[:len(codes) // len(CRITERIA)]


def make_study(program, folder):
    (folder / "tree.swc").write_text(SMALL_TREE)
    ramus(program, "study", folder / "tree.swc", "-o", folder / "study", "--size", "240x180", "--raters", "2")
    return json.loads((folder / "study" / "key.json").read_text())


def methods_of(key):
    return {code: method for scene in key["scenes"] for code, method in scene["pictures"].items()}


def answer_by_keys(browser, methods, order, left_out=None):
    """A score for every question of the open scene, by the keyboard alone; one (criterion, code) may be left out."""
    browser.driver.execute_script("document.querySelector('.scene:not([hidden]) input').focus()")
    for criterion in CRITERIA:
        for code in order:
            key = Keys.TAB if (criterion, code) == left_out else str(SCORES[methods[code]])
            browser.driver.switch_to.active_element.send_keys(key)


def fill(program, folder, key, rater):
    """A rater from start to file; returns the file and what was shown."""
    methods = methods_of(key)
    browser = RatingBrowser(folder)
    try:
        browser.open(folder.parent / "study" / "sheets" / f"rater_{rater:03}.html")
        shown = []
        for scene in range(len(key["scenes"])):
            browser.click("next")
            shown.append(browser.shown())
            answer_by_keys(browser, methods, shown[-1])
        browser.click("next")
        browser.click("save-answers")
        return browser.downloaded(), shown
    finally:
        browser.close()


def nothing_missing_is_saved(program, folder, key):
    """The first rater in all detail: stops in between, leaves one answer out, is told which, and saves."""
    methods = methods_of(key)
    page = folder.parent / "study" / "sheets" / "rater_001.html"
    browser = RatingBrowser(folder)
    shown = []
    try:
        browser.open(page)
        browser.driver.find_element(By.CSS_SELECTOR, "#role option[value=surgeon]").click()
        browser.by("years").send_keys("12")
        for scene in range(2):
            browser.click("next")
            shown.append(browser.shown())
            answer_by_keys(browser, methods, shown[-1])
        becomes(lambda: browser.driver.switch_to.active_element.get_attribute("id") == "next",
                "after the last question of a scene the keyboard is at the button that goes on")
        becomes(lambda: browser.by("progress").text == "24 of 48 answers", "progress is told")
    finally:
        browser.close()

    browser = RatingBrowser(folder)  # the next day
    try:
        browser.open(page)
        becomes(lambda: browser.by("progress").text == "24 of 48 answers", "nothing is lost when the browser is closed")
        becomes(lambda: browser.by("title").text.startswith("Scene 2 of 4"), "and the page opens where it was left")
        check(browser.shown() == shown[1], "with the pictures in the same order")
        for scene in range(2):
            browser.click("next")
            shown.append(browser.shown())
            answer_by_keys(browser, methods, shown[-1], ("transitions", shown[-1][1]) if scene == 0 else None)
        browser.all("#steps button")[-1].click()
        browser.click("save-answers")
        becomes(lambda: all(words in browser.by("save-result").text for words in ("Not saved", "1 answer is missing")),
                "a page with an answer missing is not saved")
        check(browser.texts("#missing button") == ["Picture B: Branchings"] and "Scene 3" in browser.by("missing").text,
              "and which answer it is, is told")
        check(list(browser.downloads.iterdir()) == [], "no file is written")
        browser.all("#missing button")[0].click()
        becomes(lambda: browser.by("title").text.startswith("Scene 3 of 4"), "the button leads to the scene")
        becomes(lambda: browser.driver.switch_to.active_element.get_attribute("name") == f"{shown[2][1]}-transitions",
                "and to the question")
        browser.driver.switch_to.active_element.send_keys(str(SCORES[methods[shown[2][1]]]))
        browser.all("#steps button")[-1].click()
        browser.click("save-answers")
        becomes(lambda: "Saved" in browser.by("save-result").text, "a complete page is saved")
        file = browser.downloaded()
        check(file.name == f"ratings_{key['study']}_rater_1.json", "under a name that says whose it is")
        browser.all("summary")[0].click()
        copied = json.loads(browser.driver.find_element(By.ID, "text").get_attribute("value"))
        check(copied["answers"] == json.loads(file.read_text())["answers"], "the text to copy has the same answers")
        told = [entry["message"] for entry in browser.driver.get_log("browser")]
        check(told == [], f"the browser has nothing to complain about: {told}")
        check(requests_of(browser) == [], "nothing but the page itself was asked for")
        return file, shown
    finally:
        browser.close()


def the_page_says_no_method(page, key):
    text = page.read_text()
    beside = re.sub(r"data:image/png;base64,[^\"]*", "", text).lower()
    for word in ("isosurface", "cones", "convolution", "truncated", "place_1", ".png"):
        check(word not in beside, f"the page does not say \"{word}\"")
    check("http:" not in beside and "https:" not in beside and "//cdn" not in beside, "nor any address of a network")
    for picture in re.findall(r"data:image/png;base64,([^\"]*)", text):
        data, at, chunks = base64.b64decode(picture), 8, set()
        while at < len(data):
            length = int.from_bytes(data[at:at + 4], "big")
            chunks.add(data[at + 4:at + 8].decode())
            at += 12 + length
        if not chunks <= {"IHDR", "IDAT", "IEND", "sRGB", "gAMA", "cHRM"}:
            raise Failure(f"a picture has chunks that may say something: {chunks}")
    check(True, "pictures hold nothing but pixels")


def the_browser_sends_nothing(folder):
    browser = RatingBrowser(folder)
    try:
        browser.open(folder.parent / "study" / "sheets" / "rater_002.html")
        answer = browser.driver.execute_async_script("""
            const done = arguments[0];
            fetch("https://example.invalid/").then(() => done("sent"), () => done("refused"));""")
        told = " ".join(entry["message"] for entry in browser.driver.get_log("browser"))
        check(answer == "refused" and "Content Security Policy" in told, "the page may not send anything, and says so to the browser")
        browser.click("next")
        picture = browser.all(".scene:not([hidden]) .picture")[0]
        picture.send_keys(Keys.ENTER)
        becomes(lambda: browser.by("closer-name").text == "Picture A", "a picture can be looked at closely")
        browser.driver.switch_to.active_element.send_keys(Keys.ARROW_RIGHT)
        becomes(lambda: browser.by("closer-name").text == "Picture B", "and the next one in its place")
        browser.driver.switch_to.active_element.send_keys(Keys.ESCAPE)
        becomes(lambda: browser.driver.switch_to.active_element == picture, "Escape leads back")
    finally:
        browser.close()


def every_question_fits(folder):
    for width, height in ((1280, 690), (820, 1106)):
        browser = RatingBrowser(folder, (width, height))
        try:
            browser.open(folder.parent / "study" / "sheets" / "rater_002.html")
            browser.click("next")
            page = browser.driver.execute_script(
                "return [document.documentElement.scrollWidth, document.documentElement.scrollHeight]")
            check(page[0] <= width and page[1] <= height, f"a scene fits {width} x {height} without scrolling")
            names = browser.driver.execute_script(
                "return [...document.querySelectorAll('input, select, button, img')].filter((e) => !(e.labels || []).length && "
                "!e.getAttribute('aria-label') && !e.textContent.trim() && e.getAttribute('alt') === null).length")
            check(names == 0, "everything that can be used has a name")
        finally:
            browser.close()


def run(program):
    with tempfile.TemporaryDirectory(prefix="ramus-rating-") as name:
        folder = Path(name)
        key = make_study(program, folder)
        for rater in ("first", "second", "other"):
            (folder / rater).mkdir()
        the_page_says_no_method(folder / "study" / "sheets" / "rater_001.html", key)
        first, first_shown = nothing_missing_is_saved(program, folder / "first", key)
        second, second_shown = fill(program, folder / "second", key, 2)
        for shown, orders, file in ((first_shown, key["orders"][0], first), (second_shown, key["orders"][1], second)):
            saved = [scene["order"] for scene in json.loads(file.read_text())["scenes"]]
            check(shown == orders == saved, "what was shown is the order in the key and in the file")
        by_scene = [{frozenset(order): order for order in shown} for shown in (first_shown, second_shown)]
        check(by_scene[0].keys() == by_scene[1].keys() and
              all(by_scene[0][scene] != by_scene[1][scene] for scene in by_scene[0]),
              "two raters see the pictures of each scene in different orders")
        table = json.loads(ramus(program, "ratings", folder / "study" / "key.json", first, second, "--json").stdout)
        check([rater["rater"] for rater in table["raters"]] == [1, 2], "the files go through ramus ratings")
        check(table["raters"][0]["role"] == "surgeon" and table["raters"][0]["years"] == 12, "with what the rater said")
        check(all(0 < rater["seconds"] < PATIENCE for rater in table["raters"]), "and how long the scenes took")
        for criterion in table["criteria"]:
            means = {method: figures["mean"] for method, figures in criterion["methods"].items()}
            check(means == SCORES, f"{criterion['name']}: every method has the scores that its pictures got")
        the_browser_sends_nothing(folder / "other")
        every_question_fits(folder / "other")
    return 0


def main():
    if missing := missing_tools():
        print("SKIPPED: no", ", ".join(missing), "(scripts/setup --browser installs what is missing)")
        return 0
    try:
        return run(os.path.abspath(sys.argv[1]))
    except Failure as failure:
        print("FAILED:", failure)
        return 1


if __name__ == "__main__":
    sys.exit(main())
