#include "app/session/systems.h"

#include "core/base/words.h"
#include "core/io/file_format.h"
#include "core/io/text_numbers.h"

#include <algorithm>
#include <array>
#include <utility>

namespace ramus::app {

const Systems& systems_of(const tree::VesselTree& tree, const Marks& marks) {
    return marks.systems.size() == tree.systems.size() ? marks.systems : tree.systems;
}

void set_systems(Marks& marks, Systems systems, const tree::VesselTree& tree) {
    if (systems == tree.systems)
        marks.systems.clear();
    else
        marks.systems = std::move(systems);
}

tree::VesselTree with_systems(tree::VesselTree tree, const Marks& marks) {
    tree.systems = systems_of(tree, marks);
    return tree;
}

std::string system_name(const Systems& systems, int system) {
    const auto index = static_cast<std::size_t>(system);
    if (index >= systems.size()) return {};
    return systems[index].name.empty() ? "system " + std::to_string(system + 1) : systems[index].name;
}

std::string system_of(const tree::VesselTree& tree, const Marks& marks, int branch) {
    return system_name(systems_of(tree, marks), tree.branches[static_cast<std::size_t>(branch)].system);
}

glm::vec3 shown_colour(const Systems& systems, int system) {
    // A vein's blue and an artery's red first.
    constexpr std::array<glm::vec3, 6> kOthers{{{0.35F, 0.55F, 0.85F},
                                                {0.84F, 0.37F, 0.31F},
                                                {0.90F, 0.72F, 0.30F},
                                                {0.40F, 0.72F, 0.50F},
                                                {0.70F, 0.52F, 0.80F},
                                                {0.45F, 0.75F, 0.78F}}};
    const auto index = static_cast<std::size_t>(system);
    const auto& colour = systems[index].colour;
    if (colour == std::array<std::uint8_t, 3>{}) return kOthers[index % kOthers.size()];
    return srgb_of(colour);
}

Result<int> find_system(const Systems& systems, std::string_view word) {
    const auto count = static_cast<int>(systems.size());
    if (count == 0) return fail("this tree has no systems");
    if (const auto number = parsed<int>(word); number && *number >= 1 && *number <= count) return *number - 1;
    for (int system = 0; system < count; ++system)
        if (io::lower_case(system_name(systems, system)) == io::lower_case(word)) return system;
    std::vector<std::string> names;
    for (int system = 0; system < count; ++system) names.push_back(system_name(systems, system));
    const std::vector<std::string_view> known(names.begin(), names.end());
    return fail("there is no system \"" + std::string(word) + "\"", {}, "it has " + io::listed(known));
}

std::vector<int> branches_in_system(const tree::VesselTree& tree, int system) {
    return branches_where(tree.branches.size(), [&](std::size_t id) { return tree.branches[id].system == system; });
}

std::vector<SystemFacts> system_facts(const tree::VesselTree& tree, const TreeFacts& facts, const Marks& marks) {
    std::vector<SystemFacts> found(tree.systems.size());
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const auto system = static_cast<std::size_t>(tree.branches[id].system);
        if (system >= found.size()) continue;
        ++found[system].branches;
        if (state_of(marks, static_cast<int>(id)) != tree::BranchState::kHidden) ++found[system].visible;
        found[system].length_mm += facts.branches[id].length_mm;
        found[system].volume_mm3 += facts.branches[id].volume_mm3;
    }
    return found;
}

ColourBy first_colouring(ColourBy wanted, const tree::VesselTree& tree) {
    if (wanted == ColourBy::kNothing && tree.systems.size() > 1) return ColourBy::kSystem;
    if (wanted == ColourBy::kSystem && tree.systems.size() < 2) return ColourBy::kNothing;
    return wanted;
}

} // namespace ramus::app
