// What command lines name as input, read: trees, masks and sessions.
#pragma once

#include "app/commands/surface_flags.h"
#include "app/session/session.h"
#include "core/base/error.h"
#include "core/tree/vessel_tree.h"
#include "core/volume/volume.h"

#include <memory>
#include <string>

namespace ramus::app {

// How every command reads its tree: what was repaired is told on standard error, and with --verbose what was found.
[[nodiscard]] Result<tree::VesselTree> load_tree(const std::string& file, const SurfaceFlags& flags);

// A line on standard error, with --verbose only.
void say(const SurfaceFlags& flags, const std::string& line);

// How every command reads its mask or scan: with a progress bar, and an interrupt cancels.

// What was assumed where the file does not say is told on standard error with --verbose.
[[nodiscard]] Result<volume::Volume> load_volume(const std::string& file, const SurfaceFlags& flags);

// The session that a command line asks for, with its tree.
struct OpenedSession {
    Session session;
    std::shared_ptr<const tree::VesselTree> tree;
    bool has_camera = false;
};

// Either name may be empty, not both: a tree without a session is a fresh one, a session without a tree brings its own.
// Options on the command line win over those of the session.
[[nodiscard]] Result<OpenedSession> open_session(const std::string& tree_file, const std::string& session_file,
                                                 const SurfaceFlags& flags);

} // namespace ramus::app
