#include "core/slice/level_lines.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::slice {

namespace {

constexpr int kBlockCells = 8; // along a side

class LevelField {
public:
    LevelField(const PixelGrid& grid, std::span<const double> levels,
               const std::function<double(const glm::dvec3&)>& field, double steepest)
        : grid_(grid), blocks_((grid.size - 2) / kBlockCells + 1),
          crossed_(static_cast<std::size_t>(blocks_.x) * static_cast<std::size_t>(blocks_.y)),
          values_(static_cast<std::size_t>(grid.size.x) * static_cast<std::size_t>(grid.size.y)) {
        const double half_mm = 0.5 * kBlockCells * (glm::length(grid.right) + glm::length(grid.down));
        tbb::parallel_for(0, blocks_.y, [&](int y) {
            for (int x = 0; x < blocks_.x; ++x) {
                const double value = field(grid.place(double{kBlockCells} * (glm::dvec2(x, y) + 0.5)));
                const auto near = [&](double level) { return std::abs(value - level) <= steepest * half_mm; };
                crossed_[block(x, y)] = std::ranges::any_of(levels, near) ? 1 : 0;
            }
        });
        tbb::parallel_for(0, grid.size.y, [&](int y) {
            for (int x = 0; x < grid.size.x; ++x)
                if (is_needed(x, y)) values_[pixel(x, y)] = field(grid.place(glm::dvec2(x, y)));
        });
    }

    [[nodiscard]] std::vector<Loop> lines(double level) const {
        std::vector<CutTriangle> pieces;
        std::vector<glm::uvec3> cells;
        for (int y = 0; y < blocks_.y; ++y)
            for (int x = 0; x < blocks_.x; ++x)
                if (crossed_[block(x, y)] != 0) add_cells({kBlockCells * x, kBlockCells * y}, cells);
        // The samples are a surface whose height is the field.
        const auto position = [this](std::uint32_t n) {
            const auto width = static_cast<std::uint32_t>(grid_.size.x);
            return glm::dvec3(n % width, n / width, values_[n]);
        };
        cut_triangles(cells, {{0.0, 0.0, level}, {0.0, 0.0, 1.0}}, position, pieces);
        std::vector<Loop> loops = joined_loops(pieces);
        for (Loop& loop : loops)
            for (EdgePoint& point : loop.points) point.at = grid_.place(glm::dvec2(point.at));
        return loops;
    }

private:
    [[nodiscard]] std::size_t block(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(blocks_.x) + static_cast<std::size_t>(x);
    }
    [[nodiscard]] std::size_t pixel(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(grid_.size.x) + static_cast<std::size_t>(x);
    }
    // A pixel on the border of a block belongs to both blocks.
    [[nodiscard]] bool is_needed(int x, int y) const {
        const glm::ivec2 last = glm::min(glm::ivec2(x, y) / kBlockCells, blocks_ - 1);
        const glm::ivec2 first = glm::max(glm::ivec2(x - 1, y - 1) / kBlockCells, 0);
        for (int j = first.y; j <= last.y; ++j)
            for (int i = first.x; i <= last.x; ++i)
                if (crossed_[block(i, j)] != 0) return true;
        return false;
    }
    void add_cells(glm::ivec2 first, std::vector<glm::uvec3>& cells) const {
        const glm::ivec2 end = glm::min(first + kBlockCells, grid_.size - 1);
        for (int y = first.y; y < end.y; ++y)
            for (int x = first.x; x < end.x; ++x) {
                const auto a = static_cast<std::uint32_t>(pixel(x, y));
                const auto c = static_cast<std::uint32_t>(pixel(x, y + 1));
                cells.emplace_back(a, a + 1, c + 1);
                cells.emplace_back(a, c + 1, c);
            }
    }

    const PixelGrid& grid_;
    glm::ivec2 blocks_;
    std::vector<char> crossed_; // by block: a line may cross it
    std::vector<double> values_;
};

} // namespace

std::vector<std::vector<Loop>> level_lines(const PixelGrid& grid, std::span<const double> levels,
                                           const std::function<double(const glm::dvec3&)>& field, double steepest) {
    std::vector<std::vector<Loop>> lines(levels.size());
    if (grid.size.x < 2 || grid.size.y < 2) return lines;
    const LevelField sampled(grid, levels, field, steepest);
    for (std::size_t n = 0; n < levels.size(); ++n) lines[n] = sampled.lines(levels[n]);
    return lines;
}

} // namespace ramus::slice
