#include "core/volume/skeletonize/systems.h"

#include "core/volume/label_counts.h"

#include <algorithm>
#include <set>

namespace ramus::volume {

namespace {

// A volume with more values is most likely a scan.
constexpr std::size_t kMostSystems = 64;

std::string name_of(const Volume& volume, const std::vector<std::int32_t>& labels) {
    std::string name;
    for (const std::int32_t label : labels) {
        const LabelName* named = name_of_label(volume, label);
        if (!name.empty()) name += " + ";
        name += named != nullptr && !named->name.empty() ? named->name : "label " + std::to_string(label);
    }
    return name;
}

Result<void> check_groups(const std::vector<std::vector<std::int32_t>>& groups, const std::vector<LabelCount>& counts) {
    std::set<std::int32_t> seen;
    for (const std::vector<std::int32_t>& group : groups)
        for (const std::int32_t label : group) {
            if (std::ranges::find(counts, label, &LabelCount::label) == counts.end())
                return fail("no voxel has label " + std::to_string(label), {}, "ramus info lists the labels of a mask");
            if (!seen.insert(label).second)
                return fail("label " + std::to_string(label) + " is given twice", {}, "a voxel belongs to one system");
        }
    return {};
}

} // namespace

Result<std::vector<SystemMask>> systems_of(const Volume& volume, const LabelGroups& groups) {
    const bool chosen = groups && !groups->empty();
    if (!holds_whole_numbers(volume)) {
        if (chosen) return fail("a volume of fractions has no labels", {}, "leave out --label or --labels");
        if (!looks_like_a_mask(volume))
            return fail("this looks like a scan, not like a mask of vessels", {},
                        "segment the vessels first, or take all that is at least X with --isovalue X");
        return std::vector<SystemMask>(1);
    }
    const std::vector<LabelCount> counts = label_counts(volume);
    if (counts.empty()) return fail("nothing is inside: every voxel is 0");
    if (!chosen && counts.size() > kMostSystems && !volume.segmentation)
        return fail(
            "it has " + std::to_string(counts.size()) +
                " different values, and looks like a scan, not like a mask of vessels",
            {}, "say which of them are vessels with --labels N,M, or take all that is at least X with --isovalue X");
    if (!groups) return std::vector<SystemMask>(1);
    std::vector<std::vector<std::int32_t>> labels;
    for (const std::vector<LabelChoice>& group : *groups) {
        RAMUS_TRY(numbers, label_numbers(volume, group));
        std::ranges::sort(numbers); // independent of the order of names
        labels.push_back(std::move(numbers));
    }
    if (auto good = check_groups(labels, counts); !good) return tl::unexpected(good.error());
    if (labels.empty())
        for (const LabelCount& count : counts) labels.push_back({count.label});
    std::vector<SystemMask> systems;
    for (const std::vector<std::int32_t>& group : labels) {
        const LabelName* first = name_of_label(volume, group.front());
        systems.push_back({.labels = {group.begin(), group.end()},
                           .name = name_of(volume, group),
                           .isovalue = std::nullopt,
                           .colour = first == nullptr ? std::nullopt : first->colour});
    }
    // A single label without names in the file needs no name.
    if (systems.size() == 1 && volume.label_names.empty()) systems[0].name.clear();
    return systems;
}

} // namespace ramus::volume
