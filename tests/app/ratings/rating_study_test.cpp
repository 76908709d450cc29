#include "app/ratings/rating_answers.h"
#include "app/ratings/rating_order.h"
#include "app/ratings/rating_page.h"
#include "app/ratings/rating_results.h"
#include "core/io/binary_numbers.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

using namespace ramus;
using namespace ramus::app;

namespace {

// Three methods, two study views.
RatingStudy small_study(int raters) {
    RatingStudy study;
    study.methods = {{"iso", "Isosurface"}, {"cones", "Truncated cones"}, {"cs", "Convolution surface"}};
    study.method = 2;
    study.views = {{"The whole tree", {{"a1", 1}, {"b2", 2}, {"c3", 0}}},
                   {"Close by", {{"d4", 0}, {"e5", 1}, {"f6", 2}}}};
    study.seed = 11;
    study.orders = rater_orders(study, raters);
    return study;
}

StudyPngs pngs_of(const RatingStudy& study) {
    StudyPngs pngs;
    for (const StudyView& view : study.views)
        for (const StudyPicture& picture : view.pictures) pngs[picture.code] = "bytes of " + picture.code;
    return pngs;
}

std::size_t count_of(const std::string& text, const std::string& word) {
    std::size_t count = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
    return count;
}

} // namespace

TEST_CASE("over six raters, every method is first equally often, and right of each other method equally often") {
    const RatingStudy study = small_study(18);
    REQUIRE(study.orders.size() == 18);
    for (std::size_t view = 0; view < 2; ++view) {
        std::map<std::size_t, int> first;
        std::map<std::pair<std::size_t, std::size_t>, int> beside;
        for (const RaterOrder& order : study.orders)
            for (const ShownView& shown : order) {
                if (shown.view != view) continue;
                ++first[shown.pictures[0]];
                for (std::size_t i = 1; i < 3; ++i) ++beside[{shown.pictures[i - 1], shown.pictures[i]}];
            }
        // 18 raters, three methods: six times each. Two neighbours for each of 18, six ordered pairs: six times each.
        CHECK(first == std::map<std::size_t, int>{{0, 6}, {1, 6}, {2, 6}});
        CHECK(beside.size() == 6);
        for (const auto& [pair, times] : beside) CHECK(times == 6);
    }
}

TEST_CASE("orders depend on the seed, and more raters do not change those of the first raters") {
    const RatingStudy study = small_study(4);
    CHECK(small_study(4).orders == study.orders);
    const RatingStudy more = small_study(40);
    CHECK(std::vector(more.orders.begin(), more.orders.begin() + 4) == study.orders);
    RatingStudy other = study;
    other.seed = 12;
    CHECK(rater_orders(other, 40) != more.orders);
    std::set<std::size_t> first_views;
    for (const RaterOrder& order : more.orders) first_views.insert(order[0].view);
    CHECK(first_views.size() == 2); // study views are shuffled, too
}

TEST_CASE("a study is restored from its key") {
    const RatingStudy study = small_study(3);
    const std::string text = key_json(study).dump();
    const auto read = study_from_key(nlohmann::json::parse(text), "key.json");
    REQUIRE(read.has_value());
    CHECK(*read == study);
}

TEST_CASE("the study's checksum does not reveal the methods, and changes with the pictures") {
    const RatingStudy study = small_study(1);
    RatingStudy swapped = study;
    std::swap(swapped.views[0].pictures[0].method, swapped.views[0].pictures[1].method);
    CHECK(id_of(swapped) == id_of(study));
    RatingStudy other = study;
    other.views[0].pictures[0].code = "a2";
    CHECK(id_of(other) != id_of(study));
}

TEST_CASE("a rating page has the pictures of its rater, and nothing in it can end its data") {
    RatingStudy study = small_study(2);
    study.views[1].title = "</script><!-- {{page}} \"";
    const StudyPngs pngs = pngs_of(study);
    for (int rater = 1; rater <= 2; ++rater) {
        const std::string page = rating_page(study, rater, pngs);
        CHECK(count_of(page, "</script>") == 2);
        CHECK(count_of(page, "<!--") == 0);
        CHECK(count_of(page, "{{style}}") == 0);
        const std::size_t from = page.find("application/json\">") + 18;
        const auto data = nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
        std::size_t at = 0;
        for (const ShownView& shown : study.orders[static_cast<std::size_t>(rater - 1)]) {
            const auto& view = data["scenes"][at++];
            CHECK(view["title"] == study.views[shown.view].title);
            for (std::size_t i = 0; i < 3; ++i) {
                const std::string& code = study.views[shown.view].pictures[shown.pictures[i]].code;
                CHECK(view["pictures"][i]["code"] == code);
                CHECK(view["pictures"][i]["source"] == "data:image/png;base64," + io::base64_encoded(pngs.at(code)));
            }
        }
        for (const StudyMethod& method : study.methods) CHECK(count_of(page, method.title) == 0);
    }
}

TEST_CASE("a study is written with a rating page for each rater") {
    const TemporaryFolder folder;
    const RatingStudy study = small_study(2);
    std::filesystem::create_directory(folder.path() / "sheets");
    io::OutputSet together;
    const auto files = write_study(study, pngs_of(study), folder.path(), together);
    REQUIRE(files.has_value());
    CHECK_FALSE(std::filesystem::exists(folder.path() / "key.json"));
    REQUIRE(together.commit());
    REQUIRE(files->size() == 2);
    CHECK(files->back() == folder.path() / "sheets" / "rater_002.html");
    CHECK(std::filesystem::exists(folder.path() / "key.json"));
    CHECK_FALSE(write_study(study, pngs_of(study), "/dev/null/no", together).has_value());
}

TEST_CASE("significance tests that cannot be computed leave their fields empty") {
    RatingsRead ratings{small_study(1), {RatingAnswers{}}, measure::Scores({1, 2, 3, 4})};
    ratings.answers[0].rater = 1;
    const RatingResults results = results_of(ratings, measure::PairedBy::kRater);
    CHECK(results_text(results).find("One rater") != std::string::npos);
    const Table table = results_table(results);
    REQUIRE(table.rows.size() == 12);
    for (const auto& row : table.rows) {
        REQUIRE(row.size() == table.columns.size());
        CHECK(row.back().text.empty());
        CHECK_FALSE(row.back().number.has_value());
    }
}
