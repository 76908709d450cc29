#include "app/ratings/rating_study.h"

#include "app/session/checksum.h"
#include "app/session/json_values.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

namespace ramus::app {

using namespace session_json;

namespace {

constexpr std::uint64_t kMostStudyParts = 100; // methods, study views

const json& member_of(const json& object, const char* name) {
    if (!object.contains(name)) throw Refusal{std::string("there is no \"") + name + "\""};
    return object[name];
}

const json& list_of(const json& object, const char* name, std::size_t most) {
    const json& list = member_of(object, name);
    if (!list.is_array() || list.empty() || list.size() > most)
        throw Refusal{std::string(name) + " is not a list of 1 to " + std::to_string(most)};
    return list;
}

std::size_t method_named(const RatingStudy& study, const std::string& name) {
    const auto found = std::ranges::find(study.methods, name, &StudyMethod::name);
    if (found == study.methods.end()) throw Refusal{"there is no method \"" + name + "\""};
    return static_cast<std::size_t>(found - study.methods.begin());
}

StudyView view_in(const json& value, const RatingStudy& study) {
    expect_only(value, "a scene", {"title", "pictures"});
    StudyView view{text(member_of(value, "title"), "title of a scene"), {}};
    const json& pictures = member_of(value, "pictures");
    if (!pictures.is_object()) throw Refusal{"pictures of a scene are not an object"};
    std::set<std::size_t> methods;
    for (const auto& [code, method] : pictures.items()) { // ordered by code, as objects are
        view.pictures.push_back({code, method_named(study, text(method, "method of a picture"))});
        methods.insert(view.pictures.back().method);
    }
    if (methods.size() != study.methods.size() || view.pictures.size() != study.methods.size())
        throw Refusal{"a scene has not one picture of each method"};
    return view;
}

RaterOrder order_in(const json& value, const RatingStudy& study) {
    if (!value.is_array()) throw Refusal{"the order of a rater is not a list"};
    RaterOrder order;
    std::set<std::size_t> views;
    for (const json& shown : value) {
        if (!shown.is_array()) throw Refusal{"the order of a scene is not a list"};
        ShownView& view = order.emplace_back();
        std::set<std::size_t> pictures;
        for (const json& code : shown) {
            const auto found = picture_of(study, text(code, "code of a picture"));
            if (!found) throw Refusal{"there is no picture " + code.dump()};
            if (!view.pictures.empty() && found->view != view.view)
                throw Refusal{"a rater sees pictures of two scenes next to each other"};
            view.view = found->view;
            view.pictures.push_back(found->pictures.front());
            if (!pictures.insert(view.pictures.back()).second || views.contains(view.view))
                throw Refusal{"a rater sees a picture twice"};
        }
        if (pictures.size() != study.methods.size()) throw Refusal{"a rater does not see all pictures of a scene"};
        views.insert(view.view);
    }
    if (views.size() != study.views.size()) throw Refusal{"a rater does not see all scenes"};
    return order;
}

RatingStudy study_in(const json& key) {
    expect_only(key, "the key",
                {"format", "version", "study", "criteria", "methods", "compared", "scenes", "seed", "orders"});
    if (text(member_of(key, "format"), "format") != kKeyFormat) throw Refusal{"this is not the key of a study"};
    if (integer(member_of(key, "version"), "version", 0, 1'000'000) != kRatingsVersion)
        throw Refusal{"version " + key["version"].dump() + " is not known to this ramus"};
    RatingStudy study;
    for (const json& method : list_of(key, "methods", kMostStudyParts)) {
        expect_only(method, "a method", {"name", "title"});
        study.methods.push_back({text(member_of(method, "name"), "name of a method"),
                                 text(member_of(method, "title"), "title of a method")});
    }
    study.method = method_named(study, text(member_of(key, "compared"), "compared"));
    for (const json& view : list_of(key, "scenes", kMostStudyParts)) study.views.push_back(view_in(view, study));
    const json& seed = member_of(key, "seed");
    if (!seed.is_number_unsigned()) throw Refusal{"seed is not a whole number"};
    study.seed = seed.get<std::uint64_t>();
    for (const json& order : list_of(key, "orders", kMostRaters)) study.orders.push_back(order_in(order, study));
    // Detects manual changes, and criteria of another version of ramus.
    if (text(member_of(key, "study"), "study") != id_of(study)) throw Refusal{"the checksum of the study is wrong"};
    return study;
}

} // namespace

std::string id_of(const RatingStudy& study) {
    Checksum checksum;
    checksum.add(std::to_string(kRatingsVersion));
    for (const Criterion& criterion : kCriteria)
        for (const std::string_view part :
             {criterion.key, criterion.name, criterion.question, criterion.low, criterion.high})
            checksum.add(part).add("\n");
    for (const StudyView& view : study.views) {
        checksum.add(view.title).add("\n");
        for (const StudyPicture& picture : view.pictures) checksum.add(picture.code).add("\n");
    }
    return checksum.text();
}

std::optional<ShownView> picture_of(const RatingStudy& study, const std::string& code) {
    for (std::size_t view = 0; view < study.views.size(); ++view) {
        const auto& pictures = study.views[view].pictures;
        const auto found = std::ranges::find(pictures, code, &StudyPicture::code);
        if (found != pictures.end()) return ShownView{view, {static_cast<std::size_t>(found - pictures.begin())}};
    }
    return std::nullopt;
}

nlohmann::ordered_json criteria_json() {
    nlohmann::ordered_json criteria = nlohmann::ordered_json::array();
    for (const Criterion& criterion : kCriteria)
        criteria.push_back({{"key", criterion.key},
                            {"name", criterion.name},
                            {"question", criterion.question},
                            {"low", criterion.low},
                            {"high", criterion.high}});
    return criteria;
}

nlohmann::ordered_json key_json(const RatingStudy& study) {
    nlohmann::ordered_json key{{"format", kKeyFormat}, {"version", kRatingsVersion}, {"study", id_of(study)}};
    key["criteria"] = criteria_json();
    for (const StudyMethod& method : study.methods)
        key["methods"].push_back({{"name", method.name}, {"title", method.title}});
    key["compared"] = study.methods[study.method].name;
    for (const StudyView& view : study.views) {
        nlohmann::ordered_json pictures = nlohmann::ordered_json::object();
        for (const StudyPicture& picture : view.pictures) pictures[picture.code] = study.methods[picture.method].name;
        key["scenes"].push_back({{"title", view.title}, {"pictures", pictures}});
    }
    key["seed"] = study.seed;
    for (const RaterOrder& order : study.orders) {
        nlohmann::ordered_json shown = nlohmann::ordered_json::array();
        for (const ShownView& view : order) {
            nlohmann::ordered_json codes = nlohmann::ordered_json::array();
            for (const std::size_t picture : view.pictures)
                codes.push_back(study.views[view.view].pictures[picture].code);
            shown.push_back(codes);
        }
        key["orders"].push_back(shown);
    }
    return key;
}

Result<RatingStudy> study_from_key(const json& key, const std::string& where) {
    try {
        return study_in(key);
    } catch (const Refusal& refusal) {
        return fail(refusal.what, where, "give key.json as `ramus study` wrote it");
    }
}

} // namespace ramus::app
