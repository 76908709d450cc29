// Reads the inputs that a command line names: trees, masks and sessions.
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

// Reads a vessel tree, from a tree file or from a mask. All commands read their trees with this function. Shows a
// progress bar; an interrupt cancels. Prints repairs on standard error, and with --verbose also assumptions and counts.
// Fails with the errors of the reader.
[[nodiscard]] Result<tree::VesselTree> load_tree(const std::string& file, const SurfaceFlags& flags);
// The same with the reading options of a session instead of those of `flags`.
[[nodiscard]] Result<tree::VesselTree> load_tree(const std::string& file, const SurfaceFlags& flags,
                                                 const io::ReadOptions& reading);

// Prints a line on standard error if --verbose is given.
void say(const SurfaceFlags& flags, const std::string& line);

// Reads a mask or scan. All commands read their volumes with this function. Shows a progress bar; an interrupt cancels.
// With --verbose, prints on standard error what was assumed because the file does not say it.
// `threshold`: as in io::ReadVolumeOptions.
[[nodiscard]] Result<volume::Volume> load_volume(const std::string& file, const SurfaceFlags& flags,
                                                 std::optional<double> threshold = {});

// Prints the suspicions of the volume's reader on standard error, for example that the size looks like another unit.
void warn_about(const std::string& file, const volume::Volume& volume);

// Selects the branches of some vessel systems. `systems`: the values of --system, names in the session or numbers from
// 1. Returns one entry per branch: 1 if its system is among them, 0 otherwise; all are 1 if `systems` is empty. Fails,
// with `where` as the place, if the tree has no such system or no branch is selected.
[[nodiscard]] Result<std::vector<std::uint8_t>> branches_of(const tree::VesselTree& tree, const Marks& marks,
                                                            const std::vector<std::string>& systems,
                                                            const std::string& where);

// A session with its tree.
struct OpenedSession {
    Session session;
    std::shared_ptr<const tree::VesselTree> tree; // with the session's edits; null: a session without a tree
    std::shared_ptr<const tree::VesselTree> base; // as read from the file, without edits
    bool has_camera = false;                      // whether the session file has a camera
};

// Whether open_session() accepts a session that has context shapes but no tree.
enum class Alone { kRefused, kAllowed };

// Opens the session and the tree that a command line names. One of the two names may be empty: a tree without a session
// gives a new session, and a session without a tree file uses the tree that it names. Options on the command line take
// precedence over those of the session. Fails if a file cannot be read, or if the session does not fit the tree.
[[nodiscard]] Result<OpenedSession> open_session(const std::string& tree_file, const std::string& session_file,
                                                 const SurfaceFlags& flags, Alone alone = Alone::kRefused);

} // namespace ramus::app
