#include "core/mesh/polygonize/polygonizer.h"

#include "core/base/sort_unique.h"
#include "core/base/stopwatch.h"
#include "core/mesh/polygonize/feasible.h"
#include "core/mesh/polygonize/join/join_triangles.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace ramus::mesh {

namespace {

// The share of capacity that arrays reserve for updates.
constexpr double kReserve = 0.25;

// The sizing pieces of branches with changed segments.
std::vector<std::uint32_t> pieces_of(const bricks::Sizing& sizing, const std::vector<std::uint8_t>& branches) {
    std::vector<std::uint32_t> pieces;
    for (std::uint32_t p = 0; p < sizing.pieces.size(); ++p) {
        const auto branch = static_cast<std::size_t>(sizing.pieces[p].branch);
        if (branch < branches.size() && branches[branch] != 0) pieces.push_back(p);
    }
    return pieces;
}

std::vector<std::uint32_t> merged(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
    std::vector<std::uint32_t> both(a);
    both.insert(both.end(), b.begin(), b.end());
    sort_unique(both);
    return both;
}

} // namespace

std::optional<field::SegmentChanges> Polygonizer::changes_to(const field::Field& field,
                                                             const PolygonizeOptions& options) const {
    if (state_ == nullptr) return std::nullopt;
    const PolygonizeOptions& now = state_->options;
    // Removed bricks stay in their array. Once most bricks are removed ones, computing from scratch is cheaper.
    if (options.detail != now.detail || options.cell_mm != now.cell_mm || octree_.bricks.size() > 3 * live_bricks_)
        return std::nullopt;
    return field.changes_since(state_->field);
}

Result<void> Polygonizer::make(field::Field field, const PolygonizeOptions& options, Job& job) {
    bricks::Sizing sizing = bricks::make_sizing(field, options.detail, options.cell_mm);
    return make(std::make_unique<State>(State{std::move(field), std::move(sizing), options}), job);
}

Result<void> Polygonizer::update(field::Field field, const PolygonizeOptions& options, Job& job) {
    const auto changes = changes_to(field, options);
    bricks::Sizing sizing = bricks::make_sizing(field, options.detail, options.cell_mm);
    auto state = std::make_unique<State>(State{std::move(field), std::move(sizing), options});
    if (!changes) return make(std::move(state), job);
    if (auto possible = check_feasible(state->field, state->sizing, options, PolygonizeMode::kFollow); !possible)
        return possible;
    if (!follow(std::move(state), *changes, job)) {
        clear();
        return fail("cancelled");
    }
    job.report(1.0F);
    return {};
}

void Polygonizer::clear() {
    state_.reset();
    octree_ = {};
    cells_ = {};
    slots_ = {};
    statistics_ = {};
    live_bricks_ = 0;
}

Result<void> Polygonizer::make(std::unique_ptr<State> state, Job& job) {
    clear();
    whole_ = true;
    if (auto possible = check_feasible(state->field, state->sizing, state->options, PolygonizeMode::kFollow); !possible)
        return possible;
    Stopwatch watch;
    octree_ = bricks::build_octree(state->field, state->sizing, job);
    std::vector<std::uint32_t> subtrees(octree_.subtrees.size());
    std::iota(subtrees.begin(), subtrees.end(), 0U);
    if (!job.cancelled()) bricks::find_neighbours(octree_, subtrees, cells_.neighbours);
    statistics_.bricks_s = watch.lap();
    statistics_.bricks = live_bricks_ = octree_.bricks.size();
    job.report(0.15F);
    const auto reserve_more = [&](auto& array) {
        array.reserve(array.size() + static_cast<std::size_t>(kReserve * static_cast<double>(array.size())));
    };
    reserve_more(octree_.nodes), reserve_more(octree_.bricks), reserve_more(octree_.lists);

    if (!job.cancelled()) bricks::fill_subtrees(state->field, octree_, subtrees, cells_, JobRange(job, 0.15F, 0.8F));
    count(subtrees);
    statistics_.cells_s = watch.lap();

    if (!job.cancelled()) {
        slots_.place_vertices(octree_, subtrees, cells_, kReserve);
        std::vector<bricks::JoinedSubtree> joined;
        bricks::join_subtrees(state->field, octree_, subtrees, cells_, vertices_of(slots_.mesh()), joined,
                              JobRange(job, 0.8F, 0.95F));
        if (!job.cancelled()) slots_.place_triangles(subtrees, std::move(joined), kReserve);
    }
    statistics_.join_s = watch.lap();
    if (job.cancelled()) {
        clear();
        return fail("cancelled");
    }
    state_ = std::move(state);
    job.report(1.0F);
    return {};
}

void Polygonizer::count(std::span<const std::uint32_t> subtrees) {
    if (cells_.subtrees.empty()) return;
    for (const std::uint32_t subtree : subtrees) {
        statistics_.evaluations += cells_.subtrees[subtree].counts.evaluations;
        statistics_.samples += cells_.subtrees[subtree].counts.samples;
    }
}

// Finds the neighbourhoods of the new subtrees and of adjacent ones. Returns the adjacent subtrees whose cells must be
// computed again, since they have neighbours that are finer or coarser than before.
std::vector<std::uint32_t> Polygonizer::find_new_neighbours(const bricks::OctreeChanges& changes) {
    const std::vector<std::uint32_t> beside = bricks::subtrees_beside(octree_, changes);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> sizes;
    const auto for_bricks = [&](const auto& call) {
        for (const std::uint32_t subtree : beside) {
            const bricks::Subtree& t = octree_.subtrees[subtree];
            for (std::uint32_t b = t.first_brick; b < t.first_brick + t.brick_count; ++b)
                call(subtree, cells_.neighbours[b]);
        }
    };
    for_bricks([&](std::uint32_t, const bricks::Neighbourhood& n) { sizes.emplace_back(n.finer, n.coarser); });
    bricks::find_neighbours(octree_, merged(beside, changes.added), cells_.neighbours);
    std::vector<std::uint32_t> refill;
    std::size_t at = 0;
    for_bricks([&](std::uint32_t subtree, const bricks::Neighbourhood& n) {
        const bool same = sizes[at++] == std::pair(n.finer, n.coarser);
        if (!same && (refill.empty() || refill.back() != subtree)) refill.push_back(subtree);
    });
    return refill;
}

// The unchanged subtrees whose cells depend on changed parts, since Specks looked beyond the subtree.
std::vector<std::uint32_t> Polygonizer::find_lookers(const bricks::OctreeChanges& changes) {
    std::vector<std::uint32_t> beside = bricks::subtrees_beside(octree_, changes);
    bricks::OctreeChanges around = changes;
    for (const std::uint32_t subtree : beside) {
        around.subtrees[subtree] = 1;
        around.mark(octree_, octree_.subtrees[subtree].parent);
    }
    std::vector<std::uint32_t> far = bricks::subtrees_beside(octree_, around);
    std::erase_if(beside, [&](std::uint32_t subtree) { return !cells_.subtrees[subtree].looked_beyond; });
    std::erase_if(far, [&](std::uint32_t subtree) { return !cells_.subtrees[subtree].looked_far; });
    return merged(beside, far);
}

bool Polygonizer::follow(std::unique_ptr<State> state, const field::SegmentChanges& segments, Job& job) {
    statistics_ = {};
    Stopwatch watch;
    bricks::TreeState before{state_->field, state_->sizing, segments.before, {}};
    bricks::TreeState after{state->field, state->sizing, segments.after, {}};
    std::vector<std::uint8_t> branches;
    for (const bricks::TreeState* tree : {&before, &after})
        for (const std::uint32_t segment : tree->changed_segments) {
            const auto branch = static_cast<std::size_t>(tree->field.skeleton().segments()[segment].branch);
            if (branch >= branches.size()) branches.resize(branch + 1, 0);
            branches[branch] = 1;
        }
    before.changed_pieces = pieces_of(before.sizing, branches);
    after.changed_pieces = pieces_of(after.sizing, branches);
    bricks::OctreeChanges changes = bricks::update_octree(octree_, before, after, job);
    state_ = std::move(state);
    if (job.cancelled()) return false;
    for (const std::uint32_t subtree : changes.removed) {
        slots_.remove(subtree);
        cells_.subtrees[subtree] = {};
        live_bricks_ -= octree_.subtrees[subtree].brick_count;
    }
    for (const std::uint32_t subtree : changes.added) live_bricks_ += octree_.subtrees[subtree].brick_count;
    std::vector<std::uint32_t> refill = find_new_neighbours(changes);
    const auto take_for_new = [&](std::uint32_t subtree) {
        slots_.remove(subtree);
        changes.subtrees[subtree] = 1;
        changes.mark(octree_, octree_.subtrees[subtree].parent);
    };
    std::ranges::for_each(refill, take_for_new);
    const std::vector<std::uint32_t> lookers = find_lookers(changes);
    std::ranges::for_each(lookers, take_for_new);
    refill = merged(changes.added, merged(refill, lookers));
    statistics_.bricks_s = watch.lap();
    statistics_.bricks = octree_.bricks.size();

    bricks::fill_subtrees(state_->field, octree_, refill, cells_, JobRange(job, 0.15F, 0.8F));
    if (job.cancelled()) return false;
    count(refill);
    statistics_.cells_s = watch.lap();

    slots_.place_vertices(octree_, refill, cells_, kReserve);
    std::vector<std::uint32_t> beside = bricks::subtrees_beside(octree_, changes);
    std::erase_if(beside,
                  [&](std::uint32_t subtree) { return !bricks::reaches_beyond(octree_, cells_, subtree, changes); });
    for (const std::uint32_t subtree : beside) slots_.remove_triangles(subtree);
    const std::vector<std::uint32_t> rejoin = merged(refill, beside);
    std::vector<bricks::JoinedSubtree> joined;
    bricks::join_subtrees(state_->field, octree_, rejoin, cells_, vertices_of(slots_.mesh()), joined,
                          JobRange(job, 0.8F, 0.95F));
    if (job.cancelled()) return false;
    slots_.place_triangles(rejoin, std::move(joined), kReserve);
    statistics_.join_s = watch.lap();
    return true;
}

std::vector<Bounds<glm::vec3>> Polygonizer::walled() const {
    std::vector<Bounds<glm::vec3>> boxes;
    for (const bricks::SubtreeCells& subtree : cells_.subtrees)
        for (const std::uint32_t brick : subtree.walled_bricks) boxes.push_back(bricks::box_of_brick(octree_, brick));
    return boxes;
}

SurfaceEdit Polygonizer::take_edit() {
    SurfaceEdit edit = slots_.take_edit();
    edit.whole = std::exchange(whole_, false);
    return edit;
}

} // namespace ramus::mesh
