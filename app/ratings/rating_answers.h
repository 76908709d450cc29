// The file of answers that a rater saves from a sheet, read without trust: it may be of another study, of another
// program, changed by hand, or not whole.
#pragma once

#include "app/ratings/rating_study.h"
#include "core/base/error.h"
#include "core/measure/ratings/rating_table.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

struct RatingAnswers {
    int rater = 0;            // from 1 on
    std::string role;         // of kRaterRoles; empty: no answer
    std::optional<int> years; // of experience
    double seconds = 0.0;     // all scenes together
    std::vector<int> scores;  // by scene, method and criterion, in the order of measure::Scores
};

// Fails with the file's name on answers of another study, in another order than the key has for this rater, missing,
// given twice, or out of range: it names scene, picture and criterion.
[[nodiscard]] Result<RatingAnswers> answers_from_json(const nlohmann::json& value, const RatingStudy& study,
                                                      const std::string& where);

struct RatingsRead {
    RatingStudy study;
    std::vector<RatingAnswers> answers; // by rater
    measure::Scores scores;
};

// One key and answers, in any order. Fails on answers without a key, two keys, the same rater twice, files that are
// neither.
[[nodiscard]] Result<RatingsRead> read_ratings(const std::vector<std::string>& files);

} // namespace ramus::app
