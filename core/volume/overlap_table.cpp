#include "core/volume/overlap_table.h"

#include "core/volume/label_counts.h"

#include <algorithm>
#include <utility>

namespace ramus::volume {

Result<std::int32_t> OverlapTable::with(std::int32_t value, std::int32_t label) {
    if (value == 0 || value == label) return label;
    const std::uint64_t key =
        std::uint64_t{static_cast<std::uint32_t>(value)} << 32U | static_cast<std::uint32_t>(label);
    if (const auto known = next_.find(key); known != next_.end()) return known->second;
    RAMUS_TRY(found, find(value, label));
    next_.emplace(key, found);
    return found;
}

Result<std::int32_t> OverlapTable::find(std::int32_t value, std::int32_t label) {
    constexpr std::size_t kMostSets = 4096, kMostLabels = 64;
    std::vector<std::int32_t> labels =
        value < first_ ? std::vector{value} : sets_[static_cast<std::size_t>(value - first_)].labels;
    const auto place = std::ranges::lower_bound(labels, label);
    if (place != labels.end() && *place == label) return value;
    labels.insert(place, label);
    const auto known = std::ranges::find(sets_, labels, &Overlap::labels);
    if (known != sets_.end()) return known->value;
    if (labels.size() > kMostLabels)
        return fail("more than " + std::to_string(kMostLabels) + " of its segments share a voxel", {},
                    "write fewer segments to a file");
    if (sets_.size() == kMostSets)
        return fail("its segments overlap in more than " + std::to_string(kMostSets) + " different ways", {},
                    "write fewer segments to a file");
    sets_.push_back({.value = first_ + static_cast<std::int32_t>(sets_.size()), .labels = std::move(labels)});
    return sets_.back().value;
}

void OverlapTable::finish(Volume& volume) && {
    if (sets_.empty()) return;
    volume.overlaps = std::move(sets_);
    const std::vector<std::int32_t> values = kept_values(volume);
    std::erase_if(volume.overlaps,
                  [&](const Overlap& overlap) { return !std::ranges::binary_search(values, overlap.value); });
    const std::vector<LabelCount> labels = label_counts(volume);
    if (labels.empty()) return;
    volume.minimum = std::min(volume.minimum, static_cast<double>(labels.front().label));
    volume.maximum = labels.back().label;
}

} // namespace ramus::volume
