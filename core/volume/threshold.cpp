#include "core/volume/threshold.h"

#include "core/base/disjoint_sets.h"
#include "core/base/grouped.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

namespace ramus::volume {

namespace {

constexpr std::size_t kMostThresholds = 4096;
constexpr std::uint64_t kMostJoined = 4'000'000; // voxels whose pieces are counted

using BinCounts = std::vector<std::uint64_t>;

// Finds the greatest threshold that a value reaches.
class Bins {
public:
    Bins(double first, double step, std::size_t count) : step_(step), thresholds_(count) {
        for (std::size_t b = 0; b < count; ++b) thresholds_[b] = first + static_cast<double>(b) * step;
    }
    [[nodiscard]] const std::vector<double>& thresholds() const { return thresholds_; }
    [[nodiscard]] std::size_t count() const { return thresholds_.size(); }
    [[nodiscard]] std::size_t of(double value) const {
        const double place = (value - thresholds_.front()) / step_;
        std::size_t bin = place > 0.0 ? std::min(static_cast<std::size_t>(place), count() - 1) : 0;
        // Corrects the rounding of the division: the result must agree with a comparison of the value with thresholds.
        while (bin > 0 && value < thresholds_[bin]) --bin;
        while (bin + 1 < count() && value >= thresholds_[bin + 1]) ++bin;
        return bin;
    }

private:
    double step_;
    std::vector<double> thresholds_;
};

Bins bins_of(const Volume& volume) {
    constexpr auto kMost = static_cast<double>(kMostThresholds);
    if (holds_whole_numbers(volume)) {
        const double range = volume.maximum - volume.minimum, step = std::max(1.0, std::ceil((range + 1.0) / kMost));
        return {volume.minimum, step, static_cast<std::size_t>(range / step) + 1};
    }
    // Fractions are stored in single precision, but the range in double precision.
    const double least = static_cast<float>(volume.minimum), most = static_cast<float>(volume.maximum);
    return {least, (most - least) / kMost, kMostThresholds};
}

BinCounts add_counts(BinCounts one, const BinCounts& other) {
    std::ranges::transform(one, other, one.begin(), std::plus<>());
    return one;
}

template <class T> BinCounts count_values(const SparseArray<T>& values, const Bins& bins, const JobRange& job) {
    using Part = tbb::blocked_range<std::size_t>;
    constexpr std::size_t kValuesAtOnce = std::size_t{1} << 20;
    return tbb::parallel_reduce(
        Part(0, values.size(), kValuesAtOnce), BinCounts(bins.count(), 0),
        [&](const Part& part, BinCounts counts) {
            if (job.cancelled()) return counts;
            for (std::size_t n = part.begin(); n < part.end(); ++n) ++counts[bins.of(static_cast<double>(values[n]))];
            return counts;
        },
        add_counts);
}
template <class T> BinCounts count_values(const RunsOf<T>& runs, const Bins& bins, const JobRange&) {
    BinCounts counts(bins.count(), 0);
    runs.for_runs(0, runs.size(), [&](std::size_t begin, std::size_t end, T value) {
        counts[bins.of(static_cast<double>(value))] += end - begin;
    });
    return counts;
}

// The first bin of the upper class.
std::size_t otsu_of(const BinCounts& counts) {
    double all = 0.0, sum = 0.0;
    for (std::size_t b = 0; b < counts.size(); ++b) {
        all += static_cast<double>(counts[b]);
        sum += static_cast<double>(counts[b]) * static_cast<double>(b);
    }
    double below = 0.0, sum_below = 0.0, most = -1.0;
    std::size_t first = 1, last = 1;
    for (std::size_t b = 1; b < counts.size(); ++b) {
        below += static_cast<double>(counts[b - 1]);
        sum_below += static_cast<double>(counts[b - 1]) * static_cast<double>(b - 1);
        const double above = all - below;
        if (below == 0.0 || above == 0.0) continue;
        const double apart = sum_below / below - (sum - sum_below) / above;
        const double between = below * above * apart * apart;
        if (between > most) most = between, first = b;
        if (between >= most) last = b;
    }
    return (first + last) / 2; // midway where no value lies between the classes
}

// Every step-th voxel along each axis, by its bin.
struct Grid {
    glm::ivec3 size{0};
    std::vector<std::uint16_t> bins;
};

template <class T> Grid grid_of(const Volume& volume, const SparseArray<T>& values, const Bins& bins, int step) {
    Grid grid{(volume.size + step - 1) / step, {}};
    grid.bins.reserve(voxel_count(grid.size));
    const auto columns = static_cast<std::size_t>(volume.size.x), rows = static_cast<std::size_t>(volume.size.y);
    for (int k = 0; k < volume.size.z; k += step)
        for (int j = 0; j < volume.size.y; j += step)
            for (int i = 0; i < volume.size.x; i += step) {
                const std::size_t at = static_cast<std::size_t>(i) +
                                       columns * (static_cast<std::size_t>(j) + rows * static_cast<std::size_t>(k));
                grid.bins.push_back(static_cast<std::uint16_t>(bins.of(static_cast<double>(values[at]))));
            }
    return grid;
}
template <class T> Grid grid_of(const Volume& volume, const RunsOf<T>& runs, const Bins& bins, int step) {
    Grid grid{(volume.size + step - 1) / step, {}};
    const auto columns = static_cast<std::size_t>(volume.size.x), rows = static_cast<std::size_t>(volume.size.y);
    const auto apart = static_cast<std::size_t>(step);
    for (int k = 0; k < volume.size.z; k += step)
        for (int j = 0; j < volume.size.y; j += step) {
            const std::size_t first = columns * (static_cast<std::size_t>(j) + rows * static_cast<std::size_t>(k));
            runs.for_runs(first, first + columns, [&](std::size_t begin, std::size_t end, T value) {
                const auto bin = static_cast<std::uint16_t>(bins.of(static_cast<double>(value)));
                const std::size_t from = (begin - first + apart - 1) / apart, to = (end - first + apart - 1) / apart;
                grid.bins.insert(grid.bins.end(), to - from, bin);
            });
        }
    return grid;
}

// Adds voxels from the brightest on. Each begins as a piece of its own, and joins the pieces that it touches.
Result<BinCounts> pieces_of(const Grid& grid, std::size_t count, const JobRange& job) {
    const Grouped<std::uint32_t> by_bin(count, [&](const auto& put) {
        for (std::uint32_t n = 0; n < grid.bins.size(); ++n) put(grid.bins[n], n);
    });
    const std::span<const std::uint32_t> places = by_bin.all();
    const glm::ivec3 size = grid.size;
    DisjointSets joined(places.size());
    BinCounts pieces(count, 0);
    std::uint64_t now = 0;
    constexpr std::size_t kBetweenReports = std::size_t{1} << 16U;
    std::size_t bin = count;
    for (std::size_t n = places.size(); n-- > 0;) {
        const std::uint32_t place = places[n];
        for (; bin > grid.bins[place] + std::size_t{1}; --bin) pieces[bin - 1] = now;
        ++now;
        const auto row = place / static_cast<std::uint32_t>(size.x);
        const glm::ivec3 at(place % static_cast<std::uint32_t>(size.x), row % static_cast<std::uint32_t>(size.y),
                            row / static_cast<std::uint32_t>(size.y));
        const glm::ivec3 from = glm::max(at - 1, 0), to = glm::min(at + 1, size - 1);
        for (int k = from.z; k <= to.z; ++k)
            for (int j = from.y; j <= to.y; ++j)
                for (int i = from.x; i <= to.x; ++i) {
                    const auto other = static_cast<std::uint32_t>(i + size.x * (j + size.y * k));
                    // Among equal bins: whether the other voxel was added before.
                    const bool is_in =
                        grid.bins[other] > grid.bins[place] || (grid.bins[other] == grid.bins[place] && other > place);
                    if (is_in && joined.join(place, other)) --now;
                }
        if (n % kBetweenReports != 0) continue;
        if (job.cancelled()) return fail("cancelled");
        job.report(1.0F - static_cast<float>(n) / static_cast<float>(places.size()));
    }
    for (; bin > 0; --bin) pieces[bin - 1] = now;
    return pieces;
}

int step_for(const glm::ivec3& size) {
    int step = 1;
    const auto joined = [&] {
        const glm::ivec3 taken = (size + step - 1) / step;
        return static_cast<std::uint64_t>(taken.x) * static_cast<std::uint64_t>(taken.y) *
               static_cast<std::uint64_t>(taken.z);
    };
    while (joined() > kMostJoined) ++step;
    return step;
}

} // namespace

std::size_t ThresholdCurve::at(double value) const {
    const auto above = std::ranges::upper_bound(thresholds, value);
    return above == thresholds.begin() ? 0 : static_cast<std::size_t>(above - thresholds.begin()) - 1;
}

Result<ThresholdCurve> threshold_curve(const Volume& volume, const JobRange& job) {
    if (static_cast<float>(volume.minimum) >= static_cast<float>(volume.maximum))
        return fail("all its values are equal", {}, "a scan has darker and brighter ones");
    const Bins bins = bins_of(volume);
    const BinCounts counts =
        std::visit([&](const auto& values) { return count_values(values, bins, job); }, volume.voxels);
    if (job.cancelled()) return fail("cancelled");
    job.report(0.3F);
    ThresholdCurve curve;
    curve.thresholds = bins.thresholds();
    curve.voxels = counts;
    for (std::size_t b = counts.size() - 1; b-- > 0;) curve.voxels[b] += curve.voxels[b + 1];
    curve.otsu = otsu_of(counts);
    curve.step = step_for(volume.size);
    const Grid grid =
        std::visit([&](const auto& values) { return grid_of(volume, values, bins, curve.step); }, volume.voxels);
    auto pieces = pieces_of(grid, bins.count(), job.part(0.3F, 1.0F));
    if (!pieces) return tl::unexpected(pieces.error());
    curve.pieces = std::move(*pieces);
    return curve;
}

} // namespace ramus::volume
