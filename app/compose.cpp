#include "app/compose.h"

#include "app/centerlines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

namespace ramus::app {

namespace {

// Stations of matplotlib's viridis (CC0): even steps look even, also in grey and to colour-blind eyes. The dark end is
// lifted so that it stands out from the dark background.
constexpr std::array<glm::vec3, 5> kRamp{glm::vec3{0.35F, 0.25F, 0.62F}, glm::vec3{0.23F, 0.42F, 0.66F},
                                         glm::vec3{0.13F, 0.62F, 0.60F}, glm::vec3{0.45F, 0.80F, 0.38F},
                                         glm::vec3{0.99F, 0.91F, 0.15F}};

glm::vec3 ramp(double t) {
    const double at = std::clamp(t, 0.0, 1.0) * (kRamp.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(at), kRamp.size() - 2);
    return glm::mix(kRamp[below], kRamp[below + 1], static_cast<float>(at - static_cast<double>(below)));
}

// Neighbouring ids far apart on the colour circle: steps of the golden angle.
glm::vec3 distinct(std::size_t index) {
    const double hue = std::fmod(static_cast<double>(index) * 0.61803398875, 1.0) * 6.0;
    const auto channel = [&](double shift) {
        const double k = std::fmod(shift + hue, 6.0);
        return static_cast<float>(0.88 - 0.55 * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0));
    };
    return {channel(5.0), channel(3.0), channel(1.0)};
}

double mean_diameter(const tree::VesselTree& tree, const tree::Branch& branch) {
    double sum = 0.0;
    for (const auto point : branch.points) sum += 2.0 * tree.points[point].radius;
    return branch.points.empty() ? 0.0 : sum / static_cast<double>(branch.points.size());
}

} // namespace

std::vector<glm::vec3> branch_colours(const tree::VesselTree& tree, ColourBy quantity) {
    std::vector<glm::vec3> colours;
    if (quantity == ColourBy::kNothing) return colours;
    const auto& branches = tree.branches;
    if (quantity == ColourBy::kBranch) {
        for (std::size_t i = 0; i < branches.size(); ++i) colours.push_back(distinct(i));
        return colours;
    }
    std::vector<double> values;
    for (const tree::Branch& branch : branches) {
        if (quantity == ColourBy::kGeneration)
            values.push_back(branch.generation);
        else if (quantity == ColourBy::kStrahler)
            values.push_back(branch.strahler);
        else
            values.push_back(std::log(std::max(mean_diameter(tree, branch), 1e-12))); // spans decades
    }
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    for (const double value : values)
        colours.push_back(ramp(*most > *least ? (value - *least) / (*most - *least) : 0.5));
    return colours;
}

render::Frame compose(const Session& session, const std::shared_ptr<const tree::VesselTree>& tree,
                      std::shared_ptr<const render::PagedMesh> mesh, const Viewing& viewing) {
    render::Frame frame;
    frame.mesh = std::move(mesh);
    frame.camera = session.camera;
    frame.overlays.orientation_cube = frame.overlays.scale_bar = frame.mesh != nullptr; // nothing to measure
    frame.size = viewing.size;
    frame.pixel_ratio = viewing.pixel_ratio;
    frame.states = session.marks.states;
    frame.selected = session.marks.selection;
    frame.hovered = viewing.hovered;
    if (tree && frame.hovered >= 0 && frame.hovered < static_cast<int>(tree->branches.size())) {
        frame.hovered_dependents = tree::subtree(*tree, frame.hovered);
        std::erase(frame.hovered_dependents, frame.hovered);
    }
    frame.background.transparent = viewing.transparent;
    frame.quality = viewing.quality;
    const GlassLook& glass = viewing.glass ? *viewing.glass : session.marks.glass;
    frame.appearance.glass_opacity = static_cast<float>(glass.opacity);
    // A grey with a cool tint, as bright as it says.
    frame.appearance.glass = glm::min(static_cast<float>(glass.grey) * glm::vec3(0.943F, 1.0F, 1.086F), 1.0F);
    if (tree && std::ranges::find(frame.states, render::BranchState::kDefocused) != frame.states.end())
        frame.centerlines = centerlines_of(tree, session.marks.options);
    if (tree) frame.colours = branch_colours(*tree, session.marks.colour_by);
    return frame;
}

} // namespace ramus::app
