#include "app/picture/surface_names.h"

#include "app/picture/colouring.h"
#include "app/session/colour_by.h"
#include "app/session/labels.h"
#include "app/session/systems.h"
#include "render/scene/frame.h"

#include <filesystem>

namespace ramus::app {

namespace {

std::string name_of_branch(int id, int source, const BranchNames& names) {
    std::string number = "branch " + std::to_string(id);
    if (source == tree::kNoBranch) return number;
    return source == id ? names.at(source) : names.at(source) + ", " + number;
}

} // namespace

std::optional<io::PartsBy> parts_named(std::string_view word) {
    if (word == "none") return io::PartsBy::kNone;
    if (word == "system") return io::PartsBy::kSystem;
    if (word == "branch") return io::PartsBy::kBranch;
    return std::nullopt;
}

io::PartsBy usual_parts(const tree::VesselTree& tree) {
    return tree.systems.empty() ? io::PartsBy::kBranch : io::PartsBy::kSystem;
}

io::MeshNames surface_names(const tree::VesselTree& tree, const TreeFacts& facts, const Marks& marks, const Plan* plan,
                            io::PartsBy by) {
    io::MeshNames names;
    names.by = by;
    names.claims = tree.claims;
    names.colour = bytes_of(render::Appearance{}.vessel);
    if (!tree.source.empty()) names.name = std::filesystem::path(tree.source).stem().string();
    names.systems = systems_of(tree, marks);
    for (std::size_t i = 0; i < names.systems.size(); ++i) {
        const auto system = static_cast<int>(i);
        const io::Colour colour = bytes_of(shown_colour(names.systems, system));
        names.systems[i] = {system_name(names.systems, system), colour};
    }
    const std::vector<glm::vec3> colours = colouring_of(tree, facts, marks, plan).branches;
    const std::vector<int> sources = label_sources(facts.dependency, marks);
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const int system = tree.branches[id].system;
        names.branches.push_back({name_of_branch(static_cast<int>(id), sources[id], marks.names),
                                  !colours.empty()       ? bytes_of(colours[id])
                                  : tree.systems.empty() ? names.colour
                                                         : names.systems[static_cast<std::size_t>(system)].colour,
                                  system});
        const tree::Branch& branch = tree.branches[id];
        const BranchFacts& known = facts.branches[id];
        names.vessels.push_back(
            {branch.parent, branch.generation, branch.strahler, known.length_mm, 0.5 * known.diameter_mm.mean});
    }
    return names;
}

} // namespace ramus::app
