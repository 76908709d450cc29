#include "core/volume/label_counts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <functional>
#include <map>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>
#include <type_traits>

namespace ramus::volume {

namespace {

using Counts = std::map<std::int32_t, std::uint64_t>;
using Stretch = tbb::blocked_range<std::size_t>;

// Where the values end to be those at `first`; eight bytes at a time.
template <class T> std::size_t end_of_run(const T* values, std::size_t first, std::size_t end) {
    constexpr std::size_t kAtOnce = sizeof(std::uint64_t) / sizeof(T);
    std::array<T, kAtOnce> alike;
    alike.fill(values[first]);
    const auto pattern = std::bit_cast<std::uint64_t>(alike);
    std::size_t n = first + 1;
    for (std::uint64_t word = 0; n + kAtOnce <= end; n += kAtOnce) {
        std::memcpy(&word, values + n, sizeof(word));
        if (word != pattern) break;
    }
    while (n < end && values[n] == values[first]) ++n;
    return n;
}

// Neighbours are alike as a rule, so that counting goes run by run.
template <class T> Counts count_runs(const SparseArray<T>& values, const Stretch& stretch, Counts counts) {
    for (std::size_t first = stretch.begin(); first < stretch.end();) {
        const T value = values[first];
        const std::size_t end = end_of_run(values.data(), first, stretch.end());
        if (value != T(0)) counts[static_cast<std::int32_t>(value)] += end - first;
        first = end;
    }
    return counts;
}

Counts add(Counts one, const Counts& other) {
    for (const auto& [label, voxels] : other) one[label] += voxels;
    return one;
}

constexpr std::size_t kGrain = std::size_t{1} << 20;

} // namespace

std::vector<LabelCount> label_counts(const Volume& volume) {
    const Counts counts = std::visit(
        [&]<class T>(const SparseArray<T>& values) -> Counts {
            if constexpr (std::is_integral_v<T>)
                return tbb::parallel_reduce(
                    Stretch(0, values.size(), kGrain), Counts(),
                    [&](const Stretch& stretch, Counts so_far) {
                        return count_runs(values, stretch, std::move(so_far));
                    },
                    add);
            else
                return {};
        },
        volume.voxels);
    std::vector<LabelCount> list;
    for (const auto& [label, voxels] : counts) list.push_back({label, voxels});
    return list;
}

std::uint64_t count_from(const Volume& volume, double isovalue) {
    return std::visit(
        [&](const auto& values) {
            return tbb::parallel_reduce(
                Stretch(0, values.size(), kGrain), std::uint64_t{0},
                [&](const Stretch& stretch, std::uint64_t sum) {
                    for (std::size_t n = stretch.begin(); n < stretch.end(); ++n)
                        sum += static_cast<double>(values[n]) >= isovalue ? 1 : 0;
                    return sum;
                },
                std::plus<>());
        },
        volume.voxels);
}

} // namespace ramus::volume
