#include "core/slice/sample.h"

#include "core/base/words.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <oneapi/tbb/blocked_range2d.h>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::slice {

namespace {

constexpr float kOutside = std::numeric_limits<float>::quiet_NaN();

// A grid in voxel indices.
struct IndexGrid {
    glm::dvec3 corner, right, down;
    glm::ivec2 size;
};

IndexGrid in_indices(const volume::Volume& volume, const PixelGrid& grid) {
    const glm::dmat4 to_index = glm::inverse(volume.to_patient);
    const glm::dmat3 turn(to_index);
    return {glm::dvec3(to_index * glm::dvec4(grid.corner, 1.0)), turn * grid.right, turn * grid.down, grid.size};
}

// The pixels of a row, in [first, end), whose indices lie in all voxels' extent.
std::pair<int, int> inside_of(const glm::dvec3& begin, const glm::dvec3& step, const glm::ivec3& size, int first,
                              int end) {
    double from = first;
    double to = end - 1;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = -0.5 - begin[axis];
        const double high = size[axis] - 0.5 - begin[axis];
        if (step[axis] == 0.0) {
            if (low > 0.0 || high < 0.0) return {first, first};
            continue;
        }
        const double a = low / step[axis];
        const double b = high / step[axis];
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    if (!(from <= to)) return {first, first};
    return {static_cast<int>(std::ceil(from)), static_cast<int>(std::floor(to)) + 1};
}

// Reads values by index. `Values` is an array, or runs.
template <class Values> class Sampler {
public:
    Sampler(const Values& values, const glm::ivec3& size)
        : values_(values), size_(size), most_(glm::dvec3(size - 1)), row_(size.x),
          slice_(static_cast<std::ptrdiff_t>(size.x) * size.y) {}

    [[nodiscard]] float nearest(const glm::dvec3& index) const {
        const glm::dvec3 on = glm::clamp(index, glm::dvec3(0.0), most_) + 0.5; // not negative: truncation rounds down
        return read(static_cast<std::ptrdiff_t>(on.x) + row_ * static_cast<std::ptrdiff_t>(on.y) +
                    slice_ * static_cast<std::ptrdiff_t>(on.z));
    }

    [[nodiscard]] float linear(const glm::dvec3& index) const {
        const glm::dvec3 on = glm::clamp(index, glm::dvec3(0.0), most_);
        const glm::ivec3 low(on);
        const glm::vec3 share(on - glm::dvec3(low));
        const std::ptrdiff_t at = low.x + row_ * low.y + slice_ * low.z;
        const std::ptrdiff_t x = low.x + 1 < size_.x ? 1 : 0;
        const std::ptrdiff_t y = low.y + 1 < size_.y ? row_ : 0;
        const std::ptrdiff_t z = low.z + 1 < size_.z ? slice_ : 0;
        const auto along_x = [&](std::ptrdiff_t n) {
            const float value = read(n);
            return value + share.x * (read(n + x) - value);
        };
        const auto along_y = [&](std::ptrdiff_t n) {
            const float value = along_x(n);
            return value + share.y * (along_x(n + y) - value);
        };
        const float value = along_y(at);
        return share.z == 0.0F ? value : value + share.z * (along_y(at + z) - value);
    }

private:
    [[nodiscard]] float read(std::ptrdiff_t n) const {
        return static_cast<float>(values_[static_cast<std::size_t>(n)]);
    }

    const Values& values_;
    glm::ivec3 size_;
    glm::dvec3 most_;
    std::ptrdiff_t row_, slice_;
};

float joined(Slab slab, float sum, float next) {
    switch (slab) {
    case Slab::kMaximum:
        return std::max(sum, next);
    case Slab::kMinimum:
        return std::min(sum, next);
    case Slab::kMean:
        break;
    }
    return sum + next;
}

// Tiles keep the voxels that neighbouring rows share in the processor's cache.
constexpr int kTile = 64;

template <class Call> void for_tiles(const glm::ivec2& size, const Call& call) {
    tbb::parallel_for(tbb::blocked_range2d<int>(0, size.y, kTile, 0, size.x, kTile),
                      [&](const tbb::blocked_range2d<int>& tile) { call(tile.rows(), tile.cols()); });
}

template <class Read> void sample_plane(const IndexGrid& grid, const glm::ivec3& size, const Read& read, float* out) {
    for_tiles(grid.size, [&](const auto& rows, const auto& columns) {
        for (int y = rows.begin(); y < rows.end(); ++y) {
            const glm::dvec3 begin = grid.corner + static_cast<double>(y) * grid.down;
            const auto [first, end] = inside_of(begin, grid.right, size, columns.begin(), columns.end());
            float* const row = out + static_cast<std::ptrdiff_t>(y) * grid.size.x;
            for (int x = first; x < end; ++x) row[x] = read(begin + static_cast<double>(x) * grid.right);
        }
    });
}

// The planes of a slab on either side of its middle, as steps in voxel indices.
struct SlabPlanes {
    glm::dvec3 step;
    int aside; // planes on each side
};

template <class Read>
void sample_slab(const IndexGrid& grid, const SlabPlanes& planes, Slab slab, const glm::ivec3& size, const Read& read,
                 float* out) {
    for_tiles(grid.size, [&](const auto& rows, const auto& columns) {
        std::vector<float> counts(kTile * 2);
        for (int y = rows.begin(); y < rows.end(); ++y) {
            float* const row = out + static_cast<std::ptrdiff_t>(y) * grid.size.x;
            counts.assign(static_cast<std::size_t>(columns.end() - columns.begin()), 0.0F);
            for (int p = -planes.aside; p <= planes.aside; ++p) {
                const glm::dvec3 begin =
                    grid.corner + static_cast<double>(y) * grid.down + static_cast<double>(p) * planes.step;
                const auto [first, end] = inside_of(begin, grid.right, size, columns.begin(), columns.end());
                for (int x = first; x < end; ++x) {
                    const float value = read(begin + static_cast<double>(x) * grid.right);
                    float& count = counts[static_cast<std::size_t>(x - columns.begin())];
                    row[x] = count == 0.0F ? value : joined(slab, row[x], value);
                    ++count;
                }
            }
            if (slab != Slab::kMean) continue;
            for (int x = columns.begin(); x < columns.end(); ++x)
                if (const float count = counts[static_cast<std::size_t>(x - columns.begin())]; count > 0.0F)
                    row[x] /= count;
        }
    });
}

SlabPlanes planes_of(const volume::Volume& volume, const PixelGrid& grid, double slab_mm) {
    const double step_mm = smallest_spacing_mm(volume);
    const auto aside = static_cast<int>(std::min(0.5 * slab_mm / step_mm, 1e5));
    const glm::dmat3 turn(glm::inverse(volume.to_patient));
    return {turn * (step_mm * grid.plane().normal), aside};
}

} // namespace

std::string_view name_of(Slab slab) { return kSlabs[static_cast<std::size_t>(slab)].second; }

std::optional<Slab> slab_named(std::string_view name) { return paired_with(kSlabs, name); }

std::vector<float> sampled(const volume::Volume& volume, const PixelGrid& grid, const Sampling& sampling) {
    const IndexGrid indices = in_indices(volume, grid);
    std::vector<float> values(static_cast<std::size_t>(grid.size.x) * static_cast<std::size_t>(grid.size.y), kOutside);
    const SlabPlanes planes = planes_of(volume, grid, sampling.slab_mm);
    const auto fill = [&](const auto& read) {
        if (planes.aside > 0)
            sample_slab(indices, planes, sampling.slab, volume.size, read, values.data());
        else
            sample_plane(indices, volume.size, read, values.data());
    };
    std::visit(
        [&](const auto& voxels) {
            const Sampler sampler(voxels, volume.size);
            if (sampling.interpolation == Interpolation::kNearest)
                fill([&](const glm::dvec3& index) { return sampler.nearest(index); });
            else
                fill([&](const glm::dvec3& index) { return sampler.linear(index); });
        },
        volume.voxels);
    return values;
}

float value_at(const volume::Volume& volume, const glm::dvec3& place, Interpolation interpolation) {
    return sampled(volume, {place, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, glm::ivec2(1)}, {interpolation}).front();
}

} // namespace ramus::slice
