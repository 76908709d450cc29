"""A page of `ramus page` in a browser, without a network: what scripts ask it, and what it answers beside `ramus info`."""

import json
import math
from collections import defaultdict

from browser import Browser, ramus, requests_of
from screen import Failure, check


def asked(browser, script, *arguments):
    """What a script answers; it may wait."""
    answer = browser.driver.execute_async_script(
        "const done = arguments[arguments.length - 1], given = [...arguments].slice(0, -1);"
        f"(async () => {{ {script} }})().then((value) => done([value === undefined ? null : value]), (error) => done(String(error && error.stack)));",
        *arguments)
    if not isinstance(answer, list):
        raise Failure(f"{script}: {answer}")
    return answer[0]


def opened(folder, page, size=(1200, 780), phone=False):
    browser = Browser(folder, size, phone, drawing=True)
    browser.driver.set_script_timeout(120)
    browser.driver.execute_cdp_cmd("Network.enable", {})
    browser.driver.execute_cdp_cmd("Network.emulateNetworkConditions", {"offline": True, "latency": 0, "downloadThroughput": 0, "uploadThroughput": 0})
    browser.open(page)
    check(asked(browser, "return ramus.ready"), f"{page.name} opens")
    return browser


def state(browser):
    return asked(browser, "return ramus.state()")


def reachable(branches, without):
    """By walking: the branches that are still reached from the roots when one is taken out."""
    meets = defaultdict(list)
    for branch in branches:
        for end in ("first", "last"):
            meets[tuple(branch[end])].append(branch["id"])
    found, todo = set(), [tuple(branch["first"]) for branch in branches if branch["parent"] is None]
    places = set(todo)
    while todo:
        place = todo.pop()
        for number in meets[place]:
            if number == without:
                continue
            found.add(number)
            for end in ("first", "last"):
                if (other := tuple(branches[number][end])) not in places:
                    places.add(other)
                    todo.append(other)
    return found


def dependents(branches, number):
    return sorted({branch["id"] for branch in branches} - reachable(branches, number) | {number})


def answers_like_ramus(program, folder, tree, page, step=1):
    """Every branch of the page against `ramus info`; the dependents of every `step`-th also by walking the network."""
    branches = json.loads(ramus(program, "info", tree, "--json", "--branches").stdout)["branch_list"]
    browser = opened(folder, page)
    try:
        found = asked(browser, """return [...Array(given[0]).keys()].map((id) => {
            const b = ramus.branch(id);
            return { parent: b.parent, children: b.children, length: b.length_mm, d: b.diameter_mm, generation: b.generation,
                     strahler: b.strahler, subtree: ramus.subtree(id), upstream: ramus.upstream(id) }; })""", len(branches))
        near = lambda a, b: math.isclose(a, b, rel_tol=1e-5, abs_tol=1e-5)  # noqa: E731
        for branch, one in zip(branches, found):
            name = f"branch {branch['id']} of {tree.name}"
            same = (one["parent"] == branch["parent"] and one["children"] == branch["children"] and
                    one["generation"] == branch["generation"] and one["strahler"] == branch["strahler"] and
                    near(one["length"], branch["length_mm"]) and all(near(one["d"][k], branch["diameter_mm"][k]) for k in ("min", "mean", "max")))
            if not same:
                raise Failure(f"{name} differs: {one} {branch}")
            above, up = branch["id"], []
            while above is not None:
                up.append(above)
                above = branches[above]["parent"]
            if one["upstream"] != sorted(up):
                raise Failure(f"upstream of {name}: {one['upstream']}")
            if branch["id"] % step == 0 and one["subtree"] != dependents(branches, branch["id"]):
                raise Failure(f"subtree of {name}: {one['subtree']}")
        check(True, f"{len(branches)} branches of {tree.name} answer as ramus does")
        paths_are_shortest(browser, branches)
        check(requests_of(browser) == [], "and nothing is asked of any network")
    finally:
        browser.close()


def paths_are_shortest(browser, branches):
    """Paths between middles of branches, against distances by repeated relaxation."""
    count = len(branches)
    for a, b in ((0, count - 1), (count // 2, count // 3), (count - 1, count // 2)):
        ends = lambda branch: (tuple(branch["first"]), tuple(branch["last"]))  # noqa: E731
        far = defaultdict(lambda: math.inf)
        for place in ends(branches[a]):
            far[place] = branches[a]["length_mm"] / 2
        changed = True
        while changed:
            changed = False
            for branch in branches:
                p, q = ends(branch)
                for x, y in ((p, q), (q, p)):
                    if far[x] + branch["length_mm"] < far[y] - 1e-12:
                        far[y] = far[x] + branch["length_mm"]
                        changed = True
        expected = 0.0 if a == b else min(far[place] for place in ends(branches[b])) + branches[b]["length_mm"] / 2
        found = asked(browser, "return ramus.path(given[0], given[1])", a, b)
        if found is None:
            check(math.isinf(expected), f"no vessels connect {a} and {b}")
        else:
            check(abs(found["length_mm"] - expected) < 0.1 and found["branches"][0] == a and found["branches"][-1] == b,
                  f"the path from {a} to {b} is {expected:.1f} mm long")
