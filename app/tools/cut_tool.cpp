#include "app/tools/cut_tool.h"

#include "app/session/numbers.h"
#include "app/tools/spelling.h"
#include "core/measure/branch_point.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace ramus::app {

namespace {

const glm::vec4 kCutColour{1.0F, 0.48F, 0.40F, 1.0F};
constexpr int kCorners = 40;

bool on_tree(const Pointing& pointing, const render::Pick& pick) {
    return pick.branch >= 0 && pick.branch < pointing.document.branch_count();
}

} // namespace

void CutTool::press(const Pointing& pointing) {
    const render::Pick pick = pointing.pick();
    if (!on_tree(pointing, pick)) return;
    const double fraction = measure::nearest_fraction(*pointing.document.tree(), pick.branch, pick.position);
    command({"cut", std::to_string(pick.branch), spelled(fraction, 3)});
}

void CutTool::move(const Pointing& pointing) { under_ = pointing.pick(); }

// The ring of the cross-section, a little wider than the vessel.
ToolDrawing CutTool::drawing(const Pointing& pointing) const {
    ToolDrawing drawing;
    if (!on_tree(pointing, under_)) return drawing;
    const tree::VesselTree& tree = *pointing.document.tree();
    const double fraction = measure::nearest_fraction(tree, under_.branch, under_.position);
    const measure::BranchPoint place = measure::point_on(tree, under_.branch, fraction);
    const glm::dvec3 aside = std::abs(place.direction.x) < 0.8 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(place.direction, aside));
    const glm::dvec3 v = glm::cross(place.direction, u);
    ToolDrawing::Line ring{.points = {}, .colour = kCutColour, .width = 2.0F, .closed = true};
    for (int i = 0; i < kCorners; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kCorners;
        const auto at =
            render::project(pointing.camera(), pointing.size,
                            place.position + 1.15 * place.radius_mm * (std::cos(angle) * u + std::sin(angle) * v));
        if (!at) return drawing;
        ring.points.emplace_back(*at);
    }
    drawing.lines.push_back(std::move(ring));
    drawing.texts.push_back({pointing.at + glm::dvec2(16.0, 12.0) * static_cast<double>(pointing.pixel_ratio),
                             "\xC3\x98 " + digits(2.0 * place.radius_mm) + " mm", kCutColour});
    return drawing;
}

} // namespace ramus::app
