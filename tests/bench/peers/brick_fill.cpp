#include "brick_fill.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <oneapi/tbb/parallel_for.h>
#include <span>
#include <utility>
#include <vector>

namespace ramus::peers {
namespace {

// The tube around a segment beyond which its kernel is zero, in cells from the grid's origin.
struct Support {
    glm::dvec3 from, way; // way: to the other end
    double inverse_length2, reach;
    glm::ivec3 first, last; // bricks it may reach

    Support(const field::FieldSegment& s, double support_radii, const BrickGrid& grid)
        : from((glm::dvec3(s.ax, s.ay, s.az) - grid.origin) / grid.cell_mm),
          way(glm::dvec3(s.ux, s.uy, s.uz) * (static_cast<double>(s.length) / grid.cell_mm)),
          inverse_length2(1.0 / glm::dot(way, way)),
          // A little more covers the rounding.
          reach(1.001 * support_radii * static_cast<double>(std::max(s.radius, s.end_radius())) / grid.cell_mm) {
        const glm::dvec3 low = glm::min(from, from + way) - reach;
        const glm::dvec3 high = glm::max(from, from + way) + reach;
        constexpr double kBrick = kBrickPoints;
        first = glm::max(glm::ivec3(glm::floor(low / kBrick)), glm::ivec3(0));
        last = glm::min(glm::ivec3(glm::floor(high / kBrick)), grid.bricks() - 1);
    }

    [[nodiscard]] bool meets(glm::ivec3 brick) const {
        constexpr double kHalf = 0.5 * (kBrickPoints - 1);
        const glm::dvec3 to_middle = glm::dvec3(kBrickPoints * brick) + kHalf - from;
        const double t = std::clamp(glm::dot(to_middle, way) * inverse_length2, 0.0, 1.0);
        const glm::dvec3 off = to_middle - t * way;
        const double near = reach + kHalf * std::numbers::sqrt3;
        return glm::dot(off, off) < near * near;
    }
};

// The bricks of a layer of blocks, and which segments come near each.
struct Layer {
    std::vector<std::uint32_t> ends; // by brick: where its list ends
    std::vector<std::uint32_t> lists;
};

// Place of a brick in its layer: blocks in rows, the bricks of each together.
std::size_t place_in_layer(glm::ivec3 brick, glm::ivec3 blocks) {
    const glm::ivec3 block = brick / kBlockBricks;
    const glm::ivec3 in = brick % kBlockBricks;
    const int place = ((block.y * blocks.x + block.x) * kBlockBricks + in.z) * kBlockBricks * kBlockBricks +
                      in.y * kBlockBricks + in.x;
    return static_cast<std::size_t>(place);
}

void collect(const std::vector<Support>& supports, std::span<const std::uint32_t> near, int layer,
             const BrickGrid& grid, Layer& to) {
    const auto for_bricks = [&](const auto& call) {
        for (const std::uint32_t n : near) {
            const Support& support = supports[n];
            const int low = std::max(support.first.z, layer * kBlockBricks);
            const int high = std::min(support.last.z, (layer + 1) * kBlockBricks - 1);
            for (int z = low; z <= high; ++z)
                for (int y = support.first.y; y <= support.last.y; ++y)
                    for (int x = support.first.x; x <= support.last.x; ++x)
                        if (const glm::ivec3 brick(x, y, z); support.meets(brick))
                            call(place_in_layer(brick, grid.blocks), n);
        }
    };
    const auto blocks = static_cast<std::size_t>(grid.blocks.x) * static_cast<std::size_t>(grid.blocks.y);
    to.ends.assign(blocks * kBlockBricks * kBlockBricks * kBlockBricks, 0);
    for_bricks([&](std::size_t place, std::uint32_t) { ++to.ends[place]; });
    std::uint32_t total = 0;
    for (std::uint32_t& end : to.ends) total += std::exchange(end, total); // the begin of each, which filling moves on
    to.lists.resize(total);
    for_bricks([&](std::size_t place, std::uint32_t n) { to.lists[to.ends[place]++] = n; });
}

} // namespace

BrickGrid brick_grid(const field::ConvolutionField& field, double cell_mm) {
    BrickGrid grid;
    grid.cell_mm = cell_mm;
    grid.origin = field.extent().lower - cell_mm;
    constexpr double kBlockPoints = kBrickPoints * kBlockBricks;
    const glm::dvec3 cells = (field.extent().upper - field.extent().lower) / cell_mm;
    grid.blocks = glm::ivec3(glm::ceil((cells + 3.0) / kBlockPoints));
    return grid;
}

void fill_bricks(const field::ConvolutionField& field, const BrickGrid& grid,
                 const std::function<void(glm::ivec3, const field::GridGroups&)>& put) {
    const std::vector<std::uint32_t>& present = field.present();
    std::vector<Support> supports;
    supports.reserve(present.size());
    std::vector<std::vector<std::uint32_t>> near(static_cast<std::size_t>(grid.blocks.z)); // by layer, into supports
    for (std::uint32_t n = 0; n < present.size(); ++n) {
        supports.emplace_back(field.segments()[present[n]], field.kernel().support_radii, grid);
        for (int layer = supports[n].first.z / kBlockBricks; layer <= supports[n].last.z / kBlockBricks; ++layer)
            near[static_cast<std::size_t>(layer)].push_back(n);
    }

    tbb::parallel_for(0, grid.blocks.z, [&](int z) {
        thread_local Layer layer;
        thread_local std::vector<std::uint32_t> list;
        const auto sum = field.in_brick();
        thread_local field::GridGroups samples;
        collect(supports, near[static_cast<std::size_t>(z)], z, grid, layer);
        std::size_t entry = 0;
        std::uint32_t begin = 0;
        for (int block = 0; block < grid.blocks.x * grid.blocks.y; ++block) {
            const glm::ivec3 first = kBlockBricks * glm::ivec3(block % grid.blocks.x, block / grid.blocks.x, z);
            for (int in = 0; in < kBlockBricks * kBlockBricks * kBlockBricks; ++in) {
                const std::uint32_t end = layer.ends[entry++];
                if (begin == end) continue;
                list.clear();
                for (; begin < end; ++begin) list.push_back(present[layer.lists[begin]]);
                const glm::ivec3 brick = first + glm::ivec3(in & 1, in >> 1 & 1, in >> 2);
                field::GridAxes axes;
                for (std::size_t i = 0; i < field::kGridSide; ++i) {
                    const glm::dvec3 at = glm::dvec3(kBrickPoints * brick) + static_cast<double>(i);
                    axes.x[i] = grid.origin.x + grid.cell_mm * at.x;
                    axes.y[i] = grid.origin.y + grid.cell_mm * at.y;
                    axes.z[i] = grid.origin.z + grid.cell_mm * at.z;
                }
                sum->enter(list, axes);
                sum->sample_groups(field::kOwnGroups, samples);
                put(brick, samples);
            }
        }
    });
}

} // namespace ramus::peers
