// The session that a command line asks for, with its tree.
#pragma once

#include "app/commands/surface_flags.h"
#include "app/session/session.h"

#include <memory>
#include <string>

namespace ramus::app {

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
