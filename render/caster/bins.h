// Bins: for each tile of a picture, or for each block of a tile, the indices of the cones or triangles that may reach
// it. Bins are conservative: a bin may list a cone that covers no sample of the tile. Indices keep the order of the
// input.
#pragma once

#include "core/base/grouped.h"
#include "render/caster/cast_types.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace ramus::render::caster {

using Bins = Grouped<std::uint32_t>;

// For a picture of `across` by `up` tiles, row by row from below.
[[nodiscard]] Bins bins_of(int across, int up, const std::vector<RoundCone>& cones,
                           const std::function<bool(std::size_t)>& included);
[[nodiscard]] Bins bins_of(int across, int up, const std::vector<Triangle>& triangles);

// For the blocks of the tile whose lower left pixel is (x, y): the entries of `order`, which are indices into `all`.
// The result points into `kept`, which must outlive it.
[[nodiscard]] BlockCones by_block(const std::vector<RoundCone>& all, std::span<const std::uint32_t> order, int x, int y,
                                  Bins& kept);
[[nodiscard]] BlockTriangles by_block(const std::vector<Triangle>& all, std::span<const std::uint32_t> order, int x,
                                      int y, Bins& kept);

} // namespace ramus::render::caster
