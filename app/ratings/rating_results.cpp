#include "app/ratings/rating_results.h"

#include "app/session/numbers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

namespace ramus::app {

namespace {

using measure::MethodComparison;
using measure::PairedBy;
using measure::ScoreSummary;
using Words = std::vector<std::string>;

constexpr double kSignificant = 0.05;
constexpr double kLeastShownP = 0.0001;
constexpr std::size_t kLeastRaters = 2; // minimum for any conclusion

std::string fixed(double value, int decimals = 2) {
    std::array<char, 64> text{};
    return {text.data(), std::to_chars(text.begin(), text.end(), value, std::chars_format::fixed, decimals).ptr};
}
std::string fixed(const std::optional<double>& value, int decimals = 2) {
    return value ? fixed(*value, decimals) : "-";
}

std::string p_text(const std::optional<double>& p) {
    if (!p) return "-";
    return *p < kLeastShownP ? "<0.0001" : fixed(*p, 4);
}

// Aligns columns; the first `names` are left-aligned, the others right-aligned.
std::string columns(const std::vector<Words>& rows, std::size_t names) {
    std::vector<std::size_t> widths(rows.front().size(), 0);
    for (const Words& row : rows)
        for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
    std::string text;
    for (const Words& row : rows) {
        std::string line;
        for (std::size_t c = 0; c < row.size(); ++c) {
            const std::string blanks(widths[c] - row[c].size(), ' ');
            line.append("  ").append(c < names ? row[c] + blanks : blanks + row[c]);
        }
        text.append(line.substr(0, line.find_last_not_of(' ') + 1)).append("\n");
    }
    return text;
}

const std::string& compared_title(const RatingResults& results) {
    return results.ratings.study.methods[results.ratings.study.method].title;
}

const MethodComparison* comparison_with(const RatingResults& results, std::size_t criterion, std::size_t other) {
    const auto found = std::ranges::find_if(results.table.comparisons, [&](const MethodComparison& one) {
        return one.criterion == criterion && one.other == other;
    });
    return found == results.table.comparisons.end() ? nullptr : &*found;
}

std::string summaries_text(const RatingResults& results) {
    std::string text;
    for (std::size_t c = 0; c < results.table.summaries.size(); ++c) {
        text.append("\n").append(kCriteria[c].name).append(" (").append(kCriteria[c].question).append(")\n");
        std::vector<Words> rows{{"", "mean", "sigma", "median", "count"}};
        for (std::size_t m = 0; m < results.table.summaries[c].size(); ++m) {
            const ScoreSummary& one = results.table.summaries[c][m];
            rows.push_back({results.ratings.study.methods[m].title, fixed(one.mean), fixed(one.sigma),
                            fixed(one.median, 1), std::to_string(one.count)});
        }
        text += columns(rows, 1);
    }
    return text;
}

// A warning if there are too few raters.
std::string too_few_text(const RatingResults& results) {
    const auto tests = static_cast<double>(results.table.comparisons.size());
    const std::size_t raters = results.ratings.answers.size();
    if (results.paired_by == PairedBy::kAnswer) return {};
    const auto least_p = [](std::size_t pairs) { return std::ldexp(2.0, -static_cast<int>(pairs)); };
    if (tests * least_p(raters) < kSignificant) return {};
    std::size_t enough = raters;
    while (tests * least_p(enough) >= kSignificant) ++enough;
    return "No p of ranks of " + std::to_string(raters) + " raters can be below " + fixed(least_p(raters), 4) +
           ", whatever they answer; for all " + std::to_string(results.table.comparisons.size()) +
           " comparisons it takes " + std::to_string(enough) + " raters to get below 0.05.\n";
}

std::string tests_text(const RatingResults& results) {
    std::vector<Words> ranks{{"", "", "pairs", "difference", "95 % from", "to", "p", "Holm", "", "r"}};
    std::vector<Words> means{{"", "", "t", "p", "Holm", "d"}};
    for (const MethodComparison& one : results.table.comparisons) {
        const measure::PairedT& t = one.t;
        const std::string criterion(kCriteria[one.criterion].name);
        const std::string& other = results.ratings.study.methods[one.other].title;
        ranks.push_back({criterion, other, std::to_string(t.pairs),
                         std::string(t.mean > 0.0 ? "+" : "").append(fixed(t.mean)),
                         t.half_95 ? fixed(t.mean - *t.half_95) : "-", t.half_95 ? fixed(t.mean + *t.half_95) : "-",
                         p_text(one.ranks.p), p_text(one.corrected_p), one.corrected_p < kSignificant ? "*" : "",
                         fixed(one.ranks.effect)});
        means.push_back({criterion, other, fixed(t.t), p_text(t.p), p_text(one.corrected_t), fixed(t.effect)});
    }
    return "\n" + compared_title(results) + " against the others: Wilcoxon signed-rank test\n" + columns(ranks, 2) +
           "\nThe same by the paired t test\n" + columns(means, 2) + "\n";
}

std::string comparisons_text(const RatingResults& results) {
    const auto& comparisons = results.table.comparisons;
    if (comparisons.empty())
        return "\nOne rater: nothing can be said of how significant differences are. It takes two raters at least, and "
               "more to find any.\n";
    const bool exact = std::ranges::all_of(
        comparisons, [](const MethodComparison& one) { return one.ranks.pairs <= measure::kMostExactPairs; });
    std::string text = tests_text(results);
    text += results.paired_by == PairedBy::kRater
                ? "A pair is a rater, with the means over " +
                      counted(results.ratings.study.views.size(), "scene", "scenes") + ".\n"
                : "A pair is a rater and a scene. Answers of one rater depend on each other, so these p are too small; "
                  "they hold\nfor these raters alone.\n";
    text += std::string("p is two-sided") +
            (exact ? "; of ranks it is exact" : "; of many ranks it is that of the normal distribution") +
            ", and pairs that do not differ are left out.\nHolm: corrected for all " +
            std::to_string(comparisons.size()) +
            " comparisons; * below 0.05. r: rank-biserial correlation. d: Cohen's d of the pairs.\n";
    return text + too_few_text(results);
}

nlohmann::ordered_json or_null(const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json comparison_json(const MethodComparison& one) {
    nlohmann::ordered_json interval = nullptr;
    if (one.t.half_95) interval = {one.t.mean - *one.t.half_95, one.t.mean + *one.t.half_95};
    nlohmann::ordered_json degrees = nullptr;
    if (one.t.t) degrees = one.t.pairs - 1;
    return {{"pairs", one.t.pairs},
            {"difference", one.t.mean},
            {"sigma", or_null(one.t.sigma)},
            {"confidence_95", interval},
            {"wilcoxon",
             {{"pairs", one.ranks.pairs},
              {"exact", one.ranks.pairs <= measure::kMostExactPairs},
              {"w_plus", one.ranks.positive_sum},
              {"w_minus", one.ranks.negative_sum},
              {"p", one.ranks.p},
              {"p_holm", one.corrected_p},
              {"least_p", one.ranks.least_p},
              {"rank_biserial", one.ranks.effect}}},
            {"t_test",
             {{"t", or_null(one.t.t)},
              {"degrees", degrees},
              {"p", or_null(one.t.p)},
              {"p_holm", or_null(one.corrected_t)},
              {"cohen_d", or_null(one.t.effect)}}}};
}

const char* name_of_pairing(PairedBy paired_by) { return paired_by == PairedBy::kRater ? "rater" : "answer"; }

} // namespace

RatingResults results_of(const RatingsRead& ratings, PairedBy paired_by) {
    return {ratings, measure::rating_table(ratings.scores, ratings.study.method, paired_by), paired_by};
}

std::string results_text(const RatingResults& results) {
    const RatingStudy& study = results.ratings.study;
    return "Study " + id_of(study) + ": " + counted(results.ratings.answers.size(), "rater", "raters") + ", " +
           counted(study.views.size(), "scene", "scenes") + ", scores from " + std::to_string(kLowestScore) + " to " +
           std::to_string(kHighestScore) + "\n" + summaries_text(results) + comparisons_text(results);
}

nlohmann::ordered_json results_json(const RatingResults& results) {
    const RatingStudy& study = results.ratings.study;
    nlohmann::ordered_json json{{"study", id_of(study)},
                                {"scale", {kLowestScore, kHighestScore}},
                                {"scenes", nlohmann::ordered_json::array()},
                                {"raters", nlohmann::ordered_json::array()},
                                {"compared", study.methods[study.method].name},
                                {"paired_by", name_of_pairing(results.paired_by)},
                                {"comparisons", results.table.comparisons.size()},
                                {"significance", nullptr}};
    for (const StudyView& view : study.views) json["scenes"].push_back(view.title);
    for (const RatingAnswers& rater : results.ratings.answers) {
        nlohmann::ordered_json one{
            {"rater", rater.rater}, {"role", nullptr}, {"years", nullptr}, {"seconds", rater.seconds}};
        if (!rater.role.empty()) one["role"] = rater.role;
        if (rater.years) one["years"] = *rater.years;
        json["raters"].push_back(one);
    }
    if (results.table.comparisons.empty())
        json["significance"] = "one rater: nothing can be said";
    else
        json["significance"] = "Wilcoxon signed-rank and paired t test, two-sided, corrected by Holm";
    for (std::size_t c = 0; c < kCriteria.size(); ++c) {
        nlohmann::ordered_json criterion{{"criterion", kCriteria[c].key},
                                         {"name", kCriteria[c].name},
                                         {"methods", nlohmann::ordered_json::object()}};
        for (std::size_t m = 0; m < study.methods.size(); ++m) {
            const ScoreSummary& one = results.table.summaries[c][m];
            criterion["methods"][study.methods[m].name] = {{"title", study.methods[m].title},
                                                           {"count", one.count},
                                                           {"mean", one.mean},
                                                           {"sigma", or_null(one.sigma)},
                                                           {"median", one.median}};
            if (const MethodComparison* found = comparison_with(results, c, m))
                criterion["against"][study.methods[m].name] = comparison_json(*found);
        }
        json["criteria"].push_back(criterion);
    }
    return json;
}

Table results_table(const RatingResults& results) {
    Table table{"Ratings",
                {{"criterion", "Criterion"},
                 {"method", "Method"},
                 {"count", "Count"},
                 {"mean", "Mean"},
                 {"sigma", "Sigma"},
                 {"median", "Median"},
                 {"pairs", "Pairs"},
                 {"difference", "Difference"},
                 {"low_95", "95 % from"},
                 {"high_95", "95 % to"},
                 {"w_plus", "W+"},
                 {"w_minus", "W-"},
                 {"p", "p"},
                 {"p_holm", "p, Holm"},
                 {"rank_biserial", "r"},
                 {"t", "t"},
                 {"p_t", "p of t"},
                 {"p_t_holm", "p of t, Holm"},
                 {"cohen_d", "d"}},
                {}};
    const auto cell = [](const std::optional<double>& value) { return value ? Cell(*value) : Cell(""); };
    for (std::size_t c = 0; c < kCriteria.size(); ++c)
        for (std::size_t m = 0; m < results.ratings.study.methods.size(); ++m) {
            const ScoreSummary& one = results.table.summaries[c][m];
            std::vector<Cell> row{std::string(kCriteria[c].key),
                                  results.ratings.study.methods[m].name,
                                  static_cast<double>(one.count),
                                  one.mean,
                                  cell(one.sigma),
                                  one.median};
            if (const MethodComparison* found = comparison_with(results, c, m)) {
                const measure::PairedT& t = found->t;
                const double half = t.half_95.value_or(NAN); // not a number leaves the field empty
                for (const Cell& next :
                     {Cell(static_cast<double>(t.pairs)), Cell(t.mean), Cell(t.mean - half), Cell(t.mean + half),
                      Cell(found->ranks.positive_sum), Cell(found->ranks.negative_sum), Cell(found->ranks.p),
                      Cell(found->corrected_p), Cell(found->ranks.effect), cell(t.t), cell(t.p),
                      cell(found->corrected_t), cell(t.effect)})
                    row.push_back(next);
            }
            row.resize(table.columns.size(), Cell(""));
            table.rows.push_back(std::move(row));
        }
    return table;
}

} // namespace ramus::app
