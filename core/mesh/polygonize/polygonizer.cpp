#include "core/mesh/polygonize/polygonizer.h"

#include "core/base/stopwatch.h"
#include "core/mesh/polygonize/feasible.h"
#include "core/mesh/polygonize/join/join_triangles.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

namespace ramus::mesh {

namespace {

// Share of room that is left in all arrays for what updates will bring.
constexpr double kSlack = 0.25;

// Entries of `a` that are not in `b`, and the other way round: absent there, or different.
void find_changed_segments(const field::ConvolutionField& a, const field::ConvolutionField& b,
                           std::vector<std::uint32_t>& only_a, std::vector<std::uint32_t>& only_b) {
    const bool shared = a.shares_segments(b);
    const auto same = [&](std::uint32_t place) {
        return shared || std::memcmp(&a.segments()[place], &b.segments()[place], sizeof(field::FieldSegment)) == 0;
    };
    auto in_a = a.present().begin();
    auto in_b = b.present().begin();
    while (in_a != a.present().end() || in_b != b.present().end()) {
        if (in_b == b.present().end() || (in_a != a.present().end() && *in_a < *in_b)) {
            only_a.push_back(*in_a++);
        } else if (in_a == a.present().end() || *in_b < *in_a) {
            only_b.push_back(*in_b++);
        } else {
            if (!same(*in_a)) only_a.push_back(*in_a), only_b.push_back(*in_b);
            ++in_a, ++in_b;
        }
    }
}

// Pieces of branches that have changed segments.
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
    std::ranges::sort(both);
    both.erase(std::unique(both.begin(), both.end()), both.end());
    return both;
}

} // namespace

bool Polygonizer::can_follow(const field::ConvolutionField& field, const PolygonizeOptions& options) const {
    if (state_ == nullptr) return false;
    const PolygonizeOptions& now = state_->options;
    // Bricks that are gone are left where they were: once they are most of all, making anew costs less than they do.
    return options.detail == now.detail && options.cell_mm == now.cell_mm && field.frame() == state_->field.frame() &&
           field.kernel().w == state_->field.kernel().w && field.segments().size() == state_->field.segments().size() &&
           octree_.bricks.size() <= 3 * live_bricks_;
}

Result<void> Polygonizer::make(field::ConvolutionField field, const PolygonizeOptions& options, Job& job) {
    const field::CullingSegments culling(field);
    bricks::Sizing sizing = bricks::make_sizing(field, culling.origin, options.detail, options.cell_mm);
    return make(std::make_unique<State>(State{std::move(field), culling, std::move(sizing), options}), job);
}

Result<void> Polygonizer::update(field::ConvolutionField field, const PolygonizeOptions& options, Job& job) {
    const bool follows = can_follow(field, options);
    const field::CullingSegments culling(field);
    bricks::Sizing sizing = bricks::make_sizing(field, culling.origin, options.detail, options.cell_mm);
    auto state = std::make_unique<State>(State{std::move(field), culling, std::move(sizing), options});
    if (!follows) return make(std::move(state), job);
    if (auto possible = check_feasible(state->field, state->sizing, options, Road::kFollow); !possible) return possible;
    if (!follow(std::move(state), job)) {
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
    if (auto possible = check_feasible(state->field, state->sizing, state->options, Road::kFollow); !possible)
        return possible;
    Stopwatch watch;
    octree_ = bricks::build_octree(state->field, state->culling, state->sizing, job);
    std::vector<std::uint32_t> tiles(octree_.tiles.size());
    std::iota(tiles.begin(), tiles.end(), 0U);
    if (!job.cancelled()) bricks::find_neighbours(octree_, tiles, cells_.neighbours);
    statistics_.bricks_s = watch.lap();
    statistics_.bricks = live_bricks_ = octree_.bricks.size();
    job.report(0.15F);
    const auto roomy = [&](auto& array) {
        array.reserve(array.size() + static_cast<std::size_t>(kSlack * static_cast<double>(array.size())));
    };
    roomy(octree_.nodes), roomy(octree_.bricks), roomy(octree_.lists);

    if (!job.cancelled()) bricks::fill_tiles(state->field, octree_, tiles, cells_, JobStretch(job, 0.15F, 0.8F));
    count(tiles);
    statistics_.cells_s = watch.lap();

    if (!job.cancelled()) {
        slots_.place_vertices(octree_, tiles, cells_, kSlack);
        std::vector<bricks::JoinedTile> joined;
        bricks::join_tiles(state->field, octree_, tiles, cells_, vertices_of(slots_.mesh()), joined,
                           JobStretch(job, 0.8F, 0.95F));
        if (!job.cancelled()) slots_.place_triangles(tiles, std::move(joined), kSlack);
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

void Polygonizer::count(std::span<const std::uint32_t> tiles) {
    if (cells_.tiles.empty()) return;
    for (const std::uint32_t tile : tiles) {
        statistics_.evaluations += cells_.tiles[tile].evaluations;
        statistics_.samples += cells_.tiles[tile].samples;
    }
}

// Neighbourhoods of the new tiles and of those beside them. Returns those of the latter whose cells must be found anew:
// where neighbours are finer or coarser than before.
std::vector<std::uint32_t> Polygonizer::find_new_neighbours(const bricks::OctreeChanges& changes) {
    const std::vector<std::uint32_t> beside = bricks::tiles_beside(octree_, changes);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> sizes;
    const auto for_bricks = [&](const auto& call) {
        for (const std::uint32_t tile : beside) {
            const bricks::Tile& t = octree_.tiles[tile];
            for (std::uint32_t b = t.first_brick; b < t.first_brick + t.brick_count; ++b)
                call(tile, cells_.neighbours[b]);
        }
    };
    for_bricks([&](std::uint32_t, const bricks::Neighbourhood& n) { sizes.emplace_back(n.finer, n.coarser); });
    bricks::find_neighbours(octree_, merged(beside, changes.added), cells_.neighbours);
    std::vector<std::uint32_t> refill;
    std::size_t at = 0;
    for_bricks([&](std::uint32_t tile, const bricks::Neighbourhood& n) {
        const bool same = sizes[at++] == std::pair(n.finer, n.coarser);
        if (!same && (refill.empty() || refill.back() != tile)) refill.push_back(tile);
    });
    return refill;
}

bool Polygonizer::follow(std::unique_ptr<State> state, Job& job) {
    statistics_ = {};
    Stopwatch watch;
    bricks::TreeState before{state_->field, state_->culling, state_->sizing, {}, {}};
    bricks::TreeState after{state->field, state->culling, state->sizing, {}, {}};
    find_changed_segments(before.field, after.field, before.changed_segments, after.changed_segments);
    std::vector<std::uint8_t> branches;
    for (const bricks::TreeState* tree : {&before, &after})
        for (const std::uint32_t place : tree->changed_segments) {
            const auto branch = static_cast<std::size_t>(tree->field.segments()[place].branch);
            if (branch >= branches.size()) branches.resize(branch + 1, 0);
            branches[branch] = 1;
        }
    before.changed_pieces = pieces_of(before.sizing, branches);
    after.changed_pieces = pieces_of(after.sizing, branches);
    bricks::OctreeChanges changes = bricks::update_octree(octree_, before, after, job);
    state_ = std::move(state);
    if (job.cancelled()) return false;
    for (const std::uint32_t tile : changes.removed) {
        slots_.remove(tile);
        cells_.tiles[tile] = {};
        live_bricks_ -= octree_.tiles[tile].brick_count;
    }
    for (const std::uint32_t tile : changes.added) live_bricks_ += octree_.tiles[tile].brick_count;
    const std::vector<std::uint32_t> resized = find_new_neighbours(changes);
    const std::vector<std::uint32_t> refill = merged(changes.added, resized);
    statistics_.bricks_s = watch.lap();
    statistics_.bricks = octree_.bricks.size();

    for (const std::uint32_t tile : resized) {
        slots_.remove(tile);
        changes.tiles[tile] = 1;
        changes.mark(octree_, octree_.tiles[tile].parent);
    }
    bricks::fill_tiles(state_->field, octree_, refill, cells_, JobStretch(job, 0.15F, 0.8F));
    if (job.cancelled()) return false;
    count(refill);
    statistics_.cells_s = watch.lap();

    slots_.place_vertices(octree_, refill, cells_, kSlack);
    std::vector<std::uint32_t> beside = bricks::tiles_beside(octree_, changes);
    std::erase_if(beside, [&](std::uint32_t tile) { return !bricks::reaches_beyond(octree_, cells_, tile, changes); });
    for (const std::uint32_t tile : beside) slots_.remove_triangles(tile);
    const std::vector<std::uint32_t> rejoin = merged(refill, beside);
    std::vector<bricks::JoinedTile> joined;
    bricks::join_tiles(state_->field, octree_, rejoin, cells_, vertices_of(slots_.mesh()), joined,
                       JobStretch(job, 0.8F, 0.95F));
    if (job.cancelled()) return false;
    slots_.place_triangles(rejoin, std::move(joined), kSlack);
    statistics_.join_s = watch.lap();
    return true;
}

SurfaceEdit Polygonizer::take_edit() {
    SurfaceEdit edit = slots_.take_edit();
    edit.whole = std::exchange(whole_, false);
    return edit;
}

} // namespace ramus::mesh
