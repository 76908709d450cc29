// Saved views: in the hands of commands, in session files, in reports, and on a tree that is read in another unit.
#include "app/session/session_file.h"
#include "app/session/session_limits.h"
#include "core/io/trees/tree_file.h"
#include "tests/support/built_tree.h"
#include "tests/support/command_stage.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace ramus;
using namespace ramus::app;

namespace {

struct ViewStage : test::CommandStage {
    ViewStage() : CommandStage(test::built_tree({{{0, 0, 0}, 2.0}, {{0, 0, 40}, 2.0}}, {{0, 1}})) {}
    [[nodiscard]] const render::Camera& camera() const { return document.session().camera; }
    [[nodiscard]] std::vector<std::string> names() const {
        std::vector<std::string> all;
        for (const SavedView& view : marks().views) all.push_back(view.name);
        return all;
    }
};

Session session_on_tree() {
    Session session;
    session.tree.path = "/data/tree.swc";
    return session;
}

// Why a session with these views is refused; empty: it is not.
std::string refused_views(const nlohmann::json& views) {
    nlohmann::json session = to_json(session_on_tree(), "/data");
    session["views"] = views;
    const auto read = session_from_json(session, "/data", "s.json");
    return read ? "" : read.error().message();
}

} // namespace

TEST_CASE("a view is saved, replaced, renamed and deleted, each as one step of undo") {
    ViewStage stage;
    const Marks before = stage.marks();
    stage.good("view-save \"behind the vein\"");
    const render::Camera first = stage.camera();
    CHECK(stage.last_step() == "view save behind the vein");
    stage.good("turn left 40\nview-save other");
    REQUIRE(stage.names() == std::vector<std::string>{"behind the vein", "other"});
    CHECK(stage.marks().views[0].camera == first);
    CHECK(stage.good("view-save \"behind the vein\"") == "Saved view replaced: behind the vein");
    CHECK(stage.names() == std::vector<std::string>{"behind the vein", "other"});
    CHECK(stage.marks().views[0].camera == stage.camera());
    CHECK(stage.camera() != first);
    stage.good("view-rename other lesion");
    CHECK(stage.names() == std::vector<std::string>{"behind the vein", "lesion"});
    stage.good("view-delete \"behind the vein\"");
    CHECK(stage.names() == std::vector<std::string>{"lesion"});
    for (int step = 0; step < 3; ++step) stage.good("undo");
    CHECK(stage.marks().views[0].camera == first);
    for (int step = 0; step < 2; ++step) stage.good("undo");
    CHECK(stage.marks() == before);
    CHECK_FALSE(stage.document.can_undo());
    for (int step = 0; step < 5; ++step) stage.good("redo");
    CHECK(stage.names() == std::vector<std::string>{"lesion"});
    CHECK(stage.document.has_unsaved_work());
}

TEST_CASE("going to a saved view moves the camera alone, and is no step of undo") {
    ViewStage stage;
    stage.good("view-save here");
    const render::Camera here = stage.camera();
    stage.good("turn up 30\northographic on\nzoom in");
    const auto steps = stage.document.step_count();
    const int leaps = stage.host.leaps;
    const Marks marks = stage.marks();
    stage.good("view-go here");
    CHECK(stage.camera() == here);
    CHECK(stage.host.leaps == leaps + 1);
    CHECK(stage.document.step_count() == steps);
    CHECK(stage.marks() == marks);
}

TEST_CASE("unknown views, and names that cannot be used, are refused with what is meant or possible") {
    ViewStage stage;
    CHECK(stage.bad("view-go here").find("no saved views; view-save NAME") != std::string::npos);
    stage.good("view-save \"left lobe\"\nview-save lesion");
    CHECK(stage.bad("view-go \"left lobes\"").find("did you mean \"left lobe\"?") != std::string::npos);
    CHECK(stage.bad("view-delete xyz").find("saved are left lobe, lesion") != std::string::npos);
    CHECK(stage.bad("view-rename xyz a").find("no saved view \"xyz\"") != std::string::npos);
    CHECK(stage.bad("view-rename lesion \"left lobe\"").find("\"left lobe\" already") != std::string::npos);
    for (const char* name : {"\"\"", "\"  \"", "anterior", "+z"}) {
        CHECK(stage.bad(std::string("view-save ") + name).find("name") != std::string::npos);
        CHECK(stage.bad(std::string("view-rename lesion ") + name).find("name") != std::string::npos);
    }
    CHECK(stage.bad("view-save \"two\tcolumns\"").find("one line") != std::string::npos);
    CHECK(stage.bad("view-save two words").find("quotes") != std::string::npos);
    CHECK(stage.bad("view-save").find("takes a name") != std::string::npos);
    CHECK(stage.bad("view-rename lesion").find("new name") != std::string::npos);
    CHECK(stage.bad("view lesion").find("view-go") != std::string::npos);
    for (std::size_t n = stage.marks().views.size(); n < kMostViews; ++n)
        stage.good("view-save \"number " + std::to_string(n) + "\"");
    CHECK(stage.bad("view-save more").find("saved views") != std::string::npos);
    stage.good("view-save lesion"); // replaces
}

TEST_CASE("a name that is free is proposed") {
    std::vector<SavedView> views;
    CHECK(free_view_name(views) == "View 1");
    save_view(views, "View 2", {});
    CHECK(free_view_name(views) == "View 3");
    save_view(views, "View 3", {});
    CHECK(free_view_name(views) == "View 4");
}

TEST_CASE("saved views are restored from a session file, which lacks the key where there are none") {
    Session session = session_on_tree();
    CHECK_FALSE(to_json(session, "/data").contains("views"));
    render::Camera inside{.position = {1.5, -2.25, 1e-7}, .view_angle = 90.0, .orthographic = true, .inside = true};
    session.marks.views = {{"</script>\" \xE2\x80\xAE ## %s", {}}, {"inside", inside}};
    const nlohmann::json json = to_json(session, "/data");
    CHECK(json["views"][1]["camera"]["position"] == nlohmann::json{1.5, -2.25, 1e-7});
    const auto read = session_from_json(nlohmann::json::parse(json.dump()), "/data", "s.json");
    REQUIRE(read);
    CHECK(read->session == session);
}

TEST_CASE("saved views of a session file that cannot be used are refused with the reason") {
    const nlohmann::json camera = render::to_json(render::Camera{});
    const nlohmann::json good{{"name", "a"}, {"camera", camera}};
    CHECK(refused_views(nlohmann::json{good}).empty());
    CHECK(refused_views(good).find("views is not a list") != std::string::npos);
    CHECK(refused_views({1}).find("a saved view is not an object") != std::string::npos);
    CHECK(refused_views({good, good}).find("two saved views have the name \"a\"") != std::string::npos);
    const auto one = [&](const char* key, const nlohmann::json& value) {
        nlohmann::json view = good;
        view[key] = value;
        return refused_views(nlohmann::json::array({view}));
    };
    CHECK(one("name", 3).find("name of a saved view is not a text") != std::string::npos);
    CHECK(one("name", "").find("needs a name") != std::string::npos);
    CHECK(one("name", "left").find("anatomical") != std::string::npos);
    CHECK(one("name", "a\nb").find("one line") != std::string::npos);
    CHECK(one("colour", 3).find("unknown name \"colour\" in a saved view") != std::string::npos);
    CHECK(one("camera", 3).find("saved view \"a\": camera: not an object") != std::string::npos);
    CHECK(one("camera", {{"view_angle", 0}}).find("view_angle") != std::string::npos);
    CHECK(refused_views(nlohmann::json::array({{{"name", "a"}}})).find("\"a\" has no camera") != std::string::npos);
    CHECK(refused_views(nlohmann::json::array({{{"camera", camera}}})).find("has no name") != std::string::npos);
    nlohmann::json many = nlohmann::json::array();
    for (std::size_t n = 0; n <= kMostViews; ++n) many.push_back({{"name", std::to_string(n)}, {"camera", camera}});
    CHECK(refused_views(many).find("saved views, where there can be 100") != std::string::npos);
}

TEST_CASE("saved views follow a tree that is read in another unit, and return on undo") {
    const auto read_in = [](const char* unit) {
        io::ReadOptions options;
        options.unit = io::length_unit(unit);
        auto tree =
            io::parse_tree("1 0 0 0 0 5 -1\n2 0 0 0 40 5 1\n3 0 30 0 60 3 2\n4 0 -30 0 60 3 2\n", "t.swc", options);
        REQUIRE(tree);
        return std::make_shared<const tree::VesselTree>(std::move(*tree));
    };
    Document document;
    document.open(read_in("mm"), {});
    Marks marks = document.marks();
    marks.views = {{"a", {.position = {0.0, 200.0, 30.0}, .focal_point = {0.0, 0.0, 30.0}, .scale = 50.0}}};
    document.change(marks);
    const render::Camera before = marks.views[0].camera;
    marks.reading.unit = io::length_unit("cm");
    document.change_tree(read_in("cm"), marks);
    const render::Camera& now = document.marks().views[0].camera;
    CHECK(now.position.y == doctest::Approx(2000.0));
    CHECK(now.focal_point.z == doctest::Approx(300.0));
    CHECK(now.scale == doctest::Approx(500.0));
    REQUIRE(document.undo());
    CHECK(document.marks().views[0].camera == before);
}

TEST_CASE("a report pictures the first saved views by name, and says how many it leaves out") {
    ViewStage stage;
    const TemporaryFolder folder;
    const auto report = [&] {
        stage.host.cameras.clear();
        stage.good("report \"" + (folder.path() / "r.html").string() + "\"");
        return folder.text("r.html");
    };
    CHECK(report().find("Saved views") == std::string::npos);
    for (int n = 1; n <= 8; ++n) stage.good("turn left 10\nview-save \"<b>" + std::to_string(n) + "\"");
    const std::string page = report();
    CHECK(page.find("alt=\"&lt;b&gt;1\"") < page.find("alt=\"&lt;b&gt;6\""));
    CHECK(page.find("alt=\"&lt;b&gt;6\"") != std::string::npos);
    CHECK(page.find("alt=\"&lt;b&gt;7\"") == std::string::npos);
    CHECK(page.find("And 2 more saved views") != std::string::npos);
    for (std::size_t n = 0; n < 6; ++n)
        CHECK(std::ranges::count(stage.host.cameras, stage.marks().views[n].camera) == 1);
}
