// A study of raters (paper, section VIII): the same scenes as several methods show them, pictures without names in an
// order of their own for each rater, a few criteria. One value, from which sheets for raters are written, and the key,
// which alone tells the methods: it stays with who leads the study. Answers name pictures by their codes.
#pragma once

#include "core/base/error.h"

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

inline constexpr int kLowestScore = 1;
inline constexpr int kHighestScore = 5;

struct Criterion {
    std::string_view key;       // in files
    std::string_view name;      // "Branchings"
    std::string_view question;  // one thing alone
    std::string_view low, high; // what the lowest and the highest score mean
};

// Our own wording of what section VIII asks for.
inline constexpr std::array<Criterion, 4> kCriteria{
    {{"appearance", "Appearance", "How much do the vessels look like real ones?", "artificial", "real"},
     {"spatial_shape", "Spatial shape", "How well can you see where vessels run and branch?", "unclear", "clear"},
     {"transitions", "Branchings", "How plausible is the shape where vessels branch?", "implausible", "plausible"},
     {"overall", "Overall", "How well would this picture serve you for planning?", "poorly", "very well"}}};

// What raters may say of themselves.
struct RaterRole {
    std::string_view key, name;
};
inline constexpr std::array<RaterRole, 6> kRaterRoles{{{"surgeon", "Surgeon"},
                                                       {"radiologist", "Radiologist"},
                                                       {"physician", "Another physician"},
                                                       {"student", "Student of medicine"},
                                                       {"engineer", "Engineer or scientist"},
                                                       {"other", "Something else"}}};
inline constexpr int kMostYears = 80;   // of experience
inline constexpr int kMostRaters = 500; // a sheet for each takes some MB

struct StudyMethod {
    std::string name;  // "cones"
    std::string title; // "Truncated cones"
    bool operator==(const StudyMethod&) const = default;
};

struct StudyPicture {
    std::string code;       // checksum of its bytes: says nothing of the method, and shows later what was rated
    std::size_t method = 0; // of RatingStudy::methods
    bool operator==(const StudyPicture&) const = default;
};

struct StudyScene {
    std::string title;                  // for raters and tables: "The whole tree"
    std::vector<StudyPicture> pictures; // one for each method, ordered by code
    bool operator==(const StudyScene&) const = default;
};

// A scene as a rater sees it: its pictures from left to right.
struct ShownScene {
    std::size_t scene = 0;
    std::vector<std::size_t> pictures; // of StudyScene::pictures
    bool operator==(const ShownScene&) const = default;
};
using RaterOrder = std::vector<ShownScene>; // the first one first

struct RatingStudy {
    std::vector<StudyMethod> methods;
    std::size_t method = 0; // the one that is held against each of the others
    std::vector<StudyScene> scenes;
    std::uint64_t seed = 0;
    std::vector<RaterOrder> orders; // by rater, who is called by number from 1 on
    bool operator==(const RatingStudy&) const = default;
};

// A checksum of criteria, scenes and codes: the same pictures are the same study, whoever rates them. It does not
// depend on which method a picture is of, so that nobody can find that by trying.
[[nodiscard]] std::string id_of(const RatingStudy& study);

// The picture of a code; none: there is none.
[[nodiscard]] std::optional<ShownScene> picture_of(const RatingStudy& study, const std::string& code);

// The key's file.
[[nodiscard]] nlohmann::ordered_json key_json(const RatingStudy& study);
// Fails on what is no key, or not whole; `where` names the file.
[[nodiscard]] Result<RatingStudy> study_from_key(const nlohmann::json& key, const std::string& where);

inline constexpr std::string_view kKeyFormat = "ramus-study-key";
inline constexpr std::string_view kAnswersFormat = "ramus-ratings";
inline constexpr int kRatingsVersion = 1; // of both

} // namespace ramus::app
