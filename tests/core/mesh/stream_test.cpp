// A surface that is streamed is the one that is made as a whole: in memory, and as a file byte by byte.
#include "core/field/vessel_field.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/meshes/surface_file.h"
#include "core/mesh/polygonize/octree/neighbours.h"
#include "core/mesh/polygonize/octree/subtree_schedule.h"
#include "core/mesh/polygonize/polygonize.h"
#include "core/mesh/surface.h"
#include "tests/support/grown_tree.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <numeric>

using namespace ramus;

namespace {

// The mesh that comes out of a stream.
class Collector final : public mesh::SurfaceSink {
public:
    explicit Collector(std::size_t most_batches = SIZE_MAX) : most_(most_batches) {}

    [[nodiscard]] bool add_vertices(const mesh::VertexSpan& more) override {
        mesh_.positions.insert(mesh_.positions.end(), more.positions.begin(), more.positions.end());
        return true;
    }
    [[nodiscard]] bool add_triangles(std::span<const glm::uvec3> more, const mesh::VertexSpan& vertices) override {
        mesh_.triangles.insert(mesh_.triangles.end(), more.begin(), more.end());
        for (const glm::uvec3& triangle : more)
            for (int corner = 0; corner < 3; ++corner)
                if (vertices.positions[triangle[corner]] != mesh_.positions[triangle[corner]]) ++lost_;
        return ++taken_ < most_;
    }
    // Positions and triangles alone.
    [[nodiscard]] const mesh::TriangleMesh& mesh() const { return mesh_; }
    // Corners whose vertex was let go before its triangle came.
    [[nodiscard]] std::size_t lost() const { return lost_; }
    [[nodiscard]] std::size_t batches() const { return taken_; }

private:
    std::size_t most_, taken_ = 0, lost_ = 0;
    mesh::TriangleMesh mesh_;
};

} // namespace

TEST_CASE("a subtree is joined after all that it touches are filled, and let go after they are joined") {
    const field::VesselField field = mesh::make_field(test::grown(150), {}, {});
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

TEST_CASE("a streamed surface is the whole surface") {
    const tree::VesselTree tree = test::grown(400);
    const field::VesselField field = mesh::make_field(tree, {}, {});
    for (const double cell : {0.0, 0.4}) {
        mesh::PolygonizeOptions options;
        options.cell_mm = cell;
        Job job;
        mesh::PolygonizeStatistics of_whole, of_stream;
        const auto whole = mesh::polygonize(field, options, job, &of_whole);
        REQUIRE(whole);
        Collector collector;
        REQUIRE(mesh::polygonize_to(collector, field, options, job, &of_stream));
        CHECK(collector.batches() > 3);
        CHECK(collector.mesh().positions == whole->positions);
        CHECK(collector.mesh().triangles == whole->triangles);
        CHECK(of_stream.evaluations == of_whole.evaluations);
        CHECK(collector.lost() == 0);
    }
}

TEST_CASE("a streamed file has the bytes of one that is written as a whole") {
    const tree::VesselTree tree = test::grown(151);
    std::vector<std::uint8_t> hidden(tree.branches.size(), 0);
    hidden[5] = hidden[60] = 1;
    TemporaryFolder folder;
    Job job;
    const auto whole = mesh::make_surface(tree, {}, job, hidden);
    REQUIRE(whole);
    for (const std::string extension : {".ply", ".stl", ".obj"}) {
        REQUIRE(io::write_mesh(whole->mesh, folder.path() / ("whole" + extension)));
        auto file = io::SurfaceFile::create(folder.path() / ("streamed" + extension));
        REQUIRE(file);
        REQUIRE(mesh::stream_surface(tree, {}, **file, job, hidden));
        CHECK((*file)->vertex_count() == whole->mesh.positions.size());
        CHECK((*file)->triangle_count() == whole->mesh.triangles.size());
        REQUIRE((*file)->commit());
        CHECK(folder.text("whole" + extension) == folder.text("streamed" + extension));
    }
    CHECK(folder.names().size() == 6);
}

TEST_CASE("a stream ends when its sink is full, when it is cancelled, and when even it needs too much") {
    const tree::VesselTree tree = test::grown(151);
    Job job;
    Collector small(1);
    const auto full = mesh::stream_surface(tree, {}, small, job);
    REQUIRE(!full);
    CHECK(full.error().what.find("taken") != std::string::npos);

    mesh::SurfaceOptions options;
    options.memory_bytes = 1;
    CHECK(mesh::asks_for_streaming(tree, options));
    CHECK(!mesh::asks_for_streaming(tree, {}));
    Collector any;
    const auto refused = mesh::stream_surface(tree, options, any, job);
    REQUIRE(!refused);
    CHECK(refused.error().hint.find("--memory") != std::string::npos);

    job.cancel();
    const auto cancelled = mesh::stream_surface(tree, {}, any, job);
    REQUIRE(!cancelled);
    CHECK(cancelled.error().what == "cancelled");
}
