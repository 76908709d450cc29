#include "app/ratings/rating_answers.h"

#include "app/session/json_values.h"
#include "core/base/words.h"
#include "core/io/input_file.h"
#include "core/io/trees/json_input.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace ramus::app {

using namespace session_json;

namespace {

constexpr std::uintmax_t kLargestAnswers = 2ULL << 20; // answers take some kB, the key of 500 raters less than 1 MB
constexpr double kMostSeconds = 1e8;
constexpr std::size_t kMostListed = 3; // missing answers listed in messages
constexpr const char* kSaveAgain = "open the rater's page in the same browser and save the answers again";

const json& answer_member(const json& object, const char* name) {
    if (!object.is_object() || !object.contains(name)) throw Refusal{std::string("there is no \"") + name + "\""};
    return object[name];
}

std::string in_quotes(const std::string& text) { return std::string("\"").append(text.substr(0, 40)).append("\""); }

// "picture B of "The whole tree", Branchings": the letter is the one that this rater saw.
std::string question_text(const RatingStudy& study, const RaterOrder& order, const std::string& code,
                          std::size_t criterion) {
    const auto found = *picture_of(study, code);
    const auto shown = std::ranges::find(order, found.view, &ShownView::view);
    const auto place = std::ranges::find(shown->pictures, found.pictures.front()) - shown->pictures.begin();
    return std::string("picture ") + static_cast<char>('A' + place) + " of " +
           in_quotes(study.views[found.view].title) + ", " + std::string(kCriteria[criterion].name);
}

void check_order(const json& views, const RatingStudy& study, const RaterOrder& order, RatingAnswers& answers) {
    if (!views.is_array() || views.size() != order.size())
        throw Refusal{"scenes are not a list of " + std::to_string(order.size())};
    for (std::size_t i = 0; i < order.size(); ++i) {
        expect_only(views[i], "a scene", {"order", "seconds"});
        answers.seconds += number(answer_member(views[i], "seconds"), "seconds of a scene", 0.0, kMostSeconds);
        json expected = json::array();
        for (const std::size_t picture : order[i].pictures)
            expected.push_back(study.views[order[i].view].pictures[picture].code);
        if (answer_member(views[i], "order") != expected)
            throw Refusal{"the order in which scene " + std::to_string(i + 1) + " was shown is not that of rater " +
                          std::to_string(answers.rater) + " in the key"};
    }
}

void read_scores(const json& list, const RatingStudy& study, const RaterOrder& order, RatingAnswers& answers) {
    if (!list.is_array()) throw Refusal{"answers are not a list"};
    constexpr std::size_t kCriterionCount = kCriteria.size();
    answers.scores.assign(study.views.size() * study.methods.size() * kCriterionCount, 0);
    const auto place_of = [&](const ShownView& found, std::size_t criterion) {
        const std::size_t method = study.views[found.view].pictures[found.pictures.front()].method;
        return (found.view * study.methods.size() + method) * kCriterionCount + criterion;
    };
    for (const json& answer : list) {
        expect_only(answer, "an answer", {"picture", "criterion", "score"});
        const std::string code = text(answer_member(answer, "picture"), "picture of an answer");
        const std::string key = text(answer_member(answer, "criterion"), "criterion of an answer");
        const auto picture = picture_of(study, code);
        if (!picture) throw Refusal{"there is no picture " + in_quotes(code) + " in the study"};
        const auto criterion = std::ranges::find(kCriteria, std::string_view(key), &Criterion::key);
        if (criterion == kCriteria.end()) throw Refusal{"there is no criterion " + in_quotes(key)};
        const auto index = static_cast<std::size_t>(criterion - kCriteria.begin());
        const json& score = answer_member(answer, "score");
        if (!score.is_number_integer() || score < kLowestScore || score > kHighestScore)
            throw Refusal{"the score of " + question_text(study, order, code, index) + " is " +
                          score.dump(-1, ' ', true).substr(0, 40) + ", not a whole number from " +
                          std::to_string(kLowestScore) + " to " + std::to_string(kHighestScore)};
        int& place = answers.scores[place_of(*picture, index)];
        if (place != 0) throw Refusal{question_text(study, order, code, index) + " is answered twice"};
        place = score.get<int>();
    }
    std::vector<std::string> missing;
    for (const ShownView& view : order)
        for (const std::size_t picture : view.pictures)
            for (std::size_t criterion = 0; criterion < kCriterionCount; ++criterion)
                if (answers.scores[place_of({view.view, {picture}}, criterion)] == 0)
                    missing.push_back(
                        question_text(study, order, study.views[view.view].pictures[picture].code, criterion));
    if (missing.empty()) return;
    const std::size_t count = missing.size();
    if (count > kMostListed) missing.resize(kMostListed);
    throw Refusal{std::to_string(count) + (count == 1 ? " answer is missing: " : " answers are missing: ") +
                  joined(missing, "; ") + (count > kMostListed ? "; and others" : "")};
}

RatingAnswers answers_in(const json& value, const RatingStudy& study) {
    expect_only(value, "the answers",
                {"format", "version", "study", "rater", "role", "years", "started", "saved", "scenes", "answers"});
    if (text(answer_member(value, "format"), "format") != kAnswersFormat) throw Refusal{"these are no answers"};
    if (integer(answer_member(value, "version"), "version", 0, 1'000'000) != kRatingsVersion)
        throw Refusal{"version " + value["version"].dump() + " is not known to this ramus"};
    const std::string id = text(answer_member(value, "study"), "study");
    if (id != id_of(study))
        throw Refusal{"these are answers of study " + in_quotes(id) + ", and the key is of study " +
                      in_quotes(id_of(study))};
    RatingAnswers answers;
    answers.rater = integer(answer_member(value, "rater"), "rater", 1, static_cast<int>(study.orders.size()));
    if (const json& role = answer_member(value, "role"); !role.is_null()) {
        answers.role = text(role, "role");
        if (std::ranges::find(kRaterRoles, std::string_view(answers.role), &RaterRole::key) == kRaterRoles.end())
            throw Refusal{"unknown role " + in_quotes(answers.role)};
    }
    if (const json& years = answer_member(value, "years"); !years.is_null())
        answers.years = integer(years, "years", 0, kMostYears);
    for (const char* time : {"started", "saved"}) (void)text(answer_member(value, time), time);
    const RaterOrder& order = study.orders[static_cast<std::size_t>(answers.rater - 1)];
    check_order(answer_member(value, "scenes"), study, order, answers);
    read_scores(answer_member(value, "answers"), study, order, answers);
    return answers;
}

struct RatingFile {
    std::string name;
    json content;
};

Result<RatingFile> read_rating_file(const std::string& name) {
    RAMUS_TRY(bytes, io::read_file(name, kLargestAnswers));
    auto parsed = io::parsed_json(bytes, name);
    const char* hint = "give key.json of the study and the files that raters saved";
    if (!parsed) return fail(parsed.error().what, parsed.error().where, hint);
    const std::string format = io::json_text(*parsed, "format");
    if (format != kKeyFormat && format != kAnswersFormat)
        return fail("this is neither the key of a study nor a rater's answers", name, hint);
    return RatingFile{name, std::move(*parsed)};
}

} // namespace

Result<RatingAnswers> answers_from_json(const json& value, const RatingStudy& study, const std::string& where) {
    try {
        return answers_in(value, study);
    } catch (const Refusal& refusal) {
        return fail(refusal.what, where, kSaveAgain);
    }
}

Result<RatingsRead> read_ratings(const std::vector<std::string>& files) {
    std::vector<RatingFile> read;
    std::optional<std::size_t> key;
    for (const std::string& file : files) {
        RAMUS_TRY(content, read_rating_file(file));
        if (io::json_text(content.content, "format") == kKeyFormat) {
            if (key) return fail("this is a second key, beside " + read[*key].name, file, "give one study at a time");
            key = read.size();
        }
        read.push_back(std::move(content));
    }
    if (!key)
        return fail("there is no key among the files, and answers do not tell the methods", files.front(),
                    "give key.json, which `ramus study` wrote, too");
    if (read.size() == 1)
        return fail("there are no answers beside this key", files.front(), "give the files that raters saved, too");
    RAMUS_TRY(study, study_from_key(read[*key].content, read[*key].name));
    std::map<int, std::pair<std::string, RatingAnswers>> raters;
    for (const RatingFile& file : read) {
        if (&file == &read[*key]) continue;
        RAMUS_TRY(answers, answers_from_json(file.content, study, file.name));
        const auto [place, fresh] = raters.try_emplace(answers.rater, file.name, answers);
        if (!fresh)
            return fail("these are answers of rater " + std::to_string(answers.rater) + ", as " + place->second.first +
                            " has them, too",
                        file.name, "give the newer one of the two alone");
    }
    const measure::Scores::Size size{raters.size(), study.views.size(), study.methods.size(), kCriteria.size()};
    RatingsRead found{std::move(study), {}, measure::Scores(size)};
    for (auto& [number, rater] : raters) {
        std::size_t at = 0;
        for (std::size_t view = 0; view < size.views; ++view)
            for (std::size_t method = 0; method < size.methods; ++method)
                for (std::size_t criterion = 0; criterion < size.criteria; ++criterion)
                    found.scores.at({found.answers.size(), view, method, criterion}) = rater.second.scores[at++];
        found.answers.push_back(std::move(rater.second));
    }
    return found;
}

} // namespace ramus::app
