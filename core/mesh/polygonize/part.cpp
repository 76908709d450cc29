#include "core/mesh/polygonize/part.h"

#include "core/base/stopwatch.h"
#include "core/mesh/keep_vertices.h"
#include "core/mesh/polygonize/feasible.h"
#include "core/mesh/polygonize/octree/partial_octree.h"
#include "core/mesh/polygonize/surface_batches.h"

#include <algorithm>
#include <limits>
#include <oneapi/tbb/parallel_for.h>
#include <string>
#include <utility>

namespace ramus::mesh {

namespace {

using bricks::SubtreeBatch;
using bricks::SubtreeCounts;
using bricks::SubtreePlaces;
using bricks::SubtreeRange;
using bricks::SubtreeSize;

// Work of a brick, in units of one segment in the list of a brick: an estimate. tests/bench/parts.py shows how even the
// parts are that it gives.
constexpr double kBrickWork = 6.0;

double work_of(const SubtreeSize& size) { return kBrickWork * size.bricks + static_cast<double>(size.segments); }

double work_of_all(std::span<const SubtreeSize> sizes) {
    double all = 0.0;
    for (const SubtreeSize& size : sizes) all += work_of(size);
    return all;
}

// Of the work of all subtrees, the share of those in the set.
double share_of(std::span<const std::uint8_t> set, std::span<const SubtreeSize> sizes) {
    double work = 0.0;
    for (std::size_t t = 0; t < sizes.size(); ++t)
        if (set[t] != 0) work += work_of(sizes[t]);
    return work / std::max(work_of_all(sizes), 1.0);
}

// Consecutive subtrees for each of `count` parts, with about equal work.
std::vector<SubtreeRange> ranges_of(std::span<const SubtreeSize> sizes, std::size_t count) {
    const double all = work_of_all(sizes);
    std::vector<SubtreeRange> ranges;
    double before = 0.0;
    std::uint32_t at = 0;
    for (std::size_t part = 1; part <= count; ++part) {
        const std::uint32_t first = at;
        const double until = all * static_cast<double>(part) / static_cast<double>(count);
        for (; at < sizes.size() && (part == count || before + 0.5 * work_of(sizes[at]) < until); ++at)
            before += work_of(sizes[at]);
        ranges.push_back({first, at});
    }
    return ranges;
}

// Adds all subtrees that touch those in the set.
void add_ring(std::vector<std::uint8_t>& set, std::span<const std::pair<std::uint32_t, std::uint32_t>> touching) {
    const std::vector<std::uint8_t> before = set;
    for (const auto& [a, b] : touching) set[a] |= before[b], set[b] |= before[a];
}

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

// Makes a part: plan(), then work().
class PartMaking {
public:
    // `team`: of which each process makes a part; null: this process counts the work of all parts itself.
    PartMaking(const field::Field& field, const PolygonizeOptions& options, const PartOf& part, Team* team)
        : field_(field), options_(options), part_(part), team_(team),
          sizing_(bricks::make_sizing(field, options.detail, options.cell_mm)), memory_(options.disk) {}

    // Divides the octree, and checks that the own part fits into memory.
    Result<void> plan(Job& job) {
        Stopwatch watch;
        octree_ = std::make_unique<bricks::PartialOctree>(field_, sizing_, job, memory_);
        const std::vector<SubtreeSize> sizes = sizes_of_all(job);
        if (job.cancelled() || sizes.size() < octree_->subtrees()) return fail("cancelled");
        octree_->enter(sizes);
        ranges_ = ranges_of(sizes, part_.count);
        std::vector<std::uint8_t> wanted(sizes.size(), 0);
        std::fill(wanted.begin() + range().first, wanted.begin() + range().end, 1);
        statistics_.share = share_of(wanted, sizes);
        const auto touching = touching_subtrees(octree_->octree());
        add_ring(wanted, touching);
        fill_ = wanted;
        // A subtree that is filled looks at the bricks around it, and these at those around them.
        for (int ring = 0; ring < 2; ++ring) add_ring(wanted, touching);
        const PolygonizeMode mode = options_.disk != nullptr ? PolygonizeMode::kOnDisk : PolygonizeMode::kWhole;
        auto possible = check_feasible(field_, sizing_, options_, mode, share_of(wanted, sizes));
        if (!possible) return possible;
        schedule_ = schedule_subtrees(octree_->octree());
        octree_->build(wanted, job);
        statistics_.bricks_s = watch.lap();
        return job.cancelled() ? fail("cancelled") : Result<void>{};
    }

    Result<void> work(Job& job) {
        batches_ = std::make_unique<bricks::SurfaceBatches>(field_, octree_->octree(), memory_, range());
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

    [[nodiscard]] SubtreeRange range() const { return ranges_[part_.index]; }
    [[nodiscard]] std::span<const SubtreeRange> ranges() const { return ranges_; }
    [[nodiscard]] std::span<const SubtreeBatch> schedule() const { return schedule_; }
    [[nodiscard]] std::span<const std::uint8_t> filled() const { return fill_; }
    // With the vertices of all subtrees that were filled, and the triangles of the own ones.
    [[nodiscard]] TriangleMesh& mesh() { return mesh_; }
    [[nodiscard]] bricks::SurfaceBatches& batches() { return *batches_; }
    [[nodiscard]] PartStatistics& statistics() { return statistics_; }

private:
    // Fewer if cancelled.
    [[nodiscard]] std::vector<SubtreeSize> sizes_of_all(const Job& job) const {
        if (team_ == nullptr) return octree_->sizes(0, 1, job);
        const std::vector<SubtreeSize> own = octree_->sizes(team_->rank(), team_->size(), job);
        const auto told = lists_of_all<SubtreeSize>(*team_, own);
        std::vector<SubtreeSize> all;
        for (std::size_t t = 0; t < octree_->subtrees() && t / told.size() < told[t % told.size()].size(); ++t)
            all.push_back(told[t % told.size()][t / told.size()]);
        return all;
    }

    const field::Field& field_;
    const PolygonizeOptions& options_;
    PartOf part_;
    Team* team_;
    bricks::Sizing sizing_;
    LargeAllocator<std::byte> memory_;
    std::unique_ptr<bricks::PartialOctree> octree_;
    std::vector<SubtreeRange> ranges_; // by part
    std::vector<std::uint8_t> fill_;   // by subtree
    std::vector<SubtreeBatch> schedule_;
    std::unique_ptr<bricks::SurfaceBatches> batches_;
    TriangleMesh mesh_;
    PartStatistics statistics_;
};

// Where all subtrees have their vertices and triangles in the whole mesh: in the order of SurfaceBatches.
struct WholeMesh {
    WholeMesh(std::span<const SubtreeBatch> schedule, std::span<const SubtreeCounts> counts) : places(counts.size()) {
        for (const SubtreeBatch& batch : schedule) {
            for (const std::uint32_t t : batch.fill) places[t].vertices = vertices, vertices += counts[t].vertices;
            for (const std::uint32_t t : batch.join) {
                places[t].added = vertices, vertices += counts[t].added;
                places[t].triangles = triangles, triangles += counts[t].triangles;
            }
        }
    }

    std::vector<SubtreePlaces> places; // by subtree
    std::uint64_t vertices = 0, triangles = 0;
};

// From indices in the mesh of a part to indices in the whole mesh.
class Renumbering {
public:
    Renumbering(const PartMaking& making, std::span<const SubtreeCounts> counts, std::span<const SubtreePlaces> here,
                std::span<const SubtreePlaces> there) {
        const auto add = [&](std::uint64_t from, std::uint64_t to, std::uint32_t count) {
            if (count > 0) runs_.push_back({static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to - from)});
        };
        for (std::uint32_t t = 0; t < counts.size(); ++t) {
            if (making.filled()[t] != 0) add(here[t].vertices, there[t].vertices, counts[t].vertices);
            if (making.range().holds(t)) add(here[t].added, there[t].added, counts[t].added);
        }
        std::ranges::sort(runs_, {}, &Run::first);
        // Subtrees that lie side by side in both meshes are one run.
        const auto same = [](const Run& a, const Run& b) { return a.more == b.more; };
        runs_.erase(std::unique(runs_.begin(), runs_.end(), same), runs_.end());
    }

    void renumber(std::span<glm::uvec3> triangles) const {
        Run last{1, 0};
        std::uint32_t end = 0; // of the last run
        for (glm::uvec3& triangle : triangles)
            for (int corner = 0; corner < 3; ++corner) {
                std::uint32_t& index = triangle[corner];
                if (index < last.first || index >= end) {
                    const auto next = std::ranges::upper_bound(runs_, index, {}, &Run::first);
                    last = *std::prev(next);
                    end = next == runs_.end() ? std::numeric_limits<std::uint32_t>::max() : next->first;
                }
                index += last.more;
            }
    }

private:
    struct Run {
        std::uint32_t first, more; // `more` may wrap around
    };
    std::vector<Run> runs_; // by `first`
};

// What one part has of the whole mesh in one batch: ranges in the mesh of the part and in the whole one.
struct Stretch {
    std::uint64_t from = 0, to = 0, count = 0;
};
struct Stretches {
    Stretch vertices, added, triangles;
};

// Calls call(stretches) batch by batch. `here`: null where only the places in the whole mesh are wanted.
template <class Call>
void for_each_stretch(std::span<const SubtreeBatch> schedule, SubtreeRange range, std::span<const SubtreeCounts> counts,
                      const SubtreePlaces* here, std::span<const SubtreePlaces> there, const Call& call) {
    for (const SubtreeBatch& batch : schedule) {
        Stretches found;
        const auto extend = [&](Stretch& stretch, std::uint32_t t, auto member, auto counted) {
            if (stretch.count == 0) stretch = {here != nullptr ? here[t].*member : 0, there[t].*member, 0};
            stretch.count += counts[t].*counted;
        };
        for (const std::uint32_t t : batch.fill)
            if (range.holds(t)) extend(found.vertices, t, &SubtreePlaces::vertices, &SubtreeCounts::vertices);
        for (const std::uint32_t t : batch.join) {
            if (!range.holds(t)) continue;
            extend(found.added, t, &SubtreePlaces::added, &SubtreeCounts::added);
            extend(found.triangles, t, &SubtreePlaces::triangles, &SubtreeCounts::triangles);
        }
        call(found);
    }
}

// Calls call(array, offset, count) for each stretch of each array, in one order for all processes.
template <class Call> void for_each_piece(TriangleMesh& mesh, const Stretches& at, bool there, const Call& call) {
    const auto offset = [&](const Stretch& stretch) { return there ? stretch.to : stretch.from; };
    for (const Stretch* stretch : {&at.vertices, &at.added})
        mesh.for_each_array([&](auto& array) { call(array, offset(*stretch), stretch->count); });
    call(mesh.triangles, offset(at.triangles), at.triangles.count);
}

// The part of `array` as bytes.
template <class T> std::span<std::byte> bytes_of(LargeArray<T>& array, std::uint64_t offset, std::uint64_t count) {
    return std::as_writable_bytes(std::span(array).subspan(offset, count));
}

// Gives the leader the parts of all.
TriangleMesh gather(Team& team, PartMaking& making, std::span<const SubtreeCounts> counts, const WholeMesh& whole,
                    const LargeAllocator<std::byte>& memory) {
    const std::vector<SubtreePlaces> here(making.batches().places().begin(), making.batches().places().end());
    TriangleMesh part = std::move(making.mesh());
    const auto of_part = [&](std::size_t rank, const SubtreePlaces* places, const auto& call) {
        for_each_stretch(making.schedule(), making.ranges()[rank], counts, places, whole.places, call);
    };
    if (!team.leads()) {
        of_part(team.rank(), here.data(), [&](const Stretches& at) {
            for_each_piece(part, at, false, [&](auto& array, std::uint64_t offset, std::uint64_t count) {
                if (count > 0) team.send(bytes_of(array, offset, count));
            });
        });
        return {};
    }
    TriangleMesh mesh(memory);
    mesh.resize_vertices(whole.vertices);
    mesh.triangles.resize(whole.triangles);
    of_part(0, here.data(), [&](const Stretches& at) {
        for (const Stretch* s : {&at.vertices, &at.added}) bricks::copy_vertices(part, s->from, mesh, s->to, s->count);
        std::copy_n(part.triangles.data() + at.triangles.from, at.triangles.count,
                    mesh.triangles.data() + at.triangles.to);
    });
    part = {};
    for (std::size_t rank = 1; rank < team.size(); ++rank)
        of_part(rank, nullptr, [&](const Stretches& at) {
            for_each_piece(mesh, at, true, [&](auto& array, std::uint64_t offset, std::uint64_t count) {
                if (count > 0) team.receive(rank, bytes_of(array, offset, count));
            });
        });
    return mesh;
}

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
    const SubtreeRange range = making.range();
    for (const auto& told : lists_of_all<SubtreeCounts>(team, own.subspan(range.first, range.end - range.first)))
        counts.insert(counts.end(), told.begin(), told.end());
    const WholeMesh whole(making.schedule(), counts);
    if (whole.vertices >= bricks::kAddedBit)
        return tl::unexpected(result_of(bricks::SurfaceBatches::End::kTooManyVertices, options).error());
    const Renumbering renumbering(making, counts, making.batches().places(), whole.places);
    std::span<glm::uvec3> triangles(making.mesh().triangles);
    constexpr std::size_t kAtOnce = 1 << 16;
    tbb::parallel_for(std::size_t{0}, (triangles.size() + kAtOnce - 1) / kAtOnce, [&](std::size_t n) {
        renumbering.renumber(triangles.subspan(n * kAtOnce, std::min(kAtOnce, triangles.size() - n * kAtOnce)));
    });
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
    return gather(team, making, counts, whole, LargeAllocator<std::byte>(options.disk));
}

} // namespace ramus::mesh
