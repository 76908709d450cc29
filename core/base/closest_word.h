// Finds the name that a mistyped word most likely stands for, as in "did you mean --detail?".
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace ramus {

// The number of insertions, deletions, substitutions and swaps of neighbours that turn one word into the other, in
// bytes (the optimal string alignment distance: Damerau-Levenshtein where no letter is edited twice).
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

// The candidate with the smallest edit distance to `word`, the first of several. Empty: every candidate needs more than
// one edit for every three letters of the longer word. A candidate that begins with `word` (at least three letters)
// counts as one edit away.
[[nodiscard]] std::string closest_word(std::string_view word, std::span<const std::string> candidates);

} // namespace ramus
