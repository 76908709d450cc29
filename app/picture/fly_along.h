// FlyPath: camera path along the vessels from the root to the end of a branch, made once per branch. Each fraction of
// the path's length in mm (0 at the root, 1 at the end) has a camera.
//
// kOutside: the camera stays a few local diameters behind and above the vessel and looks ahead. kInside: it stays near
// the axis and looks ahead with a wide angle.
//
// Guarantees: position and direction are continuous and change slowly even at sharp bends, because the camera follows a
// smoothed centerline; it turns by less than two degrees per thousandth of the path. It is closer to thin vessels than
// to thick ones. At constant pace the vessel moves at constant speed in the picture.
#pragma once

#include "core/tree/vessel_tree.h"
#include "render/scene/camera.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace ramus::app {

enum class Flight : std::uint8_t { kOutside, kInside };

class FlyPath {
public:
    // `end`: a branch of `tree`.
    FlyPath(const tree::VesselTree& tree, int end, Flight flight = Flight::kOutside);

    // `like`: provides view angle and projection; inside flights have their own.
    [[nodiscard]] render::Camera camera_at(double fraction, const render::Camera& like) const;
    // The point of the centerline, mm.
    [[nodiscard]] glm::dvec3 point_at(double fraction) const;
    [[nodiscard]] double distance_at(double fraction) const; // mm, from the camera to the vessel

    // The fraction reached from `fraction` after `seconds` (negative: backward). Exact for any division into steps.
    [[nodiscard]] double after(double fraction, double seconds) const;
    [[nodiscard]] double duration() const { return seconds_.back(); } // of the whole flight, s
    [[nodiscard]] double length_mm() const { return length_mm_; }
    [[nodiscard]] int end() const { return end_; }
    [[nodiscard]] Flight flight() const { return flight_; }

private:
    // Samples at even steps of the length.
    struct Sample {
        glm::dvec3 point{0.0};    // of the centerline
        glm::dvec3 focus{0.0};    // of the smoothed centerline
        glm::dvec3 ahead{0.0};    // unit
        glm::dvec3 above{0.0};    // unit, perpendicular to `ahead`
        double distance_mm = 0.0; // from the camera to the focus
    };
    [[nodiscard]] Sample at(double fraction) const;
    [[nodiscard]] bool inside() const { return flight_ == Flight::kInside; }

    int end_;
    Flight flight_;
    double length_mm_ = 0.0;
    std::vector<Sample> samples_;
    std::vector<double> seconds_; // by sample
};

// Caches the last path, so that a flight computes it once.
class FlyPaths {
public:
    [[nodiscard]] std::shared_ptr<const FlyPath> to(const std::shared_ptr<const tree::VesselTree>& tree, int end,
                                                    Flight flight = Flight::kOutside);

private:
    std::shared_ptr<const tree::VesselTree> tree_;
    std::shared_ptr<const FlyPath> path_;
};

} // namespace ramus::app
