// Bins: what reaches each of the caster's tiles, or each block of a tile, in the order of its array.
#pragma once

#include "core/base/grouped.h"
#include "render/caster/cast_types.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace ramus::render::caster {

using Bins = Grouped<std::uint32_t>;

// By tiles, `across` beside each other in `up` rows.
[[nodiscard]] Bins bins_of(int across, int up, const std::vector<RoundCone>& cones,
                           const std::function<bool(std::size_t)>& included);
[[nodiscard]] Bins bins_of(int across, int up, const std::vector<Triangle>& triangles);

// Those in `order` of `all` by the blocks of the tile whose lower left pixel is (x, y); `kept` is what it points into.
[[nodiscard]] BlockCones by_block(const std::vector<RoundCone>& all, std::span<const std::uint32_t> order, int x, int y,
                                  Bins& kept);
[[nodiscard]] BlockTriangles by_block(const std::vector<Triangle>& all, std::span<const std::uint32_t> order, int x,
                                      int y, Bins& kept);

} // namespace ramus::render::caster
