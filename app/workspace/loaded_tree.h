// A tree as it comes from a file, a session or a recovery file, with what shows it at once.
#pragma once

#include "app/assets/assets.h"
#include "app/session/session.h"
#include "app/storage/autosave.h"
#include "app/workspace/surface_maker.h"
#include "core/base/error.h"
#include "core/base/job.h"
#include "core/base/worker.h"
#include "core/io/trees/tree_file.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace ramus::app {

// A tree, read and measured, with its cones for the first picture; or a session that shows something without a tree.
struct LoadedTree {
    Assets assets;                                // the tree (null: none) and its facts; what else is known already
    std::shared_ptr<const tree::VesselTree> base; // as its file has it; null: the session has no edits
    Session session;
    bool has_camera = false;
    std::filesystem::path file;                 // the session file that it comes from; empty: none
    std::optional<std::size_t> unsaved_changes; // it was recovered, with so many
    std::shared_ptr<SurfaceMaker> maker;        // of this tree; null: none yet
    ReadySurface cones;
    double seconds = 0.0; // reading
};

// A tree file, or a session (.json with a version) and its tree. For a tree, options, colours, context and scans of
// `like` stay, but for context of the same file. `reading` is what somebody says of the file, and wins over what the
// session says.
[[nodiscard]] Result<LoadedTree> load(const std::filesystem::path& path, const Marks& like,
                                      const io::ReadOptions& reading, Job& job);

// What another process left (app/storage/autosave.h), and its tree, which must be the same as then.
[[nodiscard]] Result<LoadedTree> load(const autosave::Snapshot& snapshot, Job& job);

// TreeLoader: reads a tree on a worker, and makes its first surface there. For one thread, its owner's, which takes
// what came after update(). Whatever the loader is asked for last counts; what it was at before is dropped.
class TreeLoader {
public:
    using Read = std::function<Result<LoadedTree>(Job&)>;
    struct Arrival {
        std::filesystem::path path; // as it was asked for: a session's own name
        LoadedTree tree;
    };

    explicit TreeLoader(std::function<void()> wake) : worker_(std::move(wake)) {}

    void start(const std::filesystem::path& path, Read read);
    void cancel();
    void update();

    // Each once.
    [[nodiscard]] std::optional<Arrival> take_arrival() { return std::exchange(arrival_, std::nullopt); }
    [[nodiscard]] std::optional<Error> take_error() { return std::exchange(error_, std::nullopt); }
    // Of what arrived last, once it is made; the loader is busy until then.
    [[nodiscard]] std::optional<ReadySurface> take_first_surface() { return std::exchange(first_, std::nullopt); }

    [[nodiscard]] const Worker& worker() const { return worker_; }
    [[nodiscard]] std::string take_failure() { return worker_.take_failure(); }

private:
    void work(const std::filesystem::path& path, const Read& read, Job& job, const Worker::Post& post);

    std::optional<Arrival> arrival_;
    std::optional<ReadySurface> first_;
    std::optional<Error> error_;
    Worker worker_; // last: its thread ends first
};

} // namespace ramus::app
