// Table II of the paper (section VIII): scores of pictures of the same vessels by different methods. For each criterion
// and method: mean, sigma and median; and tests of one method against each other one.
//
// Raters are the sample. Answers of one rater about several study views are not independent, so a rater counts once in
// a test, with the mean of all study views (PairedBy::kRater). PairedBy::kAnswer treats every rater and study view as a
// separate pair. Its probabilities are smaller, and valid for these raters only.
#pragma once

#include "core/measure/ratings/paired_tests.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace ramus::measure {

// The scores of every rater for every method in every study view by every criterion, without gaps.
class Scores {
public:
    struct Size {
        std::size_t raters = 0, views = 0, methods = 0, criteria = 0;
    };
    explicit Scores(const Size& size)
        : size_(size), values_(size.raters * size.views * size.methods * size.criteria, 0) {}
    [[nodiscard]] const Size& size() const { return size_; }
    struct Place {
        std::size_t rater = 0, view = 0, method = 0, criterion = 0;
    };
    [[nodiscard]] int& at(const Place& place) { return values_[index(place)]; }
    [[nodiscard]] int at(const Place& place) const { return values_[index(place)]; }

private:
    [[nodiscard]] std::size_t index(const Place& place) const {
        return ((place.rater * size_.views + place.view) * size_.methods + place.method) * size_.criteria +
               place.criterion;
    }
    Size size_;
    std::vector<int> values_;
};

enum class PairedBy : std::uint8_t { kRater, kAnswer };

struct ScoreSummary {
    std::size_t count = 0; // raters x study views
    double mean = 0.0;
    std::optional<double> sigma; // sample standard deviation; without a value for one score
    double median = 0.0;
};

// The comparison of the tested method with another one, by one criterion. Differences are the scores of the tested
// method minus those of the other one.
struct MethodComparison {
    std::size_t criterion = 0, other = 0;
    SignedRank ranks;
    PairedT t;                         // mean, sigma and interval in steps of the scale
    double corrected_p = 1.0;          // ranks.p, corrected by Holm over all comparisons of the table
    std::optional<double> corrected_t; // t.p, corrected over all comparisons that have a t.p
};

struct RatingTable {
    std::vector<std::vector<ScoreSummary>> summaries; // by criterion, then method
    // By criterion, then other method. Empty for one rater, since a single rater allows no conclusion about others.
    std::vector<MethodComparison> comparisons;
};

// `method`: the tested method. `scores` must not be empty.
[[nodiscard]] RatingTable rating_table(const Scores& scores, std::size_t method, PairedBy paired_by = PairedBy::kRater);

} // namespace ramus::measure
