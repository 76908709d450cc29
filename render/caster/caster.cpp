#include "render/caster/caster.h"

#include "render/caster/stages.h"
#include "render/scene/record_flags.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace ramus::render::caster {

using namespace record;

namespace {

// Uses the shaders' code for the steps of outlines and halos.
struct RingSteps : LookBlock {
    static float cos(float x) { return std::cos(x); }
    static float sin(float x) { return std::sin(x); }
    static vec2 round(vec2 v) { return glm::round(v); }
#include "shaders/look/ring.glsl"
};

} // namespace

// From this many glass cones in a tile, half as many samples look the same, because the vessels are thinner than pixels
// and in many layers. Tuned on the kidney of 78,000 segments, which takes a third of a second per picture without it.
constexpr std::size_t kCrowded = 64;

struct Caster::Scratches {
    struct Scratch {
        Samples samples;
        Colours colours;
        Bins triangle_blocks, cone_blocks;
        std::vector<std::uint32_t> order, words = std::vector<std::uint32_t>(3 * kMaxFragmentsOfTile);
        std::vector<float> floats = std::vector<float>(2 * kMaxFragmentsOfTile);

        [[nodiscard]] Records records(bool with_values) {
            std::uint32_t* w = words.data();
            float* f = floats.data();
            return {w,
                    w + kMaxFragmentsOfTile,
                    w + 2 * kMaxFragmentsOfTile,
                    f,
                    with_values ? f + kMaxFragmentsOfTile : nullptr,
                    0};
        }
    };
    tbb::enumerable_thread_specific<std::unique_ptr<Scratch>> all{[] { return std::make_unique<Scratch>(); }};
};

// Vectors read beyond the end, where values must be initialised.
void Caster::KeptRecords::keep(const Records& records) {
    count = records.count;
    if (count == 0) return;
    const auto copy = [&](auto& to, const auto* from, auto filler) {
        to.assign(from, from + count);
        to.resize(count + 16, filler);
    };
    copy(position, records.position, 0U);
    copy(id, records.id, 1U);
    copy(normal, records.normal, 0U);
    copy(depth, records.depth, 1.0F);
    value.clear();
    if (records.value != nullptr) copy(value, records.value, 0.0F);
}

Records Caster::KeptRecords::view() {
    return {position.data(), id.data(), normal.data(), depth.data(), value.empty() ? nullptr : value.data(), count};
}

bool Caster::draws(const Frame& frame) {
    if (frame.only_mesh || frame.cut_away) return false;
    // A cone has one value per point: diameters and positions of cuts exclude each other.
    const bool whole = std::ranges::all_of(frame.lost, &LostPart::whole);
    // Cones have no values of vertices, and of centerlines only the data of their shape.
    using Value = ColourScale::Value;
    if (frame.scale.value == Value::kSurface || frame.scale.value == Value::kOfLines) return false;
    return whole || frame.scale.value != Value::kDiameter;
}

void Caster::resize(const View& view) {
    const bool same_reach = view.block.depth_range.z == view_.block.depth_range.z;
    if (view.width == view_.width && view.height == view_.height && same_reach && !rgba_.empty()) return;
    rgba_.clear(); // valid only once everything is allocated: memory may run out
    across_ = (view.width + kTile - 1) / kTile;
    up_ = (view.height + kTile - 1) / kTile;
    // Taps to the left and right of the picture read the padding.
    const std::size_t pixels = std::size_t(view.stride) * std::size_t(up_ * kTile) + 2 * kTile;
    for (auto* array : {&depths_, &picked_}) array->assign(pixels, kNothing);
    for (auto* array : {&rough_sky_, &smooth_sky_, &rough_key_, &smooth_key_}) array->assign(pixels, 0.0F);
    for (auto* array : {&ids_, &normals_}) array->assign(pixels, 0);
    tiles_ = std::vector<Tile>(std::size_t(across_) * std::size_t(up_));
    // The same holds for the padding beside the picture.
    const auto beside = static_cast<std::ptrdiff_t>(view.block.depth_range.z) / 4 + 2;
    const std::ptrdiff_t plane_stride = view.stride / 4 + 2 * beside, plane_size = plane_stride * view.height;
    depth_planes_.assign(4 * std::size_t(plane_size), kNothing);
    const auto inside = [](auto& array) { return array.data() + kTile; };
    picture_ = {inside(depths_),
                inside(picked_),
                inside(ids_),
                inside(normals_),
                depth_planes_.data() + beside,
                plane_stride,
                plane_size,
                {inside(rough_sky_), inside(smooth_sky_)},
                {inside(rough_key_), inside(smooth_key_)}};
    rgba_.assign(std::size_t(view.width) * std::size_t(view.height), 0);
}

template <class Call> void Caster::for_tiles(const Call& call) const {
    tbb::parallel_for(tbb::blocked_range<int>(0, across_ * up_, 4), [&](const auto& range) {
        for (int tile = range.begin(); tile < range.end(); ++tile) call(tile);
    });
}

void Caster::cast(int index, const Binned& binned, const Slicer& slicer, bool with_values) {
    Scratches::Scratch& scratch = *scratches_->all.local();
    Tile& tile = tiles_[std::size_t(index)];
    const TileTask task{view_, vessels_.field(), with_values, left(index), low(index)};
    const auto in_tile = [&](const Bins& bins) { return bins.of(std::size_t(index)); };
    const auto sorted = [&](const Bins& bins) {
        const std::span<const std::uint32_t> here = in_tile(bins);
        scratch.order.assign(here.begin(), here.end());
        std::ranges::sort(scratch.order, [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(cones_.cones[a].nearest_depth, a) < std::pair(cones_.cones[b].nearest_depth, b);
        });
        return TileCones{cones_.cones.data(), scratch.order.data(), scratch.order.size()};
    };
    const auto in_blocks = [&](const std::vector<Triangle>& all, const Bins& bins) {
        return by_block(all, in_tile(bins), task.x, task.y, scratch.triangle_blocks);
    };
    cast_tile(task, sorted(binned.opaque), scratch.samples);
    if (!in_tile(binned.solid_triangles).empty())
        raster_tile(task, in_blocks(solid_triangles_, binned.solid_triangles), scratch.samples);
    Records opaque = scratch.records(with_values);
    resolve_tile(task, scratch.samples, picture_, opaque);
    if (view_.taps > 0 || view_.shadows) split_depths(task.x, task.y, view_, picture_);
    tile.slices.clear();
    if (slicer.reaches(task)) slicer.lay(task, scratch.samples, picture_, opaque, tile.slices);
    tile.opaque.keep(opaque);
    tile.glass.count = 0;
    const TileCones glass_cones = sorted(binned.glass);
    if (glass_cones.count == 0 && in_tile(binned.clear_triangles).empty()) return;
    Records glass = scratch.records(false);
    const BlockCones cone_blocks = by_block(cones_.cones, scratch.order, task.x, task.y, scratch.cone_blocks);
    list_fragments(task, cone_blocks, in_blocks(clear_triangles_, binned.clear_triangles), scratch.samples,
                   glass_cones.count > kCrowded, picture_, glass);
    tile.glass.keep(glass);
}

Caster::Binned Caster::bin() const {
    const auto of_kind = [&](ConeList::Kind kind) {
        return bins_of(across_, up_, cones_.cones, [&](std::size_t i) { return cones_.kinds[i] == kind; });
    };
    const bool glass = std::ranges::find(cones_.kinds, ConeList::Kind::kGlass) != cones_.kinds.end();
    return {of_kind(ConeList::Kind::kOpaque),
            glass ? of_kind(ConeList::Kind::kGlass) : bins_of(across_, up_, std::vector<Triangle>()),
            bins_of(across_, up_, solid_triangles_), bins_of(across_, up_, clear_triangles_)};
}

// Computes occlusion and shadows. Denoises after all tiles are complete, since it reads neighbouring tiles.
void Caster::occlude() {
    if (view_.taps == 0) std::ranges::fill(smooth_sky_, 0.0F);
    if (view_.taps == 0 && !view_.shadows) return;
    const Taps taps = taps_of(view_);
    const ShadowRays rays = shadow_rays();
    for_tiles([&](int tile) {
        const int column = tile % across_;
        if (column % kOccludedTiles != 0) return;
        const auto first = tiles_.begin() + tile;
        if (std::none_of(first, first + std::min(kOccludedTiles, across_ - column),
                         [](const Tile& one) { return one.opaque.count > 0; }))
            return;
        if (view_.taps > 0) occlude_tiles(view_, taps, left(tile), low(tile), picture_);
        if (view_.shadows) shadow_tiles(view_, rays, left(tile), low(tile), picture_);
    });
    for_tiles([&](int tile) {
        if (tiles_[std::size_t(tile)].opaque.count == 0) return;
        if (view_.taps > 0) smooth_tile(view_, left(tile), low(tile), picture_.depth, picture_.sky);
        if (view_.shadows) smooth_tile(view_, left(tile), low(tile), picture_.depth, picture_.key);
    });
}

Shading Caster::shading_of(const Frame& frame, const Content& content) const {
    Shading shading{};
    shading.uniforms = content.uniforms;
    shading.width = view_.width;
    shading.height = view_.height;
    shading.stride = view_.stride;
    shading.branches = reinterpret_cast<const std::uint32_t*>(content.records.data());
    RingSteps ring{content.uniforms};
    for (int i = 0; i < 12; ++i) {
        shading.outline_ring[i] = ring.outline_step(i);
        shading.halo_ring[i] = ring.halo_step(i);
    }
    shading.slice_light = light_of_bytes();
    shading.lesions = content.data.lesions.data();
    shading.cuts = content.data.cuts.data();
    shading.shapes = content.data.shapes.empty() ? nullptr : &content.data.shapes.front().x;
    if (!frame.scale.ramp.empty()) shading.ramp = &frame.scale.ramp.front().x;
    shading.ramp_steps = static_cast<int>(frame.scale.ramp.size());
    if (content.uniforms.counts.w == 0.0F) return shading;
    const DistanceGrid& grid = *frame.lesions.distances;
    shading.grid.values = grid.values.data();
    for (int i = 0; i < 3; ++i) { // texture coordinates to samples
        const auto size = static_cast<float>(grid.size[i]);
        shading.grid.size[i] = grid.size[i];
        shading.grid.from_eye[i] = size * glm::row(content.uniforms.eye_to_grid, i) - vec4(0.0F, 0.0F, 0.0F, 0.5F);
    }
    return shading;
}

// By tile. An outline reaches at most into adjacent tiles.
std::vector<std::uint8_t> Caster::tiles_with_outline(const Content& content) const {
    std::vector<std::uint8_t> found(tiles_.size(), 0);
    if (!content.outlined) return found;
    const auto any_selected = [&](const KeptRecords& records) {
        return std::any_of(records.id.begin(), records.id.begin() + std::ptrdiff_t(records.count),
                           [&](std::uint32_t id) {
                               const std::size_t branch = (id & ~kLine) - 1;
                               return branch < content.records.size() && (content.records[branch][3] & kSelected) != 0;
                           });
    };
    for (int tile = 0; tile < across_ * up_; ++tile) {
        const Tile& at = tiles_[std::size_t(tile)];
        if (!any_selected(at.opaque) && !any_selected(at.glass)) continue;
        const int x = tile % across_, y = tile / across_;
        for (int ty = std::max(y - 1, 0); ty <= std::min(y + 1, up_ - 1); ++ty)
            for (int tx = std::max(x - 1, 0); tx <= std::min(x + 1, across_ - 1); ++tx)
                found[std::size_t(ty * across_ + tx)] = 1;
    }
    return found;
}

void Caster::shade(const Shading& shading, const std::vector<std::uint8_t>& outlined) {
    for_tiles([&](int index) {
        Tile& tile = tiles_[std::size_t(index)];
        Shading here = shading;
        here.outlined = outlined[std::size_t(index)] != 0;
        shade_tile(here, tile.opaque.view(), tile.glass.view(), picture_,
                   {left(index), low(index), scratches_->all.local()->colours, rgba_.data(), tile.slices.data(),
                    tile.slices.size()});
    });
}

std::size_t Caster::draw(const Frame& frame, const View& view, const glm::dmat4& to_eye, const Content& content) {
    if (!scratches_) scratches_ = std::make_shared<Scratches>();
    resize(view);
    view_ = view;
    const std::size_t drawn = vessels_.prepare(frame, view_, to_eye, content.layers, cones_);
    append_lesions(view_, content.data, cones_);
    solid_triangles_.clear();
    clear_triangles_.clear();
    const bool with_values = content.uniforms.scale.w > 0.0F || !content.data.cuts.empty();
    if (content.surface != nullptr && !with_values) {
        const Surface surface{*content.surface, to_eye, content.surface_to_clip};
        draw_thick_vessels(surface, view_, cones_, solid_triangles_);
    }
    for (const Body& body : content.bodies)
        project_triangles(body, view_, to_eye, body.clear ? clear_triangles_ : solid_triangles_);
    const Binned binned = bin();
    const Slicer slicer(content.planes, frame.planes);
    for_tiles([&](int tile) { cast(tile, binned, slicer, with_values); });
    occlude();
    shade(shading_of(frame, content), tiles_with_outline(content));
    return drawn;
}

} // namespace ramus::render::caster
