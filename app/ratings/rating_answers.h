// Reads the answers that a rater saved from a rating page. The file is not trusted: it may belong to another study or
// program, be edited, or be incomplete.
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
    int rater = 0;            // counted from 1
    std::string role;         // a key of kRaterRoles; empty: no answer
    std::optional<int> years; // of experience
    double seconds = 0.0;     // for all study views
    std::vector<int> scores;  // by study view, method and criterion, in the order of measure::Scores
};

// Fails if answers are missing, repeated or out of range, belong to another study, or differ from the key's order for
// this rater. The error names the file, and study view, picture and criterion.
[[nodiscard]] Result<RatingAnswers> answers_from_json(const nlohmann::json& value, const RatingStudy& study,
                                                      const std::string& where);

struct RatingsRead {
    RatingStudy study;
    std::vector<RatingAnswers> answers; // by rater
    measure::Scores scores;
};

// Reads a key and answers, in any order. Fails without a key, with two keys, with two files of one rater, and on other
// files.
[[nodiscard]] Result<RatingsRead> read_ratings(const std::vector<std::string>& files);

} // namespace ramus::app
