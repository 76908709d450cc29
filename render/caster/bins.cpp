#include "render/caster/bins.h"

#include <algorithm>

namespace ramus::render::caster {

namespace {

// Those of group g are items[first[g]] to items[first[g + 1] - 1]. for_each(call) calls call(item, group) for all of
// them, twice the same.
template <class ForEach>
void group_by(std::size_t groups, const ForEach& for_each, std::vector<std::uint32_t>& first,
              std::vector<std::uint32_t>& items) {
    first.assign(groups + 2, 0); // a group ahead, so that filling moves them to where they begin
    for_each([&](std::uint32_t, std::size_t group) { ++first[group + 2]; });
    for (std::size_t group = 0; group < groups; ++group) first[group + 2] += first[group + 1];
    items.resize(first.back());
    for_each([&](std::uint32_t item, std::size_t group) { items[first[group + 1]++] = item; });
}

int tile_at(float at, int most) { return static_cast<int>(std::clamp(at / kTile, 0.0F, float(most - 1))); }

} // namespace

// for_tiles(i, call) calls `call` with every tile that thing i reaches.
template <class ForTiles> void Bins::fill(std::size_t count, const ForTiles& for_tiles) {
    const auto for_each = [&](const auto& call) {
        for (std::size_t i = 0; i < count; ++i)
            for_tiles(i, [&](std::size_t tile) { call(static_cast<std::uint32_t>(i), tile); });
    };
    group_by(std::size_t(across_) * std::size_t(up_), for_each, first_, items_);
}

Bins::Bins(int across, int up, const std::vector<RoundCone>& cones, const std::function<bool(std::size_t)>& included)
    : across_(across), up_(up) {
    fill(cones.size(), [&](std::size_t i, const auto& call) {
        if (!included(i)) return;
        const RoundCone& cone = cones[i];
        const float to_x = cone.image_from[0] + cone.image_length * cone.image_direction[0],
                    to_y = cone.image_from[1] + cone.image_length * cone.image_direction[1];
        const int x0 = tile_at(std::min(cone.image_from[0], to_x) - cone.image_half_width, across_);
        const int x1 = tile_at(std::max(cone.image_from[0], to_x) + cone.image_half_width, across_);
        const int y0 = tile_at(std::min(cone.image_from[1], to_y) - cone.image_half_width, up_);
        const int y1 = tile_at(std::max(cone.image_from[1], to_y) + cone.image_half_width, up_);
        const float most = cone.image_half_width + 0.7072F * kTile;
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) {
                if (x1 - x0 + y1 - y0 > 1) { // slanting ones pass many tiles of their box by
                    const float px = (float(x) + 0.5F) * kTile - cone.image_from[0],
                                py = (float(y) + 0.5F) * kTile - cone.image_from[1];
                    const float t = std::clamp(px * cone.image_direction[0] + py * cone.image_direction[1], 0.0F,
                                               cone.image_length);
                    const float dx = px - t * cone.image_direction[0], dy = py - t * cone.image_direction[1];
                    if (dx * dx + dy * dy > most * most) continue;
                }
                call(std::size_t(y) * std::size_t(across_) + std::size_t(x));
            }
    });
}

Bins::Bins(int across, int up, const std::vector<Triangle>& triangles) : across_(across), up_(up) {
    fill(triangles.size(), [&](std::size_t i, const auto& call) {
        const Triangle& t = triangles[i];
        const int x1 = tile_at(t.high[0], across_), y1 = tile_at(t.high[1], up_);
        for (int y = tile_at(t.low[1], up_); y <= y1; ++y)
            for (int x = tile_at(t.low[0], across_); x <= x1; ++x)
                call(std::size_t(y) * std::size_t(across_) + std::size_t(x));
    });
}

BlockTriangles BlockBins::fill(const std::vector<Triangle>& all, std::span<const std::uint32_t> order, int x, int y) {
    const auto block_at = [](float at, int corner) {
        return static_cast<int>(std::clamp(at - static_cast<float>(corner), 0.0F, float(kTile - 1))) / kBlock;
    };
    const auto for_each = [&](const auto& call) {
        for (const std::uint32_t triangle : order) {
            const Triangle& t = all[triangle];
            const int x1 = block_at(t.high[0], x), y1 = block_at(t.high[1], y);
            for (int by = block_at(t.low[1], y); by <= y1; ++by)
                for (int bx = block_at(t.low[0], x); bx <= x1; ++bx)
                    call(triangle, static_cast<std::size_t>(by * kBlocks + bx));
        }
    };
    group_by(std::size_t{kBlocks} * kBlocks, for_each, first_, order_);
    return {all.data(), first_.data(), order_.data()};
}

} // namespace ramus::render::caster
