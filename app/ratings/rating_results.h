// Results of a study (Table II of the paper) as text, JSON and CSV.
#pragma once

#include "app/ratings/rating_answers.h"
#include "app/reports/report_tables.h"
#include "core/measure/ratings/rating_table.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace ramus::app {

struct RatingResults {
    const RatingsRead& ratings;
    measure::RatingTable table;
    measure::PairedBy paired_by = measure::PairedBy::kRater;
};

[[nodiscard]] RatingResults results_of(const RatingsRead& ratings, measure::PairedBy paired_by);

[[nodiscard]] std::string results_text(const RatingResults& results);
[[nodiscard]] nlohmann::ordered_json results_json(const RatingResults& results);
// One row per criterion and method; columns of the test are empty without a test.
[[nodiscard]] Table results_table(const RatingResults& results);

} // namespace ramus::app
