#include "render/caster/bins.h"

#include <algorithm>

namespace ramus::render::caster {

namespace {

int tile_at(float at, int most) { return static_cast<int>(std::clamp(at / kTile, 0.0F, float(most - 1))); }

struct PixelBox {
    float low[2], high[2];
};
PixelBox box_of(const Triangle& t) { return {{t.low[0], t.low[1]}, {t.high[0], t.high[1]}}; }
PixelBox box_of(const RoundCone& cone) {
    PixelBox box{};
    for (int axis = 0; axis < 2; ++axis) {
        const float from = cone.image_from[axis], to = from + cone.image_length * cone.image_direction[axis];
        box.low[axis] = std::min(from, to) - cone.image_half_width;
        box.high[axis] = std::max(from, to) + cone.image_half_width;
    }
    return box;
}

template <class Thing>
InBlocks<Thing> in_blocks(const std::vector<Thing>& all, std::span<const std::uint32_t> order, int x, int y,
                          Bins& kept) {
    const auto block_at = [](float at, int corner) {
        return static_cast<int>(std::clamp(at - static_cast<float>(corner), 0.0F, float(kTile - 1))) / kBlock;
    };
    constexpr std::size_t kCount = std::size_t{kBlocks} * kBlocks;
    kept = Bins(kCount, [&](const auto& put) {
        for (const std::uint32_t number : order) {
            const PixelBox box = box_of(all[number]);
            const int x1 = block_at(box.high[0], x), y1 = block_at(box.high[1], y);
            for (int by = block_at(box.low[1], y); by <= y1; ++by)
                for (int bx = block_at(box.low[0], x); bx <= x1; ++bx)
                    put(static_cast<std::size_t>(by * kBlocks + bx), number);
        }
    });
    InBlocks<Thing> found{all.data(), {}};
    for (std::size_t block = 0; block < kCount; ++block) found.first[block] = kept.of(block).data();
    found.first[kCount] = found.first[kCount - 1] + kept.of(kCount - 1).size();
    return found;
}

} // namespace

Bins bins_of(int across, int up, const std::vector<RoundCone>& cones,
             const std::function<bool(std::size_t)>& included) {
    return Bins(std::size_t(across) * std::size_t(up), [&](const auto& put) {
        for (std::size_t i = 0; i < cones.size(); ++i) {
            if (!included(i)) continue;
            const RoundCone& cone = cones[i];
            const PixelBox box = box_of(cone);
            const int x0 = tile_at(box.low[0], across), x1 = tile_at(box.high[0], across);
            const int y0 = tile_at(box.low[1], up), y1 = tile_at(box.high[1], up);
            const float most = cone.image_half_width + 0.7072F * kTile;
            for (int y = y0; y <= y1; ++y)
                for (int x = x0; x <= x1; ++x) {
                    if (x1 - x0 + y1 - y0 > 1) { // slanting cones miss many tiles of their box
                        const float px = (float(x) + 0.5F) * kTile - cone.image_from[0],
                                    py = (float(y) + 0.5F) * kTile - cone.image_from[1];
                        const float t = std::clamp(px * cone.image_direction[0] + py * cone.image_direction[1], 0.0F,
                                                   cone.image_length);
                        const float dx = px - t * cone.image_direction[0], dy = py - t * cone.image_direction[1];
                        if (dx * dx + dy * dy > most * most) continue;
                    }
                    put(std::size_t(y) * std::size_t(across) + std::size_t(x), static_cast<std::uint32_t>(i));
                }
        }
    });
}

Bins bins_of(int across, int up, const std::vector<Triangle>& triangles) {
    return Bins(std::size_t(across) * std::size_t(up), [&](const auto& put) {
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            const Triangle& t = triangles[i];
            const int x1 = tile_at(t.high[0], across), y1 = tile_at(t.high[1], up);
            for (int y = tile_at(t.low[1], up); y <= y1; ++y)
                for (int x = tile_at(t.low[0], across); x <= x1; ++x)
                    put(std::size_t(y) * std::size_t(across) + std::size_t(x), static_cast<std::uint32_t>(i));
        }
    });
}

BlockCones by_block(const std::vector<RoundCone>& all, std::span<const std::uint32_t> order, int x, int y, Bins& kept) {
    return in_blocks(all, order, x, y, kept);
}

BlockTriangles by_block(const std::vector<Triangle>& all, std::span<const std::uint32_t> order, int x, int y,
                        Bins& kept) {
    return in_blocks(all, order, x, y, kept);
}

} // namespace ramus::render::caster
