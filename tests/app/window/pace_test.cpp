// When a window draws quickly and when fully.
#include "app/window/pace.h"
#include "tests/support/tube_mesh.h"

#include <doctest/doctest.h>

using namespace ramus;
using namespace ramus::app;
using render::Quality;

namespace {

render::Frame a_frame() {
    mesh::TriangleMesh mesh;
    test::add_capsule(mesh, {0, 0, 0}, {0, 0, 50}, 5.0F, 5.0F, 0);
    render::Frame frame;
    frame.mesh = std::make_shared<const render::PagedMesh>(mesh);
    frame.states.assign(2, tree::BranchState::kNormal);
    return frame;
}

} // namespace

TEST_CASE("if full frames are fast, only drags are drawn in interactive quality") {
    Pace pace(false);
    render::Frame frame = a_frame();
    CHECK(pace.quality(frame, false, false, 1.0) == Quality::kFull);
    frame.camera.position.x += 1.0;
    CHECK(pace.quality(frame, true, false, 2.0) == Quality::kInteractive);
    CHECK(pace.quality(frame, true, false, 2.0 + 2.0 * Pace::kRestSeconds) == Quality::kFull); // the drag pauses
    frame.camera.position.x += 1.0;
    CHECK(pace.quality(frame, false, false, 3.0) == Quality::kFull);
}

TEST_CASE("if full frames are slow, changes are drawn in interactive quality until the view rests") {
    Pace pace(true);
    render::Frame frame = a_frame();
    CHECK(pace.quality(frame, false, true, 1.0) == Quality::kInteractive);
    CHECK(pace.quality(frame, false, true, 1.5) == Quality::kInteractive); // something better is coming
    CHECK(pace.quality(frame, false, false, 1.5) == Quality::kFull);
    pace.drawn(frame, 1.0);
    frame.states[1] = tree::BranchState::kHidden;
    CHECK(pace.quality(frame, false, false, 2.0) == Quality::kInteractive);
    CHECK(pace.rests_at() == doctest::Approx(2.0 + Pace::kRestSeconds));
    CHECK(pace.quality(frame, false, false, pace.rests_at()) == Quality::kFull);
    // No triangle is drawn for these.
    frame.states[0] = tree::BranchState::kHighlighted;
    frame.hovered = 1;
    CHECK(pace.quality(frame, false, false, 3.0) == Quality::kFull);
    // A small tree is drawn fast enough even so.
    pace.drawn(frame, 0.01);
    frame.camera.position.x += 1.0;
    CHECK(pace.quality(frame, false, false, 4.0) == Quality::kFull);
}

TEST_CASE("a frame that waits for its surface counts as changed when the awaited surface changes") {
    Pace pace(true);
    render::Frame frame = a_frame();
    frame.centerlines = std::make_shared<const render::Centerlines>();
    frame.width = 5.0F;
    frame.surface_awaited = true;
    CHECK(pace.quality(frame, false, true, 1.0) == Quality::kInteractive);
    CHECK(pace.quality(frame, false, true, 1.1 + Pace::kProvisionalSeconds) == Quality::kFull);
    frame.width = 4.0F;
    CHECK(pace.quality(frame, false, true, 10.0) == Quality::kInteractive);
    CHECK(pace.quality(frame, false, true, 10.1 + Pace::kProvisionalSeconds) == Quality::kFull);
    frame.centerlines = std::make_shared<const render::Centerlines>(*frame.centerlines);
    CHECK(pace.quality(frame, false, true, 20.0) == Quality::kInteractive);
}
