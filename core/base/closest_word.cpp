#include "core/base/closest_word.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace ramus {

std::size_t edit_distance(std::string_view a, std::string_view b) {
    // Rows of the table of distances between prefixes of a and of b: the row being filled, and the two before it.
    std::vector<std::size_t> row(b.size() + 1), last(row), last_but_one(row);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::swap(last_but_one, last);
        std::swap(last, row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], last_but_one[j - 2] + 1);
        }
    }
    return row[b.size()];
}

std::string closest_word(std::string_view word, std::span<const std::string> candidates) {
    constexpr std::size_t kLettersAnEdit = 3;
    std::string closest;
    std::size_t least = 0;
    for (const std::string& candidate : candidates) {
        const bool begins = word.size() >= kLettersAnEdit && candidate.starts_with(word);
        const std::size_t distance = begins ? 1 : edit_distance(word, candidate);
        const bool near = distance * kLettersAnEdit <= std::max(word.size(), candidate.size());
        if (!near || (!closest.empty() && distance >= least)) continue;
        closest = candidate;
        least = distance;
    }
    return closest;
}

} // namespace ramus
