#include "core/io/trees/mask_tree.h"

#include "core/io/standard_input.h"
#include "core/io/text_numbers.h"
#include "core/io/volumes/volume_unit.h"

#include <string>
#include <utility>
#include <vector>

namespace ramus::io {

namespace {

using tree::Note;

Note threshold_note(double isovalue) {
    return {Note::Kind::kAssumed,
            "threshold",
            "vessels are what is at least " + exact_number(isovalue) +
                " in the scan: a threshold, no segmentation; whatever else is as bright is in the tree, too",
            {}};
}

// The notes about the file and about the use of its labels.
std::vector<Note> notes_on(const volume::Volume& mask, const MaskReading& reading, std::size_t systems) {
    std::vector<Note> notes;
    for (const std::string& note : mask.notes) notes.push_back({Note::Kind::kAssumed, "mask", note, {}});
    for (const std::string& suspicion : mask.suspicions)
        notes.push_back({Note::Kind::kSuspect, "units", suspicion, {}});
    if (!reading.labels && systems > 1)
        notes.push_back({Note::Kind::kAssumed,
                         "labels",
                         "the mask has " + std::to_string(systems) +
                             " labels: each is a system of its own, connected with no other",
                         {}});
    if (reading.isovalue) notes.push_back(threshold_note(*reading.isovalue));
    return notes;
}

// The systems that the options select, by labels or by a threshold.
Result<std::vector<volume::SystemMask>> systems_in(const volume::Volume& mask, const MaskReading& reading) {
    if (reading.isovalue && reading.labels && !reading.labels->empty())
        return fail("labels and a threshold are given at once", {}, "leave out one of them");
    if (reading.isovalue) return std::vector<volume::SystemMask>{{.labels = {}, .isovalue = reading.isovalue}};
    volume::LabelGroups groups(std::in_place); // each label one
    if (reading.labels && reading.labels->empty())
        groups.reset();
    else if (reading.labels)
        groups = reading.labels;
    return volume::systems_of(mask, groups);
}

volume::SkeletonizeOptions skeletonize_options(const MaskReading& mask, double memory_bytes) {
    volume::SkeletonizeOptions options;
    options.bulge_size = mask.bulge_size.value_or(options.bulge_size);
    options.islands_mm = mask.islands_mm.value_or(options.islands_mm);
    options.fill_holes = mask.fill_holes.value_or(options.fill_holes);
    options.root = mask.root;
    options.memory_bytes = memory_bytes;
    return options;
}

Result<tree::VesselTree> make_tree(volume::Volume&& mask, const ReadOptions& options, double memory_bytes, Job& job,
                                   volume::SkeletonizeFigures* figures) {
    if (options.orientation)
        return fail("the axes of a mask are those of its file, and cannot be changed", {},
                    "leave out --orientation, or write the mask anew with the program that made it");
    RAMUS_TRY(systems, systems_in(mask, options.mask));
    std::vector<Note> notes = notes_on(mask, options.mask, systems.size());
    const tree::Claims claims = claims_of(mask, options.unit);
    auto tree =
        volume::skeletonize(std::move(mask), systems, skeletonize_options(options.mask, memory_bytes), job, figures);
    if (!tree) return tree;
    tree->claims = claims;
    tree->notes.insert(tree->notes.begin(), notes.begin(), notes.end());
    return tree;
}

} // namespace

Result<tree::VesselTree> tree_of_mask(volume::Volume&& mask, const std::filesystem::path& path,
                                      const ReadOptions& options, double memory_bytes, Job& job,
                                      volume::SkeletonizeFigures* figures) {
    auto tree = make_tree(std::move(mask), options, memory_bytes, job, figures);
    if (!tree && tree.error().where.empty()) tree.error().where = input_name(path);
    if (tree) tree->source = std::filesystem::path(input_name(path)).filename().string();
    return tree;
}

} // namespace ramus::io
