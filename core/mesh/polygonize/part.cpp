#include "core/mesh/polygonize/part.h"

#include "core/mesh/keep_vertices.h"
#include "core/mesh/polygonize/feasible.h"
#include "core/mesh/polygonize/parts/part_making.h"
#include "core/mesh/polygonize/parts/whole_mesh.h"

#include <string>
#include <utility>

namespace ramus::mesh {

using bricks::PartMaking;
using bricks::SubtreeCounts;

namespace {

// The first error of all processes.
Result<void> agree(Team& team, const Result<void>& own) {
    const std::string message = own ? std::string() : own.error().message();
    const auto told = lists_of_all<char>(team, message);
    for (std::size_t rank = 0; rank < told.size(); ++rank)
        if (!told[rank].empty()) return fail(std::string(told[rank].begin(), told[rank].end()));
    return {};
}

} // namespace

void PartStatistics::add(const PartStatistics& more) {
    evaluations += more.evaluations, samples += more.samples, bricks += more.bricks;
    bricks_s += more.bricks_s, cells_s += more.cells_s, join_s += more.join_s;
    border_evaluations += more.border_evaluations;
    share = more.share;
    find_s += more.find_s;
}

Result<TriangleMesh> polygonize_part(const field::Field& field, const PolygonizeOptions& options, const PartOf& part,
                                     Job& job, PartStatistics* statistics) {
    if (auto some = check_segments(field); !some) return tl::unexpected(some.error());
    PartMaking making(field, options, part, nullptr);
    if (auto planned = making.plan(job); !planned) return tl::unexpected(planned.error());
    if (auto made = making.work(job); !made) return tl::unexpected(made.error());
    if (statistics != nullptr) *statistics = making.statistics();
    TriangleMesh mesh = std::move(making.mesh());
    keep_used_vertices(mesh);
    return mesh;
}

Result<TriangleMesh> polygonize_together(const field::Field& field, const PolygonizeOptions& options, Team& team,
                                         Job& job, PartStatistics* statistics, std::vector<Bounds<glm::vec3>>* walled) {
    if (auto some = check_segments(field); !some) return tl::unexpected(some.error());
    PartMaking making(field, options, {team.rank(), team.size()}, &team);
    if (auto planned = agree(team, making.plan(job)); !planned) return tl::unexpected(planned.error());
    if (auto made = agree(team, making.work(job)); !made) return tl::unexpected(made.error());
    const std::span<const SubtreeCounts> own = making.batches().counts();
    std::vector<SubtreeCounts> counts;
    const bricks::SubtreeRange range = making.range();
    for (const auto& told : lists_of_all<SubtreeCounts>(team, own.subspan(range.first, range.end - range.first)))
        counts.insert(counts.end(), told.begin(), told.end());
    const bricks::WholeMesh whole(making.schedule(), counts);
    if (whole.vertices >= bricks::kAddedBit)
        return tl::unexpected(result_of(bricks::SurfaceBatches::End::kTooManyVertices, options).error());
    renumber_for_whole(making, counts, whole);
    if (statistics != nullptr) {
        *statistics = making.statistics();
        statistics->evaluations = 0;
        for (const auto& one : lists_of_all<std::uint64_t>(team, std::span(&making.statistics().evaluations, 1)))
            statistics->evaluations += one.front();
    }
    if (walled != nullptr) {
        walled->clear();
        const std::vector<Bounds<glm::vec3>> boxes = making.batches().take_walled();
        for (const auto& told : lists_of_all<Bounds<glm::vec3>>(team, boxes))
            walled->insert(walled->end(), told.begin(), told.end());
    }
    return bricks::gather(team, making, counts, whole, LargeAllocator<std::byte>(options.disk));
}

} // namespace ramus::mesh
