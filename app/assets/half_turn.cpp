#include "app/assets/half_turn.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace ramus::app {

namespace {

bool overlap(const render::Box& a, const render::Box& b) {
    return glm::all(glm::lessThanEqual(a.lower, b.upper)) && glm::all(glm::lessThanEqual(b.lower, a.upper));
}

render::Box turned(const render::Box& box) {
    return {{-box.upper.x, -box.upper.y, box.lower.z}, {-box.lower.x, -box.lower.y, box.upper.z}};
}

} // namespace

std::string half_turn_hint(const Place& mesh, const Place& vessels, const std::string& option) {
    if (mesh.box.empty() || vessels.box.empty() || overlap(mesh.box, vessels.box) ||
        !overlap(turned(mesh.box), vessels.box))
        return {};
    const std::string lies = "it lies apart from the vessels, and would lie on them if it were turned by 180 degrees "
                             "about z, as LPS is from RAS: ";
    if (mesh.axes != tree::SaidBy::kFile) return lies + "read it with " + option;
    if (vessels.axes != tree::SaidBy::kFile)
        return lies + "its file states its axes; state those of the tree with --orientation LPS";
    return {};
}

std::string other_axes_option(const std::string& read_in) {
    return std::string("--mesh-orientation ") + (read_in == "LPS" ? "RAS" : "LPS");
}

} // namespace ramus::app
