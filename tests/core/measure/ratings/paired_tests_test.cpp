#include "core/measure/ratings/paired_tests.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <doctest/doctest.h>
#include <random>

using namespace ramus;
using doctest::Approx;

namespace {

// Darwin's maize: crossed minus self-fertilized, in eighths of an inch, the first worked example of R. A. Fisher, The
// Design of Experiments, 1935, section 17, who finds a mean of 20.93 and t = 2.148.
const std::vector<double> kMaize{49, -67, 8, 16, 6, 23, 28, 41, 14, 29, 56, 24, 75, 60, -48};

// The ranks from the definition: how many are smaller, and the middle of those that are equal.
std::vector<double> ranks_by_counting(const std::vector<double>& values) {
    std::vector<double> ranks;
    for (const double value : values) {
        const auto smaller = std::ranges::count_if(values, [&](double v) { return std::abs(v) < std::abs(value); });
        const auto equal = std::ranges::count_if(values, [&](double v) { return std::abs(v) == std::abs(value); });
        ranks.push_back(static_cast<double>(smaller) + 0.5 * static_cast<double>(equal + 1));
    }
    return ranks;
}

// Every way to give the ranks signs, one by one.
double p_by_enumeration(const std::vector<double>& values) {
    const std::vector<double> ranks = ranks_by_counting(values);
    double total = 0.0, positive = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        total += ranks[i];
        if (values[i] > 0.0) positive += ranks[i];
    }
    const double distance = std::abs(positive - 0.5 * total);
    std::uint64_t as_far = 0;
    for (std::uint64_t signs = 0; signs < std::uint64_t{1} << values.size(); ++signs) {
        double sum = 0.0;
        for (std::size_t i = 0; i < values.size(); ++i)
            if ((signs >> i & 1) != 0) sum += ranks[i];
        as_far += std::abs(sum - 0.5 * total) >= distance ? 1 : 0;
    }
    return static_cast<double>(as_far) / std::ldexp(1.0, static_cast<int>(values.size()));
}

} // namespace

TEST_CASE("the signed-rank test finds what is known of Darwin's maize") {
    const measure::SignedRank found = measure::signed_rank(kMaize);
    CHECK(found.pairs == 15);
    // The two negative ones, 48 and 67, are the 10th and the 14th by size; all ranks together are 15 * 16 / 2 = 120.
    CHECK(found.negative_sum == 24.0);
    CHECK(found.positive_sum == 96.0);
    CHECK(found.p == 0.041259765625); // scipy.stats.wilcoxon(d, mode="exact"): 1352 of 32768
    CHECK(found.effect == Approx(72.0 / 120.0));
    CHECK(found.least_p == std::ldexp(1.0, -14)); // all signs alike, one way or the other: 2 of 2^15
}

TEST_CASE("the t test finds what Fisher found of Darwin's maize") {
    const measure::PairedT found = measure::paired_t(kMaize);
    CHECK(found.pairs == 15);
    CHECK(found.mean == Approx(314.0 / 15.0));
    // scipy.stats.ttest_1samp(d, 0), numpy.std(d, ddof=1), and 2.1448 = scipy.stats.t.ppf(0.975, 14) standard errors
    REQUIRE(found.p.has_value());
    CHECK(*found.sigma == Approx(37.7443783262898).epsilon(1e-12));
    CHECK(*found.t == Approx(2.1479874613311205).epsilon(1e-12));
    CHECK(*found.p == Approx(0.0497029440218009).epsilon(1e-10));
    CHECK(*found.effect == Approx(0.5546079777065185).epsilon(1e-12));
    CHECK(*found.half_95 == Approx(20.90214001493181).epsilon(1e-10));
}

TEST_CASE("pairs that do not differ are left out, ties share a rank, and the test stays exact") {
    // scipy.stats.permutation_test(permutation_type="samples", n_resamples=inf) of the sum of positive midranks
    const measure::SignedRank one = measure::signed_rank(std::vector<double>{1, 1, 2, -1, 0, 3, 1, 2, -1, 2});
    CHECK(one.pairs == 9);
    CHECK(one.positive_sum == 39.0);
    CHECK(one.negative_sum == 6.0);
    CHECK(one.p == 0.0625);
    const measure::SignedRank other = measure::signed_rank(std::vector<double>{2, 2, -1, 3, 1, 0, 0, 4, -2, 1, 1, 3});
    CHECK(other.pairs == 10);
    CHECK(other.positive_sum == 46.5);
    CHECK(other.negative_sum == 8.5);
    CHECK(other.p == 0.0625);
}

TEST_CASE("the exact probability is that of every way to give signs, counted one by one") {
    std::mt19937 random(7); // the steps of a scale: many ties
    for (int trial = 0; trial < 60; ++trial) {
        std::vector<double> values;
        const auto pairs = 1 + random() % 12;
        while (values.size() < pairs)
            if (const int value = static_cast<int>(random() % 9) - 4; value != 0) values.push_back(value);
        const measure::SignedRank found = measure::signed_rank(values);
        CHECK(found.p == Approx(p_by_enumeration(values)).epsilon(1e-12));
        CHECK(found.least_p == std::min(1.0, std::ldexp(2.0, -static_cast<int>(pairs))));
        std::ranges::for_each(values, [](double& value) { value = -value; });
        CHECK(measure::signed_rank(values).p == found.p);
        CHECK(measure::signed_rank(values).effect == -found.effect);
    }
}

TEST_CASE("many pairs take the normal distribution, corrected for ties and continuity") {
    std::vector<double> differences;
    for (int i = 0; i < 240; ++i) differences.push_back(i * 7 % 9 - 3);
    const measure::SignedRank found = measure::signed_rank(differences);
    CHECK(found.pairs == 213);
    CHECK(found.pairs > measure::kMostExactPairs);
    CHECK(found.negative_sum ==
          6426.5); // scipy.stats.wilcoxon(d, correction=True, mode="approx"): 2.824292013887079e-08
    CHECK(found.p == Approx(2.824292013887079e-08).epsilon(1e-9));
}

TEST_CASE("nothing is made up where there is nothing to say") {
    const measure::SignedRank none = measure::signed_rank({});
    CHECK(none.pairs == 0);
    CHECK(none.p == 1.0);
    CHECK(measure::signed_rank(std::vector<double>{0, 0, 0}).p == 1.0);
    CHECK(measure::signed_rank(std::vector<double>{0, 0, 0}).effect == 0.0);
    CHECK(measure::signed_rank(std::vector<double>{2}).p == 1.0); // either sign is as far from the middle
    CHECK_FALSE(measure::paired_t({}).sigma.has_value());
    const measure::PairedT single = measure::paired_t(std::vector<double>{2});
    CHECK(single.mean == 2.0);
    CHECK_FALSE(single.sigma.has_value());
    const measure::PairedT alike = measure::paired_t(std::vector<double>{0.1, 0.1, 0.1});
    CHECK(*alike.sigma == 0.0);
    CHECK_FALSE(alike.t.has_value());
    CHECK_FALSE(alike.p.has_value());
}

TEST_CASE("Holm's correction multiplies by how many are left, and keeps the order") {
    // Four tests, by hand: 4 x 0.005, 3 x 0.01, 2 x 0.03, and 0.04 not below the one before.
    const std::vector<double> corrected = measure::holm(std::vector<double>{0.01, 0.04, 0.03, 0.005});
    CHECK(corrected[0] == Approx(0.03));
    CHECK(corrected[1] == Approx(0.06));
    CHECK(corrected[2] == Approx(0.06));
    CHECK(corrected[3] == Approx(0.02));
    CHECK(measure::holm(std::vector<double>{0.7, 0.9}) == std::vector<double>{1.0, 1.0});
    CHECK(measure::holm({}).empty());
}
