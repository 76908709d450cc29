#include "core/volume/label_counts.h"

#include "core/volume/end_of_run.h"

#include <functional>
#include <map>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>
#include <type_traits>

namespace ramus::volume {

namespace {

using Counts = std::map<std::int32_t, std::uint64_t>;
using Stretch = tbb::blocked_range<std::size_t>;

template <class T> Counts count_within(const SparseArray<T>& values, const Stretch& stretch, Counts counts) {
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

template <class T> Counts count_labels(const SparseArray<T>& values) {
    if constexpr (std::is_integral_v<T>)
        return tbb::parallel_reduce(
            Stretch(0, values.size(), kGrain), Counts(),
            [&](const Stretch& stretch, Counts so_far) { return count_within(values, stretch, std::move(so_far)); },
            add);
    else
        return {};
}
Counts count_labels(const FractionRuns&) { return {}; }
Counts count_labels(const VoxelRuns& runs) {
    std::vector<std::uint64_t> voxels(std::size_t{1} << (8 * sizeof(VoxelRuns::Value)), 0);
    runs.for_runs(0, runs.size(),
                  [&](std::size_t begin, std::size_t end, VoxelRuns::Value value) { voxels[value] += end - begin; });
    Counts counts;
    for (std::size_t label = 1; label < voxels.size(); ++label)
        if (voxels[label] > 0) counts.emplace_hint(counts.end(), static_cast<std::int32_t>(label), voxels[label]);
    return counts;
}

template <class T> std::uint64_t count_above(const SparseArray<T>& values, double isovalue) {
    return tbb::parallel_reduce(
        Stretch(0, values.size(), kGrain), std::uint64_t{0},
        [&](const Stretch& stretch, std::uint64_t sum) {
            for (std::size_t n = stretch.begin(); n < stretch.end(); ++n)
                sum += static_cast<double>(values[n]) >= isovalue ? 1 : 0;
            return sum;
        },
        std::plus<>());
}
template <class T> std::uint64_t count_above(const RunsOf<T>& runs, double isovalue) {
    std::uint64_t sum = 0;
    runs.for_runs(0, runs.size(), [&](std::size_t begin, std::size_t end, T value) {
        if (static_cast<double>(value) >= isovalue) sum += end - begin;
    });
    return sum;
}

} // namespace

std::vector<LabelCount> label_counts(const Volume& volume) {
    const Counts counts = std::visit([](const auto& values) { return count_labels(values); }, volume.voxels);
    std::vector<LabelCount> list;
    for (const auto& [label, voxels] : counts) list.push_back({label, voxels});
    return list;
}

std::uint64_t count_from(const Volume& volume, double isovalue) {
    return std::visit([&](const auto& values) { return count_above(values, isovalue); }, volume.voxels);
}

} // namespace ramus::volume
