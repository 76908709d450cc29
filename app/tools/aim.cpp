#include "app/tools/aim.h"

#include <algorithm>
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

double least_distance_mm(const tree::VesselTree* tree, int branch, const glm::dvec3& at, double scene_mm) {
    constexpr double kOfRadius = 0.25, kOfScene = 1e-3;
    const double beside_vessels = kOfScene * scene_mm;
    if (tree == nullptr || branch < 0 || static_cast<std::size_t>(branch) >= tree->branches.size())
        return beside_vessels;
    double nearest = std::numeric_limits<double>::infinity(), radius = 0.0;
    for (const auto index : tree->branches[static_cast<std::size_t>(branch)].points) {
        const tree::Point& point = tree->points[index];
        const double away = glm::distance(point.position, at);
        if (away < nearest) nearest = away, radius = point.radius;
    }
    return radius > 0.0 ? kOfRadius * radius : beside_vessels;
}

} // namespace ramus::app
