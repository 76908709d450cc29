// Tests for paired scores: Wilcoxon's signed-rank test, which requires only that scores can be ordered, the paired t
// test, and Holm's correction for multiple tests. All probabilities are two-sided. Distributions are from Boost.Math.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace ramus::measure {

// F. Wilcoxon, Biometrics Bulletin 1 (6), 1945. As in the paper, differences of 0 are removed, since they have no
// direction; equal absolute differences share the mean of their ranks.
struct SignedRank {
    std::size_t pairs = 0;     // number of pairs with a difference other than 0
    double positive_sum = 0.0; // sum of the ranks of differences above 0
    double negative_sum = 0.0;
    // 1 if no pair differs. Exact, ties included: the share of all 2^pairs sign patterns whose rank sum is at least as
    // far from the middle. Above kMostExactPairs by the normal distribution, with corrections for ties and continuity.
    double p = 1.0;
    double least_p = 1.0; // the least p that is possible with these pairs and ties
    // Matched-pairs rank-biserial correlation, (positive - negative) / (positive + negative): 1 if all differences are
    // positive, -1 if all are negative (D. S. Kerby, Comprehensive Psychology 3, 2014). 0 if no pair differs.
    double effect = 0.0;
};

inline constexpr std::size_t kMostExactPairs = 200;

// Differences must be finite. Ties must be exactly equal, so pass integers rather than means.
[[nodiscard]] SignedRank signed_rank(std::span<const double> differences);

// Student's paired t test of the mean difference. t, p and effect have no value for fewer than two pairs, or if all
// differences are equal.
struct PairedT {
    std::size_t pairs = 0;
    double mean = 0.0;             // mean difference; 0 without pairs
    std::optional<double> sigma;   // sample standard deviation; without a value below two pairs
    std::optional<double> t, p;    // with pairs - 1 degrees of freedom
    std::optional<double> effect;  // Cohen's d_z = mean / sigma
    std::optional<double> half_95; // half the width of the mean's 95 % confidence interval
};

[[nodiscard]] PairedT paired_t(std::span<const double> differences);

// Corrected probabilities, in the order of the input (S. Holm, Scandinavian Journal of Statistics 6 (2), 1979): each p
// times the number of p that are not smaller; at least the corrected value of every smaller p, and at most 1.
[[nodiscard]] std::vector<double> holm(std::span<const double> probabilities);

} // namespace ramus::measure
