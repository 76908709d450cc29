#include "app/assets/selection_outline.h"

#include "core/base/lines.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

namespace ramus::app {

namespace {

constexpr std::size_t kMostOutlinePoints = 8'000; // tuned: takes some milliseconds
constexpr float kOutlineWidth = 2.2F;             // points

struct Tube {
    std::vector<glm::dvec3> places;
    std::vector<double> radii;
};

Tube tube_of(const render::Centerlines& lines, int branch) {
    Tube tube;
    if (static_cast<std::size_t>(branch) >= lines.runs.size()) return tube;
    const auto& [first, count] = lines.runs[static_cast<std::size_t>(branch)];
    for (std::uint32_t i = first; i < first + count; ++i) {
        tube.places.push_back(lines.origin + glm::dvec3(lines.points[i]));
        tube.radii.push_back(0.5 * static_cast<double>(lines.details[i].diameter_mm));
    }
    return tube;
}

// Adds intermediate places, since an outline may begin and end at any of them.
Tube finer(const Tube& tube) {
    constexpr double kMostPieces = 16.0; // per segment
    Tube fine;
    for (std::size_t i = 0; i + 1 < tube.places.size(); ++i) {
        const double length = glm::distance(tube.places[i], tube.places[i + 1]);
        const double radius = std::max(tube.radii[i], tube.radii[i + 1]);
        const auto pieces = static_cast<int>(std::clamp(std::ceil(length / (0.7 * radius)), 1.0, kMostPieces));
        for (int piece = 0; piece < pieces; ++piece) {
            const double share = static_cast<double>(piece) / pieces;
            fine.places.push_back(tube.places[i] + share * (tube.places[i + 1] - tube.places[i]));
            fine.radii.push_back(tube.radii[i] + share * (tube.radii[i + 1] - tube.radii[i]));
        }
    }
    if (!tube.places.empty()) fine.places.push_back(tube.places.back()), fine.radii.push_back(tube.radii.back());
    return fine;
}

// Whether a place is in the blend of two connected vessels: the outline ends there, although nothing hides it.
bool blends(const Tube& tube, const glm::dvec3& place) {
    constexpr double kBlend = 1.3; // radii; tuned on forks, which are thicker than their tubes
    for (std::size_t i = 1; i < tube.places.size(); ++i) {
        const glm::dvec3 along = tube.places[i] - tube.places[i - 1];
        const double share = share_along(place - tube.places[i - 1], along);
        const double radius = tube.radii[i - 1] + share * (tube.radii[i] - tube.radii[i - 1]);
        if (glm::distance(tube.places[i - 1] + share * along, place) < kBlend * radius) return true;
    }
    return false;
}

class Outline {
public:
    explicit Outline(SelectionOutline& outline) : of_(outline.of), tree_(*of_.tree), marks_(outline.marks) {}

    // Returns the number of places used.
    std::size_t add(int branch) {
        const Tube tube = finer(tube_of(*of_.lines, branch));
        if (tube.places.size() < 2) return 0;
        const std::vector<Tube> met = neighbours(branch);
        for (const double side : {-1.0, 1.0}) add_side(tube, met, side);
        if (tree_.branches[static_cast<std::size_t>(branch)].children.empty()) add_cap(tube);
        return tube.places.size();
    }

private:
    // The vessels at its ends, selected or not.
    [[nodiscard]] std::vector<Tube> neighbours(int branch) const {
        std::vector<Tube> met;
        const tree::Branch& own = tree_.branches[static_cast<std::size_t>(branch)];
        const auto add = [&](int other) {
            if (other != tree::kNoBranch && other != branch) met.push_back(tube_of(*of_.lines, other));
        };
        add(own.parent);
        for (const int child : own.children) add(child);
        if (own.parent != tree::kNoBranch)
            for (const int sibling : tree_.branches[static_cast<std::size_t>(own.parent)].children) add(sibling);
        return met;
    }

    [[nodiscard]] glm::dvec3 towards_eye(const glm::dvec3& place) const {
        const render::Camera& camera = of_.camera;
        return camera.orthographic ? -render::axes_of(camera).forward : glm::normalize(camera.position - place);
    }

    void add_side(const Tube& tube, const std::vector<Tube>& met, double side) {
        std::vector<glm::dvec3> line;
        const auto end_line = [&] {
            if (line.size() > 1) marks_.push_back(of_selection(std::move(line)));
            line.clear();
        };
        for (std::size_t i = 0; i < tube.places.size(); ++i) {
            const glm::dvec3 along =
                tube.places[std::min(i + 1, tube.places.size() - 1)] - tube.places[i > 0 ? i - 1 : 0];
            const glm::dvec3 across = glm::cross(along, towards_eye(tube.places[i]));
            const double length = glm::length(across);
            if (!(length > 1e-9 * glm::length(along))) { // seen from its end
                end_line();
                continue;
            }
            const glm::dvec3 place = tube.places[i] + side * tube.radii[i] / length * across;
            if (std::ranges::any_of(met, [&](const Tube& other) { return blends(other, place); }))
                end_line();
            else
                line.push_back(place);
        }
        end_line();
    }

    // Half a circle around the free end.
    void add_cap(const Tube& tube) {
        constexpr int kSteps = 12;
        const glm::dvec3 end = tube.places.back(), eye = towards_eye(end);
        const glm::dvec3 along = end - tube.places[tube.places.size() - 2], across = glm::cross(along, eye);
        if (!(glm::length(across) > 1e-9 * glm::length(along))) return;
        const glm::dvec3 u = glm::normalize(across), v = glm::normalize(glm::cross(eye, u));
        std::vector<glm::dvec3> line;
        for (int i = 0; i <= kSteps; ++i) {
            const double angle = 3.14159265358979 * i / kSteps;
            line.push_back(end + tube.radii.back() * (std::cos(angle) * u + std::sin(angle) * v));
        }
        marks_.push_back(of_selection(std::move(line)));
    }

    [[nodiscard]] static render::MarkLine of_selection(std::vector<glm::dvec3> line) {
        return {std::move(line), render::Appearance{}.selection, kOutlineWidth, true};
    }

    const SelectionOutline::Of& of_;
    const tree::VesselTree& tree_;
    std::vector<render::MarkLine>& marks_;
};

} // namespace

SelectionOutline selection_outline(SelectionOutline::Of of) {
    SelectionOutline made{std::move(of), {}};
    if (!made.of.lines || !made.of.tree || made.of.selection.empty()) return made;
    const auto& lines = *made.of.lines;
    const auto& states = made.of.states;
    std::vector<std::pair<float, int>> thickest; // by the diameter at its start
    for (const int branch : made.of.selection) {
        const auto index = static_cast<std::size_t>(branch);
        const bool hidden = index < states.size() && states[index] == tree::BranchState::kHidden;
        if (branch < 0 || index >= lines.runs.size() || index >= made.of.tree->branches.size() || hidden) continue;
        if (lines.runs[index].count > 1)
            thickest.emplace_back(lines.details[lines.runs[index].first].diameter_mm, branch);
    }
    std::ranges::sort(thickest, std::greater<>());
    Outline outline(made);
    std::size_t points = 0;
    for (const auto& [diameter, branch] : thickest) {
        points += outline.add(branch);
        if (points > kMostOutlinePoints) break;
    }
    return made;
}

} // namespace ramus::app
