// Recognises files to open, reads trees from them, and finds files that ramus comes with.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/io/trees/tree_file.h"

#include <filesystem>
#include <optional>

namespace ramus::app {

// Whether the file is a session rather than a tree. False if it cannot be read; reading it then reports why.
[[nodiscard]] bool is_session_file(const std::filesystem::path& path);

// Reads the tree in a file; for a segmentation mask, the result of io::tree_of_mask(). `memory_bytes`: limit for the
// process; 0: half of the machine's memory. Fails like io::read_tree(), io::read_volume() and io::tree_of_mask().
[[nodiscard]] Result<tree::VesselTree> read_tree_or_mask(const std::filesystem::path& path,
                                                         const io::ReadOptions& options, double memory_bytes, Job& job);

// The demo tree: in $RAMUS_ASSETS, in the installation, or in the source tree of the build.
[[nodiscard]] std::optional<std::filesystem::path> demo_tree();

// The folder of the Snakemake workflow (workflow/README.md): in the installation, or in the source tree of the build.
[[nodiscard]] std::optional<std::filesystem::path> workflow_folder();

} // namespace ramus::app
