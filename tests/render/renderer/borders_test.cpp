// Borders between branches: rings around the vessel, not the edges of triangles.
#include "core/mesh/surface.h"
#include "core/tree/build_tree.h"
#include "render/gl/gl_context.h"
#include "render/renderer/renderer.h"
#include "tests/support/gl_test.h"

#include <array>
#include <doctest/doctest.h>

using namespace ramus;
using namespace ramus::render;

namespace {

// A straight vessel along x, in two branches that are mirror images about x = 0: a thin twig leaves behind it there.
std::shared_ptr<const PagedMesh> halved_vessel() {
    tree::Graph graph;
    for (int i = -4; i <= 4; ++i) graph.points.push_back({{5.0 * i + 0.013, 0.021, -0.017}, 4.0});
    for (std::uint32_t i = 0; i < 8; ++i) graph.edges.emplace_back(i, i + 1);
    graph.points.push_back({{0.013, 14.0, -0.017}, 1.0});
    graph.edges.emplace_back(4U, 9U);
    graph.roots = {0};
    const auto tree =
        tree::build_tree(std::move(graph), tree::Repair::kAll, [](std::uint32_t) { return std::string("halved"); });
    REQUIRE(tree.has_value());
    Job job;
    mesh::SurfaceOptions options;
    options.smooth_passes = 0;
    auto surface = mesh::make_surface(*tree, options, job);
    REQUIRE(surface.has_value());
    return std::make_shared<const PagedMesh>(surface->mesh);
}

Frame seen_from_behind() {
    Frame frame;
    frame.mesh = halved_vessel();
    frame.size = {640, 480};
    frame.camera = camera_for(frame.mesh->positions(), View::kPosterior, frame.size);
    frame.overlays.orientation_cube = frame.overlays.scale_bar = false;
    return frame;
}

} // namespace

TEST_CASE("a border between two branches is the plane between them, to the pixel" * doctest::test_suite("slow")) {
    for (const GlVersion version : {GlVersion{4, 5}, GlVersion{3, 3}}) {
        CAPTURE(version.text());
        const ramus::test::WatchedContext context(version);
        const auto renderer = Renderer::create().value();
        Frame frame = seen_from_behind();
        const double middle = Projector(frame.camera, frame.size)(glm::dvec3(0.013, 0.0, 0.0))->x;
        std::array<int, 2> halves{};
        // As opaque vessels, and with a half of glass.
        for (const bool glass : {false, true}) {
            CAPTURE(glass);
            REQUIRE(renderer->draw(frame));
            const BranchPicture picture = renderer->read_branches();
            if (!glass) halves = {picture.at(middle - 60.0, 240.0), picture.at(middle + 60.0, 240.0)};
            REQUIRE(halves[0] != kNoBranch);
            REQUIRE(halves[1] != kNoBranch);
            REQUIRE(halves[0] != halves[1]);
            int rows = 0;
            double farthest = 0.0;
            for (int y = 0; y < picture.height; ++y)
                for (int x = 1; x < picture.width; ++x)
                    if (picture.at(x - 1.0, y) == halves[0] && picture.at(x, y) == halves[1])
                        ++rows, farthest = std::max(farthest, std::abs(x - middle));
            MESSAGE(rows, " rows, the border at most ", farthest, " pixels away");
            CHECK(rows > 100);
            CHECK(farthest <= 1.5);
            frame.states.assign(static_cast<std::size_t>(frame.mesh->branch_count()), BranchState::kDefocused);
            frame.states[static_cast<std::size_t>(halves[0])] = BranchState::kNormal;
        }
    }
}

TEST_CASE("another colour or state of opaque branches draws no triangle") {
    const ramus::test::WatchedContext context;
    const auto renderer = Renderer::create().value();
    Frame frame = seen_from_behind();
    CHECK(renderer->draw(frame)->geometry);
    frame.states = {BranchState::kHighlighted};
    const auto highlighted = renderer->draw(frame).value();
    CHECK(highlighted.shaded);
    CHECK_FALSE(highlighted.geometry);
    frame.colours = {glm::vec3(0.1F, 0.6F, 0.2F), glm::vec3(0.7F, 0.6F, 0.2F)};
    const auto coloured = renderer->draw(frame).value();
    CHECK_FALSE(coloured.geometry);
    CHECK(coloured.uploaded == 0);
}
