"""What raters answered, on the command line: from files as rating pages save them to the table, and what is refused."""

import csv
import io
import json
import unittest

from ramus import GOOD, CommandLineTest

CRITERIA = ("appearance", "spatial_shape", "transitions", "overall")
METHODS = ("isosurface", "cones", "convolution")


class Ratings(CommandLineTest):
    """A study of pictures that nobody sees: made once, for it takes the most time."""

    study = None

    def setUp(self):
        super().setUp()
        if Ratings.study is None:
            self.write("tree.swc", GOOD)
            self.expect_done("study", "tree.swc", "-o", "made", "--size", "64x48", "--raters", "12", "--seed", "5")
            Ratings.study = (self.folder / "made" / "key.json").read_text()
        self.write("key.json", Ratings.study)
        self.key = json.loads(Ratings.study)
        self.method = {code: method for scene in self.key["scenes"] for code, method in scene["pictures"].items()}

    def answers(self, rater, score):
        """The file of a rater; score(scene, method, criterion), the scene as the rater counts."""
        orders = self.key["orders"][rater - 1]
        return {
            "format": "ramus-ratings", "version": 1, "study": self.key["study"], "rater": rater, "role": None, "years": None,
            "started": "2026-01-01T10:00:00.000Z", "saved": "2026-01-01T10:20:00.000Z",
            "scenes": [{"order": order, "seconds": 60.5} for order in orders],
            "answers": [{"picture": code, "criterion": criterion, "score": score(scene, self.method[code], criterion)}
                        for scene, order in enumerate(orders) for code in order for criterion in CRITERIA]}

    def write_answers(self, name, answers):
        return self.write(name, json.dumps(answers)).name

    def raters(self, count, score):
        return [self.write_answers(f"r{rater}.json", self.answers(rater, lambda *asked, r=rater: score(r, *asked)))
                for rater in range(1, count + 1)]

    @staticmethod
    def better(rater, scene, method, criterion):
        """The convolution surface is above the isosurface for all, and above the cones by as much as the rater is odd."""
        if method == "isosurface":
            return 2
        if method == "cones":
            return 3
        return 4 if criterion == "appearance" else 3 + rater % 2

    def test_the_table_of_ten_raters(self):
        files = self.raters(10, self.better)
        table = self.json("ratings", *files, "key.json", "--json")
        self.assertEqual(table["study"], self.key["study"])
        self.assertEqual(table["compared"], "convolution")
        self.assertEqual([rater["rater"] for rater in table["raters"]], list(range(1, 11)))
        self.assertEqual(table["raters"][0]["seconds"], 60.5 * len(self.key["scenes"]))
        scenes = len(self.key["scenes"])
        appearance, overall = table["criteria"][0], table["criteria"][3]
        self.assertEqual([criterion["criterion"] for criterion in table["criteria"]], list(CRITERIA))
        self.assertEqual(appearance["methods"]["convolution"],
                         {"title": "Convolution surface", "count": 10 * scenes, "mean": 4.0, "sigma": 0.0, "median": 4.0})
        # Ten raters, all in one direction: 2 of 2^10 ways. There are eight comparisons, five of them such: the smallest
        # five are all multiplied by eight, for a corrected value is never below one before it.
        against = appearance["against"]["isosurface"]
        self.assertEqual(against["pairs"], 10)
        self.assertEqual(against["difference"], 2.0)
        self.assertEqual(against["wilcoxon"], {"pairs": 10, "exact": True, "w_plus": 55.0, "w_minus": 0.0, "p": 2 / 1024,
                                               "p_holm": 8 * 2 / 1024, "least_p": 2 / 1024, "rank_biserial": 1.0})
        self.assertIsNone(against["t_test"]["t"])  # all differ alike
        self.assertIsNone(against["confidence_95"])
        # Against the cones every second rater sees no difference: five pairs, 2 of 2^5, the last three of eight.
        against = overall["against"]["cones"]
        self.assertEqual(against["wilcoxon"]["pairs"], 5)
        self.assertEqual(against["wilcoxon"]["p"], 2 / 32)
        self.assertEqual(against["wilcoxon"]["p_holm"], 3 * 2 / 32)
        # Five differences of 1 and five of 0: mean 0.5, sigma sqrt(10 / 4 / 9), t = 0.5 / (sigma / sqrt(10)) = 3.
        self.assertAlmostEqual(against["t_test"]["t"], 3.0, places=12)
        self.assertAlmostEqual(against["t_test"]["p"], 0.014956363910414127, places=12)  # 2 * scipy.stats.t.sf(3, 9)
        self.assertAlmostEqual(against["difference"], 0.5, places=12)
        self.assertAlmostEqual(against["t_test"]["cohen_d"], 3 / 10 ** 0.5, places=12)

    def test_the_table_as_text_and_csv(self):
        files = self.raters(10, self.better)
        told = self.expect_done("ratings", "key.json", *files, "--csv", "table.csv").stdout
        for words in ("10 raters", "Appearance", "Truncated cones", "Convolution surface", "2.00", "Wilcoxon",
                      "0.0020", "0.0156", "Holm"):
            self.assertIn(words, told)
        streamed = self.expect_done("ratings", "key.json", *files, "--csv", "-").stdout
        self.assertEqual(streamed.splitlines(), (self.folder / "table.csv").read_text().splitlines())
        self.expect_failure("ratings", "key.json", *files, "--csv", "-", "--json", says=["standard output"])
        rows = list(csv.DictReader(io.StringIO((self.folder / "table.csv").read_bytes().decode(), newline="")))
        self.assertEqual([(row["criterion"], row["method"]) for row in rows],
                         [(criterion, method) for criterion in CRITERIA for method in METHODS])
        self.assertEqual(float(rows[0]["p"]), 0.001953125)
        self.assertEqual(rows[0]["t"], "")
        self.assertEqual(rows[2]["p"], "")
        self.assertEqual(float(rows[2]["mean"]), 4.0)

    def test_pairs_of_answers_on_request(self):
        files = self.raters(3, lambda rater, scene, method, criterion: {"isosurface": 1, "cones": 2}.get(method, 3 + scene % 2))
        scenes = len(self.key["scenes"])
        table = self.json("ratings", "key.json", *files, "--pair-by", "answer", "--json")
        self.assertEqual(table["criteria"][0]["against"]["cones"]["pairs"], 3 * scenes)
        self.assertEqual(table["criteria"][0]["against"]["cones"]["wilcoxon"]["p"], 2.0 ** (1 - 3 * scenes))
        self.assertEqual(self.json("ratings", "key.json", *files, "--json")["criteria"][0]["against"]["cones"]["pairs"], 3)
        self.assertIn("too small", self.expect_done("ratings", "key.json", *files, "--pair-by", "answer").stdout)

    def test_one_rater_gives_no_significance_and_few_raters_give_a_warning(self):
        files = self.raters(5, self.better)
        told = self.expect_done("ratings", "key.json", files[0]).stdout
        self.assertIn("One rater: nothing can be said", told)
        self.assertNotIn("Wilcoxon", told)
        table = self.json("ratings", "key.json", files[0], "--json")
        self.assertEqual(table["comparisons"], 0)
        self.assertNotIn("against", table["criteria"][0])
        self.assertIn("one rater", table["significance"])
        # 8 x 2 / 2^n is below 0.05 from nine raters on.
        self.assertIn("No p of ranks of 5 raters can be below 0.0625", self.expect_done("ratings", "key.json", *files).stdout)
        self.assertIn("it takes 9 raters", self.expect_done("ratings", "key.json", *files).stdout)

    def refused(self, name, answers, *says):
        self.write_answers(name, answers)
        self.expect_failure("ratings", "key.json", name, says=(name, *says))

    def test_incomplete_and_out_of_range_answers(self):
        good = self.answers(1, lambda *asked: 3)
        text = json.dumps(good)

        def changed(change):
            answers = json.loads(text)
            change(answers)
            return answers

        self.refused("a.json", changed(lambda a: a["answers"].pop()), "1 answer is missing", "Overall", "picture C")
        self.refused("a.json", changed(lambda a: a["answers"].clear()), "answers are missing", "and others")
        for score in (0, 6, -1, 2.5, "3", None, True, 10 ** 30, [3]):
            self.refused("a.json", changed(lambda a, s=score: a["answers"][0].update(score=s)), "score", "from 1 to 5", "Appearance")
        self.refused("a.json", changed(lambda a: a["answers"].append(a["answers"][0])), "answered twice")
        self.refused("a.json", changed(lambda a: a["answers"][0].update(picture="0123")), "0123")
        self.refused("a.json", changed(lambda a: a["answers"][0].update(criterion="beauty")), "beauty")
        self.refused("a.json", changed(lambda a: a["scenes"].reverse()), "order", "rater 1")
        self.refused("a.json", changed(lambda a: a.update(rater=2)), "order", "rater 2")
        self.refused("a.json", changed(lambda a: a.update(rater=13)), "rater 13 is out of range")
        self.refused("a.json", changed(lambda a: a.update(rater="me")), "rater is not a whole number")
        self.refused("a.json", changed(lambda a: a.update(version=2)), "version 2")
        self.refused("a.json", changed(lambda a: a.update(role="king")), "king")
        self.refused("a.json", changed(lambda a: a.update(years=-1)), "years")
        self.refused("a.json", changed(lambda a: a.update(extra=1)), "extra")
        for member in good:
            if member != "format":
                self.refused("a.json", changed(lambda a, m=member: a.pop(m)), f'there is no "{member}"')
        self.refused("a.json", changed(lambda a: a.update(study="0" * 16)), "study", self.key["study"])

    def test_files_that_do_not_belong_together(self):
        one, two = self.raters(2, self.better)
        self.write("again.json", (self.folder / one).read_bytes())
        self.expect_failure("ratings", "key.json", one, two, "again.json", says=("again.json", "rater 1", one))
        self.expect_failure("ratings", one, two, says=(one, "no key", "key.json"))
        self.expect_failure("ratings", "key.json", says=("key.json", "no answers"))
        self.write("other.json", Ratings.study)
        self.expect_failure("ratings", "key.json", "other.json", one, says=("other.json", "second key"))

    def test_files_of_other_kinds(self):
        (one,) = self.raters(1, self.better)
        for content, says in (("", "empty"), ("{", "JSON"), ("[1, 2]", "neither"), ("{}", "neither"), ("null", "neither"),
                              ('{"format": "ramus-tree"}', "neither"), ('{"format": 3}', "neither"), (b"\x89PNG\r\n", "JSON")):
            self.write("x.json", content)
            self.expect_failure("ratings", "key.json", one, "x.json", says=("x.json", says))
        self.expect_failure("ratings", "key.json", one, "none.json", says=("none.json",))
        self.expect_failure("ratings", "key.json", one, ".", says=(".",))

    def test_deep_and_huge_files(self):
        (one,) = self.raters(1, self.better)
        head = json.dumps(self.answers(2, lambda *asked: 3))[:-1]
        for deep in ("[" * 300_000 + "]" * 300_000, '{"a":' * 100_000 + "1" + "}" * 100_000):
            self.write("deep.json", head + ', "extra": ' + deep + "}")
            self.expect_failure("ratings", "key.json", one, "deep.json", says=("deep.json", "deeper"))
        self.write("deep.json", "[" * 1_000_000)
        self.expect_failure("ratings", "key.json", one, "deep.json", says=("deep.json", "deeper"))
        self.write("huge.json", head + ', "extra": "' + "x" * (3 << 20) + '"}')
        self.expect_failure("ratings", "key.json", one, "huge.json", says=("huge.json", "larger than 2 MiB"))

    def test_a_key_that_was_changed(self):
        (one,) = self.raters(1, self.better)

        def refused(change, *says):
            key = json.loads(Ratings.study)
            change(key)
            self.write("changed.json", json.dumps(key))
            self.expect_failure("ratings", "changed.json", one, says=("changed.json", *says))

        refused(lambda key: key["scenes"][0].update(title="Another"), "checksum")
        refused(lambda key: key["orders"][0].pop(), "all scenes")
        refused(lambda key: key["orders"][0][0].pop(), "all pictures")
        refused(lambda key: key["orders"][0][0].__setitem__(0, key["orders"][0][0][1]), "twice")
        refused(lambda key: key["orders"][0][0].__setitem__(0, key["orders"][0][1][1]), "two scenes")
        refused(lambda key: key["scenes"][0]["pictures"].popitem(), "one picture of each method")
        refused(lambda key: key.update(compared="magic"), "magic")
        refused(lambda key: key.update(seed=-1), "seed")
        refused(lambda key: key.pop("methods"), "methods")
        refused(lambda key: key.update(scenes={}), "scenes")

    def test_wrong_usage_and_unwritable_output(self):
        (one,) = self.raters(1, self.better)
        self.assertEqual(self.run_ramus("ratings").returncode, 2)
        self.assertEqual(self.run_ramus("ratings", "key.json", one, "--pair-by", "scene").returncode, 2)
        self.expect_failure("ratings", "key.json", one, "--csv", "nowhere/table.csv", says=("nowhere",))
        names = self.names()
        self.expect_failure("ratings", "key.json", one, one, "--csv", "table.csv", says=("rater 1",))
        self.assertEqual(self.names(), names)


if __name__ == "__main__":
    unittest.main()
