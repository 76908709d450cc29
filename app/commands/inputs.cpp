#include "app/commands/inputs.h"

#include "app/commands/progress.h"
#include "app/session/numbers.h"
#include "app/session/session_file.h"
#include "core/io/volumes/volume_file.h"

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <utility>

namespace ramus::app {

Result<tree::VesselTree> load_tree(const std::string& file, const SurfaceFlags& flags) {
    auto tree = io::read_tree(file, flags.read);
    if (!tree) return tree;
    // A file that needs many repairs shall not drown what else is said.
    constexpr std::size_t kShown = 5;
    const std::size_t shown = flags.verbose ? tree->repairs.size() : std::min(kShown, tree->repairs.size());
    for (std::size_t i = 0; i < shown; ++i) std::cerr << "ramus: repaired: " << tree->repairs[i] << '\n';
    if (shown < tree->repairs.size())
        std::cerr << "ramus: repaired: " << grouped(tree->repairs.size() - shown)
                  << " more places (ramus info lists them)\n";
    say(flags, file + ": " + counted(tree->points.size(), "point", "points") + ", " +
                   counted(tree->segment_count(), "segment", "segments") + ", " +
                   counted(tree->branches.size(), "branch", "branches"));
    return tree;
}

void say(const SurfaceFlags& flags, const std::string& line) {
    if (flags.verbose) std::cerr << "ramus: " << line << '\n';
}

Result<volume::Volume> load_volume(const std::string& file, const SurfaceFlags& flags) {
    Job job;
    auto read = [&] {
        const CancelOnInterrupt cancel(job);
        const ProgressBar bar("reading", job);
        return io::read_volume(file, {static_cast<double>(flags.surface.memory_bytes)}, job);
    }();
    if (job.cancelled()) return fail("cancelled");
    if (!read) return read;
    say(flags, file + ": " + read->type + ", " + std::to_string(read->size.x) + " x " + std::to_string(read->size.y) +
                   " x " + std::to_string(read->size.z) + " voxels");
    for (const std::string& note : read->notes) say(flags, file + ": " + note);
    return read;
}

Result<OpenedSession> open_session(const std::string& tree_file, const std::string& session_file,
                                   const SurfaceFlags& flags) {
    SavedSession saved;
    if (session_file.empty()) {
        saved.session.marks.options = flags.surface;
    } else {
        RAMUS_TRY(read, read_session(session_file));
        saved = std::move(read);
        saved.session.marks.options = flags.over(saved.session.marks.options);
    }
    OpenedSession opened{std::move(saved.session), nullptr, saved.has_camera};
    if (!tree_file.empty()) opened.session.tree.path = std::filesystem::absolute(tree_file).lexically_normal();
    auto tree = load_tree(tree_file.empty() ? opened.session.tree.path.string() : tree_file, flags);
    if (!tree) return tl::unexpected(tree.error());
    RAMUS_TRY(checksum, checksum_of(opened.session.tree.path));
    if (auto fits = check_against(opened.session, *tree, checksum, session_file); !fits)
        return tl::unexpected(fits.error());
    opened.session.tree.checksum = checksum;
    opened.tree = std::make_shared<const tree::VesselTree>(std::move(*tree));
    return opened;
}

} // namespace ramus::app
