#include "core/volume/label_counts.h"

#include "core/volume/end_of_run.h"

#include <algorithm>
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

// For scans, whose neighbouring values differ: a table of all values is faster than a map.
template <class T> Counts count_in_table(const SparseArray<T>& values) {
    using Table = std::vector<std::uint64_t>;
    using Index = std::make_unsigned_t<T>;
    const Table table = tbb::parallel_reduce(
        Stretch(0, values.size(), kGrain), Table(std::size_t{1} << (8 * sizeof(T)), 0),
        [&](const Stretch& stretch, Table so_far) {
            for (std::size_t n = stretch.begin(); n < stretch.end(); ++n) ++so_far[static_cast<Index>(values[n])];
            return so_far;
        },
        [](Table one, const Table& other) {
            std::ranges::transform(one, other, one.begin(), std::plus<>());
            return one;
        });
    Counts counts;
    for (std::size_t index = 1; index < table.size(); ++index)
        if (table[index] > 0) counts[static_cast<T>(static_cast<Index>(index))] = table[index];
    return counts;
}

template <class T> Counts count_labels(const SparseArray<T>& values) {
    if constexpr (std::is_integral_v<T> && sizeof(T) <= 2)
        return count_in_table(values);
    else if constexpr (std::is_integral_v<T>)
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

Counts count_values(const Volume& volume) {
    return std::visit([](const auto& values) { return count_labels(values); }, volume.voxels);
}

std::vector<LabelCount> list_of(const Counts& counts) {
    std::vector<LabelCount> list;
    for (const auto& [label, voxels] : counts) list.push_back({label, voxels});
    return list;
}

} // namespace

std::vector<LabelCount> label_counts(const Volume& volume) {
    Counts counts = count_values(volume);
    for (const Overlap& overlap : volume.overlaps) {
        const auto found = counts.find(overlap.value);
        if (found == counts.end()) continue;
        const std::uint64_t voxels = found->second;
        counts.erase(found);
        for (const std::int32_t label : overlap.labels) counts[label] += voxels;
    }
    return list_of(counts);
}

std::vector<std::int32_t> kept_values(const Volume& volume) {
    std::vector<std::int32_t> values;
    for (const auto& [value, voxels] : count_values(volume)) values.push_back(value);
    return values;
}

std::vector<LabelCount> listed_counts(const Volume& volume) {
    std::vector<LabelCount> list = label_counts(volume);
    if (!volume.segmentation) return list;
    for (const LabelName& each : volume.label_names)
        if (std::ranges::find(list, each.label, &LabelCount::label) == list.end()) list.push_back({each.label, 0});
    std::ranges::sort(list, {}, &LabelCount::label);
    return list;
}

std::vector<SharedCount> shared_counts(const Volume& volume) {
    if (volume.overlaps.empty()) return {};
    const Counts counts = count_values(volume);
    std::map<std::array<std::int32_t, 2>, std::uint64_t> pairs;
    for (const Overlap& overlap : volume.overlaps) {
        const auto found = counts.find(overlap.value);
        if (found == counts.end()) continue;
        for (std::size_t a = 0; a < overlap.labels.size(); ++a)
            for (std::size_t b = a + 1; b < overlap.labels.size(); ++b)
                pairs[{overlap.labels[a], overlap.labels[b]}] += found->second;
    }
    std::vector<SharedCount> list;
    for (const auto& [labels, voxels] : pairs) list.push_back({labels, voxels});
    return list;
}

std::uint64_t count_from(const Volume& volume, double isovalue) {
    return std::visit([&](const auto& values) { return count_above(values, isovalue); }, volume.voxels);
}

} // namespace ramus::volume
