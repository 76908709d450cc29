#include "app/tools/aim.h"

#include "core/base/lines.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace ramus::app {

void Aim::see(std::vector<render::DepthMap> maps, const render::Camera& camera) {
    maps_ = std::move(maps);
    visible_ = render::visible_in(maps_);
    const bool of_now = !maps_.empty() && maps_.front().camera == camera;
    if (of_now || !held_ || held_->camera != camera) look_up();
}

void Aim::point(std::size_t viewport, glm::dvec2 pixel, double reach) {
    spot_ = Spot{viewport, pixel, reach};
    look_up();
}

void Aim::point_nowhere() {
    spot_.reset();
    held_.reset();
}

void Aim::look_up() {
    held_.reset();
    if (!spot_ || spot_->viewport >= maps_.size()) return;
    const render::DepthMap& map = maps_[spot_->viewport];
    if (const auto under = map.point_at(spot_->pixel, spot_->reach)) held_ = Held{*under, true, map.camera};
}

void Aim::carry(const render::Camera& camera) {
    if (held_) held_->camera = camera;
}

void Aim::carry(const render::Camera& camera, glm::dvec2 pixel) {
    if (spot_) spot_->pixel = pixel;
    carry(camera);
}

std::optional<Aim::Target> Aim::target(const render::Camera& camera) const {
    if (held_ && held_->under && held_->camera == camera) return Target{held_->at, On::kPointer};
    if (visible_) return Target{visible_->middle, On::kMiddle};
    return {};
}

std::optional<glm::dvec3> Aim::goal(const render::Camera& camera) {
    if (held_ && held_->camera == camera) return held_->at;
    if (spot_ && spot_->viewport < maps_.size() && maps_[spot_->viewport].camera == camera)
        if (const auto nearest = maps_[spot_->viewport].nearest_point(spot_->pixel)) {
            held_ = Held{*nearest, false, camera};
            return nearest;
        }
    if (visible_) return visible_->middle;
    return {};
}

std::optional<glm::dvec3> Aim::in_middle(const render::Camera& camera) {
    if (maps_.empty() || !visible_) return {};
    const render::DepthMap& map = maps_.front();
    if (map.camera == camera) {
        const auto at = map.nearest_point(0.5 * glm::dvec2(map.picture));
        const auto pixel = at ? render::project(camera, map.picture, *at) : std::nullopt;
        middle_ = pixel ? std::optional(Middle{*at, glm::dvec2(*pixel)}) : std::nullopt;
    } else if (middle_) { // depths of this view are not available yet
        const auto pixel = render::project(camera, map.picture, middle_->at);
        if (!pixel || glm::distance(glm::dvec2(*pixel), middle_->pixel) > 1.0) middle_.reset();
    }
    return middle_ ? middle_->at : visible_->middle;
}

namespace {

// Radius of the vessel at a surface point; 0: not on a vessel.
double radius_around(const tree::VesselTree& tree, const glm::dvec3& at) {
    constexpr double kOnSurface = 1.5; // radii from the axis, at most
    double nearest = kOnSurface, radius = 0.0;
    for (const tree::Branch& branch : tree.branches)
        for (std::size_t n = 1; n < branch.points.size(); ++n) {
            const tree::Point& a = tree.points[branch.points[n - 1]];
            const tree::Point& b = tree.points[branch.points[n]];
            const glm::dvec3 along = b.position - a.position;
            const double share = share_along(at - a.position, along);
            const double its = glm::mix(a.radius, b.radius, share);
            const double away = glm::distance(a.position + share * along, at);
            if (away < nearest * its) nearest = away / its, radius = its;
        }
    return radius;
}

} // namespace

double least_distance_mm(const tree::VesselTree* tree, int branch, const glm::dvec3& at, double scene_mm) {
    constexpr double kOfRadius = 0.25, kOfScene = 1e-3;
    double radius = 0.0;
    if (tree != nullptr && branch >= 0 && static_cast<std::size_t>(branch) < tree->branches.size()) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const auto index : tree->branches[static_cast<std::size_t>(branch)].points) {
            const tree::Point& point = tree->points[index];
            const double away = glm::distance(point.position, at);
            if (away < nearest) nearest = away, radius = point.radius;
        }
    } else if (tree != nullptr) {
        radius = radius_around(*tree, at);
    }
    return radius > 0.0 ? kOfRadius * radius : kOfScene * scene_mm;
}

} // namespace ramus::app
