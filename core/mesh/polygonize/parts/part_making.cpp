#include "core/mesh/polygonize/parts/part_making.h"

#include "core/base/stopwatch.h"
#include "core/mesh/polygonize/feasible.h"
#include "core/mesh/polygonize/octree/neighbours.h"
#include "core/mesh/polygonize/parts/division.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ramus::mesh::bricks {

namespace {

// The batches with only what `fill` and `own` hold.
std::vector<SubtreeBatch> batches_of_part(std::span<const SubtreeBatch> schedule, std::span<const std::uint8_t> fill,
                                          SubtreeRange own) {
    std::vector<SubtreeBatch> batches;
    for (const SubtreeBatch& whole : schedule) {
        SubtreeBatch batch;
        std::ranges::copy_if(whole.fill, std::back_inserter(batch.fill), [&](auto t) { return fill[t] != 0; });
        std::ranges::copy_if(whole.join, std::back_inserter(batch.join), [&](auto t) { return own.holds(t); });
        std::ranges::copy_if(whole.drop, std::back_inserter(batch.drop), [&](auto t) { return fill[t] != 0; });
        if (!batch.fill.empty() || !batch.join.empty() || !batch.drop.empty()) batches.push_back(std::move(batch));
    }
    return batches;
}

} // namespace

PartMaking::PartMaking(const field::Field& field, const PolygonizeOptions& options, const PartOf& part, Team* team)
    : field_(field), options_(options), part_(part), team_(team), memory_(options.disk),
      sizing_(make_sizing(field, options.detail, options.cell_mm, memory_)) {}

Result<void> PartMaking::plan(Job& job) {
    Stopwatch watch;
    octree_ = std::make_unique<PartialOctree>(field_, sizing_, part_.count, job, memory_);
    const Stopwatch finding;
    const std::vector<FoundSubtrees> found = found_by_all(job);
    statistics_.find_s = finding.seconds();
    std::size_t groups = 0;
    for (const FoundSubtrees& some : found) groups += some.groups.size();
    if (job.cancelled() || groups < octree_->groups()) return fail("cancelled");
    const std::vector<SubtreeSize> sizes = octree_->enter(found);
    const auto pairs = touching_subtrees(octree_->octree(), memory_);
    const Touching touching = touching_each(pairs, sizes.size(), memory_);
    ranges_ = divided(octree_->octree(), sizes, touching, part_.count);
    std::vector<std::uint8_t> wanted(sizes.size(), 0);
    std::fill(wanted.begin() + range().first, wanted.begin() + range().end, 1);
    statistics_.share = share_of_work(sizes, range());
    // Joining asks for cells in the subtrees around. Filling these looks at the bricks around them, and these at
    // those around them.
    for (int ring = 0; ring < 3; ++ring) add_ring(wanted, touching);
    const PolygonizeMode mode = options_.disk != nullptr ? PolygonizeMode::kOnDisk : PolygonizeMode::kWhole;
    auto possible = check_feasible(field_, sizing_, options_, mode, share_of_bricks(sizes, wanted));
    if (!possible) return possible;
    schedule_ = schedule_subtrees(octree_->octree(), pairs);
    octree_->build(wanted, job);
    if (job.cancelled()) return fail("cancelled");
    fill_ = subtrees_to_fill(octree_->octree(), range(), touching);
    statistics_.bricks_s = watch.lap();
    return {};
}

Result<void> PartMaking::work(Job& job) {
    batches_ = std::make_unique<SurfaceBatches>(field_, octree_->octree(), memory_, range());
    const auto end = batches_->work(batches_of_part(schedule_, fill_, range()), job);
    const double octree_s = statistics_.bricks_s;
    static_cast<PolygonizeStatistics&>(statistics_) = batches_->statistics();
    statistics_.bricks_s = octree_s;
    statistics_.border_evaluations = batches_->border_evaluations();
    for (std::uint32_t t = range().first; t < range().end; ++t)
        statistics_.bricks += octree_->octree().subtrees[t].brick_count;
    mesh_ = batches_->take();
    return result_of(end, options_);
}

std::vector<FoundSubtrees> PartMaking::found_by_all(const Job& job) const {
    if (team_ == nullptr) return {octree_->find(0, 1, job)};
    const FoundSubtrees own = octree_->find(team_->rank(), team_->size(), job);
    auto groups = lists_of_all<FoundSubtrees::Group>(*team_, own.groups);
    auto upper = lists_of_all<FoundUpper>(*team_, own.upper);
    auto subtrees = lists_of_all<FoundSubtrees::One>(*team_, own.subtrees);
    std::vector<FoundSubtrees> all;
    for (std::size_t rank = 0; rank < team_->size(); ++rank)
        all.push_back({std::move(groups[rank]), std::move(upper[rank]), std::move(subtrees[rank])});
    return all;
}

} // namespace ramus::mesh::bricks
