#include "app/assets/shapes.h"
#include "app/session/session_file.h"
#include "app/storage/opening_files.h"
#include "app/workspace/workspace.h"
#include "core/base/worker.h"
#include "core/io/meshes/mesh_file.h"
#include "tests/support/icosphere.h"
#include "tests/support/settle.h"
#include "tests/support/temporary_folder.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <doctest/doctest.h>
#include <filesystem>
#include <stdexcept>
#include <thread>
#include <unistd.h>

using namespace ramus;
using namespace ramus::app;
using ramus::test::settle;
namespace fs = std::filesystem;

namespace {

constexpr const char* kFork = "1 3 0 0 0 2 -1\n2 3 0 0 20 2 1\n3 3 10 0 30 1 2\n4 3 -10 0 30 1.5 2\n";

} // namespace

TEST_CASE("drain() delivers the results of a worker in order, and only those of the newest task") {
    std::atomic<int> wakes{0};
    Worker worker([&] { ++wakes; });
    std::vector<int> seen;
    worker.start("first", [&](Job& job, const Worker::Post& post) {
        post([&] { seen.push_back(1); });
        while (!job.cancelled()) std::this_thread::yield();
        post([&] { seen.push_back(2); }); // too late
    });
    while (wakes == 0) std::this_thread::yield();
    CHECK(seen.empty());
    worker.drain();
    CHECK(seen == std::vector<int>{1});
    CHECK(worker.busy());
    worker.start("second", [&](Job& job, const Worker::Post& post) {
        job.report(0.5F);
        post([&] { seen.push_back(3); });
        post([&] { seen.push_back(4); });
    });
    CHECK(worker.title() == "second");
    while (worker.busy()) worker.drain();
    CHECK(seen == std::vector<int>{1, 3, 4});
}

TEST_CASE("a tree is shown as cones first, then with its surface; undo restores the earlier surface") {
    const TemporaryFolder folder;
    Workspace workspace({});
    workspace.open(folder.write("fork.swc", kFork));
    REQUIRE(settle(workspace, [&] { return workspace.document().tree() != nullptr; }));
    // Its cones, unless something better was as quick.
    REQUIRE(workspace.shown().mesh);
    CHECK(workspace.shown().mesh->triangle_count() > 100);
    REQUIRE(workspace.take_opened());
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    const auto first = workspace.shown().mesh;
    CHECK(first->triangle_count() > 100);

    Marks finer = workspace.document().marks();
    finer.options.detail = 24;
    workspace.document().change(finer);
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    CHECK(workspace.shown().mesh->triangle_count() > first->triangle_count());
    REQUIRE(workspace.document().undo());
    workspace.update();
    CHECK(workspace.shown().mesh == first);
}

TEST_CASE("hidden branches are removed from the surface, and undo restores them") {
    const TemporaryFolder folder;
    Workspace workspace({});
    workspace.open(folder.write("fork.swc", kFork));
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    const auto all = workspace.shown().mesh;
    const auto seen = [&](int branch) {
        return !workspace.shown().mesh->positions([&](int b) { return b == branch; }).empty();
    };
    CHECK(seen(2));
    Marks without = workspace.document().marks();
    const std::vector<int> leaf{2};
    set_state(without, leaf, tree::BranchState::kHidden);
    workspace.document().change(without);
    workspace.update();
    CHECK(workspace.shown().mesh); // the old one until the other is there
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    CHECK_FALSE(seen(2));
    CHECK(seen(1));
    Marks none = without;
    set_state(none, std::vector<int>{0, 1, 2}, tree::BranchState::kHidden);
    workspace.document().change(none);
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    CHECK(workspace.shown().mesh->triangle_count() == 0);
    CHECK(workspace.surface_problem().empty());
    REQUIRE(workspace.document().undo());
    REQUIRE(workspace.document().undo());
    workspace.update();
    CHECK(workspace.surface_ready());
    CHECK(workspace.shown().mesh == all);
}

TEST_CASE("previewed options change the picture and not the session") {
    const TemporaryFolder folder;
    Workspace workspace({});
    workspace.open(folder.write("fork.swc", kFork));
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    mesh::SurfaceOptions wide = workspace.document().marks().options;
    wide.width = 2.0;
    workspace.try_options(wide);
    REQUIRE(settle(workspace, [&] { return workspace.shown().request.options.width == 2.0 && !workspace.busy(); }));
    CHECK_FALSE(workspace.surface_ready());
    CHECK_FALSE(workspace.document().modified());
    workspace.try_options({});
    workspace.update();
    CHECK(workspace.surface_ready());
}

TEST_CASE("a file that cannot be read leaves the old tree as it was") {
    const TemporaryFolder folder;
    Workspace workspace({});
    workspace.open(folder.write("fork.swc", kFork));
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    const auto tree = workspace.document().tree();
    const auto mesh = workspace.shown().mesh;
    workspace.open(folder.write("bad.swc", "1 3 0 0 0 nan -1\n"));
    std::optional<Error> error;
    REQUIRE(settle(workspace, [&] { return (error = workspace.take_error()).has_value(); }));
    CHECK(error->message().find("bad.swc") != std::string::npos);
    CHECK(workspace.document().tree() == tree);
    CHECK(workspace.shown().mesh == mesh);
}

TEST_CASE("a session opens with its tree; one of another tree is refused") {
    const TemporaryFolder folder;
    const fs::path tree = folder.write("fork.swc", kFork);
    Session session;
    session.tree = {tree, checksum_of(tree).value()};
    session.marks.selection = {1};
    REQUIRE(write_session(session, folder.path() / "s.json"));
    CHECK(is_session_file(folder.path() / "s.json"));
    CHECK_FALSE(is_session_file(tree));
    CHECK_FALSE(is_session_file(folder.write("other.json", R"({"points": []})")));
    CHECK_FALSE(is_session_file(folder.write("junk.json", "{")));
    Job job;
    const auto loaded = load(folder.path() / "s.json", {}, {}, job);
    REQUIRE(loaded);
    CHECK(loaded->session == session);
    CHECK(loaded->has_camera);

    folder.write("fork.swc", std::string(kFork) + "5 3 0 0 60 1 3\n");
    CHECK_FALSE(load(folder.path() / "s.json", {}, {}, job));
}

TEST_CASE("the facts of a fork agree with its geometry") {
    const TemporaryFolder folder;
    Job job;
    const auto loaded = load(folder.write("fork.swc", kFork), {}, {}, job);
    REQUIRE(loaded);
    const TreeFacts& facts = *loaded->assets.facts;
    REQUIRE(facts.branches.size() == 3);
    CHECK(facts.branches[0].dependents.branches == 2);
    CHECK(facts.branches[0].length_mm == doctest::Approx(20.0));
    CHECK(facts.branches[0].diameter_mm.mean == doctest::Approx(4.0));
    CHECK(facts.statistics.leaves == 2);
    CHECK(facts.statistics.generations == 2);
    CHECK(facts.statistics.length_mm == doctest::Approx(20.0 + 2.0 * std::sqrt(200.0)));
    CHECK(path_to(*loaded->assets.tree, 2) == std::vector<int>{0, 2});
}

TEST_CASE("distances to mesh lesions are measured in the background" * doctest::test_suite("slow")) {
    const TemporaryFolder folder;
    auto ball = test::icosphere(4, {0, 9, 5}, 3.0);
    ball.radii.resize(ball.positions.size(), 1.0F);
    ball.branches.resize(ball.positions.size(), 0);
    const fs::path file = folder.path() / "tumour.stl";
    REQUIRE(io::write_mesh(ball, file));
    Workspace workspace({});
    workspace.open(folder.write("fork.swc", kFork));
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    Job job;
    REQUIRE(load_lesion(workspace.assets(), {file.string()}, job));

    Document& document = workspace.document();
    Marks marks = document.marks();
    add_lesion(marks, {.file = file.string()});
    marks.cuts = {{0, 0.5}};
    document.change(marks);
    // Who must not wait sees the mesh and the cut at once, but no distances yet.
    const auto current_plan = [&] { return workspace.current_assets().plan; };
    const auto awaited = [&] { return lesions_awaited(workspace.assets(), document.marks(), GridIs::kMadeAhead); };
    REQUIRE(awaited());
    auto plan = current_plan();
    CHECK(plan->measuring);
    CHECK(plan->meshes.size() == 1);
    CHECK(plan->cuts.cuts.size() == 1);
    CHECK(plan->bands.empty());
    CHECK(current_plan() == plan);
    REQUIRE(settle(workspace, [&] { return !awaited(); }));
    plan = current_plan();
    CHECK_FALSE(plan->measuring);
    REQUIRE(plan->lesion_distances_mm.size() == 3);
    CHECK(plan->lesion_distances_mm[0] == doctest::Approx(4.0).epsilon(0.01)); // 9 - 3 - 2
    // What pictures colour by is there before they do.
    CHECK(workspace.assets().lesion_grid.fits(plan->lesions, widest_margin_mm(marks.planning)));
    // A cut more takes the distances over, other margins too; another lesion needs them anew.
    marks.cuts.push_back({1, 0.5});
    document.change(marks);
    CHECK_FALSE(awaited());
    CHECK(current_plan()->cuts.cuts.size() == 2);
    CHECK(current_plan()->lesion_distances_mm == plan->lesion_distances_mm);
    marks.planning.bands_mm = {7.0};
    document.change(marks);
    CHECK_FALSE(current_plan()->measuring);
    CHECK(current_plan()->bands.size() == 1);
    REQUIRE(awaited());
    REQUIRE(settle(workspace, [&] { return !awaited(); }));
    CHECK(workspace.assets().lesion_grid.reach_mm == 7.0);
    add_lesion(marks, {.sphere = {0, -9, 5, 3}});
    document.change(marks);
    CHECK(awaited());
    CHECK(current_plan()->lesion_distances_mm.size() == 3); // of the sphere alone
    // Who asks for all of it waits.
    complete_lesions(workspace.assets(), document);
    CHECK(current_plan()->lesion_distances_mm[0] == doctest::Approx(4.0).epsilon(0.01));
    CHECK_FALSE(awaited());
}

TEST_CASE("a lesion file that has changed is read again, and distances are updated" * doctest::test_suite("slow")) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "tumour.stl";
    const auto write_ball = [&](double radius, int level) {
        auto ball = test::icosphere(level, {0, 9, 5}, radius);
        ball.radii.resize(ball.positions.size(), 1.0F);
        ball.branches.resize(ball.positions.size(), 0);
        // As another program does it: this one writes over nothing that it has read.
        const fs::path other = folder.path() / "written.stl";
        REQUIRE(io::write_mesh(ball, other));
        fs::rename(other, file);
    };
    write_ball(3.0, 4);
    Document document;
    document.open(std::make_shared<const tree::VesselTree>(io::read_tree(folder.write("fork.swc", kFork)).value()), {});
    Marks marks = document.marks();
    add_lesion(marks, {.file = file.string()});
    document.change(marks);
    Assets assets;
    refresh(assets, document);
    CHECK(assets.plan->measuring);
    complete_lesions(assets, document);
    CHECK_FALSE(assets.plan->measuring);
    const auto first = assets.lesion_mesh(marks.lesions[0]);
    const double distance = assets.plan->lesion_distances_mm[0];
    // A copy is a value: what it learns, the original learns by merging.
    Assets copy = assets;
    write_ball(4.0, 3);
    complete_lesions(copy, marks, GridIs::kMadeAhead);
    CHECK(copy.lesion_mesh(marks.lesions[0]) != first);
    CHECK(assets.lesion_mesh(marks.lesions[0]) == first);
    merge(assets, copy);
    refresh(assets, document);
    CHECK_FALSE(assets.plan->measuring);
    CHECK(assets.plan->lesion_distances_mm[0] == doctest::Approx(distance - 1.0).epsilon(0.02));
    // Read with nothing written since, it is the same.
    const auto second = assets.lesion_mesh(marks.lesions[0]);
    Job job;
    CHECK(load_lesion(assets, {file.string()}, job).value()->parts.front() == second);
}

TEST_CASE("centerlines of a large tree are computed by a worker, and the previous ones are kept until then") {
    std::string line;
    for (int i = 1; i <= 20'010; ++i)
        line += std::to_string(i) + " 2 " + std::to_string(i % 7) + " 0 " + std::to_string(i) + " 1 " +
                (i == 1 ? "-1" : std::to_string(i - 1)) + "\n";
    const auto tree = std::make_shared<const tree::VesselTree>(io::parse_tree(line, "line.swc").value());
    Document document;
    document.open(tree, {});
    Assets alone, assets;
    assets.centerlines_follow = true;
    refresh(alone, document);
    refresh(assets, document);
    CHECK_FALSE(assets.centerlines.lines);
    std::vector<ComparedSurface> compared;
    const auto works = background_works({}, compared);
    BackgroundWork& maker = *works[static_cast<std::size_t>(WorkKind::kCenterlines)];
    std::deque<Error> errors;
    const ReadySurface shown;
    const auto follow = [&] {
        return maker.follow({.document = document, .request = surface_request(document.marks()), .shown = shown},
                            assets, errors);
    };
    while (!follow()) std::this_thread::yield();
    REQUIRE(assets.centerlines.lines);
    CHECK(assets.centerlines.lines->points == alone.centerlines.lines->points);
    const auto before = assets.centerlines.lines;
    Marks marks = document.marks();
    marks.options.smooth_passes += 2;
    document.change(marks);
    refresh(alone, document);
    CHECK(alone.centerlines.fits(marks.options));
    refresh(assets, document);
    CHECK(assets.centerlines.lines == before);
    CHECK(centerlines_awaited(assets, marks.options));
    while (!follow()) std::this_thread::yield();
    CHECK_FALSE(centerlines_awaited(assets, marks.options));
    CHECK(assets.centerlines.lines->points == alone.centerlines.lines->points);
    CHECK_FALSE(follow());
}

TEST_CASE("after an edit the tree is shown without waiting, and callers that save a picture can wait") {
    const TemporaryFolder folder;
    Workspace workspace({});
    workspace.open(folder.write("fork.swc", kFork));
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    const auto edit = [&] {
        REQUIRE(workspace.document().edit_tree({.kind = tree::Edit::Kind::kScale, .branches = {1}, .value = 0.5}));
    };
    const auto before = workspace.shown().mesh;
    edit();
    CHECK(workspace.follow_tree());
    CHECK(workspace.between_trees());
    CHECK_FALSE(workspace.shown().mesh); // nothing of either
    CHECK_FALSE(workspace.surface_ready());
    CHECK(workspace.busy());
    REQUIRE(settle(workspace, [&] { return !workspace.between_trees(); }));
    CHECK(workspace.shown().mesh);
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    CHECK(workspace.shown().mesh != before);

    edit();
    workspace.await_tree();
    CHECK_FALSE(workspace.between_trees());
    CHECK(workspace.shown().mesh);
    CHECK(workspace.assets().tree == workspace.document().tree());
    CHECK(workspace.assets().centerlines.lines);
}

TEST_CASE("a task that throws ends, and its failure is reported") {
    Worker worker({});
    worker.start("too much", [](Job&, const Worker::Post&) { throw std::runtime_error("it broke"); });
    while (worker.busy()) worker.drain();
    CHECK(worker.take_failure() == "it broke");
    CHECK(worker.take_failure().empty());
    bool ran = false;
    worker.start("next", [&](Job&, const Worker::Post& post) { post([&] { ran = true; }); });
    while (worker.busy()) worker.drain();
    CHECK(ran);
}

TEST_CASE("a file that finishes loading after unsaved changes waits until it is accepted") {
    const TemporaryFolder folder;
    Workspace workspace({});
    workspace.open(folder.write("fork.swc", kFork));
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    const auto first = workspace.document().tree();
    const fs::path other = folder.write("other.swc", "1 3 0 0 0 2 -1\n2 3 0 0 20 2 1\n");
    const auto change = [&](const char* name) {
        Marks marks = workspace.document().marks();
        marks.names[1] = name;
        workspace.document().change(marks);
    };
    workspace.open(other);
    change("right branch");
    REQUIRE(settle(workspace, [&] { return workspace.arrival_waits(); }));
    CHECK(workspace.document().tree() == first);
    workspace.discard_arrival();
    REQUIRE(settle(workspace, [&] { return !workspace.busy(); }));
    CHECK(workspace.document().tree() == first);
    CHECK(workspace.document().marks().names.at(1) == "right branch");
    CHECK(workspace.surface_ready());

    workspace.open(other);
    change("left branch");
    REQUIRE(settle(workspace, [&] { return workspace.arrival_waits(); }));
    workspace.accept_arrival();
    CHECK_FALSE(workspace.arrival_waits());
    CHECK(workspace.document().tree() != first);
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready() && !workspace.busy(); }));
    CHECK(workspace.document().marks().names.empty());
    // Without such work it comes in by itself.
    CHECK(workspace.take_opened()); // what was let in
    workspace.open(other);
    REQUIRE(settle(workspace, [&] { return workspace.take_opened().has_value(); }));
    CHECK_FALSE(workspace.arrival_waits());
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
}
