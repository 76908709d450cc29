#include "app/picture/close_ups.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <set>

namespace ramus::app {

namespace {

constexpr double kCloseUpHeight = 14.0; // of a close-up's picture, in diameters of the vessel in its middle
constexpr double kCloseUpShare = 0.35;  // of the whole tree's picture that it shows at most, in height

} // namespace

std::vector<CloseUp> close_ups_of(const tree::VesselTree& tree) {
    std::map<std::uint32_t, int> meeting;
    for (const tree::Branch& branch : tree.branches)
        for (const std::uint32_t end : {branch.points.front(), branch.points.back()}) ++meeting[end];
    std::vector<CloseUp> found;
    for (const auto& [point, branches] : meeting)
        if (branches > 2) found.push_back({tree.points[point].position, tree.points[point].radius});
    for (std::size_t i = 0; found.size() < kCloseUps && i < tree.branches.size(); ++i) {
        const auto& points = tree.branches[i].points;
        const tree::Point& middle = tree.points[points[points.size() / 2]];
        found.push_back({middle.position, middle.radius});
    }
    std::ranges::stable_sort(found, std::greater<>(), &CloseUp::radius);
    return found;
}

std::vector<CloseUp> choose_close_ups(render::Renderer& renderer, const render::Frame& drawn,
                                      const std::vector<CloseUp>& all) {
    std::vector<CloseUp> seen;
    for (const CloseUp& one : all) {
        const auto at = render::project(drawn.camera, drawn.size, one.position);
        const glm::dvec2 margin = 0.08 * glm::dvec2(drawn.size);
        if (!at || at->x < margin.x || at->y < margin.y || at->x > drawn.size.x - margin.x ||
            at->y > drawn.size.y - margin.y)
            continue;
        const render::Pick pick = renderer.pick(at->x, at->y);
        if (pick.branch != render::kNoBranch && glm::distance(pick.position, one.position) < 2.0 * one.radius)
            seen.push_back(one);
    }
    const std::vector<CloseUp>& from = seen.size() >= kCloseUps ? seen : all;
    std::set<std::size_t> ranks;
    for (const double share : {0.0, 0.4, 0.85})
        ranks.insert(std::min(from.size() - 1, static_cast<std::size_t>(share * static_cast<double>(from.size()))));
    std::vector<CloseUp> chosen;
    for (const std::size_t rank : ranks) chosen.push_back(from[rank]);
    return chosen;
}

render::Camera close_to(const CloseUp& close_up, render::Camera camera) {
    const double slope = std::tan(glm::radians(0.5 * camera.view_angle));
    const double whole = slope * glm::distance(camera.position, camera.focal_point);
    const double half = std::min(0.5 * kCloseUpHeight * 2.0 * close_up.radius, kCloseUpShare * whole);
    const glm::dvec3 forward = render::axes_of(camera).forward;
    camera.focal_point = close_up.position;
    camera.position = close_up.position - half / slope * forward;
    camera.scale = half;
    return camera;
}

} // namespace ramus::app
