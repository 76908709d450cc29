#include "app/session/lesion_meshes.h"
#include "app/session/session_file.h"
#include "app/storage/tree_source.h"
#include "app/workspace/workspace.h"
#include "core/base/worker.h"
#include "core/io/mesh_writer.h"
#include "tests/support/icosphere.h"
#include "tests/support/settle.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <unistd.h>

using namespace ramus;
using namespace ramus::app;
using ramus::test::settle;
namespace fs = std::filesystem;

namespace {

struct Folder {
    fs::path path = fs::temp_directory_path() / ("ramus_workspace_test_" + std::to_string(::getpid()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
    fs::path write(const std::string& name, const std::string& text) const {
        std::ofstream(path / name) << text;
        return path / name;
    }
};

constexpr const char* kFork = "1 3 0 0 0 2 -1\n2 3 0 0 20 2 1\n3 3 10 0 30 1 2\n4 3 -10 0 30 1.5 2\n";

} // namespace

TEST_CASE("a worker's results come in drain(), in order, and the newest task wins") {
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

TEST_CASE("a tree opens with its cones, then its surface; undo finds the surface that was") {
    const Folder folder;
    Workspace workspace({});
    workspace.open(folder.write("fork.swc", kFork));
    REQUIRE(settle(workspace, [&] { return workspace.document.tree() != nullptr; }));
    // Its cones, unless something better was as quick.
    REQUIRE(workspace.shown().mesh);
    CHECK(workspace.shown().mesh->triangle_count() > 100);
    REQUIRE(workspace.take_opened());
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    const auto first = workspace.shown().mesh;
    CHECK(first->triangle_count() > 100);

    Marks finer = workspace.document.marks();
    finer.options.detail = 24;
    workspace.document.change(finer);
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    CHECK(workspace.shown().mesh->triangle_count() > first->triangle_count());
    REQUIRE(workspace.document.undo());
    workspace.update();
    CHECK(workspace.shown().mesh == first);
}

TEST_CASE("hidden branches go from the surface, and undo finds them again") {
    const Folder folder;
    Workspace workspace({});
    workspace.open(folder.write("fork.swc", kFork));
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    const auto all = workspace.shown().mesh;
    const auto seen = [&](int branch) {
        return !workspace.shown().mesh->positions([&](int b) { return b == branch; }).empty();
    };
    CHECK(seen(2));
    Marks without = workspace.document.marks();
    const std::vector<int> leaf{2};
    set_state(without, leaf, render::BranchState::kHidden);
    workspace.document.change(without);
    workspace.update();
    CHECK(workspace.shown().mesh); // the old one until the other is there
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    CHECK_FALSE(seen(2));
    CHECK(seen(1));
    Marks none = without;
    set_state(none, std::vector<int>{0, 1, 2}, render::BranchState::kHidden);
    workspace.document.change(none);
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    CHECK(workspace.shown().mesh->triangle_count() == 0);
    CHECK(workspace.surface_problem().empty());
    REQUIRE(workspace.document.undo());
    REQUIRE(workspace.document.undo());
    workspace.update();
    CHECK(workspace.surface_ready());
    CHECK(workspace.shown().mesh == all);
}

TEST_CASE("options that are tried change the picture and not the session") {
    const Folder folder;
    Workspace workspace({});
    workspace.open(folder.write("fork.swc", kFork));
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    mesh::SurfaceOptions wide = workspace.document.marks().options;
    wide.width = 2.0;
    workspace.try_options(wide);
    REQUIRE(settle(workspace, [&] { return workspace.shown().request.options.width == 2.0 && !workspace.busy(); }));
    CHECK_FALSE(workspace.surface_ready());
    CHECK_FALSE(workspace.document.modified());
    workspace.try_options({});
    workspace.update();
    CHECK(workspace.surface_ready());
}

TEST_CASE("a file that cannot be read leaves the old tree as it was") {
    const Folder folder;
    Workspace workspace({});
    workspace.open(folder.write("fork.swc", kFork));
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    const auto tree = workspace.document.tree();
    const auto mesh = workspace.shown().mesh;
    workspace.open(folder.write("bad.swc", "1 3 0 0 0 nan -1\n"));
    std::optional<Error> error;
    REQUIRE(settle(workspace, [&] { return (error = workspace.take_error()).has_value(); }));
    CHECK(error->message().find("bad.swc") != std::string::npos);
    CHECK(workspace.document.tree() == tree);
    CHECK(workspace.shown().mesh == mesh);
}

TEST_CASE("a session opens with its tree; one of another tree is refused") {
    const Folder folder;
    const fs::path tree = folder.write("fork.swc", kFork);
    Session session;
    session.tree = {tree, checksum_of(tree).value()};
    session.marks.selection = {1};
    REQUIRE(write_session(session, folder.path / "s.json"));
    CHECK(is_session_file(folder.path / "s.json"));
    CHECK_FALSE(is_session_file(tree));
    CHECK_FALSE(is_session_file(folder.write("other.json", R"({"points": []})")));
    CHECK_FALSE(is_session_file(folder.write("junk.json", "{")));
    Job job;
    const auto loaded = load(folder.path / "s.json", {}, {}, job);
    REQUIRE(loaded);
    CHECK(loaded->session == session);
    CHECK(loaded->has_camera);

    folder.write("fork.swc", std::string(kFork) + "5 3 0 0 60 1 3\n");
    CHECK_FALSE(load(folder.path / "s.json", {}, {}, job));
}

TEST_CASE("facts of a fork are those of its geometry") {
    const Folder folder;
    Job job;
    const auto loaded = load(folder.write("fork.swc", kFork), {}, {}, job);
    REQUIRE(loaded);
    const TreeFacts& facts = *loaded->facts;
    REQUIRE(facts.branches.size() == 3);
    CHECK(facts.branches[0].dependents == 2);
    CHECK(facts.branches[0].length_mm == doctest::Approx(20.0));
    CHECK(facts.branches[0].mean_diameter_mm == doctest::Approx(4.0));
    CHECK(facts.leaves == 2);
    CHECK(facts.generations == 2);
    CHECK(facts.length_mm == doctest::Approx(20.0 + 2.0 * std::sqrt(200.0)));
    CHECK(path_to(*loaded->tree, 2) == std::vector<int>{0, 2});
}

TEST_CASE("distances to lesions that are meshes are measured behind the window's back") {
    const Folder folder;
    auto ball = test::icosphere(4, {0, 9, 5}, 3.0);
    ball.radii.resize(ball.positions.size(), 1.0F);
    ball.branches.resize(ball.positions.size(), 0);
    const fs::path file = folder.path / "tumour.stl";
    REQUIRE(io::write_mesh(ball, file));
    Workspace workspace({});
    workspace.open(folder.write("fork.swc", kFork));
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    workspace.read_lesion_mesh(file);
    CHECK(workspace.busy());
    REQUIRE(settle(workspace, [&] { return workspace.take_read_mesh() == file; }));
    CHECK(lesion_mesh_read_before(file));
    CHECK_FALSE(lesion_mesh_read_before(folder.path / "other.stl"));

    Document& document = workspace.document;
    Marks marks = document.marks();
    marks.lesion_meshes = {file.string()};
    marks.cuts = {{0, 0.5}};
    document.change(marks);
    // Who must not wait sees the mesh and the cut at once, but no distances yet.
    REQUIRE(document.plan_wanted());
    auto plan = document.plan_so_far();
    CHECK(plan->measuring);
    CHECK(plan->meshes.size() == 1);
    CHECK(plan->cuts.cuts.size() == 1);
    CHECK(plan->bands.empty());
    CHECK(document.plan_so_far() == plan);
    REQUIRE(settle(workspace, [&] { return !document.plan_wanted(); }));
    plan = document.plan_so_far();
    CHECK_FALSE(plan->measuring);
    REQUIRE(plan->lesion_distances_mm.size() == 3);
    CHECK(plan->lesion_distances_mm[0] == doctest::Approx(4.0).epsilon(0.01)); // 9 - 3 - 2
    // A cut more takes the distances over; another lesion needs them anew.
    marks.cuts.push_back({1, 0.5});
    document.change(marks);
    CHECK_FALSE(document.plan_wanted());
    CHECK(document.plan_so_far()->cuts.cuts.size() == 2);
    CHECK(document.plan_so_far()->lesion_distances_mm == plan->lesion_distances_mm);
    marks.lesions = {{0, -9, 5, 3}};
    document.change(marks);
    CHECK(document.plan_wanted());
    CHECK(document.plan_so_far()->lesion_distances_mm.size() == 3); // of the sphere alone
    // Who asks for all of it waits.
    CHECK(document.plan()->lesion_distances_mm[0] == doctest::Approx(4.0).epsilon(0.01));
    CHECK_FALSE(document.plan_wanted());
}

TEST_CASE("a task that throws ends, and says so") {
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

TEST_CASE("a file that arrives while unsaved work went on waits to be let in") {
    const Folder folder;
    Workspace workspace({});
    workspace.open(folder.write("fork.swc", kFork));
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    const auto first = workspace.document.tree();
    const fs::path other = folder.write("other.swc", "1 3 0 0 0 2 -1\n2 3 0 0 20 2 1\n");
    const auto change = [&](const char* name) {
        Marks marks = workspace.document.marks();
        marks.names[1] = name;
        workspace.document.change(marks);
    };
    workspace.open(other);
    change("right branch");
    REQUIRE(settle(workspace, [&] { return workspace.arrival_waits(); }));
    CHECK(workspace.document.tree() == first);
    workspace.send_away();
    REQUIRE(settle(workspace, [&] { return !workspace.busy(); }));
    CHECK(workspace.document.tree() == first);
    CHECK(workspace.document.marks().names.at(1) == "right branch");
    CHECK(workspace.surface_ready());

    workspace.open(other);
    change("left branch");
    REQUIRE(settle(workspace, [&] { return workspace.arrival_waits(); }));
    workspace.let_in();
    CHECK_FALSE(workspace.arrival_waits());
    CHECK(workspace.document.tree() != first);
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready() && !workspace.busy(); }));
    CHECK(workspace.document.marks().names.empty());
    // Without such work it comes in by itself.
    CHECK(workspace.take_opened()); // what was let in
    workspace.open(other);
    REQUIRE(settle(workspace, [&] { return workspace.take_opened().has_value(); }));
    CHECK_FALSE(workspace.arrival_waits());
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
}

TEST_CASE("lesions on their way do not reach the next tree") {
    const Folder folder;
    Workspace workspace({});
    workspace.open(folder.write("fork.swc", kFork));
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    for (int i = 0; i < 20; ++i) workspace.read_lesion_mesh(folder.path / ("tumour" + std::to_string(i) + ".stl"));
    workspace.update();
    LoadedTree loaded;
    loaded.tree = workspace.document.tree();
    loaded.session = workspace.document.session();
    workspace.adopt(std::move(loaded), "elsewhere.swc");
    REQUIRE(settle(workspace, [&] { return !workspace.busy(); }));
    CHECK_FALSE(workspace.take_read_mesh());
}
