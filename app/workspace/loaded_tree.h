// A tree as it comes from a file, a session or a recovery file, with what shows it at once.
#pragma once

#include "app/assets/assets.h"
#include "app/session/session.h"
#include "app/storage/autosave.h"
#include "app/workspace/surface_maker.h"
#include "core/base/error.h"
#include "core/base/job.h"
#include "core/io/trees/tree_file.h"

#include <filesystem>
#include <memory>

namespace ramus::app {

// A tree, read and measured, with its cones for the first picture.
struct LoadedTree {
    Assets assets; // the tree and its facts; what else is known already
    Session session;
    bool has_camera = false;
    std::filesystem::path file;                 // the session file that it comes from; empty: none
    std::optional<std::size_t> unsaved_changes; // it was recovered, with so many
    std::shared_ptr<SurfaceMaker> maker;        // of this tree; null: none yet
    ReadySurface cones;
    double seconds = 0.0; // reading
};

// A tree file, or a session (.json with a version) and its tree. For a tree, `options` and colours of `like` stay.
[[nodiscard]] Result<LoadedTree> load(const std::filesystem::path& path, const Marks& like,
                                      const io::ReadOptions& reading, Job& job);

// What another process left (app/storage/autosave.h), and its tree, which must be the same as then.
[[nodiscard]] Result<LoadedTree> load(const autosave::Snapshot& snapshot, const io::ReadOptions& reading, Job& job);

} // namespace ramus::app
