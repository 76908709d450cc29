// A file that is read again in another way: the surface follows the tree, there and back, and sessions open with it.
#include "app/actions/command_runner.h"
#include "app/session/session_file.h"
#include "app/workspace/workspace.h"
#include "render/scene/bounds.h"
#include "tests/support/command_stage.h"
#include "tests/support/settle.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

using namespace ramus;
using namespace ramus::app;
using ramus::test::settle;

namespace {

constexpr const char* kForkInFile = "1 3 0 0 0 2 -1\n2 3 0 0 20 2 1\n3 3 10 0 30 1 2\n4 3 -10 0 30 1.5 2\n";

// Of the surface that is shown, along z.
double height_mm(const Workspace& workspace) {
    const auto positions = workspace.shown().mesh->positions();
    const auto [low, high] = std::ranges::minmax(positions, {}, [](const glm::vec3& p) { return p.z; });
    return static_cast<double>(high.z) - static_cast<double>(low.z);
}

void run(Workspace& workspace, const std::vector<std::string>& words) {
    test::TestPicture picture;
    ActionContext context{.document = workspace.document(), .picture = picture, .assets = workspace.assets()};
    const auto done = run_command(context, words);
    REQUIRE_MESSAGE(done, (done ? std::string() : done.error().message()));
    workspace.update();
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
}

} // namespace

TEST_CASE("the surface follows the options of reading, also after undo, redo and opening a session") {
    const TemporaryFolder folder;
    Workspace workspace({});
    workspace.open(folder.write("fork.swc", kForkInFile));
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    const double height = height_mm(workspace);
    CHECK(height > 30.0);
    run(workspace, {"read-as", "units", "cm"});
    CHECK(height_mm(workspace) == doctest::Approx(10.0 * height).epsilon(1e-3));
    CHECK(workspace.current_assets().tree == workspace.document().tree());
    CHECK(workspace.document().modified());
    run(workspace, {"undo"});
    CHECK(height_mm(workspace) == doctest::Approx(height).epsilon(1e-3));
    run(workspace, {"redo"});
    CHECK(height_mm(workspace) == doctest::Approx(10.0 * height).epsilon(1e-3));

    const auto session = folder.path() / "s.ramus.json";
    REQUIRE(write_session(workspace.document().session(), session));
    Workspace other({});
    other.open(session);
    REQUIRE(settle(other, [&] { return other.surface_ready(); }));
    CHECK(height_mm(other) == doctest::Approx(10.0 * height).epsilon(1e-3));
    CHECK_FALSE(other.document().modified());
    // Who says something else when it is opened is heard.
    Workspace said({});
    io::ReadOptions in_mm;
    in_mm.unit = io::length_unit("mm");
    said.say_reading(in_mm, session);
    said.open(session);
    REQUIRE(settle(said, [&] { return said.surface_ready(); }));
    CHECK(height_mm(said) == doctest::Approx(height).epsilon(1e-3));
    // What was said of one file is not said of another.
    const auto copy = folder.path() / "copy.ramus.json";
    REQUIRE(write_session(workspace.document().session(), copy));
    said.open(copy);
    REQUIRE(settle(said, [&] { return said.surface_ready() && said.document().file() == copy; }));
    CHECK(height_mm(said) == doctest::Approx(10.0 * height).epsilon(1e-3));
}
