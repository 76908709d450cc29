#include "app/commands/open_session.h"

#include "app/commands/load_tree.h"
#include "app/session/session_file.h"

#include <filesystem>
#include <utility>

namespace ramus::app {

Result<OpenedSession> open_session(const std::string& tree_file, const std::string& session_file,
                                   const SurfaceFlags& flags) {
    SavedSession saved;
    if (session_file.empty()) {
        saved.session.marks.options = flags.surface;
    } else {
        auto read = read_session(session_file);
        if (!read) return tl::unexpected(read.error());
        saved = std::move(*read);
        saved.session.marks.options = flags.over(saved.session.marks.options);
    }
    OpenedSession opened{std::move(saved.session), nullptr, saved.has_camera};
    if (!tree_file.empty()) opened.session.tree.path = std::filesystem::absolute(tree_file).lexically_normal();
    auto tree = load_tree(tree_file.empty() ? opened.session.tree.path.string() : tree_file, flags);
    if (!tree) return tl::unexpected(tree.error());
    const auto checksum = checksum_of(opened.session.tree.path);
    if (!checksum) return tl::unexpected(checksum.error());
    if (auto fits = check_against(opened.session, *tree, *checksum, session_file); !fits)
        return tl::unexpected(fits.error());
    opened.session.tree.checksum = *checksum;
    opened.tree = std::make_shared<const tree::VesselTree>(std::move(*tree));
    return opened;
}

} // namespace ramus::app
