#include "render/caster/caster.h"

#include "render/caster/cast.h"
#include "render/caster/occlude.h"
#include "render/caster/panes.h"
#include "render/caster/raster.h"
#include "render/caster/shade.h"
#include "render/scene/record_flags.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace ramus::render::caster {

using namespace record;

namespace {

// What a thread works in.
struct Scratch {
    Samples samples;
    Colours colours;
    BlockBins blocks;
    std::vector<std::uint32_t> order, words;
    std::vector<float> floats;
};

} // namespace

bool Caster::draws(const Frame& frame) {
    // A place on a vessel has one value: its diameter cannot go with where it is cut.
    const bool whole = std::ranges::all_of(frame.lost, &LostPart::whole);
    return whole || frame.scale.value != ColourScale::Value::kDiameter;
}

void Caster::make_room(const View& view) {
    const bool same_reach = view.reach_pixels == view_.reach_pixels;
    if (view.width == view_.width && view.height == view_.height && same_reach && !rgba_.empty()) return;
    across_ = (view.width + kTile - 1) / kTile;
    up_ = (view.height + kTile - 1) / kTile;
    // Taps to the left and right of the picture read the padding.
    const std::size_t pixels = std::size_t(view.stride) * std::size_t(up_ * kTile) + 2 * kTile;
    for (auto* array : {&depths_, &picked_}) array->assign(pixels, kNothing);
    for (auto* array : {&occlusion_, &smooth_}) array->assign(pixels, 0.0F);
    for (auto* array : {&ids_, &normals_}) array->assign(pixels, 0);
    rgba_.assign(std::size_t(view.width) * std::size_t(view.height), 0);
    tiles_ = std::vector<Tile>(std::size_t(across_) * std::size_t(up_));
    // As are those where pixels beside the picture would be.
    const auto beside = static_cast<std::ptrdiff_t>(view.reach_pixels) / 4 + 2;
    const std::ptrdiff_t dealt_stride = view.stride / 4 + 2 * beside, dealt_plane = dealt_stride * view.height;
    dealt_.assign(4 * std::size_t(dealt_plane), kNothing);
    picture_ = {depths_.data() + kTile, picked_.data() + kTile, ids_.data() + kTile, normals_.data() + kTile,
                dealt_.data() + beside, dealt_stride,           dealt_plane,         occlusion_.data() + kTile,
                smooth_.data() + kTile};
}

namespace {

tbb::enumerable_thread_specific<std::unique_ptr<Scratch>>& scratches() {
    static tbb::enumerable_thread_specific<std::unique_ptr<Scratch>> all([] {
        auto scratch = std::make_unique<Scratch>();
        scratch->words.resize(3 * kMostPanesOfTile);
        scratch->floats.resize(2 * kMostPanesOfTile);
        return scratch;
    });
    return all;
}

// Vectors read beyond the end: what lies there must be something.
template <class Value> void keep(std::vector<Value>& to, const Value* from, std::size_t count, Value filler) {
    to.assign(from, from + count);
    to.resize(count + 16, filler);
}

} // namespace

void Caster::cast(int index, const Binned& binned, bool with_values) {
    Scratch& scratch = *scratches().local();
    Tile& tile = tiles_[std::size_t(index)];
    const int x = index % across_ * kTile, y = index / across_ * kTile;
    const auto sorted = [&](const Bins& bins) {
        const std::span<const std::uint32_t> here = bins.of(index);
        scratch.order.assign(here.begin(), here.end());
        std::ranges::sort(scratch.order, [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(cones_[a].nearest, a) < std::pair(cones_[b].nearest, b);
        });
    };
    sorted(binned.opaque);
    cast_tile(view_, field_, cones_.data(), scratch.order.data(), scratch.order.size(), with_values, x, y,
              scratch.samples);
    if (const auto solid = binned.solid_triangles.of(index); !solid.empty())
        raster_tile(view_, scratch.blocks.fill(solid_triangles_, solid, x, y), with_values, x, y, scratch.samples);
    std::uint32_t* words = scratch.words.data();
    float* floats = scratch.floats.data();
    Records records{words,  words + kMostPanesOfTile,  words + 2 * kMostPanesOfTile,
                    floats, floats + kMostPanesOfTile, 0};
    resolve_tile(view_, field_, scratch.samples, with_values, x, y, picture_, records);
    if (view_.taps > 0) deal_tile(x, y, view_, picture_);
    tile.count = records.count;
    if (records.count > 0) {
        keep(tile.place, records.place, records.count, 0U);
        keep(tile.id, records.id, records.count, 1U);
        keep(tile.normal, records.normal, records.count, 0U);
        keep(tile.depth, records.depth, records.count, 1.0F);
        if (with_values) keep(tile.value, records.value, records.count, 0.0F);
    }
    tile.panes = 0;
    const auto clear = binned.clear_triangles.of(index);
    sorted(binned.glass);
    if (scratch.order.empty() && clear.empty()) return;
    Panes panes{words, words + kMostPanesOfTile, words + 2 * kMostPanesOfTile, floats, 0};
    list_panes(view_, field_, cones_.data(), scratch.order.data(), scratch.order.size(),
               scratch.blocks.fill(clear_triangles_, clear, x, y), x, y, scratch.samples, picture_, panes);
    tile.panes = panes.count;
    if (panes.count == 0) return;
    keep(tile.pane_place, panes.place, panes.count, 0U);
    keep(tile.pane_id, panes.id, panes.count, 1U);
    keep(tile.pane_normal, panes.normal, panes.count, 0U);
    keep(tile.pane_depth, panes.depth, panes.count, 1.0F);
}

std::size_t Caster::draw(const Frame& frame, const View& view, const glm::dmat4& to_eye, const Look& look,
                         bool outlined, const std::vector<Layer>& layers,
                         const std::vector<std::array<std::uint16_t, 4>>& records, const Meaning& meaning) {
    make_room(view);
    view_ = view;
    const glm::mat4 lines_to_eye(glm::translate(to_eye, thinned_.origin));
    const std::size_t segments = segments_.size();
    const bool any_glass = std::ranges::find(layers, Layer::kGlass) != layers.end();
    cones_.resize(any_glass ? 2 * segments : segments); // the second half: lines inside glass
    std::vector<Kind> kinds(cones_.size(), Kind::kNone);
    find_near(frame);
    find_contested(layers);
    pieces_.assign(near_width_ > 0.0F ? segments + 1 : 0, kNowhere);
    field_ = {pieces_.empty() ? nullptr : pieces_.data(),
              near_.first.data(),
              near_.segments.data(),
              std::sqrt(frame.width),
              std::exp2(-frame.width),
              rivals_.first.data(),
              rivals_.segments.data(),
              piece_branches_.data(),
              piece_layers_.data()};
    std::atomic<std::size_t> drawn{0};
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, segments, 512), [&](const auto& range) {
        std::size_t there = 0;
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const auto branch = std::size_t(segments_[i].branch);
            const Layer layer = branch < layers.size() ? layers[branch] : Layer::kOpaque;
            if (layer == Layer::kNone) continue;
            if (!pieces_.empty()) pieces_[i] = piece_of(segments_[i], lines_to_eye);
            if (!prepare(segments_[i], lines_to_eye, frame, fitted_, cones_[i])) continue;
            cones_[i].contested = rivals_.first[i] < rivals_.first[i + 1];
            ++there;
            kinds[i] = layer == Layer::kGlass ? Kind::kGlass : Kind::kOpaque;
            if (layer != Layer::kGlass) continue;
            if (prepare_line(segments_[i], lines_to_eye, frame, cones_[segments + i]))
                kinds[segments + i] = Kind::kOpaque;
        }
        drawn += there;
    });
    for (std::size_t i = 1; i < segments; ++i) {
        if (kinds[i] != Kind::kOpaque || kinds[i - 1] != Kind::kOpaque) continue;
        cones_[i].follows = segments_[i].before == segments_[i - 1].point && !cones_[i].contested &&
                            segments_[i - 1].point + 1 == segments_[i].point && !cones_[i - 1].contested;
    }
    const std::size_t vessels = cones_.size();
    cones_.resize(vessels + meaning.lesions.size());
    kinds.resize(cones_.size(), Kind::kNone);
    for (std::size_t i = 0; i < meaning.lesions.size(); ++i)
        if (place_ball(meaning.lesions[i], kSolid | static_cast<std::uint32_t>(i + 1), cones_[vessels + i]))
            kinds[vessels + i] = Kind::kGlass;
    solid_triangles_.clear();
    clear_triangles_.clear();
    for (const Body& body : meaning.bodies)
        place_triangles(body, view_, to_eye, body.clear ? clear_triangles_ : solid_triangles_);
    Binned binned;
    const auto bin = [&](Kind wanted) {
        return Bins(across_, up_, cones_, [&](std::size_t i) { return kinds[i] == wanted; });
    };
    binned.opaque = bin(Kind::kOpaque);
    if (any_glass || !meaning.lesions.empty()) binned.glass = bin(Kind::kGlass);
    if (!solid_triangles_.empty()) binned.solid_triangles = Bins(across_, up_, solid_triangles_);
    if (!clear_triangles_.empty()) binned.clear_triangles = Bins(across_, up_, clear_triangles_);

    const bool on_scale =
        !meaning.margins && frame.scale.value != ColourScale::Value::kNone && !frame.scale.ramp.empty();
    const bool with_values = on_scale || !meaning.cuts.empty();
    const int tiles = across_ * up_;
    const auto for_tiles = [&](const auto& call) {
        tbb::parallel_for(tbb::blocked_range<int>(0, tiles, 4), [&](const auto& range) {
            for (int tile = range.begin(); tile < range.end(); ++tile) call(tile);
        });
    };
    for_tiles([&](int tile) { cast(tile, binned, with_values); });
    const auto corner = [&](int tile) { return std::pair(tile % across_ * kTile, tile / across_ * kTile); };
    if (view.taps > 0) {
        const Taps taps = taps_of(view_);
        for_tiles([&](int tile) {
            const int column = tile % across_;
            if (column % kOccludedTiles != 0) return;
            const auto first = tiles_.begin() + tile;
            if (std::any_of(first, first + std::min(kOccludedTiles, across_ - column),
                            [](const Tile& one) { return one.count > 0; }))
                occlude_tiles(view_, taps, corner(tile).first, corner(tile).second, picture_);
        });
        for_tiles([&](int tile) {
            if (tiles_[std::size_t(tile)].count > 0)
                smooth_tile(view_, corner(tile).first, corner(tile).second, picture_);
        });
    } else {
        std::ranges::fill(smooth_, 0.0F);
    }
    Shading shading{};
    shading.look = look;
    shading.branches = reinterpret_cast<const std::uint32_t*>(records.data());
    for (int i = 0; i < 12; ++i) { // as outline() and halo() of shade.frag
        const float angle = 0.5235988F * (static_cast<float>(i) + 0.5F);
        const auto put_step = [&](int(&step)[2], float reach) {
            step[0] = static_cast<int>(std::lround(reach * std::cos(angle)));
            step[1] = static_cast<int>(std::lround(reach * std::sin(angle)));
        };
        put_step(shading.outline_ring[i], look.selection[3]);
        put_step(shading.halo_ring[i], look.cues[3] * ((i & 1) == 0 ? 1.0F : 0.55F));
    }
    const ColourScale& scale = frame.scale;
    if (!meaning.cuts.empty()) shading.cuts = &meaning.cuts.front().x;
    shading.cut_count = static_cast<int>(meaning.cuts.size() / 5);
    shading.context = meaning.context.empty() ? nullptr : &meaning.context.front().x;
    shading.margins = meaning.margins ? &*meaning.margins : nullptr;
    if (on_scale) {
        const bool log = scale.logarithmic;
        const float low = log ? std::log(scale.low) : scale.low, high = log ? std::log(scale.high) : scale.high;
        shading.ramp = &scale.ramp.front().x;
        shading.ramp_steps = static_cast<int>(scale.ramp.size());
        shading.scale_low = low;
        shading.scale_slope = high > low ? 1.0F / (high - low) : 0.0F;
        shading.scale_logarithmic = log;
    }
    // An outline reaches into the tiles around at most.
    std::vector<std::uint8_t> near_selected(outlined ? std::size_t(tiles) : 0, 0);
    const auto is_selected = [&](std::uint32_t id) {
        const std::size_t branch = (id & ~kLine) - 1;
        return branch < records.size() && (records[branch][3] & kSelected) != 0;
    };
    for (int tile = 0; tile < tiles && outlined; ++tile) {
        const Tile& at = tiles_[std::size_t(tile)];
        if (std::none_of(at.id.begin(), at.id.begin() + std::ptrdiff_t(at.count), is_selected) &&
            std::none_of(at.pane_id.begin(), at.pane_id.begin() + std::ptrdiff_t(at.panes), is_selected))
            continue;
        const int x = tile % across_, y = tile / across_;
        for (int ty = std::max(y - 1, 0); ty <= std::min(y + 1, up_ - 1); ++ty)
            for (int tx = std::max(x - 1, 0); tx <= std::min(x + 1, across_ - 1); ++tx)
                near_selected[std::size_t(ty * across_ + tx)] = 1;
    }
    for_tiles([&](int index) {
        Tile& tile = tiles_[std::size_t(index)];
        const Records found{tile.place.data(), tile.id.data(),    tile.normal.data(),
                            tile.depth.data(), tile.value.data(), tile.count};
        const Panes panes{tile.pane_place.data(), tile.pane_id.data(), tile.pane_normal.data(), tile.pane_depth.data(),
                          tile.panes};
        Shading here = shading;
        here.outlined = outlined && near_selected[std::size_t(index)] != 0;
        shade_tile(view_, here, found, panes, corner(index).first, corner(index).second, picture_,
                   scratches().local()->colours, rgba_.data());
    });
    return drawn;
}

} // namespace ramus::render::caster
