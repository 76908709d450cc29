// Table II of the paper (section VIII): what raters think of pictures of the same vessels that different methods made,
// for each criterion and method mean, sigma and median, and whether one method differs from each of the others.
//
// Raters are the sample. Answers of one rater about several scenes are not independent of each other, so a rater counts
// once in a test, with the mean of all scenes (PairedBy::kRater). PairedBy::kAnswer takes every rater and scene for a
// pair of its own: it finds smaller probabilities, which hold for these raters and not for others.
#pragma once

#include "core/measure/ratings/paired_tests.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace ramus::measure {

// Every rater scored every method in every scene by every criterion: answers without gaps.
class Scores {
public:
    struct Size {
        std::size_t raters = 0, scenes = 0, methods = 0, criteria = 0;
    };
    explicit Scores(const Size& size)
        : size_(size), values_(size.raters * size.scenes * size.methods * size.criteria, 0) {}
    [[nodiscard]] const Size& size() const { return size_; }
    struct Place {
        std::size_t rater = 0, scene = 0, method = 0, criterion = 0;
    };
    [[nodiscard]] int& at(const Place& place) { return values_[index(place)]; }
    [[nodiscard]] int at(const Place& place) const { return values_[index(place)]; }

private:
    [[nodiscard]] std::size_t index(const Place& place) const {
        return ((place.rater * size_.scenes + place.scene) * size_.methods + place.method) * size_.criteria +
               place.criterion;
    }
    Size size_;
    std::vector<int> values_;
};

enum class PairedBy : std::uint8_t { kRater, kAnswer };

struct ScoreSummary {
    std::size_t count = 0; // raters x scenes
    double mean = 0.0;
    std::optional<double> sigma; // sample standard deviation; without a value for one score
    double median = 0.0;
};

// The method in question against another one, by one criterion. Differences are the method's scores minus the other's.
struct MethodComparison {
    std::size_t criterion = 0, other = 0;
    SignedRank ranks;
    PairedT t;                         // mean, sigma and interval in steps of the scale
    double corrected_p = 1.0;          // of ranks.p, by Holm, over all comparisons of the table
    std::optional<double> corrected_t; // the same of t.p, over those that have one
};

struct RatingTable {
    std::vector<std::vector<ScoreSummary>> summaries; // by criterion, then method
    // By criterion, then other method. Empty for one rater, of whom nothing can be concluded about others.
    std::vector<MethodComparison> comparisons;
};

// `method`: the one that is held against each of the others. There are scores.
[[nodiscard]] RatingTable rating_table(const Scores& scores, std::size_t method, PairedBy paired_by = PairedBy::kRater);

} // namespace ramus::measure
