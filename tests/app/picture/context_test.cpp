// What is shown beside the tree: commands that add, change and remove it, what is read of it and when, and what the
// picture gets.
#include "app/assets/shapes.h"
#include "app/picture/compose.h"
#include "app/session/colour_by.h"
#include "app/session/session_file.h"
#include "app/storage/opening_files.h"
#include "app/workspace/workspace.h"
#include "core/io/meshes/mesh_file.h"
#include "render/scene/bounds.h"
#include "tests/support/context_stage.h"
#include "tests/support/settle.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace ramus;
using namespace ramus::app;
using ramus::test::ContextStage;
using ramus::test::drawn;
using ramus::test::settle;
namespace fs = std::filesystem;

TEST_CASE("context is added, changed, hidden and removed by commands, each one step of undo") {
    ContextStage stage;
    const std::string file = stage.ball("organ.stl");
    CHECK(stage.commands.good("context \"" + file + "\"").find("1,280 triangles") != std::string::npos);
    REQUIRE(stage.context().size() == 1);
    CHECK(stage.context()[0].file == file);
    CHECK(stage.context()[0].opacity == 0.25);
    REQUIRE(stage.drawn().size() == 1);
    CHECK(stage.drawn()[0].mesh->triangles.size() == 1280);
    CHECK(stage.drawn()[0].clear());
    stage.commands.good("context \"" + file + "\" --wireframe --colour 20ff80");
    REQUIRE(stage.context().size() == 2);
    CHECK(stage.context()[1].wireframe);
    CHECK(stage.context()[1].opacity == 1.0);
    CHECK(stage.context()[1].colour == std::array<std::uint8_t, 3>{0x20, 0xff, 0x80});
    CHECK(stage.context()[0].colour != stage.context()[1].colour);

    stage.commands.good("context-opacity 1 0.6");
    CHECK(stage.drawn()[0].opacity == 0.6F);
    stage.commands.good("context-colour 1 \"#102030\"");
    CHECK(stage.context()[0].colour == std::array<std::uint8_t, 3>{16, 32, 48});
    CHECK(stage.drawn()[0].colour.z == doctest::Approx(48.0 / 255.0));
    stage.commands.good("context-style 2 surface");
    CHECK_FALSE(stage.drawn()[1].wireframe);
    CHECK(stage.drawn()[0].mesh == stage.drawn()[1].mesh); // read once
    stage.commands.good("context-hide 1");
    CHECK(stage.drawn().size() == 1);
    CHECK(stage.context().size() == 2);
    stage.commands.good("context-show 1");
    CHECK(stage.drawn().size() == 2);
    stage.commands.good("context-remove 1");
    REQUIRE(stage.context().size() == 1);
    CHECK_FALSE(stage.context()[0].wireframe);
    stage.commands.good("context-clear");
    CHECK(stage.drawn().empty());
    for (int i = 0; i < 6; ++i) stage.commands.good("undo");
    REQUIRE(stage.context().size() == 2);
    CHECK(stage.context()[0].opacity == 0.6);
    CHECK(stage.context()[0].colour == std::array<std::uint8_t, 3>{201, 130, 104});
    CHECK(stage.drawn().size() == 2);
    stage.commands.good("undo\nundo\nundo");
    CHECK(stage.context().empty());
    stage.commands.good("redo");
    CHECK(stage.drawn().size() == 1);
}

TEST_CASE("while context is being read, perspective views have no scale bar, since it would change") {
    ContextStage stage;
    stage.commands.good("context \"" + stage.ball("ball.ply") + "\"");
    Session session = stage.commands.document.session();
    const auto has_bar = [&](bool awaited, bool orthographic) {
        session.camera.orthographic = orthographic;
        Assets alone;
        alone.context_shapes = stage.commands.assets.context_shapes;
        return compose(session, alone, nullptr, {.context_awaited = awaited}).overlays.scale_bar;
    };
    CHECK(has_bar(false, false));
    CHECK_FALSE(has_bar(true, false));
    CHECK(has_bar(true, true));
}

TEST_CASE("a context mesh that does not state its axes can be given them later") {
    ContextStage stage;
    const std::string file = stage.ball("ball.ply", {5, 0, 15}), own = (stage.folder.path() / "own.ply").string();
    stage.commands.good("context \"" + file + "\"");
    const auto shape = [&] {
        Job job;
        REQUIRE(load_context(stage.commands.assets, stage.commands.marks(), job)); // as before a picture
        return stage.commands.assets.context_shape(source_of(stage.context()[0]));
    };
    CHECK(shape()->box.upper.x == doctest::Approx(17.0).epsilon(0.01));
    stage.commands.good("context-axes 1 LPS");
    CHECK(stage.context()[0].axes == "LPS");
    CHECK(shape()->box.upper.x == doctest::Approx(7.0).epsilon(0.01));
    stage.commands.good("undo");
    CHECK(shape()->box.upper.x == doctest::Approx(17.0).epsilon(0.01));
    CHECK(stage.commands.bad("context-axes 1 XYZ").find("LPS or RAS") != std::string::npos);
    CHECK(stage.commands.bad("context-axes 2 LPS").find("from 1 to 1") != std::string::npos);
    auto mesh = test::icosphere(2, {0, 0, 15}, 12.0);
    mesh.radii.resize(mesh.positions.size(), 1.0F);
    mesh.branches.resize(mesh.positions.size(), 0);
    REQUIRE(io::write_mesh(mesh, own, io::MeshNames()));
    stage.commands.good("context \"" + own + "\"");
    CHECK(stage.commands.bad("context-axes 2 LPS").find("states its axes") != std::string::npos);
}

TEST_CASE("files that cannot be context are refused, and change nothing") {
    ContextStage stage;
    const std::string good = stage.ball("good.ply");
    stage.commands.good("context \"" + good + "\"");
    const auto path = [&](const char* name) {
        return std::string("\"") + (stage.folder.path() / name).string() + "\"";
    };
    stage.folder.write("broken.stl", "solid nothing\nendsolid nothing\n");
    stage.folder.write("broken.nii", std::string(100, 'x'));
    const std::string mask = stage.mask("mask.nii");
    const std::pair<std::string, const char*> cases[] = {
        {"context \"" + good + "\"", "already"},
        {"context " + path("gone.stl"), "gone.stl"},
        {"context " + path("gone.nii.gz"), "gone.nii.gz"},
        {"context " + path("broken.stl"), "broken.stl"},
        {"context " + path("broken.nii"), "broken.nii"},
        {"context " + path("fork.swc"), "neither a mask nor a mesh"},
        {"context \"" + good + "\" --label 1", "neither labels nor values"},
        {"context \"" + good + "\" --isovalue 1", "neither labels nor values"},
        {"context \"" + mask + "\" --isovalue much", "--isovalue"},
        {"context \"" + mask + "\" --isovalue 1 --label 1", "not both"},
        {"context \"" + mask + "\" --label 7", "7"},
        {"context \"" + mask + "\" --label 0", "--label"},
        {"context \"" + mask + "\" --label", "--label"},
        {"context \"" + mask + "\" --colour red", "--colour"},
        {"context \"" + mask + "\" --opacity 1.5", "--opacity"},
        {"context \"" + mask + "\" --nonsense", "context FILE"},
        {"context \"" + mask + "\" \"" + good + "\"", "context FILE"},
        {"context --wireframe", "context takes a file"},
        {"context", "FILE"},
        {"context-remove 2", "from 1 to 1"},
        {"context-remove", "number"},
        {"context-opacity 1 2", "0 to 1"},
        {"context-opacity 1", "number"},
        {"context-colour 1 12345", "colour"},
        {"context-style 1 dotted", "dotted"},
        {"context-hide 0", "from 1 to 1"},
    };
    for (const auto& one : cases) {
        CAPTURE(one.first);
        const std::string message = stage.commands.bad(one.first);
        CAPTURE(message);
        CHECK(message.find(one.second) != std::string::npos);
    }
}

TEST_CASE("the surface of a mask, of one label or of all, is in the coordinates of the patient") {
    ContextStage stage;
    const std::string file = stage.mask("organ.nii");
    stage.commands.good("context \"" + file + "\" --label 2 --exact\ncontext \"" + file +
                        "\" --opacity 1 --exact\ncontext \"" + file + "\" --label 2");
    const auto drawn = stage.drawn();
    REQUIRE(drawn.size() == 3);
    CHECK(drawn[2].mesh != drawn[0].mesh); // relaxed
    CHECK(drawn[2].mesh->triangles.size() == drawn[0].mesh->triangles.size());
    const render::Box one = render::bounds_of(*drawn[0].mesh), all = render::bounds_of(*drawn[1].mesh);
    // Midway between voxels: label 2 are those with middles at x = 11 to 17, and half a voxel more.
    CHECK(one.lower.x == doctest::Approx(10.0));
    CHECK(one.upper.x == doctest::Approx(18.0));
    CHECK(all.lower.x == doctest::Approx(0.0));
    CHECK(all.upper.z == doctest::Approx(16.5));
    CHECK(drawn[1].solid());
    CHECK(drawn[0].mesh->normals.size() == drawn[0].mesh->positions.size());
}

TEST_CASE("a mesh with holes may be context, and a mesh far from the tree is reported") {
    ContextStage stage;
    stage.folder.write("open.obj", "v 0 0 0\nv 10 0 0\nv 0 10 0\nf 1 2 3\n");
    CHECK(stage.commands.good("context \"" + (stage.folder.path() / "open.obj").string() + "\"").find("1 triangle") !=
          std::string::npos);
    const std::string said = stage.commands.good("context \"" + stage.ball("far.stl", {0, 0, 530}) + "\"");
    CHECK(said.find("same coordinates") != std::string::npos);
    CHECK(said.find("488 mm") != std::string::npos); // 530 - 12 from the centerlines' end at 30
    CHECK(stage.commands.good("context \"" + stage.ball("near.stl") + "\"").find("coordinates") == std::string::npos);
}

TEST_CASE("large context has a coarse version for drawing while the view moves" * doctest::test_suite("slow")) {
    ContextStage stage;
    stage.commands.good("context \"" + stage.ball("small.ply") + "\"\ncontext \"" +
                        stage.ball("large.ply", {0, 0, 15}, 7) + "\"");
    const auto drawn = stage.drawn();
    REQUIRE(drawn.size() == 2);
    CHECK(drawn[0].preview == nullptr);
    REQUIRE(drawn[1].preview != nullptr);
    CHECK(drawn[1].mesh->triangles.size() == 327680);
    CHECK(drawn[1].preview->triangles.size() < 60000);
    CHECK(drawn[1].preview->triangles.size() > 20000);
}

TEST_CASE("a session names its context, and the window reads it in the background") {
    ContextStage stage;
    const std::string file = stage.ball("organ.stl"), mask = stage.mask("mask.nii");
    stage.commands.good("context \"" + mask + "\" --label 1 --opacity 0.5\ncontext \"" + file +
                        "\" --colour 00ff10\ncontext-hide 2");
    Session session = stage.commands.document.session();
    session.tree.path = stage.tree;
    ContextItem gone;
    gone.file = (stage.folder.path() / "gone.stl").string();
    session.marks.context.push_back(gone);
    number_objects(session.marks);
    const fs::path saved = stage.folder.path() / "plan.ramus.json";
    REQUIRE(write_session(session, saved));

    Workspace workspace({});
    workspace.open(saved);
    REQUIRE(settle(workspace, [&] { return workspace.take_opened().has_value(); }));
    CHECK(workspace.document().marks().context == session.marks.context);
    REQUIRE(settle(workspace, [&] { return !workspace.busy(); }));
    CHECK(drawn(workspace).size() == 1);
    CHECK(workspace.assets().context_shape({file, 0, false}) == nullptr); // hidden
    // What is not there is said once, and not tried again and again.
    const auto error = workspace.take_error();
    REQUIRE(error.has_value());
    CHECK(error->message().find("gone.stl") != std::string::npos);
    CHECK(workspace.assets().trouble({gone.file, 0, false}).has_value());
    workspace.update();
    CHECK_FALSE(workspace.awaited(WorkKind::kContext));
    CHECK_FALSE(workspace.take_error().has_value());
    // Shown again, it is read.
    Marks marks = workspace.document().marks();
    marks.context[1].visible = true;
    workspace.document().change(marks);
    REQUIRE(settle(workspace, [&] { return drawn(workspace).size() == 2; }));
    // Headless pictures fail instead of leaving it out.
    Job job;
    const auto read = load_context(workspace.assets(), marks, job);
    REQUIRE_FALSE(read);
    CHECK(read.error().message().find("gone.stl") != std::string::npos);
    marks.context.pop_back();
    CHECK(load_context(workspace.assets(), marks, job));
}

TEST_CASE("a scan is shown as the surface of its isovalue") {
    ContextStage stage;
    test::NiftiFile file; // a ramp along x: 0, 100, ... 900
    file.dim = {3, 10, 4, 6, 1, 1, 1, 1};
    file.type = static_cast<int>(test::NiftiType::kInt16);
    file.rows = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    std::vector<std::int16_t> values;
    for (int n = 0; n < 10 * 4 * 6; ++n) values.push_back(static_cast<std::int16_t>(100 * (n % 10)));
    file.put(values);
    const std::string scan = test::write_plain(stage.folder.path() / "ramp.nii", file.bytes()).string();
    CHECK(stage.commands.bad("context \"" + scan + "\"").find("not those of a mask") != std::string::npos);
    stage.commands.good("context \"" + scan + "\" --isovalue 250 --exact");
    // Halfway between the voxels with 200 and 300.
    CHECK(render::bounds_of(*stage.drawn()[0].mesh).lower.x == doctest::Approx(2.5));
    stage.commands.good("context \"" + scan + "\" --isovalue 650 --exact"); // another surface of the same file
    CHECK(render::bounds_of(*stage.drawn()[1].mesh).lower.x == doctest::Approx(6.5));
    const auto once = to_json(stage.commands.document.session(), "/");
    const auto again = session_from_json(once, "/", "s.json");
    REQUIRE(again);
    CHECK(again->session.marks.context == stage.context());
}

TEST_CASE("a picture depends only on its arguments") {
    ContextStage stage;
    stage.commands.good("context \"" + stage.ball("organ.stl") +
                        "\"\ncut 1\nmeasure diameter 0 0.5\ncolour-by diameter");
    const Session& session = stage.commands.document.session();
    const Assets assets = stage.commands.current_assets();
    const render::Frame frame = compose(session, assets, nullptr, {});
    REQUIRE(frame.context.size() == 1);
    CHECK(frame.lost.size() == 1);
    CHECK(frame.labels.size() == 1);
    // What others have read is not in it, and what becomes of files does not matter.
    Assets fresh;
    refresh(fresh, stage.commands.document);
    CHECK(compose(session, fresh, nullptr, {}).context.empty());
    CHECK(compose(session, fresh, nullptr, {}).lost == frame.lost);
    CHECK(compose(session, {}, nullptr, {}).lost.empty());
    fs::remove(stage.context()[0].file);
    CHECK(compose(session, assets, nullptr, {}) == frame);
}

TEST_CASE("reading that was cancelled is not started again until requested" * doctest::test_suite("slow")) {
    ContextStage stage;
    const std::string file = stage.ball("organ.ply", {0, 0, 15}, 6);
    Workspace workspace({});
    workspace.open(stage.tree);
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready() && !workspace.busy(); }));
    Marks marks = workspace.document().marks();
    ContextItem item;
    item.file = file;
    marks.context = {item};
    workspace.document().change(marks);
    workspace.update();
    REQUIRE(workspace.awaited(WorkKind::kContext));
    workspace.cancel_work();
    for (int i = 0; i < 20; ++i) workspace.update();
    CHECK_FALSE(workspace.awaited(WorkKind::kContext));
    REQUIRE(workspace.assets().trouble({file, 0, false}));
    CHECK(workspace.assets().trouble({file, 0, false})->what == "cancelled");
    CHECK(drawn(workspace).empty());
    workspace.retry(WorkKind::kContext);
    REQUIRE(settle(workspace, [&] { return drawn(workspace).size() == 1; }));
}

TEST_CASE("colours are written as #RRGGBB and read with or without the sign") {
    CHECK(colour_text({1, 171, 255}) == "#01abff");
    CHECK(colour_in("#01aBff") == std::array<std::uint8_t, 3>{1, 171, 255});
    CHECK(colour_in("01abff") == std::array<std::uint8_t, 3>{1, 171, 255});
    for (const char* wrong : {"", "#", "red", "#01abf", "01abff0", "#0x1122", "-1-1-1", "zzzzzz"})
        CHECK_FALSE(colour_in(wrong).has_value());
}
