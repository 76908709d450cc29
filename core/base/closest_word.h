// What a mistyped word was meant to be: one of a list of names, for "did you mean --detail?".
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace ramus {

// How many letters have to be put in, left out, exchanged for others, or swapped with their neighbour, to make one word
// of the other (the Damerau-Levenshtein distance in which no letter is touched twice). In bytes.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

// The candidate nearest to `word`, the first of several; empty where none is near: at most one edit for every three
// letters of the longer word. A candidate that begins with `word` (three letters at least) counts as one edit away.
[[nodiscard]] std::string closest_word(std::string_view word, std::span<const std::string> candidates);

} // namespace ramus
