#include "app/session/document.h"
#include "app/session/session_file.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <nlohmann/json.hpp>

using namespace ramus;
using namespace ramus::app;
using tree::BranchState;
namespace fs = std::filesystem;

namespace {

Session lively_session(const fs::path& folder) {
    Session session;
    session.tree = {folder / "trees" / "liver tree.swc", "0123456789abcdef"};
    session.marks.selection = {2, 5};
    set_state(session.marks, std::vector<int>{1, 4}, BranchState::kHighlighted);
    set_state(session.marks, std::vector<int>{3}, BranchState::kHidden);
    set_state(session.marks, std::vector<int>{7}, BranchState::kDefocused);
    session.marks.lesions = {{.sphere = {1.5, -2.25, 3.0, 10.0}}};
    session.marks.cuts = {{4, 0.25}};
    session.marks.names = {{5, "right \"posterior\" branch"}, {6, "left"}};
    session.marks.subtree_names = {6};
    add_lesion(session.marks, {.file = (folder / "tumour.stl").string()});
    add_lesion(session.marks, {.file = "/elsewhere/second tumour.ply", .axes = "LPS", .name = "second"});
    session.marks.lesions.front().visible = false;
    session.marks.context = {
        {(folder / "scans" / "liver.nii.gz").string(), 2, {1, 20, 255}, 1.0 / 3.0, false, true, true, "cm"},
        {"/elsewhere/rib cage.stl", 0, {200, 190, 180}, 1.0, true, false, false, ""}};
    number_objects(session.marks);
    const int sphere = session.marks.lesions[0].id, mesh = session.marks.lesions[2].id;
    session.marks.measurements = {
        {.kind = Measurement::Kind::kDistance, .points = {{{0.1, -1.0 / 3.0, 3.0}, {4.0, 5.0, 6e-7}}}},
        {.kind = Measurement::Kind::kDistance,
         .points = {{{0.1, -1.0 / 3.0, 3.0}, {4.0, 5.0, 6e-7}}},
         .lesions = {kNoObject, mesh}},
        {.kind = Measurement::Kind::kDistance,
         .lesions = {sphere, kNoObject},
         .shortest = true,
         .places = {{{6, 0.5}}}},
        {.kind = Measurement::Kind::kPath, .places = {{{2, 0.1}, {7, 1.0 / 7.0}}}},
        {.kind = Measurement::Kind::kDiameter, .places = {{{3, 1.0 / 3.0}}}},
        {.kind = Measurement::Kind::kAngle, .places = {{{1, 0.5}}}},
        {.kind = Measurement::Kind::kAngle, .places = {{{1, 0.25}, {2, 0.0}, {3, 1.0}}}}};
    session.marks.measurements.back().name = "the angle";
    number_objects(session.marks);
    session.marks.planning = {{2.5, 7.0, 11.0 / 3.0 + 10.0}, 4.0, 1.0 / 7.0};
    session.marks.shortest_distances = true;
    session.marks.glass = {1.75, 0.25};
    session.marks.colour_by = Quantity::kStrahler;
    session.marks.options.detail = 24;
    session.marks.options.prune_ratio = 0.1;
    session.camera.position = {0.1, 1.0 / 3.0, -7e-5};
    session.camera.orthographic = true;
    return session;
}

} // namespace

TEST_CASE("a session survives its file to the last bit") {
    const TemporaryFolder folder;
    const Session session = lively_session(folder.path());
    const fs::path file = folder.path() / "plan.ramus.json";
    REQUIRE(write_session(session, file));
    const auto read = read_session(file);
    REQUIRE_MESSAGE(read, read.error().message());
    CHECK(read->has_camera);
    CHECK(read->session == session);
}

TEST_CASE("a session finds its tree after both are moved together") {
    const Session session = lively_session("/data");
    CHECK(to_json(session, "/data")["tree"]["path"] == "trees/liver tree.swc");
    CHECK(to_json(session, "/elsewhere")["tree"]["path"] == "/data/trees/liver tree.swc");
    const auto moved = session_from_json(to_json(session, "/data"), "/moved", "s");
    REQUIRE(moved);
    CHECK(moved->session.tree.path == "/moved/trees/liver tree.swc");
}

TEST_CASE("a file that is not a session is refused with its name and the reason") {
    const auto message = [](const char* text) {
        const auto session = session_from_json(nlohmann::json::parse(text), "/data", "s.json");
        REQUIRE_FALSE(session);
        CHECK(session.error().where == "s.json");
        return session.error().what;
    };
    CHECK(message("[]") == "the session is not an object");
    CHECK(message("{}") == "no version: this is not a session file");
    CHECK(message(R"({"version": 2})") == "version 2 is not known to this ramus");
    CHECK(message(R"({"version": 1})") == "no tree");
    CHECK(message(R"({"version": 1, "tree": {"path": 3}})") == "path of the tree is not a text");
    CHECK(message(R"({"version": 1, "tree": {"path": "a"}, "selection": [-1]})") ==
          "branch id in selection -1 is out of range");
    CHECK(message(R"({"version": 1, "tree": {"path": "a"}, "states": {"hidden": [1], "highlighted": [1]}})") ==
          "branch 1 has two states");
    CHECK(message(R"({"version": 1, "tree": {"path": "a"}, "options": {"smoothing": 1}})") ==
          "unknown name \"smoothing\" in options");
    CHECK(message(R"({"version": 1, "tree": {"path": "a"}, "cuts": [[1]]})") == "a cut is not [branch id, fraction]");
    CHECK(message(R"({"version": 1, "tree": {"path": "a"}, "names": {"one": "x"}})") ==
          "\"one\" in names is not a branch id");
}

TEST_CASE("invalid cuts, lesions and measurements are refused") {
    const auto message = [](const std::string& members) {
        const auto session = session_from_json(
            nlohmann::json::parse(R"({"version": 1, "tree": {"path": "a"}, )" + members + "}"), "/data", "s.json");
        REQUIRE_FALSE(session);
        return session.error().what;
    };
    CHECK(message(R"("lesions": {"a": [1, 2, 3, 4]})") == "lesions is not a list");
    CHECK(message(R"("lesions": [[1, 2, 3]])") == "a lesion is not [x, y, z, radius]");
    CHECK(message(R"("lesions": [[1, 2, 3, -4]])") == "lesion -4 is out of range");
    CHECK(message(R"("lesions": [[1, 2, "3", 4]])") == "lesion is not a number");
    CHECK(message(R"("lesion_meshes": "a.stl")") == "lesion_meshes is not a list");
    CHECK(message(R"("lesion_meshes": [7])") == "path of a lesion is not a text");
    CHECK(message(R"("lesion_meshes": [{"path": "a.nii", "part": 0}])") == "part 0 is out of range");
    CHECK(message(R"("lesion_meshes": [{"path": "a.nii", "labels": [2]}])") ==
          "labels and units are of a lesion that is a part of a mask");
    CHECK(message(R"("lesion_meshes": [{"path": "a.nii", "part": 1, "axes": "LPS"}])") ==
          "a mask states its axes itself");
    CHECK(message(R"("context": {})") == "context is not a list");
    CHECK(message(R"("context": [{"opacity": 1}])") == "a context mesh has no path");
    CHECK(message(R"("context": [{"path": "a.stl", "opacity": 2}])") == "opacity 2 is out of range");
    CHECK(message(R"("context": [{"path": "a.stl", "colour": "red"}])") == "\"red\" is not a colour: #RRGGBB");
    CHECK(message(R"("context": [{"path": "a.stl", "visible": 1}])") == "visible is not true or false");
    CHECK(message(R"("context": [{"path": "a.stl", "color": "#ffffff"}])") == "unknown name \"color\" in context");
    CHECK(message(R"("cuts": [[3, 1.5]])") == "cut 1.5 is out of range");
    CHECK(message(R"("measurements": {})") == "measurements is not a list");
    CHECK(message(R"("measurements": [5])") == "measurement is not an object");
    CHECK(message(R"("measurements": [{"kind": "volume"}])") == "unknown measurement \"volume\"");
    CHECK(message(R"("measurements": [{"kind": 3}])") == "kind of a measurement is not a text");
    CHECK(message(R"("measurements": [{"kind": "path", "branches": [1]}])") ==
          "a measurement of kind path has 0 points and 2 branches");
    CHECK(message(R"("measurements": [{"kind": "distance", "points": [[1, 2, 3], [4, 5]]}])") ==
          "a point is not [x, y, z]");
    CHECK(message(R"("measurements": [{"kind": "angle", "branches": [-2]}])") ==
          "branch id of a measurement -2 is out of range");
    CHECK(message(R"("measurements": [{"kind": "diameter", "branches": [1], "fraction": 2}])") ==
          "fraction 2 is out of range");
    CHECK(message(R"("options": {"bands": 5})") == "bands is not a list");
    CHECK(message(R"("options": {"bands": [10, 5]})") == "bands do not ascend");
    CHECK(message(R"("options": {"bands": [0, 5]})") == "band 0 is out of range");
    CHECK(message(R"("options": {"reconstruct": "much"})") == "reconstruct is not a number");
    CHECK(message(R"("options": {"glass_opacity": 3})") == "glass_opacity 3 is out of range");
    CHECK(message(R"("options": {"glass_grey": -0.1})") == "glass_grey -0.1 is out of range");
}

TEST_CASE("reading a session reports what is wrong with the file") {
    CHECK(read_session("/nowhere/s.json").error().what == "no such file");
    CHECK(read_session(fs::temp_directory_path()).error().what == "this is a directory, not a file");
    const TemporaryFolder folder;
    CHECK(read_session(folder.write("junk.json", "\x7f"
                                                 "ELF"))
              .error()
              .what == "this is not valid JSON");
}

TEST_CASE("a session that cannot be written leaves nothing behind") {
    CHECK_FALSE(write_session(lively_session("/data"), "/nowhere/s.json"));
    const TemporaryFolder folder;
    fs::create_directories(folder.path() / "s.json");
    CHECK_FALSE(write_session(lively_session(folder.path()), folder.path() / "s.json"));
    CHECK(folder.names() == std::vector<std::string>{"s.json"});
}

TEST_CASE("a session of another tree is refused") {
    tree::VesselTree small;
    small.branches.resize(3);
    Session session;
    session.tree = {"/data/a.swc", "abc"};
    CHECK(check_against(session, small, "abc", "s.json"));
    CHECK_FALSE(check_against(session, small, "def", "s.json"));
    session.marks.selection = {3};
    CHECK(check_against(session, small, "abc", "s.json").error().what == "there is no branch 3 in a tree of 3");
}

TEST_CASE("the states exclude each other and equal sessions compare equal") {
    Marks marks;
    set_state(marks, std::vector<int>{4, 2}, BranchState::kHighlighted);
    set_state(marks, std::vector<int>{4}, BranchState::kHidden);
    CHECK(state_of(marks, 4) == BranchState::kHidden);
    CHECK(state_of(marks, 2) == BranchState::kHighlighted);
    CHECK(state_of(marks, 400) == BranchState::kNormal);
    CHECK(branches_in_state(marks, BranchState::kHidden) == std::vector<int>{4});
    set_state(marks, std::vector<int>{2, 4}, BranchState::kNormal);
    CHECK(marks == Marks{});
    CHECK(canonical({3, 1, 3, 2}) == std::vector<int>{1, 2, 3});
}

TEST_CASE("undo brings back every earlier value, and redo every later one") {
    Document document;
    document.open(nullptr, {});
    std::vector<Marks> values{document.marks()};
    for (int i = 0; i < 5; ++i) {
        Marks next = document.marks();
        next.selection = {i};
        document.change(next);
        values.push_back(next);
    }
    document.change(document.marks());
    for (int i = 4; i >= 0; --i) {
        REQUIRE(document.undo());
        CHECK(document.marks() == values[static_cast<std::size_t>(i)]);
    }
    CHECK_FALSE(document.undo());
    for (std::size_t i = 1; i <= 5; ++i) {
        REQUIRE(document.redo());
        CHECK(document.marks() == values[i]);
    }
    CHECK_FALSE(document.redo());

    REQUIRE(document.undo());
    Marks other = document.marks();
    other.lesions.push_back({.sphere = {0.0, 0.0, 0.0, 1.0}}); // work, not a look alone
    document.change(other);
    CHECK_FALSE(document.can_redo());
}

TEST_CASE("the camera is no step of undo") {
    Document document;
    document.open(nullptr, {});
    Marks next;
    next.selection = {1};
    document.change(next);
    render::Camera camera;
    camera.view_angle = 12.0;
    document.set_camera(camera);
    REQUIRE(document.undo());
    CHECK(document.session().camera == camera);
    CHECK_FALSE(document.can_undo());
}

TEST_CASE("saving a session whose names are not text fails, and keeps the existing file") {
    const TemporaryFolder folder;
    Session session;
    session.tree.path = folder.path() / "tree.swc";
    const auto file = folder.path() / "s.ramus.json";
    REQUIRE(write_session(session, file));
    session.tree.path = folder.path() / "M\xFCller.swc"; // Latin-1
    const auto written = write_session(session, file);
    REQUIRE_FALSE(written);
    CHECK(written.error().what.find("UTF-8") != std::string::npos);
    CHECK(read_session(file)->session.tree.path == folder.path() / "tree.swc");
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
}

TEST_CASE("depth cues are part of a session") {
    const TemporaryFolder folder;
    Session session;
    session.tree.path = folder.path() / "tree.swc";
    session.marks.depth_cues.set(*depth_cue_named("halos"), true);
    session.marks.depth_cues.set(*depth_cue_named("fog"), false);
    REQUIRE(write_session(session, folder.path() / "s.ramus.json"));
    const auto read = read_session(folder.path() / "s.ramus.json");
    REQUIRE(read);
    CHECK(read->session.marks.depth_cues == session.marks.depth_cues);
    CHECK(session.marks.depth_cues.has(*depth_cue_named("occlusion")));
    CHECK(session.marks.depth_cues != Marks{}.depth_cues);
}
