#include "core/measure/ratings/rating_table.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ramus::measure {

namespace {

ScoreSummary summary_of(const Scores& scores, std::size_t method, std::size_t criterion) {
    std::vector<double> values;
    for (std::size_t rater = 0; rater < scores.size().raters; ++rater)
        for (std::size_t view = 0; view < scores.size().views; ++view)
            values.push_back(scores.at({rater, view, method, criterion}));
    std::ranges::sort(values);
    ScoreSummary found;
    found.count = values.size();
    const auto count = static_cast<double>(values.size());
    found.mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    found.median = 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
    double squares = 0.0;
    for (const double value : values) squares += (value - found.mean) * (value - found.mean);
    if (values.size() > 1) found.sigma = std::sqrt(squares / (count - 1.0));
    return found;
}

// An integer for each pair. For raters it is the sum over the study views, not the mean, so that ties are exactly
// equal.
std::vector<double> differences(const Scores& scores, const MethodComparison& pair, std::size_t method,
                                PairedBy paired_by) {
    std::vector<double> found;
    for (std::size_t rater = 0; rater < scores.size().raters; ++rater) {
        int sum = 0;
        for (std::size_t view = 0; view < scores.size().views; ++view) {
            const int difference =
                scores.at({rater, view, method, pair.criterion}) - scores.at({rater, view, pair.other, pair.criterion});
            if (paired_by == PairedBy::kAnswer) found.push_back(difference);
            sum += difference;
        }
        if (paired_by == PairedBy::kRater) found.push_back(sum);
    }
    return found;
}

void scale(PairedT& test, double factor) {
    test.mean *= factor;
    if (test.sigma) *test.sigma *= factor;
    if (test.half_95) *test.half_95 *= factor;
}

void correct(std::vector<MethodComparison>& comparisons) {
    std::vector<double> by_ranks, by_t;
    for (const MethodComparison& one : comparisons) {
        by_ranks.push_back(one.ranks.p);
        if (one.t.p) by_t.push_back(*one.t.p);
    }
    by_ranks = holm(by_ranks);
    by_t = holm(by_t);
    std::size_t next = 0;
    for (std::size_t i = 0; i < comparisons.size(); ++i) {
        comparisons[i].corrected_p = by_ranks[i];
        if (comparisons[i].t.p) comparisons[i].corrected_t = by_t[next++];
    }
}

} // namespace

RatingTable rating_table(const Scores& scores, std::size_t method, PairedBy paired_by) {
    const Scores::Size& size = scores.size();
    RatingTable table;
    for (std::size_t criterion = 0; criterion < size.criteria; ++criterion) {
        std::vector<ScoreSummary>& row = table.summaries.emplace_back();
        for (std::size_t m = 0; m < size.methods; ++m) row.push_back(summary_of(scores, m, criterion));
        for (std::size_t other = 0; other < size.methods && size.raters > 1; ++other) {
            if (other == method) continue;
            MethodComparison one;
            one.criterion = criterion;
            one.other = other;
            const std::vector<double> pairs = differences(scores, one, method, paired_by);
            one.ranks = signed_rank(pairs);
            one.t = paired_t(pairs);
            if (paired_by == PairedBy::kRater) scale(one.t, 1.0 / static_cast<double>(size.views));
            table.comparisons.push_back(one);
        }
    }
    correct(table.comparisons);
    return table;
}

} // namespace ramus::measure
