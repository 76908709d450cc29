// What ramus reads of its own: sessions with their edits, settings, commands, conditions of the list of branches, keys
// of studies with answers of raters.
#include "app/actions/script.h"
#include "app/ratings/rating_answers.h"
#include "app/session/branch_filter.h"
#include "app/session/session_file.h"
#include "app/session/tree_edits.h"
#include "app/storage/settings.h"
#include "core/io/json_text.h"
#include "core/tree/build_tree.h"
#include "tests/fuzz/target.h"

#include <memory>
#include <nlohmann/json.hpp>

namespace ramus::fuzz {

namespace {

// A stem, two branches, a loop between them, and a vessel alone.
std::shared_ptr<const tree::VesselTree> small_network() {
    tree::Graph graph;
    for (const glm::dvec3& at :
         {glm::dvec3(0, 0, 0), {0, 0, 5}, {4, 0, 9}, {-4, 0, 9}, {0, 0, 13}, {20, 0, 0}, {20, 9, 0}})
        graph.points.push_back({at, 1.0});
    graph.edges = {{0, 1}, {1, 2}, {1, 3}, {2, 4}, {3, 4}, {5, 6}};
    graph.roots = {0, 5};
    auto tree = tree::build_tree(graph, tree::Repair::kUsual, [](std::uint32_t) { return std::string("a point"); });
    must(tree.has_value(), "the small network is no tree");
    return std::make_shared<const tree::VesselTree>(std::move(*tree));
}

void check_on_tree(const app::Session& session, const std::string& where) {
    static const std::shared_ptr<const tree::VesselTree> base = small_network();
    const auto edited = app::with_edits(base, session, session.tree.checksum, where);
    if (!edited) return check_error(edited.error(), where);
    check_tree(**edited);
    const auto fits = app::check_against(session, **edited, session.tree.checksum, where);
    if (!fits) check_error(fits.error(), where);
}

void read_session_bytes(std::string_view bytes) {
    const std::string path = written_file("session.json", bytes);
    const auto saved = app::read_session(path);
    if (!saved) return check_error(saved.error(), path);
    check_on_tree(saved->session, path);
    const nlohmann::json once = app::to_json(saved->session, "/folder");
    const auto again = app::session_from_json(once, "/folder", "again.json");
    must(again.has_value(), "ramus does not read what it wrote: " + (again ? "" : again.error().message()));
    must(app::to_json(again->session, "/folder") == once, "a session is another one after its own format");
}

void read_settings_bytes(std::string_view bytes) {
    const auto json = io::parsed_json(bytes, "settings.json");
    if (!json) return check_error(json.error(), "settings.json");
    const auto settings = app::settings_from_json(*json, "settings.json");
    if (!settings) return must(!settings.error().what.empty(), "an error says nothing");
    must(app::settings_from_json(app::to_json(*settings), "again.json").has_value(), "settings cannot be read again");
}

void read_commands_bytes(std::string_view bytes) {
    const auto lines = app::parse_script(bytes, "commands.txt");
    if (!lines) return check_error(lines.error(), "commands.txt");
    for (const app::ScriptLine& line : *lines) must(!line.words.empty(), "a line has no words");
}

void read_condition_bytes(std::string_view bytes) {
    const auto filter = app::parse_branch_filter(bytes);
    if (!filter) must(!filter.error().what.empty(), "an error says nothing");
}

// The key of a study, and answers of one of its raters.
void read_ratings_bytes(std::string_view bytes) {
    const auto [first, second] = two_files(bytes);
    const auto key = nlohmann::json::parse(first, nullptr, false);
    const auto study = app::study_from_key(key, "key.json");
    if (!study) return check_error(study.error(), "key.json");
    const auto again = app::study_from_key(nlohmann::json::parse(app::key_json(*study).dump()), "again.json");
    must(again.has_value(), "ramus does not read the key that it wrote: " + (again ? "" : again.error().message()));
    must(*again == *study, "a study is another one after its own format");
    const auto answers = app::answers_from_json(nlohmann::json::parse(second, nullptr, false), *study, "answers.json");
    if (!answers) return check_error(answers.error(), "answers.json");
    for (const int score : answers->scores)
        must(score >= app::kLowestScore && score <= app::kHighestScore, "a score is not of the scale");
}

} // namespace

std::vector<Target> session_targets() {
    return {{"session", read_session_bytes},
            {"settings", read_settings_bytes},
            {"commands", read_commands_bytes},
            {"condition", read_condition_bytes},
            {"ratings", read_ratings_bytes}};
}

} // namespace ramus::fuzz
