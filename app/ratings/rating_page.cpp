#include "app/ratings/rating_page.h"

#include "app/ratings/page_texts.h"
#include "app/session/json_text.h"
#include "core/io/binary_numbers.h"
#include "core/io/output_file.h"

#include <nlohmann/json.hpp>
#include <system_error>

namespace ramus::app {

namespace {

// JSON that is safe inside a script element: "</script>" and "<!--" would end or change it.
std::string script_json(const nlohmann::ordered_json& value) {
    std::string text;
    for (const char c : value.dump()) c == '<' ? text += "\\u003c" : text += c;
    return text;
}

nlohmann::ordered_json page_json(const RatingStudy& study, int rater, const StudyPngs& pngs) {
    nlohmann::ordered_json page{{"format", kAnswersFormat},
                                {"version", kRatingsVersion},
                                {"study", id_of(study)},
                                {"rater", rater},
                                {"scale", {kLowestScore, kHighestScore}},
                                {"most_years", kMostYears}};
    page["criteria"] = criteria_json();
    for (const RaterRole& role : kRaterRoles) page["roles"].push_back({{"key", role.key}, {"name", role.name}});
    for (const ShownView& shown : study.orders[static_cast<std::size_t>(rater - 1)]) {
        const StudyView& view = study.views[shown.view];
        nlohmann::ordered_json pictures;
        for (const std::size_t picture : shown.pictures) {
            const std::string& code = view.pictures[picture].code;
            pictures.push_back(
                {{"code", code}, {"source", "data:image/png;base64," + io::base64_encoded(pngs.at(code))}});
        }
        page["scenes"].push_back({{"title", view.title}, {"pictures", pictures}});
    }
    return page;
}

} // namespace

std::string rating_page(const RatingStudy& study, int rater, const StudyPngs& pngs) {
    const std::map<std::string, std::string, std::less<>> parts{{"style", std::string(kPageTexts.at("page.css"))},
                                                                {"script", std::string(kPageTexts.at("page.js"))},
                                                                {"rater", std::to_string(rater)},
                                                                {"page", script_json(page_json(study, rater, pngs))}};
    // Replaces in one pass, so that inserted text is not searched again.
    std::string_view left = kPageTexts.at("page.html");
    std::string page;
    for (std::size_t open = left.find("{{"); open != std::string_view::npos; open = left.find("{{")) {
        const std::size_t close = left.find("}}", open);
        page.append(left.substr(0, open)).append(parts.find(left.substr(open + 2, close - open - 2))->second);
        left.remove_prefix(close + 2);
    }
    return page.append(left);
}

Result<std::vector<std::filesystem::path>> write_study(const RatingStudy& study, const StudyPngs& pngs,
                                                       const std::filesystem::path& folder, io::OutputSet& together) {
    const std::filesystem::path sheets = folder / "sheets";
    std::vector<std::filesystem::path> files;
    for (std::size_t rater = 1; rater <= study.orders.size(); ++rater) {
        const std::string number = std::to_string(rater);
        const std::string name = "rater_" + std::string(3 - std::min<std::size_t>(3, number.size()), '0') + number;
        files.push_back(sheets / (name + ".html"));
        if (auto done = together.add(files.back(), rating_page(study, static_cast<int>(rater), pngs)); !done)
            return tl::unexpected(done.error());
    }
    RAMUS_TRY(key, json_text(key_json(study), (folder / "key.json").string()));
    if (auto done = together.add(folder / "key.json", key); !done) return tl::unexpected(done.error());
    return files;
}

} // namespace ramus::app
