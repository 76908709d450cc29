// Session files: JSON with `version`, `tree` (path, checksum), `selection`, `states`, `lesions`, `lesion_meshes`,
// `cuts`, `measurements`, `names`, `camera` and `options`. Optional: `comparison`, `systems` (if renamed or
// recoloured), `edits` (ids refer to the edited tree), `reading` (if not the default). `tree` is null if masks, scans
// or meshes are shown without a tree; `context` lists them.
//
// Guarantees: a session that is written and read again is equal, except for the machine's settings (threads, memory).
// Reading rejects unknown names, wrong types and other versions, and names the file in the error. It does not check
// that branch ids exist, which needs the tree: check_against().
//
// The path of the tree is relative if the tree is in the session file's folder or below, so that both can be moved
// together, otherwise absolute.
#pragma once

#include "app/session/session.h"
#include "core/base/error.h"

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

namespace ramus::app {

inline constexpr int kSessionVersion = 1;
inline constexpr std::uintmax_t kMostSessionBytes = std::uintmax_t{64} << 20;

// `folder`: of the session file.
[[nodiscard]] nlohmann::json to_json(const Session& session, const std::filesystem::path& folder);

struct SavedSession {
    Session session;
    bool has_camera = false; // false: the caller fits a camera to the tree
};
[[nodiscard]] Result<SavedSession> session_from_json(const nlohmann::json& json, const std::filesystem::path& folder,
                                                     const std::string& where);

[[nodiscard]] Result<SavedSession> read_session(const std::filesystem::path& path);
// Atomic: the file is complete or absent.
[[nodiscard]] Result<void> write_session(const Session& session, const std::filesystem::path& path);

// Checksum of the file's bytes, or of the names and sizes in a folder (app/session/checksum.h).
[[nodiscard]] Result<std::string> checksum_of(const std::filesystem::path& path);

// Fails if the tree's file is not the one that the session was saved with.
[[nodiscard]] Result<void> check_checksum(const Session& session, const std::string& checksum,
                                          const std::string& where);

// Fails if `session` does not belong to `tree`, whose edits must have been made: the checksum must match and every
// branch id must exist. `where` names the session file in errors.
[[nodiscard]] Result<void> check_against(const Session& session, const tree::VesselTree& tree,
                                         const std::string& checksum, const std::string& where);

} // namespace ramus::app
