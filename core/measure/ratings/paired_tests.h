// Whether scores that belong together in pairs differ: Wilcoxon's signed-rank test, which asks of scores only that they
// can be ordered, the paired t test beside it, and Holm's correction for many tests at once. All probabilities are
// two-sided. Distributions are Boost.Math's.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace ramus::measure {

// F. Wilcoxon, Biometrics Bulletin 1 (6), 1945. Differences of 0 say nothing about the direction and are left out, as
// Wilcoxon does; equal sizes share the mean of their ranks.
struct SignedRank {
    std::size_t pairs = 0;     // that differ
    double positive_sum = 0.0; // of the ranks of differences above 0
    double negative_sum = 0.0;
    // 1 where no pair differs. Exact, ties included: the share of all 2^pairs ways to give the ranks signs that are as
    // far from the middle as this one, or farther. Above kMostExactPairs by the normal distribution, corrected for ties
    // and for continuity.
    double p = 1.0;
    double least_p = 1.0; // that so many pairs, with their ties, can give at all
    // Matched-pairs rank-biserial correlation, (positive - negative) / (positive + negative): 1 where all pairs that
    // differ do so upward, -1 downward (D. S. Kerby, Comprehensive Psychology 3, 2014). 0 where none differs.
    double effect = 0.0;
};

inline constexpr std::size_t kMostExactPairs = 200;

// Differences are finite, and equal where they shall count as tied: give whole numbers rather than means.
[[nodiscard]] SignedRank signed_rank(std::span<const double> differences);

// Student's t of the mean difference. Without a value where it is not defined: fewer than two pairs, or all of them
// differ alike.
struct PairedT {
    std::size_t pairs = 0;
    double mean = 0.0;             // of the differences; 0 without pairs
    std::optional<double> sigma;   // sample standard deviation; without a value below two pairs
    std::optional<double> t, p;    // with pairs - 1 degrees of freedom
    std::optional<double> effect;  // Cohen's d_z = mean / sigma
    std::optional<double> half_95; // half the width of the mean's 95 % confidence interval
};

[[nodiscard]] PairedT paired_t(std::span<const double> differences);

// S. Holm, Scandinavian Journal of Statistics 6 (2), 1979: each p times the number of those that are not smaller, never
// below the corrected value of a smaller one, at most 1. In the order given.
[[nodiscard]] std::vector<double> holm(std::span<const double> probabilities);

} // namespace ramus::measure
