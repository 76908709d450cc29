#include "core/base/closest_word.h"

#include <doctest/doctest.h>
#include <string>
#include <vector>

using ramus::closest_word;
using ramus::edit_distance;

TEST_CASE("the edit distance counts letters put in, left out, exchanged and swapped") {
    CHECK(edit_distance("", "") == 0);
    CHECK(edit_distance("", "abc") == 3);
    CHECK(edit_distance("abc", "") == 3);
    CHECK(edit_distance("mesh", "mesh") == 0);
    CHECK(edit_distance("mehs", "mesh") == 1);
    CHECK(edit_distance("detial", "detail") == 1);
    CHECK(edit_distance("detal", "detail") == 1);
    CHECK(edit_distance("detaill", "detail") == 1);
    CHECK(edit_distance("kitten", "sitting") == 3); // Levenshtein's own k-s, e-i, and a g at the end
    CHECK(edit_distance("ca", "abc") == 3);         // no letter is touched twice: else it would be 2
    // The same in both directions.
    for (const char* a : {"render", "info", "x", ""})
        for (const char* b : {"redner", "inof", "xx", "render"}) CHECK(edit_distance(a, b) == edit_distance(b, a));
}

TEST_CASE("the closest word is near, or there is none") {
    const std::vector<std::string> words = {"mesh", "render", "info", "convert", "--detail", "--detail-of", "--width"};
    CHECK(closest_word("mehs", words) == "mesh");
    CHECK(closest_word("rendre", words) == "render");
    CHECK(closest_word("--detial", words) == "--detail");
    CHECK(closest_word("--det", words) == "--detail"); // as it begins; the first of two
    CHECK(closest_word("conv", words) == "convert");
    CHECK(closest_word("of", words).empty());
    CHECK(closest_word("xyzzy", words).empty());
    CHECK(closest_word("", words).empty());
    CHECK(closest_word("mesh", {}).empty());
}
