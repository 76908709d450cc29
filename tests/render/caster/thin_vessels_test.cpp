// Vessels some pixels wide, of which most trees have the most: outlines are most of what one sees of them.
#include "render/renderer/renderer.h"
#include "tests/support/built_tree.h"
#include "tests/support/gl_test.h"
#include "tests/support/surface_frame.h"

#include <cmath>
#include <cstdlib>
#include <doctest/doctest.h>
#include <utility>
#include <vector>

using namespace ramus::render;

namespace {

// A fan of vessels that fork once each, radii from 0.5 to 1.2.
ramus::tree::VesselTree fan() {
    std::vector<ramus::tree::Point> points{{{0.0, 0.0, -40.0}, 2.0}};
    std::vector<ramus::tree::Edge> edges;
    constexpr int kForks = 24;
    for (int i = 0; i < kForks; ++i) {
        const double turn = 2.39996323 * i, radius = 0.5 + 0.03 * i, x = std::cos(turn), y = std::sin(turn);
        const auto fork = static_cast<std::uint32_t>(points.size());
        points.push_back({{14.0 * x, 14.0 * y, -10.0 + 0.8 * i}, radius});
        points.push_back({{22.0 * x - 5.0 * y, 22.0 * y + 5.0 * x, 12.0 + i}, 0.8 * radius});
        points.push_back({{25.0 * x + 6.0 * y, 25.0 * y - 6.0 * x, 8.0 - i}, 0.8 * radius});
        edges.push_back({0, fork});
        edges.push_back({fork, fork + 1});
        edges.push_back({fork, fork + 2});
    }
    return ramus::test::built_tree(std::move(points), std::move(edges));
}

} // namespace

// The resting picture's normals are those of its triangles at the pixels' middles, where those often do not reach.
TEST_CASE("thin vessels look while the view moves as they do at rest" * doctest::test_suite("slow")) {
    const ramus::test::WatchedContext context(GlVersion{99, 0});
    const auto still = Renderer::create().value(), moving = Renderer::create().value();
    ramus::mesh::SurfaceOptions options;
    options.smooth_passes = 0;
    Frame frame = ramus::test::surface_frame(fan(), options, {200, 160});
    frame.quality = Quality::kInteractive;
    REQUIRE(moving->draw(frame)); // what moves has been somewhere else
    frame.camera = turned(frame.camera, 15.0, 10.0);
    const auto cast = moving->draw(frame);
    REQUIRE(cast);
    CHECK(cast->cones > 0);
    const Image on_the_way = moving->read_image();
    const BranchPicture there = moving->read_branches();
    frame.quality = Quality::kFull;
    REQUIRE(still->draw(frame));
    const Image at_rest = still->read_image();
    const BranchPicture here = still->read_branches();
    double apart = 0.0, wider = 0.0;
    std::size_t vessels = 0;
    for (std::size_t i = 0; i < here.branches.size(); ++i) {
        wider += (there.branches[i] == kNoBranch ? 0 : 1) - (here.branches[i] == kNoBranch ? 0 : 1);
        if (here.branches[i] == kNoBranch && there.branches[i] == kNoBranch) continue;
        ++vessels;
        for (std::size_t k = 4 * i; k < 4 * i + 3; ++k) apart += std::abs(on_the_way.rgba[k] - at_rest.rgba[k]) / 3.0;
    }
    apart /= static_cast<double>(vessels);
    wider /= static_cast<double>(vessels);
    MESSAGE("mean difference " << apart << " of 255, " << 100.0 * wider << " % more pixels, of " << vessels);
    REQUIRE(vessels > 3'000);
    CHECK(apart < 1.9);              // 2.2 with the cones' own normals
    CHECK(std::abs(wider) < 0.0025); // 0.0032 where cones go around the mesh, not between its corners and edges
}
