#include "app/storage/opening_files.h"

#include "core/io/json_text.h"
#include "core/io/trees/branch_table.h"
#include "core/io/trees/mask_tree.h"
#include "core/io/volumes/volume_file.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <utility>
#include <vector>

namespace ramus::app {

namespace fs = std::filesystem;

bool is_session_file(const fs::path& path) {
    std::error_code ignored;
    if (path.extension() != ".json" || !fs::is_regular_file(path, ignored)) return false;
    std::ifstream stream(path, std::ios::binary);
    const std::vector<std::string> names = io::json_names(stream);
    const auto has = [&](const char* name) { return std::ranges::find(names, name) != names.end(); };
    return has("tree") && has("version");
}

Result<tree::VesselTree> read_tree_or_mask(const fs::path& path, const io::ReadOptions& options, double memory_bytes,
                                           Job& job) {
    if (is_session_file(path))
        return fail("this is a session, where a vessel tree or a mask is needed", path.string(),
                    "give it to --session of ramus render, mesh or convert, or name its tree's file");
    if (!io::is_volume(path)) return io::read_tree(path, options);
    RAMUS_TRY(mask, io::read_volume(path, {memory_bytes, options.unit, options.part, options.mask.isovalue}, job));
    RAMUS_TRY(tree, io::tree_of_mask(std::move(mask), path, options, memory_bytes, job));
    if (auto good = io::join_branch_table(tree, options); !good) return tl::unexpected(good.error());
    return std::move(tree);
}

namespace {

// Where ramus keeps the files that it comes with: beside an installed program, or in the sources of the build.
std::optional<fs::path> installed_share() {
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    if (program.empty()) return {};
    return program.parent_path().parent_path() / "share" / "ramus";
}

} // namespace

std::optional<fs::path> workflow_folder() {
    std::error_code ignored;
    std::vector<fs::path> folders{fs::path(RAMUS_ASSETS).parent_path() / "workflow"};
    if (const auto share = installed_share()) folders.insert(folders.begin(), *share / "workflow");
    for (const fs::path& folder : folders)
        if (fs::is_regular_file(folder / "Snakefile", ignored)) return folder;
    return {};
}

std::optional<fs::path> demo_tree() {
    std::vector<fs::path> folders;
    if (const char* assets = std::getenv("RAMUS_ASSETS"); assets != nullptr) folders.emplace_back(assets);
    std::error_code ignored;
    if (const auto share = installed_share()) folders.push_back(*share);
    folders.emplace_back(RAMUS_ASSETS);
    for (const fs::path& folder : folders)
        for (const char* name : {"liver_portal_vein.swc", "liver_portal_vein.json"})
            if (fs::is_regular_file(folder / name, ignored)) return folder / name;
    return {};
}

} // namespace ramus::app
