// What command lines name as input, read: trees, masks and sessions.
#pragma once

#include "app/commands/surface_flags.h"
#include "app/session/session.h"
#include "core/base/error.h"
#include "core/tree/vessel_tree.h"
#include "core/volume/volume.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace ramus::app {

// How every command reads its tree: what was repaired is told on standard error, and with --verbose what was found.
[[nodiscard]] Result<tree::VesselTree> load_tree(const std::string& file, const SurfaceFlags& flags);
// The same as a session reads it.
[[nodiscard]] Result<tree::VesselTree> load_tree(const std::string& file, const SurfaceFlags& flags,
                                                 const io::ReadOptions& reading);

// A line on standard error, with --verbose only.
void say(const SurfaceFlags& flags, const std::string& line);

// How every command reads its mask or scan: with a progress bar, and an interrupt cancels. With --verbose it tells on
// standard error what was assumed where the file does not say.
[[nodiscard]] Result<volume::Volume> load_volume(const std::string& file, const SurfaceFlags& flags);

// Tells on standard error where the size looks like another unit.
void warn_about(const std::string& file, const volume::Volume& volume);

// 1 for each branch of the systems that --system names (as the session calls them), 0 for others; all when it names
// none. Fails on one that the tree lacks, with `where`.
[[nodiscard]] Result<std::vector<std::uint8_t>> branches_of(const tree::VesselTree& tree, const Marks& marks,
                                                            const std::vector<std::string>& systems,
                                                            const std::string& where);

// The session that a command line asks for, with its tree.
struct OpenedSession {
    Session session;
    std::shared_ptr<const tree::VesselTree> tree; // with the session's edits
    std::shared_ptr<const tree::VesselTree> base; // as the file has it
    bool has_camera = false;
};

// A session that shows something without a tree is refused, unless `alone` says that it may be.
enum class Alone { kRefused, kAllowed };

// Either name may be empty, not both: a tree without a session is a fresh one, a session without a tree brings its own.
// Options on the command line win over those of the session.
[[nodiscard]] Result<OpenedSession> open_session(const std::string& tree_file, const std::string& session_file,
                                                 const SurfaceFlags& flags, Alone alone = Alone::kRefused);

} // namespace ramus::app
