#!/usr/bin/env python3
"""A colleague opens a page of `ramus page` in a browser: chromium without a window, WebGL by software, no network.

    page_journey.py RAMUS

`scripts/setup --browser` installs what it needs. Where that is missing the journey is skipped and says so.
"""

import base64
import json
import math
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from browser import Browser, becomes, missing_tools, ramus, requests_of  # noqa: E402
from marionette import Firefox, missing_firefox  # noqa: E402
from page_in_browser import answers_like_ramus, asked, opened, state  # noqa: E402
from screen import SMALL_TREE, Failure, check  # noqa: E402

try:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.keys import Keys
except ImportError:
    pass

# What a name may hold: markup, ends of scripts, marks that turn the direction of writing.
HOSTILE = ["<script>hurt()</script>", "\"><img src=x onerror=hurt()>", "</script><!-- ' & \u202e evil \u2066"]
# Two trees that never meet, the second with a ring of two branches and a branch that ends at none.
RING = """\
# vtk DataFile Version 3.0
a ring behind a stem; lengths in mm, axes RAS
ASCII
DATASET POLYDATA
POINTS 9 float
0 0 0  0 0 10  -6 0 20  6 0 20  0 0 30  0 0 40  5 0 48  -5 0 48  9 0 26
LINES 8 25
2 0 1
3 1 2 4
2 1 3
2 3 4
2 4 5
2 5 6
2 5 7
2 3 8
POINT_DATA 9
SCALARS Radius float 1
LOOKUP_TABLE default
3 3 2 2 2.5 2 1 1 0.8
"""
DEMO = Path(__file__).resolve().parents[2] / "assets" / "liver_portal_vein.swc"


def make_case(program, folder):
    """A session with all that a page can hold, hostile names among it."""
    (folder / "tree.swc").write_text(SMALL_TREE)
    names = [f'name {number} "{name}"' for number, name in enumerate(text.replace('"', "'") for text in HOSTILE)]
    commands = [*names, "lesion 20,5,15,4", "cut 1 0.5", "measure path 1 2", "select 3",
                "view superior", "view-save \"from above\"", "orthographic on", "view left", f"view-save \"{HOSTILE[2].replace(chr(34), chr(39))}\"", "orthographic off", "view anterior", f"save {folder / 'case.json'}"]
    (folder / "commands.txt").write_text("\n".join(commands) + "\n")
    ramus(program, "render", folder / "tree.swc", "-o", folder / "case.png", "--size", "120x90", "--commands", folder / "commands.txt", "--overwrite")
    session = json.loads((folder / "case.json").read_text())
    (folder / "case.json").write_text(json.dumps(session))
    ramus(program, "page", "--session", folder / "case.json", "-o", folder / "case.html", "--title", HOSTILE[0])
    return folder / "case.html"


def place_of(browser, number):
    """A pixel of the picture, from its left and top, where a branch is hit exactly."""
    found = asked(browser, """for (let i = 1; i < 20; ++i) {
            const pixel = ramus.project(ramus.place(given[0], i / 20)).slice(0, 2).map(Math.round), hit = ramus.pick(...pixel);
            if (hit && hit.exact && hit.branch === given[0]) return pixel;
        }
        return null;""", number)
    if found is None:
        raise Failure(f"branch {number} is nowhere in the picture")
    return found


def at(browser, pixel):
    """An action chain with the pointer at a pixel of the picture."""
    canvas = browser.by("picture")
    size = canvas.size
    return ActionChains(browser.driver, duration=20).move_to_element_with_offset(canvas, int(pixel[0] - size["width"] / 2), int(pixel[1] - size["height"] / 2))


def moved(a, b):
    return max(abs(x - y) for x, y in zip(a["position"] + a["focal_point"], b["position"] + b["focal_point"]))


def direction(camera):
    way = [b - a for a, b in zip(camera["position"], camera["focal_point"])]
    return [part / math.hypot(*way) for part in way]


def by_mouse(folder, page):
    browser = opened(folder, page)
    try:
        check(state(browser)["selection"] == [3], "what was selected in ramus is selected in the page")
        pixel = place_of(browser, 0)
        at(browser, pixel).click().perform()
        becomes(lambda: state(browser)["selection"] == [0], "a click selects a branch")
        browser.click("do-dependents")
        becomes(lambda: state(browser)["selection"] == [0, 1, 2, 3, 4], "Dependents takes all of the tree")
        at(browser, (90, 400)).click().perform()
        becomes(lambda: state(browser)["selection"] == [], "a click beside the vessels selects nothing")
        at(browser, place_of(browser, 2)).key_down(Keys.ALT).click().key_up(Keys.ALT).perform()
        becomes(lambda: state(browser)["selection"] == [2, 3, 4], "Alt+click takes what depends on a branch")
        browser.click("do-defocus")
        becomes(lambda: state(browser)["states"].count("defocused") == 3, "Defocus makes glass of it")
        check(asked(browser, "return ramus.pick(given[0], given[1]).branch", *place_of(browser, 2)) == 2, "glass can be picked")
        browser.click("do-hide")
        becomes(lambda: state(browser)["states"].count("hidden") == 3, "Hide hides it")
        before = state(browser)["camera"]
        at(browser, (300, 300)).click_and_hold().move_by_offset(80, 30).release().perform()
        turned = state(browser)["camera"]
        check(moved(before, turned) > 1 and len(state(browser)["selection"]) == 3, "a drag turns and selects nothing")
        at(browser, (300, 300)).key_down(Keys.SHIFT).click_and_hold().move_by_offset(40, 0).release().key_up(Keys.SHIFT).perform()
        panned = state(browser)["camera"]
        check(moved(turned, panned) > 1 and math.dist(direction(turned), direction(panned)) < 1e-6, "Shift+drag moves without turning")
        pixel = place_of(browser, 0)
        point = asked(browser, "return ramus.pick(given[0], given[1]).point", *pixel)
        ActionChains(browser.driver).scroll_from_origin(origin(browser, pixel), 0, -300).perform()
        becomes(lambda: moved(panned, state(browser)["camera"]) > 1, "the wheel zooms")
        there = asked(browser, "return ramus.project(given[0])", point)
        check(math.dist(there[:2], pixel) < 1.5, "to the point under the pointer")
        saved_views_by_mouse(browser)
        for _ in range(8):
            browser.driver.find_element("xpath", "//button[text()='Undo']").click()
        becomes(lambda: state(browser)["states"].count("hidden") == 0, "Undo brings everything back")
        measuring_by_mouse(browser)
        browser.by("tab-plan").click()
        check(browser.by("plan").is_displayed() and not browser.by("explore").is_displayed(), "tabs open")
        plan_by_mouse(browser)
        browser.by("tab-about").click()
        check("Not a medical device" in browser.by("about").text and str(folder) not in browser.driver.page_source, "what the page is, and no path, is said")
        complaints(browser)
    finally:
        browser.close()


def saved_views_by_mouse(browser):
    buttons = browser.driver.find_elements("css selector", "#view-list button")
    check([" ".join(button.accessible_name.split()) for button in buttons] == ["from above", " ".join(HOSTILE[2].translate({0x202e: None, 0x2066: None}).split())], "saved views are buttons with their names")
    buttons[0].click()
    becomes(lambda: direction(state(browser)["camera"])[2] < -0.999, "a click goes to a saved view")
    check("from above" in browser.by("status").text, "and a screen reader hears which")
    buttons[1].click()
    becomes(lambda: state(browser)["camera"]["orthographic"] and direction(state(browser)["camera"])[0] > 0.999, "also to one of the other projection, whatever its name")
    asked(browser, "ramus.view('from above')")
    becomes(lambda: direction(state(browser)["camera"])[2] < -0.999 and not state(browser)["camera"]["orthographic"], "scripts go to a saved view by its name")
    check(asked(browser, "try { ramus.view('nowhere'); return ''; } catch (error) { return error.message; }") == "no view is called nowhere", "and are told of one that is not there")
    asked(browser, "document.getElementById('picture').focus()")
    ActionChains(browser.driver).send_keys("2").perform()
    becomes(lambda: direction(state(browser)["camera"])[0] > 0.999, "keys go to saved views by their number")
    ActionChains(browser.driver).send_keys("1").perform()
    becomes(lambda: not state(browser)["camera"]["orthographic"], "and back")


def origin(browser, pixel):
    from selenium.webdriver.common.actions.wheel_input import ScrollOrigin
    canvas = browser.by("picture")
    return ScrollOrigin.from_element(canvas, int(pixel[0] - canvas.size["width"] / 2), int(pixel[1] - canvas.size["height"] / 2))


def measuring_by_mouse(browser):
    asked(browser, "ramus.showAll(); ramus.view('anterior'); await new Promise((done) => setTimeout(done, 700));")
    pixels = [place_of(browser, number) for number in (1, 2)]
    points = [asked(browser, "return ramus.pick(given[0], given[1]).point", *pixel) for pixel in pixels]
    browser.click("tool-distance")
    for pixel in pixels:
        at(browser, pixel).click().perform()
    becomes(lambda: len(state(browser)["measurements"]) == 2, "two clicks measure a distance")
    made = state(browser)["measurements"][-1]
    check(abs(made["length_mm"] - math.dist(*points)) < 0.1, "that of the two points")
    browser.click("tool-diameter")
    at(browser, place_of(browser, 0)).click().perform()
    becomes(lambda: len(state(browser)["measurements"]) == 3, "a click measures a diameter")
    check(abs(state(browser)["measurements"][-1]["length_mm"] - 10.0) < 0.1, "of the vessel there")
    browser.click("tool-lasso")
    size = state(browser)["size"]
    around = [(20, 70), (size[0] - 20, 70), (size[0] - 20, size[1] - 20), (20, size[1] - 20)]
    chain = at(browser, around[0]).click_and_hold()
    for here, there in zip(around, around[1:]):
        chain = chain.move_by_offset(there[0] - here[0], there[1] - here[1])
    chain.release().perform()
    becomes(lambda: state(browser)["selection"] == [0, 1, 2, 3, 4], "a lasso around everything selects everything")
    browser.click("tool-select")


def plan_by_mouse(browser):
    for view in ("before", "after", "marked"):
        browser.driver.find_element("css selector", f"input[name=plan-view][value={view}]").click()
        becomes(lambda view=view: state(browser)["planView"] == view, f"the plan is shown: {view}")
    check(browser.driver.find_elements("css selector", "#plan table td") != [], "with its figures")


def by_keys(folder, page):
    """From the address bar with the keyboard alone."""
    browser = opened(folder, page)
    try:
        reached = []
        for _ in range(60):
            ActionChains(browser.driver).send_keys(Keys.TAB).perform()
            focus = asked(browser, """const e = document.activeElement;
                return [e.id || e.textContent.trim().slice(0, 20), e.getAttribute("aria-label") || (e.labels && e.labels.length ? e.labels[0].textContent : "") || e.textContent.trim()]""")
            if focus in reached:
                break
            reached.append(focus)
        check({"picture", "tab-explore", "filter", "colour-by"} <= {name for name, _ in reached}, f"Tab reaches every part: {[name for name, _ in reached]}")
        check(all(label for name, label in reached), "and everything it reaches has a name")
        asked(browser, "document.getElementById('picture').focus()")
        keys = lambda *text: ActionChains(browser.driver).send_keys(*text).perform()  # noqa: E731
        keys(Keys.ESCAPE)
        becomes(lambda: state(browser)["selection"] == [], "Escape selects nothing")
        keys("]")
        becomes(lambda: state(browser)["selection"] == [0], "a bracket starts at the root")
        keys("]")
        becomes(lambda: state(browser)["selection"] == [1, 2], "and goes to its children")
        keys("d")
        becomes(lambda: state(browser)["selection"] == [1, 2, 3, 4], "D takes dependents")
        keys("g")
        becomes(lambda: state(browser)["states"].count("defocused") == 4, "G makes glass")
        keys("n")
        becomes(lambda: state(browser)["states"].count("defocused") == 0, "N shows normally")
        camera = state(browser)["camera"]
        keys(Keys.ARROW_LEFT, "+")
        becomes(lambda: moved(camera, state(browser)["camera"]) > 1, "arrows and plus move the view")
        keys("s")
        becomes(lambda: abs(state(browser)["camera"]["view_up"][1] - 1) < 1e-6, "S looks from above")
        keys("/")
        keys("id=3")
        becomes(lambda: "1 branch found" in browser.by("found").text, "the search finds a branch by its number")
        keys(Keys.ENTER)
        becomes(lambda: state(browser)["selection"] == [3], "Enter selects what was found")
        becomes(lambda: "Selected" in browser.by("status").text or "generation" in browser.by("status").text, "and a screen reader hears it")
        complaints(browser)
    finally:
        browser.close()


def by_touch(folder, page):
    """A phone: fingers, and nothing wider than the screen."""
    browser = opened(folder, page, (390, 844), phone=True)
    try:
        box = asked(browser, "const box = document.getElementById('picture').getBoundingClientRect(); return [box.left, box.top, box.width, box.height]")
        check(box[2] == 390 and box[3] > 300, "the picture fills the width of the phone")
        check(asked(browser, "return document.documentElement.scrollWidth") <= 390, "and nothing is wider")
        low = asked(browser, """return [...document.querySelectorAll('#live button, #live select')].filter((e) => e.offsetParent && !e.closest('thead') && e.getBoundingClientRect().height < 36).map((e) => e.textContent)""")
        check(low == [], f"buttons are as high as fingers need: {low}")

        def fingers(kind, *points):
            browser.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [
                {"x": box[0] + x, "y": box[1] + y, "id": number} for number, (x, y) in enumerate(points)]})

        pixel = place_of(browser, 0)
        fingers("touchStart", pixel)
        fingers("touchEnd")
        becomes(lambda: state(browser)["selection"] == [0], "a tap selects a branch")
        before = state(browser)["camera"]
        fingers("touchStart", (195, 200))
        for step in range(6):
            fingers("touchMove", (195 + 12 * step, 200))
        fingers("touchEnd")
        becomes(lambda: moved(before, state(browser)["camera"]) > 1, "one finger turns")
        turned = state(browser)["camera"]
        fingers("touchStart", (170, 200), (220, 200))
        for step in range(6):
            fingers("touchMove", (170 - 8 * step, 200), (220 + 8 * step, 200))
        fingers("touchEnd")
        distance = lambda camera: math.dist(camera["position"], camera["focal_point"])  # noqa: E731
        becomes(lambda: distance(state(browser)["camera"]) < 0.9 * distance(turned), "two fingers zoom")
        check(state(browser)["selection"] == [0], "and select nothing")
        complaints(browser)
    finally:
        browser.close()


def names_do_nothing(folder, page):
    browser = opened(folder, page)
    try:
        asked(browser, "ramus.select([0, 1, 2]); for (const id of ['plan', 'tables', 'about', 'explore']) document.getElementById('tab-' + id).click();")
        check(asked(browser, "return typeof hurt") == "undefined" and asked(browser, "return document.querySelectorAll('#live img, #live script').length") == 0,
              "names are text and nothing else")
        check(not re.search("[\u202a-\u202e\u2066-\u2069]", asked(browser, "return document.getElementById('branches').textContent")), "and turn no other text around")
        check(asked(browser, "return fetch('https://example.invalid/').then(() => 'sent', () => 'refused')") == "refused", "the page may send nothing")
        check(asked(browser, """const button = document.createElement("button"), script = document.createElement("script");
            button.setAttribute("onclick", "window.ran = true");
            script.textContent = "window.ran = true";
            document.body.append(button, script);
            button.click();
            return window.ran === undefined"""), "and runs no other script")
        check(requests_of(browser) == [], "nothing but the page itself was asked for")
    finally:
        browser.close()


def readable(folder, page):
    """Contrast of all text, light and dark: WCAG's 4.5 : 1."""
    browser = opened(folder, page)
    try:
        asked(browser, "ramus.select([1])")
        for theme in ("dark", "light"):
            for tab in ("explore", "plan", "tables", "about"):
                browser.by(f"tab-{tab}").click()
                poor = asked(browser, CONTRAST)
                check(poor == [], f"{theme}, {tab}: every text has a contrast of 4.5 : 1: {poor[:5]}")
            browser.click("theme")
    finally:
        browser.close()


CONTRAST = """
const paint = document.createElement('canvas').getContext('2d', { willReadFrequently: true });
const rgba = (colour) => { paint.clearRect(0, 0, 1, 1); paint.fillStyle = colour; paint.fillRect(0, 0, 1, 1); const d = paint.getImageData(0, 0, 1, 1).data; return [d[0], d[1], d[2], d[3] / 255]; };
const light = (c) => { const [r, g, b] = c.slice(0, 3).map((v) => (v /= 255) <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4); return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
const poor = [];
for (const e of document.querySelectorAll('body *')) {
  if (!e.checkVisibility() || e.closest('#stage canvas, :disabled') || ![...e.childNodes].some((n) => n.nodeType === 3 && n.textContent.trim())) continue;
  if (getComputedStyle(e).clipPath !== 'none') continue;
  const stack = [];
  for (let at = e; at; at = at.parentElement) stack.push(rgba(getComputedStyle(at).backgroundColor));
  let back = rgba(getComputedStyle(document.documentElement).backgroundColor);
  for (const c of stack.reverse()) back = back.map((v, k) => k < 3 ? c[k] * c[3] + v * (1 - c[3]) : 1);
  const a = light(rgba(getComputedStyle(e).color)), b = light(back), ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
  if (ratio < 4.5) poor.push([e.tagName, e.id, e.textContent.slice(0, 30), Math.round(100 * ratio) / 100]);
}
return poor;
"""


def without_webgl(folder, page):
    browser = Browser(folder)  # no graphics at all
    try:
        browser.driver.set_script_timeout(60)
        browser.driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": "HTMLCanvasElement.prototype.getContext = () => null;"})
        browser.open(page)
        check(asked(browser, "return ramus.ready") is False, "without WebGL the page does not pretend")
        check("cannot be shown" in browser.by("trouble").text and browser.by("report").is_displayed() and not browser.by("live").is_displayed(),
              "it says so and shows the report")
    finally:
        browser.close()


def looks_like_ramus(program, folder, tree, page):
    """The same camera in both: solid, and with glass. Mean difference of 255."""
    browser = opened(folder, page)
    try:
        for name, limit, script, commands in (
                ("solid", 6.0, "ramus.showAll(); ramus.select([])", "select-none"),
                ("glass", 10.0, "ramus.defocus(ramus.subtree(1)); ramus.select([])", "select 1\nselect-dependents\ndefocus\nselect-none")):
            camera, picture = asked(browser, f"{script}; return [ramus.camera(), ramus.picture({{ bare: true }})]")
            mine, theirs = folder / f"{name}_page.png", folder / f"{name}_ramus.png"
            mine.write_bytes(base64.b64decode(picture.split(",")[1]))
            size = [int.from_bytes(mine.read_bytes()[at:at + 4], "big") for at in (16, 20)]
            (folder / "look.txt").write_text(commands + "\n")
            ramus(program, "render", tree, "-o", theirs, "--size", f"{size[0]}x{size[1]}", "--camera", json.dumps(camera), "--overlays", "none", "--commands", folder / "look.txt")
            answer = subprocess.run(["compare", "-metric", "MAE", mine, theirs, "null:"], capture_output=True, text=True).stderr
            mean = 255.0 * float(re.search(r"\(([-\d.e]+)\)", answer)[1])
            check(mean < limit, f"{name}: the page's picture differs from ramus' by {mean:.2f} of 255")
    finally:
        browser.close()


def in_firefox(folder, page):
    if missing := missing_firefox():
        print("not tried in Firefox: no", ", ".join(missing))
        return
    browser = Firefox()
    try:
        browser.open(page)
        check(browser.asked("return await ramus.ready"), "Firefox opens the page too")
        check(browser.asked("return ramus.state().selection.length === 1 && ramus.subtree(0).length === 5"), "and answers")
        check(browser.asked("const [x, y] = ramus.project(ramus.place(0)); return ramus.pick(x, y).branch === 0"), "and picks")
        requests = browser.asked("return performance.getEntriesByType('resource').map((one) => one.name).filter((name) => !/^(data|blob):/.test(name))")
        check(requests == [], f"and asks for nothing: {requests}")
    finally:
        browser.close()


def speed(folder, page):
    """Figures, and limits that a busy machine keeps too."""
    browser = Browser(folder, (1440, 900), drawing=True)
    try:
        browser.driver.set_script_timeout(120)
        browser.open(page)
        first = asked(browser, """await ramus.ready;
            while (ramus.state().frames === 0) await new Promise((done) => setTimeout(done, 5));
            return performance.now();""")
        turning = asked(browser, """const begin = performance.now(), frames = ramus.state().frames, picture = document.getElementById("picture");
            const key = () => picture.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft", bubbles: true }));
            while (performance.now() - begin < 5000) { key(); await new Promise(requestAnimationFrame); }
            return 1000 * (ramus.state().frames - frames) / (performance.now() - begin);""")
        print(f"first picture after {first / 1000:.1f} s, {turning:.1f} pictures a second while turning, {page.stat().st_size / 1e6:.1f} MB")
        check(page.stat().st_size < 12e6, "the page of the demo tree is below 12 MB")
        check(first < 60000 and turning > 0.3, "the first picture comes, and the view turns")
    finally:
        browser.close()


def complaints(browser):
    told = [entry["message"] for entry in browser.driver.get_log("browser") if "GPU stall" not in entry["message"]]
    check(told == [], f"the browser has nothing to complain about: {told}")
    check(requests_of(browser) == [], "nothing is asked of any network")


def run(program):
    with tempfile.TemporaryDirectory(prefix="ramus-page-") as name:
        folder = Path(name)
        (folder / "ring.vtk").write_text(RING)
        trees = [(folder / "ring.vtk", 1), (DEMO, 41)]
        real = Path(os.environ.get("RAMUS_SHARED_DATA", "")) / "trees"
        trees += [(real / name, 17) for name in ("mouse_airways_m04.swc", "brain_BG05.swc", "brain_unjoined_7001.swc") if (real / name).is_file()]
        for tree, step in trees:
            page = folder / f"{tree.stem}.html"
            ramus(program, "page", tree, "-o", page)
            answers_like_ramus(program, folder, tree, page, step)
        looks_like_ramus(program, folder, DEMO, folder / f"{DEMO.stem}.html")
        speed(folder, folder / f"{DEMO.stem}.html")
        page = make_case(program, folder)
        by_mouse(folder, page)
        by_keys(folder, page)
        by_touch(folder, page)
        names_do_nothing(folder, page)
        readable(folder, page)
        without_webgl(folder, page)
        in_firefox(folder, page)
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
