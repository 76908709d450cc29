#include "app/commands/load_tree.h"

#include "app/session/numbers.h"

#include <cstdio>
#include <iostream>

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

} // namespace ramus::app
