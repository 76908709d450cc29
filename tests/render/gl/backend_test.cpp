// Where contexts come from makes no difference to the picture.
#include "render/gl/headless_context.h"
#include "render/renderer/renderer.h"
#include "tests/support/gl_test.h"
#include "tests/support/tube_mesh.h"

#include <cstdio>
#include <doctest/doctest.h>

using namespace ramus::render;
using ramus::test::WatchedContext;

namespace {

Image picture(WatchedContext& context) {
    REQUIRE(context.make_current());
    ramus::mesh::TriangleMesh mesh;
    ramus::test::add_capsule(mesh, {0, 0, -30}, {0, 0, 10}, 5.0F, 4.0F, 0);
    ramus::test::add_capsule(mesh, {0, 0, 10}, {-25, 0, 30}, 3.5F, 2.0F, 1);
    ramus::test::add_capsule(mesh, {-20, 12, -14}, {20, 12, -10}, 1.0F, 1.0F, 2);
    Frame frame;
    frame.mesh = std::make_shared<const PagedMesh>(mesh);
    frame.size = {400, 300};
    frame.camera = camera_for(frame.mesh->positions(), View::kAnterior, frame.size);
    frame.states = {BranchState::kNormal, BranchState::kDefocused, BranchState::kDefocused};
    frame.selected = {0};
    const auto renderer = Renderer::create();
    REQUIRE_MESSAGE(renderer.has_value(), (renderer ? "" : renderer.error().message()));
    REQUIRE((*renderer)->draw(frame));
    return (*renderer)->read_image();
}

} // namespace

TEST_CASE("EGL and OSMesa give the same picture" * doctest::test_suite("slow")) {
    {
        const auto there = make_egl_context();
        if (!there) {
            std::printf("SKIPPED: no EGL here: %s\n", there.error().message().c_str());
            CHECK_FALSE(there.error().hint.empty());
            return;
        }
        if (!is_software_rasteriser()) {
            std::printf("SKIPPED: EGL draws with %s, not as OSMesa does\n", gl_description().c_str());
            return;
        }
    }
    for (const GlVersion version : {GlVersion{4, 5}, GlVersion{3, 3}}) {
        CAPTURE(version.text());
        WatchedContext osmesa(version);
        const Image expected = picture(osmesa);
        WatchedContext egl(version, [] { return make_headless_context(Backend::kEgl); });
        const int difference = ramus::test::largest_difference(expected, picture(egl));
        CHECK(difference <= 1);
        CHECK(ramus::test::largest_difference(expected, picture(osmesa)) == 0); // both live, one after the other
        MESSAGE("OpenGL ", version.text(), ": ", difference, " of 255 apart");
    }
}

TEST_CASE("EGL's devices can be chosen, and one that is not there is refused") {
    const int devices = static_cast<int>(egl_devices().size());
    if (devices > 0) {
        const auto first = make_egl_context(0);
        CHECK_MESSAGE(first.has_value(), (first ? "" : first.error().message()));
    }
    const auto beyond = make_egl_context(devices);
    REQUIRE_FALSE(beyond.has_value());
    CHECK_FALSE(beyond.error().hint.empty());
}

TEST_CASE("a context that is too old is refused with both versions and what to do") {
    limit_gl_version({3, 1});
    const auto context = make_headless_context(Backend::kOsMesa);
    limit_gl_version({99, 0});
    REQUIRE_FALSE(context.has_value());
    const std::string message = context.error().message();
    for (const char* word : {"OpenGL 3.1 is too old", "3.3 is needed", "llvmpipe", "install"})
        CHECK_MESSAGE(message.find(word) != std::string::npos, message);
}
