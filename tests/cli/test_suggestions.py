"""A command or an option that does not exist: what was meant is said, on standard error, with exit status 2."""

import re
import unittest

from ramus import GOOD, CommandLineTest


class SuggestionsTest(CommandLineTest):
    def commands(self):
        helped = self.expect_done("--help").stdout.split("Subcommands:")[1]
        return re.findall(r"^  ([a-z]+) ", helped, re.MULTILINE)

    def refused(self, *arguments, says):
        return self.expect_failure(*arguments, status=2, says=says)

    def test_a_misspelled_command_is_recognised_with_any_arguments(self):
        rests = ((), ("liver.swc",), ("liver.swc", "-o", "x.stl"), ("--json", "--size", "1x1"))
        for number, command in enumerate(self.commands()):
            swapped = command[:-2] + command[-1] + command[-2]
            for rest in rests if number == 0 else rests[number % len(rests):][:1]:
                self.refused(swapped, *rest, says=(f"{swapped}: neither a command nor a file", f"did you mean {command}?"))

    def test_an_unknown_word_refers_to_the_list_of_commands(self):
        result = self.refused("xyzzy", says=("xyzzy: neither a command nor a file", "ramus --help"))
        self.assertNotIn("did you mean", result.stderr)

    def test_every_misspelled_long_option_is_recognised(self):
        """An option that several commands share is tested with the first of them."""
        found = set()
        for command in self.commands():
            options = set(re.findall(r"(--[a-z][a-z-]{4,})", self.expect_done(command, "--help").stdout))
            self.assertGreater(len(options), 1)
            for option in sorted(options - found):
                wrong = option[:4] + "q" + option[4:]
                self.assertNotIn(wrong, options)
                result = self.run_ramus(command, wrong)
                if "required" in result.stderr.lower():
                    continue  # the first thing to say
                found.add(option)
                self.assertEqual(result.returncode, 2)
                self.assertIn(f"Did you mean {option}?", result.stderr)

    def test_a_misspelled_option(self):
        self.write("tree.swc", GOOD)
        for words in (("--detial", "16"), ("--detial=16",), ("--det", "16")):
            self.refused("mesh", "tree.swc", "-o", "x.stl", *words, says=("not expected", "Did you mean --detail?",
                                                                        "Run ramus mesh --help"))
        self.refused("info", "tree.swc", "--jsno", says=("Did you mean --json?", "Run ramus info --help"))
        self.refused("convert", "tree.swc", "-o", "x.swc", "--outptu", "y.swc", says=("Did you mean --output?",))
        self.refused("--ui-scael", "2", says=("Did you mean --ui-scale?", "Run ramus --help"))
        self.assertEqual(self.names(), ["tree.swc"])

    def test_an_option_of_another_command(self):
        self.write("tree.swc", GOOD)
        self.refused("info", "tree.swc", "--for-printing", says=("--for-printing is an option of ramus mesh",))

    def test_an_option_without_similar_ones(self):
        self.write("tree.swc", GOOD)
        result = self.refused("info", "tree.swc", "--xyzzy", says=("not expected: --xyzzy",))
        self.assertNotIn("Did you mean", result.stderr)

    def test_a_misspelled_line_of_a_commands_file(self):
        self.write("tree.swc", GOOD)
        self.write("c.txt", "slect 2\n")
        self.expect_failure("render", "tree.swc", "-o", "x.png", "--commands", "c.txt",
                            says=("c.txt:1", "did you mean select?"))


if __name__ == "__main__":
    unittest.main()
