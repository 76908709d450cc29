// Flying along the vessels: the camera follows them from the root to the end of a branch, outside, a few local
// diameters behind and above, and looks ahead along the vessel. A path is made once for a branch; then every fraction
// of it, 0 at the root and 1 at the end, has its camera. Fractions are of the length in mm.
//
// Inside (Flight::kInside) the camera follows the axis itself, near which it stays, and looks ahead with a wide angle.
//
// Position and direction change continuously and slowly, however sharply the vessels bend: the camera follows a
// smoothed centerline, nearer to a thin vessel than to a thick one, and turns by less than two degrees on a thousandth
// of the way. Played at an even pace, the vessel seems to pass at the same speed in the picture everywhere.
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
    // `end` is a branch of `tree`.
    FlyPath(const tree::VesselTree& tree, int end, Flight flight = Flight::kOutside);

    // `like` gives the view angle and the projection; inside, both are the flight's own.
    [[nodiscard]] render::Camera camera_at(double fraction, const render::Camera& like) const;
    // The point of the centerline itself.
    [[nodiscard]] glm::dvec3 point_at(double fraction) const;
    [[nodiscard]] double distance_at(double fraction) const; // mm, from the camera to the vessel

    // Where one is after so many seconds of flight (negative: back). Exact however the time is cut into steps.
    [[nodiscard]] double after(double fraction, double seconds) const;
    [[nodiscard]] double duration() const { return seconds_.back(); } // of the whole flight, seconds
    [[nodiscard]] double length_mm() const { return length_mm_; }
    [[nodiscard]] int end() const { return end_; }
    [[nodiscard]] Flight flight() const { return flight_; }

private:
    // Of samples at even steps of the length.
    struct Sample {
        glm::dvec3 point{0.0};    // of the centerline
        glm::dvec3 focus{0.0};    // of the smoothed one
        glm::dvec3 ahead{0.0};    // unit
        glm::dvec3 above{0.0};    // unit, across `ahead`
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

// The path that was asked for last, so that a flight makes it once.
class FlyPaths {
public:
    [[nodiscard]] std::shared_ptr<const FlyPath> to(const std::shared_ptr<const tree::VesselTree>& tree, int end,
                                                    Flight flight = Flight::kOutside);

private:
    std::shared_ptr<const tree::VesselTree> tree_;
    std::shared_ptr<const FlyPath> path_;
};

} // namespace ramus::app
