// Session files: JSON with `version`, `tree` (path, checksum), `selection`, `states`, `lesions`, `lesion_meshes`,
// `cuts`, `measurements`, `names`, `camera` and `options`, `comparison` where surfaces are compared, `systems` where
// they have other names or colours than in the file, `edits` where the tree was edited (ids are those of the tree after
// them), and `reading` where the tree's file is not read as usual. Writing and reading again gives an equal Session,
// but for what is the machine's business: threads and memory.
//
// `tree` is null where masks, scans or meshes are shown without one: `context` has them.
//
// The tree's path is written relative to the session file when the tree lies in the same folder or below, so that the
// two can move together; absolute otherwise. Reading refuses unknown names, wrong types and other versions with the
// file's name in the message. Whether the branch ids exist is for whoever has the tree to check: check_against().
#pragma once

#include "app/session/session.h"
#include "core/base/error.h"

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

namespace ramus::app {

inline constexpr int kSessionVersion = 1;
inline constexpr std::uintmax_t kMostSessionBytes = std::uintmax_t{64} << 20;

// `folder`: where the session file lies or will lie.
[[nodiscard]] nlohmann::json to_json(const Session& session, const std::filesystem::path& folder);

struct SavedSession {
    Session session;
    bool has_camera = false; // without one the reader fits its own to the tree
};
[[nodiscard]] Result<SavedSession> session_from_json(const nlohmann::json& json, const std::filesystem::path& folder,
                                                     const std::string& where);

[[nodiscard]] Result<SavedSession> read_session(const std::filesystem::path& path);
// Atomic: the file is whole or not there.
[[nodiscard]] Result<void> write_session(const Session& session, const std::filesystem::path& path);

// Of the file's bytes, or of the names and sizes in a folder (app/session/checksum.h).
[[nodiscard]] Result<std::string> checksum_of(const std::filesystem::path& path);

// Whether the session's tree is still the file that it was saved with.
[[nodiscard]] Result<void> check_checksum(const Session& session, const std::string& checksum,
                                          const std::string& where);

// Whether `session` belongs to `tree`, its edits made: the checksum is that of its file and every branch id exists.
// `where` names the session file in the message.
[[nodiscard]] Result<void> check_against(const Session& session, const tree::VesselTree& tree,
                                         const std::string& checksum, const std::string& where);

} // namespace ramus::app
