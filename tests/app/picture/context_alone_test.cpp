// Masks, scans and meshes that are shown without a tree.
#include "app/assets/shapes.h"
#include "app/session/session_file.h"
#include "app/workspace/workspace.h"
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

TEST_CASE("a mask is shown without a tree: viewed, measured, saved and opened again") {
    ContextStage stage;
    const std::string mask = stage.mask("mask.nii"), ball = stage.ball("organ.stl", {100, 0, 0});
    test::CommandStage alone(std::shared_ptr<const tree::VesselTree>{});
    CHECK_FALSE(alone.document.has_scene());
    alone.bad("save " + (stage.folder.path() / "nothing.json").string());
    alone.good("context \"" + mask + "\" --exact --opacity 1");
    CHECK(alone.document.has_scene());
    CHECK(alone.document.subject() == mask);
    // It was looked at: all corners are in the picture.
    const auto in_view = [&](const glm::vec3& at) {
        const auto pixel = render::project(alone.document.session().camera, alone.host.size, at);
        return pixel && pixel->x > 0 && pixel->y > 0 && pixel->x < 400 && pixel->y < 300;
    };
    CHECK(in_view({0, 0, 0}));
    CHECK(in_view({18, 3, 16}));
    CHECK_FALSE(in_view({112, 0, 0}));
    const auto frame = [&] { return compose(alone.document.session(), alone.current_assets(), nullptr, {}); };
    CHECK(frame().overlays.scale_bar);
    CHECK(frame().overlays.orientation_cube);
    CHECK(frame().overlays.unit_known == (frame().overlays.axes == render::side_letters())); // NIfTI says both or none
    CHECK_FALSE(frame().overlays.scale); // its depth is read of the picture
    alone.good("context-opacity 1 0.3");
    CHECK(frame().overlays.scale); // there is none to be read
    alone.good("view superior\nfit\northographic");

    // A mesh says neither its unit nor its sides; what is shown with it is as uncertain.
    alone.good("orthographic\nview anterior\ncontext \"" + ball + "\"");
    CHECK(in_view({112, 0, 0})); // nobody had looked elsewhere
    CHECK_FALSE(frame().overlays.unit_known);
    CHECK(frame().overlays.axes == render::plain_axes());
    alone.good("context-hide 1\ncontext-hide 2");
    CHECK_FALSE(frame().overlays.scale_bar);
    alone.good("context-show 1");

    const fs::path saved = stage.folder.path() / "alone.ramus.json";
    alone.good("save \"" + saved.string() + "\"");
    CHECK(is_session_file(saved));
    Workspace workspace({});
    workspace.open(saved);
    REQUIRE(settle(workspace, [&] { return workspace.all_shown(); }));
    CHECK(workspace.document().session() == alone.document.session());
    CHECK(drawn(workspace).size() == 1);
    CHECK_FALSE(workspace.document().tree());
    CHECK_FALSE(workspace.document().modified());
    // A tree comes in among it.
    workspace.open(stage.tree);
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    CHECK(workspace.document().marks().context == alone.marks().context);
    // And takes it along when another one comes: that is of the tree before.
    workspace.open(stage.tree);
    REQUIRE(settle(workspace, [&] { return workspace.document().marks().context.empty(); }));
}

TEST_CASE("without a tree, the unit of all context can be set, and the view follows") {
    ContextStage stage;
    const std::string ball = stage.ball("organ.stl"), other = stage.ball("other.stl", {40, 0, 15});
    test::CommandStage alone(std::shared_ptr<const tree::VesselTree>{});
    alone.bad("units cm");
    alone.good("context \"" + ball + "\"\ncontext \"" + other + "\"\nview left\nzoom in 3");
    const auto frame = [&] { return compose(alone.document.session(), alone.current_assets(), nullptr, {}); };
    const auto pixel = [&](const glm::dvec3& at) {
        const auto seen = render::project(alone.document.session().camera, alone.host.size, at);
        REQUIRE(seen);
        return *seen;
    };
    CHECK_FALSE(frame().overlays.unit_known);
    const glm::dvec3 place{3, 12, 20};
    const glm::dvec3 before = pixel(place);
    const render::Camera camera = alone.document.session().camera;
    alone.good("units cm");
    CHECK(alone.marks().context[0].units == "cm");
    CHECK(frame().overlays.unit_known);
    CHECK(frame().overlays.axes == render::plain_axes()); // nobody says sides
    const render::Box box = render::bounds_of(*frame().context.at(0).mesh);
    CHECK(box.upper.z - box.lower.z == doctest::Approx(240.0).epsilon(1e-4)); // 24 cm
    const glm::dvec3 after = pixel(10.0 * place);
    CHECK(after.x == doctest::Approx(before.x).epsilon(1e-3));
    CHECK(after.y == doctest::Approx(before.y).epsilon(1e-3));
    alone.good("undo"); // the view as well
    CHECK_FALSE(frame().overlays.unit_known);
    CHECK(alone.document.session().camera == camera);
    alone.good("redo\nunits auto");
    CHECK(alone.marks().context[1].units.empty());
    CHECK_FALSE(frame().overlays.unit_known);
    alone.bad("units parsecs");
    alone.bad("orientation LPS");
}

TEST_CASE("a session without a tree is refused if it names branches or has no context") {
    const TemporaryFolder folder;
    Workspace workspace({});
    for (const char* const text : {R"({"version": 1, "tree": null})",
                                   R"({"version": 1, "tree": null, "context": [{"path": "a.stl"}], "selection": [0]})",
                                   R"({"version": 1, "tree": {}, "context": [{"path": "a.stl"}]})"}) {
        CAPTURE(text);
        Job job;
        const auto refused = load(folder.write("s.json", text), {}, {}, job);
        REQUIRE_FALSE(refused);
        CHECK(refused.error().where.find("s.json") != std::string::npos);
    }
}
