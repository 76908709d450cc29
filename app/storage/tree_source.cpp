#include "app/storage/tree_source.h"

#include "app/session/numbers.h"
#include "app/session/of_file.h"
#include "core/io/trees/branch_table.h"
#include "core/io/volumes/volume_file.h"
#include "core/io/volumes/volume_unit.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace ramus::app {

namespace fs = std::filesystem;

bool is_session_file(const fs::path& path) {
    std::error_code ignored;
    if (path.extension() != ".json" || !fs::is_regular_file(path, ignored)) return false;
    std::ifstream stream(path, std::ios::binary);
    // The names at the top are enough: what is inside them is thrown away while it is read.
    bool has_version = false;
    bool has_tree = false;
    const auto keep = [&](int depth, nlohmann::json::parse_event_t event, nlohmann::json& parsed) {
        if (event == nlohmann::json::parse_event_t::key && depth == 1) {
            has_tree |= parsed == "tree";
            has_version |= parsed == "version";
        }
        return depth < 1;
    };
    const auto parsed = nlohmann::json::parse(stream, keep, false);
    return !parsed.is_discarded() && has_tree && has_version;
}

namespace {

// What is told of the file, and of what was made of its labels.
std::vector<tree::Note> notes_on(const volume::Volume& mask, std::size_t systems) {
    std::vector<tree::Note> notes;
    for (const std::string& note : mask.notes) notes.push_back({tree::Note::Kind::kAssumed, "mask", note, {}});
    for (const std::string& suspicion : mask.suspicions)
        notes.push_back({tree::Note::Kind::kSuspect, "units", suspicion, {}});
    if (systems > 1)
        notes.push_back({tree::Note::Kind::kAssumed,
                         "labels",
                         "the mask has " + std::to_string(systems) +
                             " labels: each is a system of its own, connected with no other",
                         {}});
    return notes;
}

// What the reading says of labels, or a threshold.
Result<std::vector<volume::SystemMask>> systems_in(const volume::Volume& mask, const io::MaskReading& reading) {
    if (reading.isovalue && reading.labels && !reading.labels->empty())
        return fail("labels and a threshold are asked for at once", {}, "leave out one of them");
    if (reading.isovalue) return std::vector<volume::SystemMask>{{.labels = {}, .isovalue = reading.isovalue}};
    volume::LabelGroups groups(std::in_place); // each label one
    if (reading.labels && reading.labels->empty())
        groups.reset();
    else if (reading.labels)
        groups = reading.labels;
    return volume::systems_of(mask, groups);
}

Result<tree::VesselTree> tree_of_mask(const fs::path& path, const io::ReadOptions& options, double memory_bytes,
                                      Job& job) {
    if (options.orientation)
        return fail("the axes of a mask are those of its file, and cannot be said otherwise", path.string(),
                    "leave out --orientation, or write the mask anew with the program that made it");
    RAMUS_TRY(mask, io::read_volume(path, {memory_bytes, options.unit}, job));
    RAMUS_TRY(systems, of_file(systems_in(mask, options.mask), path.string()));
    std::vector<tree::Note> notes = notes_on(mask, options.mask.labels ? 0 : systems.size());
    if (options.mask.isovalue) notes.push_back(threshold_note(*options.mask.isovalue));
    const volume::SkeletonizeOptions how = skeletonize_options(options.mask, memory_bytes);
    const tree::Claims claims = io::claims_of(mask, options.unit);
    auto tree = of_file(volume::skeletonize(std::move(mask), systems, how, job), path.string());
    if (!tree) return tree;
    tree->claims = claims;
    tree->source = fs::path(io::input_name(path)).filename().string();
    tree->notes.insert(tree->notes.begin(), notes.begin(), notes.end());
    if (auto good = io::join_branch_table(*tree, options); !good) return tl::unexpected(good.error());
    return tree;
}

} // namespace

tree::Note threshold_note(double isovalue) {
    return {tree::Note::Kind::kAssumed,
            "threshold",
            "vessels are what is at least " + exact_text(isovalue) +
                " in the scan: a threshold, no segmentation; whatever else is as bright is in the tree, too",
            {}};
}

volume::SkeletonizeOptions skeletonize_options(const io::MaskReading& mask, double memory_bytes) {
    volume::SkeletonizeOptions options;
    options.bulge_size = mask.bulge_size.value_or(options.bulge_size);
    options.islands_mm = mask.islands_mm.value_or(options.islands_mm);
    options.fill_holes = mask.fill_holes.value_or(options.fill_holes);
    options.root = mask.root;
    options.memory_bytes = memory_bytes;
    return options;
}

Result<tree::VesselTree> read_tree_or_mask(const fs::path& path, const io::ReadOptions& options, double memory_bytes,
                                           Job& job) {
    if (is_session_file(path))
        return fail("this is a session, where a vessel tree or a mask is needed", path.string(),
                    "give it to --session of ramus render, mesh or convert, or name its tree's file");
    if (io::is_volume(path)) return tree_of_mask(path, options, memory_bytes, job);
    return io::read_tree(path, options);
}

std::optional<fs::path> demo_tree() {
    std::vector<fs::path> folders;
    if (const char* assets = std::getenv("RAMUS_ASSETS"); assets != nullptr) folders.emplace_back(assets);
    std::error_code ignored;
    if (const fs::path program = fs::read_symlink("/proc/self/exe", ignored); !program.empty())
        folders.push_back(program.parent_path().parent_path() / "share" / "ramus");
    folders.emplace_back(RAMUS_ASSETS);
    for (const fs::path& folder : folders)
        for (const char* name : {"liver_portal_vein.swc", "liver_portal_vein.json"})
            if (fs::is_regular_file(folder / name, ignored)) return folder / name;
    return {};
}

} // namespace ramus::app
