#include "app/actions/command_runner.h"
#include "app/actions/export_kinds.h"
#include "core/base/memory.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/trees/tree_file.h"
#include "tests/support/built_tree.h"
#include "tests/support/command_stage.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <thread>
#include <utility>

using namespace ramus;
using namespace ramus::app;

namespace {

// A stem with two children, the right one with two of its own: branches 0 to 4. Mm apart, so that nothing blends.
tree::VesselTree export_forks() {
    return test::built_tree({{{0, 0, 0}, 1.0},
                             {{0, 0, 20}, 1.0},
                             {{-20, 0, 40}, 0.3},
                             {{20, 0, 40}, 1.0},
                             {{10, 0, 60}, 0.8},
                             {{40, 0, 60}, 0.8}},
                            {{0, 1}, {1, 2}, {1, 3}, {3, 4}, {3, 5}});
}

struct ExportStage : test::CommandStage {
    TemporaryFolder folder;
    explicit ExportStage(tree::VesselTree tree = export_forks()) : test::CommandStage(std::move(tree)) {}
    [[nodiscard]] std::string at(const std::string& name) const { return (folder.path() / name).string(); }
    std::string exported(const std::string& words, const std::string& name, const std::string& more = "") {
        return good("export " + words + " \"" + at(name) + "\" " + more);
    }
};

std::set<int> exported_sides(const std::filesystem::path& file) {
    const auto mesh = io::read_mesh(file);
    REQUIRE(mesh);
    std::set<int> sides; // where there is surface, by the corner of the tree that is there alone
    for (const glm::vec3& p : mesh->positions) {
        if (p.z < 15.0F) sides.insert(0);
        if (p.x < -5.0F) sides.insert(1);
        if (p.x > 5.0F && p.z < 38.0F) sides.insert(2);
        if (p.z > 50.0F && p.x < 18.0F) sides.insert(3);
        if (p.z > 50.0F && p.x > 25.0F) sides.insert(4);
    }
    return sides;
}

} // namespace

TEST_CASE("the surface of visible, selected or all branches can be exported") {
    ExportStage stage;
    CHECK(stage.exported("surface", "all.ply", "--of all") == "Surface saved: " + stage.at("all.ply"));
    CHECK(exported_sides(stage.at("all.ply")) == std::set{0, 1, 2, 3, 4});
    stage.good("select 3\nhide\nselect 1 4");
    stage.exported("surface", "visible.ply");
    CHECK(exported_sides(stage.at("visible.ply")) == std::set{0, 1, 2, 4});
    stage.exported("surface", "selected.ply", "--of selected");
    CHECK(exported_sides(stage.at("selected.ply")) == std::set{1, 4});
    stage.exported("surface", "all again.ply", "--of all");
    CHECK(stage.folder.text("all again.ply") == stage.folder.text("all.ply"));
    CHECK(stage.document.position() == stage.document.step_count()); // nothing of this is a step
    CHECK(stage.last_step().starts_with("select"));
}

TEST_CASE("trees and tables are exported with the same branches as surfaces") {
    ExportStage stage;
    stage.exported("tree", "all.json");
    const auto all = io::read_tree(stage.at("all.json"));
    REQUIRE(all);
    CHECK(all->points == export_forks().points);
    stage.good("select 1 3\nhide\nselect 4");
    CHECK(stage.exported("tree", "visible.swc") == "Tree saved: " + stage.at("visible.swc"));
    const auto visible = io::read_tree(stage.at("visible.swc"));
    REQUIRE(visible);
    CHECK(visible->points.size() == 4);
    CHECK(visible->branches.size() == 1); // no fork is left
    stage.exported("tree", "selected.vtp", "--of selected");
    CHECK(io::read_tree(stage.at("selected.vtp"))->segment_count() == 1);
    CHECK(stage.exported("table", "visible.csv") == "Table saved: " + stage.at("visible.csv"));
    const std::string csv = stage.folder.text("visible.csv");
    CHECK(std::ranges::count(csv, '\n') == 1 + 3);
    CHECK(csv.starts_with("branch,name,"));
    stage.exported("table", "all.csv", "--of all");
    CHECK(std::ranges::count(stage.folder.text("all.csv"), '\n') == 1 + 5);
}

TEST_CASE("an exported picture does not depend on the selected branches") {
    ExportStage stage;
    stage.exported("picture", "seen.png");
    REQUIRE(stage.host.figures.size() == 1);
    CHECK(stage.host.figures[0].file == stage.folder.path() / "seen.png");
    CHECK(stage.host.figures[0].size == stage.host.size);
    CHECK(stage.exported("sheet", "four.png", "--size 800x600 --caption \"a b\"") ==
          "Sheet saved: " + stage.at("four.png"));
    CHECK(stage.host.figures[1].size == glm::ivec2(800, 600));
    CHECK((stage.host.figures[1].options.sheet && stage.host.figures[1].options.caption == "a b"));
    stage.exported("turntable", "t.png", "--pictures 12");
    CHECK(stage.host.figures[2].options.turntable == 12);
    stage.exported("report", "r.html");
    CHECK(stage.folder.text("r.html").find("<html") != std::string::npos);
    CHECK(stage.exported("page", "p.html", "--title Board --without names").find("Page saved: ") == 0);
    CHECK(stage.folder.text("p.html").find("<title>Board</title>") != std::string::npos);
    stage.good("select-invert\nhide");
    stage.exported("picture", "empty.png");
}

TEST_CASE("the surface of a tree of unknown unit and orientation does not claim any") {
    tree::VesselTree tree = export_forks();
    tree.claims = {tree::SaidBy::kNobody, tree::SaidBy::kNobody};
    ExportStage stage(std::move(tree));
    for (const std::string name : {"s.stl", "s.ply", "s.obj"}) {
        CAPTURE(name);
        stage.exported("surface", name);
        const std::string header = stage.folder.text(name).substr(0, 400);
        CHECK(header.find("unit unknown, orientation unknown") != std::string::npos);
        CHECK(header.find("RAS") == std::string::npos);
    }
}

TEST_CASE("a surface that is computed on the disk is exported like any other" * doctest::test_suite("slow")) {
    ExportStage stage;
    Marks marks = stage.marks();
    // Some two million triangles: 80 bytes each are more than that.
    marks.options.detail = 230;
    stage.document.change(marks);
    const std::string said = stage.exported("surface", "whole.ply");
    marks.options.memory_bytes = static_cast<std::uint64_t>(process_memory() + 140e6);
    stage.document.change(marks);
    CHECK(stage.exported("surface", "streamed.ply") == said.substr(0, said.find("whole")) + "streamed.ply");
    CHECK(stage.folder.text("streamed.ply") == stage.folder.text("whole.ply"));
}

TEST_CASE("an export for printing reports thin places") {
    ExportStage stage;
    // Branch 1 narrows to a radius of 0.3 mm at its end.
    const std::string thin = stage.exported("surface", "p.stl", "--for-printing");
    CHECK(thin.find("; 1 branch is thinner than 0.800 mm, the thinnest with 0.6") != std::string::npos);
    CHECK(thin.find("(branch 1 at (") != std::string::npos);
    stage.good("select 1\nhide");
    const std::string thick = stage.exported("surface", "p.stl", "--for-printing");
    CHECK(thick.find("; closed, in mm; thinnest place 1.5") != std::string::npos);
    CHECK(stage.bad("export surface \"" + stage.at("p.glb") + "\" --for-printing").find("metres") != std::string::npos);
}

TEST_CASE("an export that is not possible reports the reason, and writes nothing") {
    ExportStage stage;
    const auto refused = [&](const std::string& words) { return stage.bad("export " + words); };
    CHECK(refused("sculpture x.stl").find("there is no export of \"sculpture\"") != std::string::npos);
    CHECK(refused("surface").find("needs a file here") != std::string::npos);
    CHECK(refused("surface --of all").find("takes a file") != std::string::npos);
    CHECK(refused("picture a.png --pictures 12").find("only a turntable") != std::string::npos);
    CHECK(refused("picture a.png --size 10").find("not a size") != std::string::npos);
    CHECK(refused("table a.csv --rows leaves").find("--rows takes branches") != std::string::npos);
    CHECK(refused("table \"" + stage.at("a.csv") + "\" --rows cuts").find("nothing to report of cuts") !=
          std::string::npos);
    CHECK(refused("tree a.swc --rows cuts").find("only a table") != std::string::npos);
    CHECK(refused("report a.csv").find("of type .html") != std::string::npos);
    CHECK(refused("surface a.stl b.stl").find("one file") != std::string::npos);
    CHECK(refused("surface a.stl --off all").find("export surface|tree") != std::string::npos);
    CHECK(refused("surface a.stl --of some").find("visible, selected or all") != std::string::npos);
    CHECK(refused("surface a.stl --of").find("visible, selected or all") != std::string::npos);
    CHECK(refused("surface a.glb --parts leaf").find("branch, system or none") != std::string::npos);
    CHECK(refused("surface a.stl --parts branch").find("no parts") != std::string::npos);
    CHECK(refused("surface a.glb --parts system").find("no systems") != std::string::npos);
    CHECK(refused("tree a.swc --for-printing").find("only a surface") != std::string::npos);
    CHECK(refused("surface a.swc").find("cannot be written") != std::string::npos);
    CHECK(refused("tree a.stl").find("no tree format has the extension") != std::string::npos);
    CHECK(refused("table a.txt").find("of type .csv") != std::string::npos);
    CHECK(refused("picture a.jpg").find("of type .png") != std::string::npos);
    CHECK(refused("surface a.stl --of selected").find("nothing is selected") != std::string::npos);
    CHECK(refused("surface \"" + stage.at("missing/a.stl") + "\"").find("missing") != std::string::npos);
    CHECK(refused("").find("export needs a file here") != std::string::npos);
    stage.good("select-invert\nhide");
    CHECK(refused("tree a.swc").find("every branch is hidden") != std::string::npos);
    CHECK(stage.folder.names().empty());
}

TEST_CASE("the window writes its picture in the background, as it was when the command was given") {
    struct PictureElsewhere final : test::TestPicture {
        std::optional<app::Deferred<Result<render::Image>>> deferred_picture() override {
            return app::known_now<Result<render::Image>>(render::Image(30, 20));
        }
    } host;
    ExportStage stage;
    ActionContext context{
        .document = stage.document, .picture = host, .assets = stage.assets, .tell = stage.context.tell};
    CommandRunner runner({});
    const auto settle = [&] {
        std::vector<Error> failed;
        for (int i = 0; i < 5000 && runner.busy(); ++i) {
            for (const Error& error : runner.update(context)) failed.push_back(error);
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        return failed;
    };
    REQUIRE(runner.run(context, std::vector<std::string>{"shot", stage.at("now.png")}));
    CHECK(runner.activity() == "Drawing now.png");
    CHECK(settle().empty());
    CHECK(host.pictures.empty()); // by nobody who waits
    CHECK(stage.said == "Picture saved: " + stage.at("now.png"));
    CHECK(std::filesystem::file_size(stage.at("now.png")) > 0);
    REQUIRE(runner.run(context, std::vector<std::string>{"shot", stage.at("missing/now.png")}));
    CHECK(settle().size() == 1);
}

TEST_CASE("the window exports in the background, and the export can be cancelled") {
    ExportStage stage;
    CommandRunner runner({});
    const std::vector<std::string> words = {"export", "surface", stage.at("later.glb"), "--parts", "branch"};
    REQUIRE(runner.run(stage.context, words));
    CHECK(runner.busy());
    CHECK(runner.activity() == "Exporting later.glb");
    for (int i = 0; i < 5000 && runner.busy(); ++i) {
        CHECK(runner.update(stage.context).empty());
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    CHECK_FALSE(runner.busy());
    CHECK(stage.said == "Surface saved: " + stage.at("later.glb"));
    CHECK(std::filesystem::exists(stage.at("later.glb")));
    stage.said.clear();
    REQUIRE(runner.run(stage.context, std::vector<std::string>{"export", "surface", stage.at("never.stl")}));
    runner.cancel();
    CHECK(runner.update(stage.context).empty());
    CHECK(stage.said.empty());
}

TEST_CASE("the kinds of export offer all formats that can be written") {
    const auto extensions_of = [](ExportWhat what) {
        std::vector<std::string_view> extensions;
        for (const ExportFormat& format : export_kinds()[static_cast<std::size_t>(what)].formats)
            extensions.emplace_back(format.extension);
        return extensions;
    };
    for (std::size_t i = 0; i < export_kinds().size(); ++i) {
        const ExportKind& kind = export_kinds()[i];
        CHECK(static_cast<std::size_t>(kind.what) == i);
        CHECK(export_kind_named(kind.key) == kind.what);
        REQUIRE_FALSE(kind.formats.empty());
    }
    for (std::size_t i = 0; i < kExportScopes.size(); ++i) CHECK(static_cast<std::size_t>(kExportScopes[i].of) == i);
    for (const auto& format : io::mesh_formats())
        CHECK((is_written(format) && !format.in_files) ==
              (std::ranges::count(extensions_of(ExportWhat::kSurface), format.extensions.front()) == 1));
    for (const auto& format : io::tree_formats())
        CHECK(is_written(format) ==
              (std::ranges::count(extensions_of(ExportWhat::kTree), format.extensions.front()) == 1));
}
