// Bins: what reaches each of the caster's tiles, cones or triangles, in the order of their array.
#pragma once

#include "render/caster/cast_types.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace ramus::render::caster {

class Bins {
public:
    Bins() = default;
    Bins(int across, int up, const std::vector<RoundCone>& cones, const std::function<bool(std::size_t)>& included);
    Bins(int across, int up, const std::vector<Triangle>& triangles);

    [[nodiscard]] std::span<const std::uint32_t> of(int tile) const {
        if (items_.empty()) return {};
        const auto t = static_cast<std::size_t>(tile);
        return std::span(items_).subspan(first_[t], first_[t + 1] - first_[t]);
    }

private:
    template <class ForTiles> void fill(std::size_t count, const ForTiles& for_tiles);

    int across_ = 0, up_ = 0;
    std::vector<std::uint32_t> first_, items_; // of tile t: items_[first_[t]] to items_[first_[t + 1] - 1]
};

// The same for the blocks of one tile.
class BlockBins {
public:
    // Of triangles `order` of `all`; (x, y) is the tile's lower left pixel. What it says lasts until the next.
    [[nodiscard]] BlockTriangles fill(const std::vector<Triangle>& all, std::span<const std::uint32_t> order, int x,
                                      int y);

private:
    std::vector<std::uint32_t> first_, order_;
};

} // namespace ramus::render::caster
