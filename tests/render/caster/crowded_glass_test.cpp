// Glass in so many layers that two samples of a pixel share a ray while the view moves.
#include "render/renderer/renderer.h"
#include "tests/support/built_tree.h"
#include "tests/support/gl_test.h"
#include "tests/support/straight_vessels.h"
#include "tests/support/surface_frame.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <doctest/doctest.h>
#include <utility>
#include <vector>

using namespace ramus::render;

namespace {

constexpr int kThinVessels = 300;

// Three hundred thin vessels of glass across, behind a thick one that is none.
Frame crowded_frame() {
    std::vector<ramus::test::StraightVessel> vessels;
    for (int i = 0; i < kThinVessels; ++i) {
        const float at = static_cast<float>(i) / kThinVessels, away = 30.0F * std::sin(40.0F * at);
        vessels.push_back({{-30.0F, away, 40.0F * at - 20.0F}, {30.0F, -away, 38.0F * at - 18.0F}, 0.25F, 0.25F});
    }
    vessels.push_back({{-3.0F, 40.0F, -20.0F}, {3.0F, 40.0F, 20.0F}, 4.0F, 4.0F});
    Frame frame = ramus::test::frame_of(vessels, 16, {160, 120}, false);
    frame.states.assign(kThinVessels, BranchState::kDefocused);
    frame.states.push_back(BranchState::kNormal);
    return frame;
}

// What moves, from a little beside where it was before.
DrawStatistics move_to(Renderer& renderer, Frame frame) {
    frame.quality = Quality::kInteractive;
    Frame before = frame;
    before.camera = turned(frame.camera, 10.0, 5.0);
    REQUIRE(renderer.draw(before));
    const auto cast = renderer.draw(frame);
    REQUIRE(cast);
    return *cast;
}

} // namespace

TEST_CASE("of glass one cone stands for segments far shorter than pixels, and looks like them" *
          doctest::test_suite("slow")) {
    constexpr std::uint32_t kSegments = 256;
    std::vector<ramus::tree::Point> points;
    std::vector<ramus::tree::Edge> edges;
    for (std::uint32_t i = 0; i <= kSegments; ++i) {
        const double along = double(i) / kSegments;
        points.push_back({{30.0 * along, 5.0 * std::sin(5.0 * along), 20.0 * along}, 1.0 - 0.3 * along});
        if (i > 0) edges.push_back({i - 1, i});
    }
    ramus::mesh::SurfaceOptions options;
    options.smooth_passes = 0;
    const ramus::test::WatchedContext context(GlVersion{99, 0});
    const auto still = Renderer::create().value(), moving = Renderer::create().value();
    const ramus::tree::VesselTree tree = ramus::test::built_tree(std::move(points), std::move(edges));
    Frame frame = ramus::test::surface_frame(tree, options, {160, 120});
    const std::uint64_t all = move_to(*moving, frame).cones; // where nothing is glass
    frame.states = {BranchState::kDefocused};
    const std::uint64_t few = move_to(*moving, frame).cones;
    const Image on_the_way = moving->read_image();
    REQUIRE(still->draw(frame));
    const Image at_rest = still->read_image();
    const BranchPicture branches = still->read_branches();
    double apart = 0.0;
    std::size_t seen = 0;
    for (std::size_t i = 0; i < branches.branches.size(); ++i) {
        if (branches.branches[i] == kNoBranch) continue;
        ++seen;
        for (std::size_t k = 4 * i; k < 4 * i + 3; ++k) apart += std::abs(on_the_way.rgba[k] - at_rest.rgba[k]) / 3.0;
    }
    apart /= static_cast<double>(seen);
    frame.size = {3200, 2400};
    const std::uint64_t near = move_to(*moving, frame).cones;
    MESSAGE(few << " cones of " << all << ", " << near << " of a picture 20 times as large; " << apart << " of 255 in "
                << seen << " pixels");
    CHECK(all > 64);
    CHECK(2 * few < all);
    CHECK(near == all);
    REQUIRE(seen > 500);
    CHECK(apart < 1.3);
}

TEST_CASE("glass that crowds looks while the view moves as it does at rest") {
    const ramus::test::WatchedContext context(GlVersion{99, 0});
    const auto still = Renderer::create().value(), moving = Renderer::create().value();
    Frame frame = crowded_frame();
    frame.quality = Quality::kInteractive;
    REQUIRE(moving->draw(frame)); // what moves has been somewhere else
    frame.camera = turned(frame.camera, 10.0, 5.0);
    const auto cast = moving->draw(frame);
    REQUIRE(cast);
    CHECK(cast->cones == kThinVessels + 1);
    frame.quality = Quality::kFull;
    REQUIRE(still->draw(frame));
    const Image on_the_way = moving->read_image(), at_rest = still->read_image();
    const BranchPicture there = moving->read_branches(), here = still->read_branches();
    std::size_t vessels = 0, missing = 0, solid = 0;
    double apart = 0.0, brighter = 0.0;
    for (std::size_t i = 0; i < here.branches.size(); ++i) {
        if (here.branches[i] == kNoBranch) continue;
        ++vessels;
        missing += there.branches[i] == kNoBranch ? 1 : 0;
        double more = 0.0;
        for (std::size_t k = 4 * i; k < 4 * i + 3; ++k) {
            more += (on_the_way.rgba[k] - at_rest.rgba[k]) / 3.0;
            apart += std::abs(on_the_way.rgba[k] - at_rest.rgba[k]) / 3.0;
        }
        if (here.branches[i] != kThinVessels || there.branches[i] != kThinVessels) continue;
        ++solid;
        brighter += more;
    }
    apart /= static_cast<double>(vessels);
    brighter /= static_cast<double>(solid);
    MESSAGE("mean difference " << apart << " of 255, " << missing << " missing of " << vessels
                               << "; what is no glass: " << brighter << " brighter");
    REQUIRE(vessels > 8'000);
    REQUIRE(solid > 300);
    CHECK(apart < 12.0); // of vessels a pixel wide, each with a sample more or less
    CHECK(missing * 100 <= vessels);
    CHECK(std::abs(brighter) < 1.0); // glass behind it does not shine through
}
