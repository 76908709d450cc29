// PathCurve: the file's centerline along a way as points at equal steps of its arc length, and a Gaussian filter along
// it. An inner part of core/slice/vessel_path.h.
#pragma once

#include "core/slice/vessel_path.h"

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::slice {

// `begin_mm` and `end_mm` of the parts are set to arc lengths of the file's centerline.
struct PathCurve {
    std::vector<glm::dvec3> points; // equally spaced, both ends included; at least two
    std::vector<double> radii;
    double step_mm = 0.0;

    [[nodiscard]] double length_mm() const { return step_mm * static_cast<double>(points.size() - 1); }
};
[[nodiscard]] PathCurve curve_along(const tree::VesselTree& tree, std::span<PathPart> parts, double step_mm);

// Sums of a curve's points around a position in its index, weighted by a Gaussian of standard deviation `sigma` in
// steps. Beyond the ends the curve continues by point reflection.
class CurveFilter {
public:
    explicit CurveFilter(std::span<const glm::dvec3> points) : points_(points) {}
    [[nodiscard]] glm::dvec3 mean(double at, double sigma) const;
    // The direction of the filtered curve, of any length.
    [[nodiscard]] glm::dvec3 direction(double at, double sigma) const;
    [[nodiscard]] glm::dvec3 point(double at) const; // linear between points

private:
    std::span<const glm::dvec3> points_;
};

} // namespace ramus::slice
