// RatingStudy: a study with raters (paper, section VIII). Several methods show the same study views; raters score the
// pictures by a few criteria, without knowing the methods and each in an individual order. From this value the rating
// pages are written, and the key, which alone identifies the methods and stays with the organiser. Answers refer to
// pictures by code.
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
    std::string_view question;  // asks for one thing
    std::string_view low, high; // what the lowest and the highest score mean
};

// Own wording of the criteria of section VIII.
inline constexpr std::array<Criterion, 4> kCriteria{
    {{"appearance", "Appearance", "How much do the vessels look like real ones?", "artificial", "real"},
     {"spatial_shape", "Spatial shape", "How well can you see where vessels run and branch?", "unclear", "clear"},
     {"transitions", "Branchings", "How plausible is the shape where vessels branch?", "implausible", "plausible"},
     {"overall", "Overall", "How well would this picture serve you for planning?", "poorly", "very well"}}};

// The professions that raters can choose.
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
inline constexpr int kMostRaters = 500; // a rating page takes some MB

struct StudyMethod {
    std::string name;  // "cones"
    std::string title; // "Truncated cones"
    bool operator==(const StudyMethod&) const = default;
};

struct StudyPicture {
    std::string code;       // checksum of its bytes: does not reveal the method, and identifies the picture
    std::size_t method = 0; // index into RatingStudy::methods
    bool operator==(const StudyPicture&) const = default;
};

struct StudyView {
    std::string title;                  // for raters and tables: "The whole tree"
    std::vector<StudyPicture> pictures; // one per method, ordered by code
    bool operator==(const StudyView&) const = default;
};

// A study view as a rater sees it: its pictures from left to right.
struct ShownView {
    std::size_t view = 0;
    std::vector<std::size_t> pictures; // indices into StudyView::pictures
    bool operator==(const ShownView&) const = default;
};
using RaterOrder = std::vector<ShownView>; // in order of presentation

struct RatingStudy {
    std::vector<StudyMethod> methods;
    std::size_t method = 0; // the method compared with each of the others
    std::vector<StudyView> views;
    std::uint64_t seed = 0;
    std::vector<RaterOrder> orders; // by rater number - 1
    bool operator==(const RatingStudy&) const = default;
};

// A checksum of criteria, study views and codes: equal pictures are the same study, whoever the raters are. It does not
// depend on the assignment of methods, so that nobody can find it by trial.
[[nodiscard]] std::string id_of(const RatingStudy& study);

// The picture with this code; none: unknown.
[[nodiscard]] std::optional<ShownView> picture_of(const RatingStudy& study, const std::string& code);

// kCriteria, as the key and the page of a rater have them.
[[nodiscard]] nlohmann::ordered_json criteria_json();
// The content of the key's file.
[[nodiscard]] nlohmann::ordered_json key_json(const RatingStudy& study);
// Fails if `key` is not a complete key; `where` names the file.
[[nodiscard]] Result<RatingStudy> study_from_key(const nlohmann::json& key, const std::string& where);

inline constexpr std::string_view kKeyFormat = "ramus-study-key";
inline constexpr std::string_view kAnswersFormat = "ramus-ratings";
inline constexpr int kRatingsVersion = 1; // of both

} // namespace ramus::app
