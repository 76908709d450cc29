#include "app/reports/validation/branch_radii.h"
#include "app/reports/validation/data_set.h"
#include "app/reports/validation/validation_page.h"
#include "app/reports/validation/validation_tables.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

using namespace ramus;
using namespace ramus::app;

namespace {

measure::DeviationStatistics distances(std::vector<double> values, std::optional<double> threshold) {
    return measure::statistics_of(values, threshold);
}

validate::RadiusPlace place(int branch, double along, double input, double surface, bool alone) {
    return {branch, along, {along, 0, 0}, input, surface, surface, alone, {1, 0, 0}};
}

ValidatedDataSet data_set(const std::string& tree, const std::vector<double>& to_cones) {
    ValidatedDataSet set;
    set.tree = tree;
    set.to_cones = {distances(to_cones, std::nullopt), {}};
    set.validation.radii = {place(0, 0, 1, 3, false), place(0, 1, 1, 1.1, true), place(1, 0, 2, 1.4, true),
                            place(1, 1, 2, 2, true), place(2, 0, 1, 5, false)};
    set.cones_radii_mm = {1, 1, 2, 2, 1};
    return set;
}

double number(const Table& table, std::size_t row, const std::string& column) {
    const auto found = std::ranges::find(table.columns, column, &Column::name);
    REQUIRE(found != table.columns.end());
    return table.rows.at(row)[static_cast<std::size_t>(found - table.columns.begin())].number.value();
}

} // namespace

TEST_CASE("an average is the mean over data sets, each with the same weight") {
    // Figures of values 0, 2 (mean 1, sigma 1, rms sqrt 2) and of 6, 6, 6, 6 (mean 6, sigma 0, rms 6). Of all six
    // values together the mean would be 26/6; the mean of the means is 3.5.
    const std::vector<DistanceFigures> rows{figures_of(distances({0.0, 2.0}, 1.0)),
                                            figures_of(distances({6.0, 6.0, 6.0, 6.0}, 1.0))};
    const DistanceFigures mean = summary_of(rows, Of::kMean);
    CHECK(mean.mean == doctest::Approx(3.5));
    CHECK(mean.sigma == doctest::Approx(0.5));
    CHECK(mean.rms == doctest::Approx(0.5 * (std::sqrt(2.0) + 6.0)));
    CHECK(mean.min == doctest::Approx(3.0));
    CHECK(mean.max == doctest::Approx(4.0));
    CHECK(mean.median == doctest::Approx(3.5));
    CHECK(mean.percentile_95 == doctest::Approx(0.5 * (1.9 + 6.0)));
    CHECK(mean.above_percent.value() == doctest::Approx(0.5 * (50.0 + 100.0)));

    const std::vector<DistanceFigures> one_without{rows[0], figures_of(distances({6.0}, std::nullopt))};
    CHECK_FALSE(summary_of(one_without, Of::kMean).above_percent);
    CHECK(summary_of(std::span(rows).first(1), Of::kMean).sigma == doctest::Approx(1.0)); // of one: itself
}

TEST_CASE("averages count places per data set, and omit missing radii") {
    std::vector<ValidatedDataSet> sets{data_set("a.swc", {1.0, 3.0}), data_set("b.swc", {4.0})};
    sets[0].validation.lost.resize(3);
    sets[1].validation.merged.resize(1);
    sets[0].validation.radius_error = {10, 0.02, 0.08, 0.0, 0.0};
    const ValidationSummary averages = summary_of(by_unit(sets).front().sets, Of::kMean);
    CHECK(averages.data_sets == 2);
    CHECK(averages.to_cones.mean == doctest::Approx(3.0));
    CHECK_FALSE(averages.to_mask);
    CHECK(averages.lost == doctest::Approx(1.5));
    CHECK(averages.merged == doctest::Approx(0.5));
    CHECK(averages.radius_median.value() == doctest::Approx(0.02)); // b has no place for it
    sets[0].validation.radius_error = {};
    CHECK_FALSE(summary_of(by_unit(sets).front().sets, Of::kMean).radius_median);
    sets[0].to_mask = {distances({5.0}, 1.0), {}};
    CHECK_FALSE(summary_of(by_unit(sets).front().sets, Of::kMean).to_mask); // not all have a mask
    sets[1].to_mask = {distances({7.0}, 1.0), {}};
    CHECK(summary_of(by_unit(sets).front().sets, Of::kMean).to_mask.value().mean == doctest::Approx(6.0));
}

TEST_CASE("lengths in mm and in an unknown unit are never averaged together") {
    std::vector<ValidatedDataSet> sets{data_set("a.swc", {1.0, 3.0}), data_set("b.swc", {400.0}),
                                       data_set("c.swc", {4.0})};
    sets[1].claims.unit = tree::SaidBy::kNobody;
    const std::vector<UnitGroup> groups = by_unit(sets);
    REQUIRE(groups.size() == 2);
    CHECK(groups[0].unit == "mm");
    CHECK(summary_of(groups[0].sets, Of::kMean).to_cones.mean == doctest::Approx(3.0));
    CHECK(groups[1].unit == "unknown");
    CHECK(summary_of(groups[1].sets, Of::kMean).to_cones.mean == doctest::Approx(400.0));

    const Table table = distance_table(sets, Held::kToCones);
    REQUIRE(table.rows.size() == 3 + 2 * 2);
    CHECK(table.columns[3].name == "mean");
    CHECK(table.columns.back().name == "unit");
    CHECK(table.rows[1].back().text == "unknown");
    CHECK(table.rows[3][1].text == "average, mm");
    CHECK(table.rows[3][3].number.value() == doctest::Approx(3.0));
    CHECK(table.rows[5][1].text == "average, unknown");
    CHECK(table.rows[5][3].number.value() == doctest::Approx(400.0));
    const Table words = in_words(table);
    CHECK(words.columns[3].heading == "Mean"); // of two units
    CHECK(words.columns.back().heading == "Unit");
    const Table one = in_words(distance_table(std::span(sets).subspan(1, 1), Held::kToCones));
    CHECK(one.columns[3].heading == "Mean, units");
    CHECK(one.columns.back().heading != "Unit");
}

TEST_CASE("the table of distances ends with average and standard deviation where there are several data sets") {
    const std::vector<ValidatedDataSet> sets{data_set("a.swc", {1.0, 3.0}), data_set("b.swc", {4.0})};
    const Table table = distance_table(sets, Held::kToCones);
    REQUIRE(table.rows.size() == 4);
    CHECK(number(table, 0, "mean") == doctest::Approx(2.0));
    CHECK(number(table, 2, "mean") == doctest::Approx(3.0));
    CHECK(table.rows[2][1].text == "average");
    CHECK(number(table, 3, "mean") == doctest::Approx(std::sqrt(2.0))); // of 2 and 4, a sample
    CHECK(table.rows[3][1].text == "standard deviation");
    CHECK(distance_table(std::span(sets).first(1), Held::kToCones).rows.size() == 1);
    CHECK(distance_table(sets, Held::kToMask).rows.empty());
    const Table shown = for_people(table); // no mask, no voxels
    CHECK(shown.columns.size() + 2 == table.columns.size());
    CHECK(std::ranges::find(shown.columns, "above_percent", &Column::name) == shown.columns.end());
    CHECK(all_distances_table(sets).columns[2].name == "distance");
}

TEST_CASE("the worst branches have the largest error of the radius where they are alone") {
    const ValidatedDataSet set = data_set("a.swc", {1.0});
    const std::vector<validate::BranchError> worst = validate::worst_branches(set.validation, 9);
    REQUIRE(worst.size() == 2); // nothing of branch 2 is alone
    CHECK(worst[0].branch == 1);
    CHECK(worst[0].error == doctest::Approx(0.3)); // 1.4 in place of 2
    CHECK(worst[0].worst == 2);
    CHECK(worst[1].branch == 0);
    CHECK(worst[1].error == doctest::Approx(0.1)); // not 3 in place of 1, beside a joint
    CHECK(validate::worst_branches(set.validation, 1).size() == 1);
    const RadiusCurves curves = curves_of(set, worst[0]);
    CHECK(curves.surface_mm == std::vector<double>{1.4, 2.0});
    CHECK(curves.cones_mm == std::vector<double>{2.0, 2.0});
    CHECK(curves.mask_mm.empty());
}

TEST_CASE("every place of every question is a row of one table") {
    std::vector<ValidatedDataSet> sets{data_set("a.swc", {1.0}), data_set("b.swc", {1.0})};
    sets[1].validation.lost = {{7, {1, 2, 3}, 4.5}};
    sets[1].validation.merged = {{{3, 9}, {0, 0, 1}, -0.5}};
    sets[1].validation.constrictions = {{5, {0, 0, 0}, 0.8, 1.2}};
    sets[1].validation.widths = {{6, {0, 0, 0}, 9.0, 1.0, 1.5}};
    sets[1].validation.positions = {{8, {0, 0, 0}, 7.0, 0.5}};
    const Table table = all_places_table(sets);
    REQUIRE(table.rows.size() == 5);
    CHECK(csv_of(table) ==
          "data_set,question,branch,other_branch,x,y,z,length,gap,offset,expected_radius,radius,unit\r\n"
          "2,lost,7,,1,2,3,4.5,,,,,mm\r\n"
          "2,merged,3,9,0,0,1,,-0.5,,,,mm\r\n"
          "2,constriction,5,,0,0,0,,,,0.8,1.2,mm\r\n"
          "2,width,6,,0,0,0,9,,,1,1.5,mm\r\n"
          "2,position,8,,0,0,0,7,,0.5,,,mm\r\n");
}

TEST_CASE("the page is self-contained, and shows names as text") {
    std::vector<ValidatedDataSet> sets{data_set("/data/<b>&.swc", {0.0, 1.0})};
    sets[0].files = {{"tree", "/data/<b>&.swc", "abc"}};
    for (std::size_t count : {1, 2}) {
        sets.resize(count, sets.front());
        const std::string page = validation_page(sets, {{"Unit", "<i>"}}, "today");
        CHECK(page.find("&lt;b&gt;&amp;.swc") != std::string::npos);
        CHECK(page.find("<b>") == std::string::npos);
        CHECK(page.find("<i>") == std::string::npos);
        for (const char* needed : {"<script", "<link", "src=\"http", "url(", "@import"})
            CHECK(page.find(needed) == std::string::npos);
        CHECK((page.find("average") != std::string::npos) == (count > 1));
    }
    CHECK_FALSE(has_mask(sets));
}
