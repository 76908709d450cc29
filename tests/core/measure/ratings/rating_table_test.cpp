#include "core/measure/ratings/rating_table.h"

#include <array>
#include <cmath>
#include <doctest/doctest.h>

using namespace ramus;
using doctest::Approx;

namespace {

// Scores of one criterion; rows are raters, with the study views one after the other, and for each the methods.
template <std::size_t raters, std::size_t values>
measure::Scores scores_of(const std::array<std::array<int, values>, raters>& rows, std::size_t views) {
    measure::Scores scores({raters, views, values / views, 1});
    for (std::size_t rater = 0; rater < raters; ++rater)
        for (std::size_t i = 0; i < values; ++i)
            scores.at({rater, i / (values / views), i % (values / views), 0}) = rows[rater][i];
    return scores;
}

// Three raters, two study views, two methods.
const measure::Scores kSmall = scores_of<3, 4>({{{2, 4, 3, 3}, {1, 5, 2, 4}, {3, 4, 2, 5}}}, 2);

} // namespace

TEST_CASE("mean, sigma and median are those of all raters and study views") {
    const measure::RatingTable table = measure::rating_table(kSmall, 1);
    REQUIRE(table.summaries.size() == 1);
    REQUIRE(table.summaries[0].size() == 2);
    const measure::ScoreSummary& first = table.summaries[0][0]; // 2 3 1 2 3 2
    CHECK(first.count == 6);
    CHECK(first.mean == Approx(13.0 / 6.0));
    CHECK(first.median == 2.0);
    // Squares around the mean: 31 - 169 / 6 = 17 / 6, by 5 degrees of freedom.
    CHECK(*first.sigma == Approx(std::sqrt(17.0 / 30.0)));
    CHECK(table.summaries[0][1].median == 4.0); // 3 4 4 4 5 5
    CHECK(table.summaries[0][1].mean == Approx(25.0 / 6.0));
}

TEST_CASE("a rater counts once, with the mean over the study views") {
    const measure::RatingTable table = measure::rating_table(kSmall, 1);
    REQUIRE(table.comparisons.size() == 1);
    const measure::MethodComparison& one = table.comparisons[0];
    CHECK(one.other == 0);
    CHECK(one.ranks.pairs == 3);
    // Sums over the study views: 2, 6, 4. Three pairs of one direction: 2 of 8 ways.
    CHECK(one.ranks.p == 0.25);
    CHECK(one.corrected_p == 0.25);
    CHECK(one.ranks.effect == 1.0);
    CHECK(one.t.mean == Approx(2.0)); // of 1, 3, 2
    CHECK(*one.t.sigma == Approx(1.0));
    CHECK(*one.t.t == Approx(2.0 * std::sqrt(3.0)));
    CHECK(*one.t.effect == Approx(2.0));
}

TEST_CASE("every answer is a pair of its own when that is asked for") {
    const measure::RatingTable table = measure::rating_table(kSmall, 1, measure::PairedBy::kAnswer);
    const measure::MethodComparison& one = table.comparisons.at(0); // 2 0 4 2 1 3
    CHECK(one.ranks.pairs == 5);
    CHECK(one.ranks.p == 0.0625); // five of one direction: 2 of 32
    CHECK(one.t.pairs == 6);
    CHECK(one.t.mean == Approx(2.0));
}

TEST_CASE("means over study views that are no binary numbers are tied all the same") {
    // Three study views: both raters differ by thirds, the one by 1 + 0 + 0 and the other by 0 + 0 + 1.
    const measure::Scores scores = scores_of<2, 6>({{{1, 2, 3, 3, 4, 4}, {5, 5, 2, 2, 3, 4}}}, 3);
    const measure::MethodComparison one = measure::rating_table(scores, 1).comparisons.at(0);
    CHECK(one.ranks.positive_sum == 3.0);
    CHECK(*one.t.sigma == 0.0);
    CHECK(one.t.mean == Approx(1.0 / 3.0));
    CHECK_FALSE(one.t.p.has_value());
    CHECK_FALSE(one.corrected_t.has_value());
}

TEST_CASE("nothing is concluded from one rater") {
    const measure::RatingTable table = measure::rating_table(scores_of<1, 4>({{{2, 4, 3, 3}}}, 2), 1);
    CHECK(table.comparisons.empty());
    CHECK(table.summaries[0][1].mean == Approx(3.5));
    const measure::RatingTable single = measure::rating_table(scores_of<1, 2>({{{2, 4}}}, 1), 1);
    CHECK_FALSE(single.summaries[0][0].sigma.has_value());
}

TEST_CASE("probabilities are corrected over all comparisons of the table") {
    // Two criteria, three methods, ten raters: the last method is one step above the first in both, and level with the
    // second in the first criterion, above it in the second.
    measure::Scores scores({10, 1, 3, 2});
    for (std::size_t rater = 0; rater < 10; ++rater)
        for (std::size_t criterion = 0; criterion < 2; ++criterion) {
            scores.at({rater, 0, 0, criterion}) = 2;
            scores.at({rater, 0, 1, criterion}) = criterion == 0 ? 3 : 1;
            scores.at({rater, 0, 2, criterion}) = 3;
        }
    const auto& found = measure::rating_table(scores, 2).comparisons;
    REQUIRE(found.size() == 4);
    const double smallest = 2.0 / 1024.0; // ten of one direction
    CHECK(found[0].ranks.p == smallest);
    CHECK(found[1].ranks.p == 1.0);
    CHECK(found[0].corrected_p == Approx(4.0 * smallest));
    CHECK(found[1].corrected_p == 1.0);
    CHECK(found[2].corrected_p == Approx(4.0 * smallest));
    CHECK(found[3].corrected_p == Approx(4.0 * smallest));
    CHECK(found[3].criterion == 1);
    CHECK(found[3].other == 1);
}
