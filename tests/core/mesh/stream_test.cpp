// A surface that is made on the disk, for want of memory, is the one that is made in memory.
#include "core/base/disk_pages.h"
#include "core/field/vessel_field.h"
#include "core/mesh/edge_balance.h"
#include "core/mesh/polygonize/octree/neighbours.h"
#include "core/mesh/polygonize/octree/subtree_schedule.h"
#include "core/mesh/polygonize/polygonize.h"
#include "core/mesh/surface.h"
#include "core/mesh/tree_field.h"
#include "tests/support/grown_tree.h"
#include "tests/support/packed_trees.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tree_field.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <memory>
#include <numeric>

using namespace ramus;

TEST_CASE("a subtree is joined after all that it touches are filled, and let go after they are joined") {
    const field::Field field = test::make_field(test::grown(150), {}, {});
    const mesh::bricks::Sizing sizing = mesh::bricks::make_sizing(field, 16, 0.0);
    Job job;
    const mesh::bricks::Octree octree = mesh::bricks::build_octree(field, sizing, job);
    const auto batches = mesh::bricks::schedule_subtrees(octree, 256);
    REQUIRE(batches.size() > 8);

    constexpr std::size_t kNever = SIZE_MAX;
    std::vector<std::size_t> filled(octree.subtrees.size(), kNever), joined(filled), dropped(filled);
    std::size_t most_at_work = 0;
    std::size_t at_work = 0;
    std::uint32_t next = 0;
    for (std::size_t b = 0; b < batches.size(); ++b) {
        for (const std::uint32_t subtree : batches[b].fill) {
            CHECK(subtree == next++);
            filled[subtree] = b;
        }
        for (const std::uint32_t subtree : batches[b].join) {
            CHECK(joined[subtree] == kNever);
            joined[subtree] = b;
        }
        for (const std::uint32_t subtree : batches[b].drop) {
            CHECK(dropped[subtree] == kNever);
            dropped[subtree] = b;
        }
        at_work += batches[b].fill.size();
        most_at_work = std::max(most_at_work, at_work);
        at_work -= batches[b].drop.size();
    }
    CHECK(next == octree.subtrees.size());
    CHECK(at_work == 0);
    CHECK(most_at_work < octree.subtrees.size() / 2);

    // By the neighbourhoods that joining goes by, not by the pairs that the schedule does.
    std::vector<std::uint32_t> all(octree.subtrees.size());
    std::iota(all.begin(), all.end(), 0U);
    ChunkedArray<mesh::bricks::Neighbourhood> around;
    mesh::bricks::find_neighbours(octree, all, around);
    for (std::uint32_t b = 0; b < octree.bricks.size(); ++b) {
        const std::uint32_t subtree = octree.bricks[b].subtree;
        for (int d = 0; d < mesh::bricks::kDirections; ++d) {
            const auto kind = around[b].kind(d);
            if (kind != mesh::bricks::Neighbour::kSame && kind != mesh::bricks::Neighbour::kCoarser) continue;
            const std::uint32_t other = octree.bricks[around[b].brick[static_cast<std::size_t>(d)]].subtree;
            CHECK(filled[other] <= joined[subtree]);
            CHECK(filled[subtree] <= joined[other]);
            CHECK(joined[other] <= dropped[subtree]);
            CHECK(joined[subtree] <= dropped[other]);
        }
    }
}

TEST_CASE("a surface on the disk is the one in memory" * doctest::test_suite("slow")) {
    const TemporaryFolder folder;
    const auto pages = std::make_shared<DiskPages>(folder.path() / "surface.stl", 1e9);
    const field::Field field = test::make_field(test::grown(400), {}, {});
    for (const double cell : {0.0, 0.4}) {
        mesh::PolygonizeOptions options;
        options.cell_mm = cell;
        Job job;
        mesh::PolygonizeStatistics in_memory, on_disk;
        const auto whole = mesh::polygonize(field, options, job, &in_memory);
        REQUIRE(whole);
        options.disk = pages;
        const auto streamed = mesh::polygonize(field, options, job, &on_disk);
        REQUIRE(streamed);
        CHECK(streamed->memory().memory() == pages);
        CHECK(*streamed == *whole);
        CHECK(on_disk.evaluations == in_memory.evaluations);
    }
    CHECK(folder.names().empty());
}

TEST_CASE("repairs on the disk are those in memory") {
    const TemporaryFolder folder;
    const tree::VesselTree tree = test::packed_trees(40); // vessels that press on each other
    mesh::SurfaceOptions surface;
    surface.smooth_passes = 0;
    const tree::PreparedTree prepared = mesh::prepare_tree(tree, surface);
    const field::Field field = test::make_field(tree, surface, {});
    const auto repaired = [&](std::shared_ptr<ArrayMemory> disk) {
        mesh::PolygonizeOptions options;
        options.detail = 8;
        options.disk = std::move(disk);
        Job job;
        std::vector<Bounds<glm::vec3>> walled;
        auto made = mesh::polygonize(field, options, job, nullptr, &walled);
        REQUIRE(made);
        (void)mesh::match_tree(*made, prepared, walled, 1e9, job, options.disk);
        CHECK(mesh::untangle(*made, walled, job).left == 0);
        CHECK(mesh::check_balance(*made));
        return std::move(*made);
    };
    const mesh::TriangleMesh whole = repaired(nullptr);
    const auto pages = std::make_shared<DiskPages>(folder.path() / "surface.stl", 1.0); // nothing stays in memory
    CHECK(repaired(pages) == whole);
    CHECK(folder.names().empty());
}

TEST_CASE("a surface is refused when even the disk does not help, and when it is cancelled") {
    const TemporaryFolder folder;
    const tree::VesselTree tree = test::grown(151);
    mesh::SurfaceOptions options;
    options.memory_bytes = 1;
    Job job;
    const auto refused = mesh::make_untangled_surface(tree, options, job, {}, folder.path() / "surface.stl");
    REQUIRE(!refused);
    CHECK(refused.error().hint.find("--memory") != std::string::npos);

    job.cancel();
    const auto cancelled = mesh::make_untangled_surface(tree, {}, job, {}, folder.path() / "surface.stl");
    REQUIRE(!cancelled);
    CHECK(cancelled.error().what == "cancelled");
    CHECK(folder.names().empty());
}
