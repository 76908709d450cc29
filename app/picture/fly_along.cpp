#include "app/picture/fly_along.h"

#include "app/session/branch_facts.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace ramus::app {

namespace {

// Tuned on grown and real portal veins, to show a few branchings ahead without losing the vessel.
constexpr int kSamples = 1600;
constexpr double kDiametersAway = 9.0;
constexpr double kLeastDistance = 0.06; // of the whole path: twigs are shown with their surroundings
constexpr double kSmoothing = 0.22;     // standard deviation, in distances to the vessel
constexpr double kMostTurn = 0.017;     // radians from sample to sample
constexpr double kTurnSmoothing = 16.0; // standard deviation, in samples
constexpr double kElevation = 0.60;     // radians above the direction of flight
constexpr double kLookAhead = 0.18;     // of the distance
constexpr double kDiametersAhead = 1.5; // inside
constexpr double kOffAxis = 0.4;        // inside: of the radius, at most
constexpr double kInsideAngle = 80.0;   // degrees
constexpr double kSecondsPerDistance = 1.4;
constexpr double kLeastSeconds = 4.0;
constexpr double kMostSeconds = 40.0;

struct Polyline {
    std::vector<tree::Point> points;
    std::vector<double> at; // mm from the start
};

Polyline way_to(const tree::VesselTree& tree, int end) {
    Polyline way;
    for (const int id : path_to(tree, end))
        for (const auto point : tree.branches[static_cast<std::size_t>(id)].points) {
            const tree::Point& next = tree.points[point];
            const double step = way.points.empty() ? 0.0 : glm::distance(way.points.back().position, next.position);
            if (!way.points.empty() && step == 0.0) continue; // where one branch ends and the next begins
            way.at.push_back(way.points.empty() ? 0.0 : way.at.back() + step);
            way.points.push_back(next);
        }
    return way;
}

// Points at even steps of the length.
std::vector<tree::Point> resampled(const Polyline& way) {
    std::vector<tree::Point> samples;
    std::size_t segment = 1;
    for (int i = 0; i < kSamples; ++i) {
        const double along = way.at.back() * i / (kSamples - 1);
        while (segment + 1 < way.at.size() && way.at[segment] < along) ++segment;
        const tree::Point& a = way.points[segment - 1];
        const tree::Point& b = way.points[segment];
        const double length = way.at[segment] - way.at[segment - 1];
        const double t = length > 0.0 ? std::clamp((along - way.at[segment - 1]) / length, 0.0, 1.0) : 1.0;
        samples.push_back({glm::mix(a.position, b.position, t), glm::mix(a.radius, b.radius, t)});
    }
    return samples;
}

// Extension beyond the ends: constant, or by point reflection, which keeps the ends in place.
enum class Beyond { kHold, kReflect };

// Gaussian mean whose width (in samples) may vary along the path.
template <class T>
std::vector<T> smoothed(const std::vector<T>& values, const std::vector<double>& widths, Beyond beyond) {
    const auto count = static_cast<int>(values.size());
    const auto value = [&](int i) -> T {
        if (beyond == Beyond::kHold) return values[static_cast<std::size_t>(std::clamp(i, 0, count - 1))];
        if (i < 0) return 2.0 * values.front() - values[static_cast<std::size_t>(std::min(-i, count - 1))];
        if (i >= count) return 2.0 * values.back() - values[static_cast<std::size_t>(std::max(2 * count - 2 - i, 0))];
        return values[static_cast<std::size_t>(i)];
    };
    std::vector<T> result;
    for (int i = 0; i < count; ++i) {
        const double width = std::max(widths[static_cast<std::size_t>(i)], 1e-3);
        const int reach = std::min(static_cast<int>(std::ceil(3.0 * width)), count - 1);
        T sum(0.0);
        double weights = 0.0;
        for (int k = -reach; k <= reach; ++k) {
            const double weight = std::exp(-0.5 * (k / width) * (k / width));
            sum += weight * value(i + k);
            weights += weight;
        }
        result.push_back(sum / weights);
    }
    return result;
}

glm::dvec3 any_across(const glm::dvec3& direction) {
    return glm::normalize(
        glm::cross(direction, std::abs(direction.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
}

glm::dvec3 across(const glm::dvec3& vector, const glm::dvec3& direction) {
    const glm::dvec3 rest = vector - glm::dot(vector, direction) * direction;
    const double length = glm::length(rest);
    return length > 1e-3 ? rest / length : any_across(direction);
}

// Limits the turn between consecutive directions to kMostTurn, following the given ones as fast as possible. Turns
// begin early: half of a sharp bend is flown before it, half after.
std::vector<glm::dvec3> limited(const std::vector<glm::dvec3>& given) {
    std::vector<glm::dvec3> result{given.front()};
    constexpr std::size_t kAhead = 30; // samples
    for (std::size_t i = 1; i < given.size(); ++i) {
        const glm::dvec3 last = result.back();
        const glm::dvec3& goal = given[std::min(i + kAhead, given.size() - 1)];
        const double angle = std::acos(std::clamp(glm::dot(last, goal), -1.0, 1.0));
        result.push_back(angle <= kMostTurn
                             ? goal
                             : glm::normalize(std::cos(kMostTurn) * last + std::sin(kMostTurn) * across(goal, last)));
    }
    return result;
}

} // namespace

FlyPath::FlyPath(const tree::VesselTree& tree, int end, Flight flight) : end_(end), flight_(flight) {
    const Polyline way = way_to(tree, end);
    length_mm_ = way.at.back();
    const std::vector<tree::Point> points = resampled(way);
    const double step = length_mm_ / (kSamples - 1);

    // The thickness of the vessel without jumps at branchings: averages ratios.
    std::vector<double> distances;
    std::vector<glm::dvec3> positions;
    for (const tree::Point& point : points) {
        distances.push_back(std::log(inside()
                                         ? std::max(kDiametersAhead * 2.0 * point.radius, 1e-4 * length_mm_)
                                         : std::max(kDiametersAway * 2.0 * point.radius, kLeastDistance * length_mm_)));
        positions.push_back(point.position);
    }
    std::vector<double> widths(points.size());
    const auto set_widths = [&](double share) {
        std::ranges::transform(distances, widths.begin(),
                               [&](double d) { return std::min(share * std::exp(d) / step, 0.12 * kSamples); });
    };
    set_widths(1.0);
    widths = smoothed(widths, std::vector<double>(widths.size(), 0.03 * kSamples), Beyond::kHold);
    distances = smoothed(distances, widths, Beyond::kHold);
    set_widths(kSmoothing);
    std::vector<glm::dvec3> focus = smoothed(positions, widths, Beyond::kReflect);
    for (std::size_t i = 0; i < focus.size() && inside(); ++i) {
        const glm::dvec3 off = focus[i] - positions[i];
        const double most = kOffAxis * points[i].radius, length = glm::length(off);
        if (length > most) focus[i] = positions[i] + most / length * off;
    }

    // Directions of the smoothed path, smoothed again, since the viewer sees them turn.
    std::vector<glm::dvec3> ahead;
    for (std::size_t i = 0; i < focus.size(); ++i) {
        const glm::dvec3 along = focus[std::min(i + 1, focus.size() - 1)] - focus[i > 0 ? i - 1 : 0];
        const double length = glm::length(along);
        ahead.push_back(length > 0.0 ? along / length : ahead.empty() ? glm::dvec3(0, 0, 1) : ahead.back());
    }
    ahead = smoothed(limited(ahead), std::vector<double>(ahead.size(), kTurnSmoothing), Beyond::kHold);

    glm::dvec3 above(0.0, 1.0, 0.0); // start in front of the patient
    double seconds = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        Sample sample;
        sample.point = positions[i];
        sample.focus = focus[i];
        sample.ahead = glm::normalize(ahead[i]);            // the mean of similar directions is never zero
        sample.above = above = across(above, sample.ahead); // parallel transport: no twist
        sample.distance_mm = std::exp(distances[i]);
        samples_.push_back(sample);
        seconds_.push_back(seconds);
        seconds += kSecondsPerDistance * step / sample.distance_mm;
    }
    const double duration = std::clamp(seconds_.back(), kLeastSeconds, kMostSeconds);
    for (double& time : seconds_) time *= duration / seconds_.back();
}

FlyPath::Sample FlyPath::at(double fraction) const {
    const double sample_at = std::clamp(fraction, 0.0, 1.0) * (kSamples - 1);
    const auto before = std::min(static_cast<std::size_t>(sample_at), samples_.size() - 2);
    const double t = sample_at - static_cast<double>(before);
    const Sample& a = samples_[before];
    const Sample& b = samples_[before + 1];
    Sample sample;
    sample.point = glm::mix(a.point, b.point, t);
    sample.focus = glm::mix(a.focus, b.focus, t);
    sample.ahead = glm::normalize(glm::mix(a.ahead, b.ahead, t));
    sample.above = across(glm::mix(a.above, b.above, t), sample.ahead);
    sample.distance_mm = glm::mix(a.distance_mm, b.distance_mm, t);
    return sample;
}

render::Camera FlyPath::camera_at(double fraction, const render::Camera& like) const {
    const Sample here = at(fraction);
    render::Camera camera = render::outside(like);
    if (inside()) {
        camera.position = here.focus;
        camera.focal_point = here.focus + here.distance_mm * here.ahead;
        camera.view_up = here.above;
        camera.view_angle = kInsideAngle;
        camera.orthographic = false;
        camera.inside = true;
        return camera;
    }
    camera.focal_point = here.focus + kLookAhead * here.distance_mm * here.ahead;
    camera.position =
        camera.focal_point + here.distance_mm * (std::sin(kElevation) * here.above - std::cos(kElevation) * here.ahead);
    camera.view_up = here.above;
    camera.scale = here.distance_mm * std::tan(0.5 * glm::radians(like.view_angle));
    return camera;
}

glm::dvec3 FlyPath::point_at(double fraction) const { return at(fraction).point; }

double FlyPath::distance_at(double fraction) const { return at(fraction).distance_mm; }

double FlyPath::after(double fraction, double seconds) const {
    const double sample_at = std::clamp(fraction, 0.0, 1.0) * (kSamples - 1);
    const auto before = std::min(static_cast<std::size_t>(sample_at), seconds_.size() - 2);
    const double now = glm::mix(seconds_[before], seconds_[before + 1], sample_at - static_cast<double>(before));
    const double then = std::clamp(now + seconds, 0.0, seconds_.back());
    const auto next = std::ranges::upper_bound(seconds_, then);
    const auto last = std::clamp<std::ptrdiff_t>(next - seconds_.begin(), 1, kSamples - 1);
    const double from = seconds_[static_cast<std::size_t>(last) - 1];
    const double to = seconds_[static_cast<std::size_t>(last)];
    return (static_cast<double>(last) - 1.0 + std::clamp((then - from) / (to - from), 0.0, 1.0)) / (kSamples - 1);
}

std::shared_ptr<const FlyPath> FlyPaths::to(const std::shared_ptr<const tree::VesselTree>& tree, int end,
                                            Flight flight) {
    if (tree_ != tree || !path_ || path_->end() != end || path_->flight() != flight) {
        tree_ = tree;
        path_ = std::make_shared<const FlyPath>(*tree, end, flight);
    }
    return path_;
}

} // namespace ramus::app
