#include "app/ratings/rating_page.h"

#include "app/ratings/page_texts.h"
#include "app/reports/html.h"
#include "app/session/json_text.h"
#include "core/io/binary_numbers.h"
#include "core/io/output_file.h"

#include <nlohmann/json.hpp>
#include <system_error>

namespace ramus::app {

namespace {

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
    const std::string number = std::to_string(rater), page = script_json(page_json(study, rater, pngs));
    return filled(kPageTexts.at("page.html"), {{"style", kPageTexts.at("page.css")},
                                               {"script", kPageTexts.at("page.js")},
                                               {"rater", number},
                                               {"page", page}});
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
