#include "core/measure/ratings/paired_tests.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace ramus::measure {

namespace {

// Twice the ranks of the absolute differences, in the order of the input. Integers, although ties have half-integer
// ranks.
std::vector<std::uint64_t> doubled_ranks(const std::vector<double>& differences) {
    std::vector<std::size_t> order(differences.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto size = [&](std::size_t i) { return std::abs(differences[i]); };
    std::ranges::stable_sort(order, {}, size);
    std::vector<std::uint64_t> ranks(order.size());
    for (std::size_t from = 0, end = 0; from < order.size(); from = end) {
        while (end < order.size() && size(order[end]) == size(order[from])) ++end;
        // The ranks from + 1 to end have the mean (from + 1 + end) / 2.
        for (std::size_t i = from; i < end; ++i) ranks[order[i]] = from + 1 + end;
    }
    return ranks;
}

// The share of all sign patterns whose sum of positive (doubled) ranks is at most `sum`.
double share_up_to(const std::vector<std::uint64_t>& ranks, std::uint64_t sum) {
    std::vector<double> share(sum + 1, 0.0); // by the sum of the positive ones among those seen so far
    share[0] = 1.0;
    for (const std::uint64_t rank : ranks)
        for (std::uint64_t at = sum + 1; at-- > 0;)
            share[at] = 0.5 * (share[at] + (at >= rank ? share[at - rank] : 0.0));
    return std::accumulate(share.begin(), share.end(), 0.0);
}

double normal_p(const std::vector<std::uint64_t>& ranks, double smaller_sum) {
    // Each rank belongs to the positive sum with probability 1/2, which contributes a quarter of its square to the
    // variance.
    double mean = 0.0, variance = 0.0;
    for (const std::uint64_t doubled : ranks) {
        const double rank = 0.5 * static_cast<double>(doubled);
        mean += 0.5 * rank;
        variance += 0.25 * rank * rank;
    }
    const double z = std::min(0.0, smaller_sum + 0.5 - mean) / std::sqrt(variance);
    return std::min(1.0, 2.0 * cdf(boost::math::normal(), z));
}

} // namespace

SignedRank signed_rank(std::span<const double> differences) {
    std::vector<double> different;
    std::ranges::copy_if(differences, std::back_inserter(different), [](double d) { return d != 0.0; });
    SignedRank found;
    found.pairs = different.size();
    if (different.empty()) return found;
    const std::vector<std::uint64_t> ranks = doubled_ranks(different);
    std::uint64_t positive = 0, negative = 0;
    for (std::size_t i = 0; i < ranks.size(); ++i) (different[i] > 0.0 ? positive : negative) += ranks[i];
    found.positive_sum = 0.5 * static_cast<double>(positive);
    found.negative_sum = 0.5 * static_cast<double>(negative);
    found.effect = (found.positive_sum - found.negative_sum) / (found.positive_sum + found.negative_sum);
    const std::uint64_t smaller = std::min(positive, negative);
    if (found.pairs <= kMostExactPairs) {
        found.p = std::min(1.0, 2.0 * share_up_to(ranks, smaller));
        found.least_p = std::min(1.0, 2.0 * share_up_to(ranks, 0));
    } else {
        found.p = normal_p(ranks, 0.5 * static_cast<double>(smaller));
        found.least_p = normal_p(ranks, 0.0);
    }
    return found;
}

PairedT paired_t(std::span<const double> differences) {
    PairedT found;
    found.pairs = differences.size();
    if (differences.empty()) return found;
    const auto count = static_cast<double>(differences.size());
    found.mean = std::accumulate(differences.begin(), differences.end(), 0.0) / count;
    if (differences.size() < 2) return found;
    double squares = 0.0;
    for (const double difference : differences) squares += (difference - found.mean) * (difference - found.mean);
    found.sigma = std::sqrt(squares / (count - 1.0));
    // Does not test sigma == 0, since the mean of equal numbers may differ from them in the last digit.
    if (std::ranges::all_of(differences, [&](double d) { return d == differences.front(); })) {
        found.sigma = 0.0;
        return found;
    }
    const boost::math::students_t distribution(count - 1.0);
    const double error = *found.sigma / std::sqrt(count);
    found.t = found.mean / error;
    found.p = 2.0 * cdf(distribution, -std::abs(*found.t));
    found.effect = found.mean / *found.sigma;
    found.half_95 = error * quantile(complement(distribution, 0.025));
    return found;
}

std::vector<double> holm(std::span<const double> probabilities) {
    std::vector<std::size_t> order(probabilities.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return probabilities[i]; });
    std::vector<double> corrected(probabilities.size());
    double largest = 0.0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        largest = std::max(largest, static_cast<double>(order.size() - i) * probabilities[order[i]]);
        corrected[order[i]] = std::min(1.0, largest);
    }
    return corrected;
}

} // namespace ramus::measure
