#include "tests/fuzz/target.h"

#include "tests/support/temporary_folder.h"

#include <cmath>
#include <fstream>
#include <glm/vec3.hpp>

namespace ramus::fuzz {

namespace {

void check_branch(const tree::VesselTree& tree, std::size_t id) {
    const tree::Branch& branch = tree.branches[id];
    const auto count = static_cast<int>(tree.branches.size());
    must(branch.points.size() >= 2, "a branch has fewer than two points");
    for (std::size_t n = 0; n < branch.points.size(); ++n) {
        must(branch.points[n] < tree.points.size(), "a branch has a point that is not there");
        must(n == 0 || tree.points[branch.points[n]].position != tree.points[branch.points[n - 1]].position,
             "two points of a branch lie at one place");
    }
    must(branch.parent >= tree::kNoBranch && branch.parent < count, "a branch has a parent that is not there");
    if (branch.parent != tree::kNoBranch) {
        const tree::Branch& parent = tree.branches[static_cast<std::size_t>(branch.parent)];
        must(branch.generation == parent.generation + 1, "a branch is not one generation after its parent");
        must(branch.system == parent.system, "a branch is of another system than its parent");
    }
    for (const int child : branch.children)
        must(child >= 0 && child < count && tree.branches[static_cast<std::size_t>(child)].parent == int(id),
             "a child knows another parent");
    must(branch.system >= 0 && (branch.system == 0 || branch.system < static_cast<int>(tree.systems.size())),
         "a branch is of a system that is not there");
}

} // namespace

void check_tree(const tree::VesselTree& tree) {
    for (const tree::Point& point : tree.points) {
        must(std::isfinite(point.radius) && point.radius > 0.0, "a radius is not positive");
        for (int axis = 0; axis < 3; ++axis) must(std::isfinite(point.position[axis]), "a position is not finite");
    }
    for (std::size_t id = 0; id < tree.branches.size(); ++id) check_branch(tree, id);
    must(tree.labels.empty() || tree.labels.size() == tree.points.size(), "there are more or fewer labels than points");
    must(!tree.roots.empty(), "a tree has no root");
    for (const std::uint32_t root : tree.roots) must(root < tree.points.size(), "a root is not there");
    must(tree.loop_count >= 0, "there are less than no loops");
}

std::pair<std::string_view, std::string_view> two_files(std::string_view bytes) {
    constexpr std::string_view kBetween = "\n====\n";
    const std::size_t at = bytes.find(kBetween);
    if (at == std::string_view::npos) return {bytes, {}};
    return {bytes.substr(0, at + 1), bytes.substr(at + kBetween.size())};
}

std::string written_file(const std::string& name, std::string_view bytes) {
    static const TemporaryFolder folder;
    std::string path = (folder.path() / name).string();
    std::ofstream file(path, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path;
}

const std::vector<Target>& targets() {
    static const std::vector<Target> all = [] {
        std::vector<Target> joined;
        for (const auto part : {tree_targets, volume_targets, mesh_targets, session_targets, mask_targets})
            for (Target& target : part()) joined.push_back(std::move(target));
        return joined;
    }();
    return all;
}

} // namespace ramus::fuzz
