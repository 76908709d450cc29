// sampled(): the values of a scan at the pixels of a slice. The window, the command line and reports show the same
// values, because all of them come from here.
//
// Guarantees: with kNearest every pixel has the value of the voxel that its centre lies in, exactly as the file has it
// (whole numbers up to 2^24, since values are in single precision). With kLinear it has the trilinear interpolation of
// the voxels around it; beyond the outermost voxel centres, within half a voxel, the value at the border holds. Pixels
// outside of all voxels are NaN. The result does not depend on the number of threads.
// Not guaranteed: that a voxel thinner than a pixel is seen. Choose pixels as small as the smallest voxel spacing.
#pragma once

#include "core/slice/pixel_grid.h"
#include "core/volume/volume.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::slice {

enum class Interpolation : std::uint8_t { kNearest, kLinear };

// What a thick slice shows of the values across it.
enum class Slab : std::uint8_t { kMaximum, kMean, kMinimum };
inline constexpr std::array<std::pair<Slab, std::string_view>, 3> kSlabs{
    {{Slab::kMaximum, "maximum"}, {Slab::kMean, "mean"}, {Slab::kMinimum, "minimum"}}};
[[nodiscard]] std::string_view name_of(Slab slab);
[[nodiscard]] std::optional<Slab> slab_named(std::string_view name);

struct Sampling {
    Interpolation interpolation = Interpolation::kLinear;
    Slab slab = Slab::kMaximum;
    double slab_mm = 0.0; // thickness, centred at the plane, sampled at the smallest voxel spacing; 0: the plane alone
    bool operator==(const Sampling&) const = default;
};

// Row by row, grid.size.x * grid.size.y values. The grid's pixels need not be in a plane's order of magnitude with
// voxels; a grid of one row gives the values along a line.
[[nodiscard]] std::vector<float> sampled(const volume::Volume& volume, const PixelGrid& grid,
                                         const Sampling& sampling = {});

// The value at a place, as one pixel of sampled(); NaN outside.
[[nodiscard]] float value_at(const volume::Volume& volume, const glm::dvec3& place,
                             Interpolation interpolation = Interpolation::kNearest);

} // namespace ramus::slice
