#include "core/field/convolution_field.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace ramus::field {

Kernel::Kernel(double width)
    : w(width * std::numbers::ln2), sqrt_w(std::sqrt(w)), isovalue(std::exp(-w)),
      support_radii(1.7 * std::sqrt(5.0 / width)) {}

ConvolutionField::ConvolutionField(const tree::PreparedTree& prepared, double width) : kernel_(width) {
    const tree::VesselTree& tree = prepared.tree;
    segments_.reserve(tree.segment_count());
    lower_ = glm::dvec3(std::numeric_limits<double>::max());
    upper_ = -lower_;
    std::size_t ordinal = 0;
    for (const tree::Branch& branch : tree.branches) {
        for (std::size_t i = 1; i < branch.points.size(); ++i, ++ordinal) {
            const tree::Point& from = tree.points[branch.points[i - 1]];
            const tree::Point& to = tree.points[branch.points[i]];
            const double length = glm::distance(from.position, to.position);
            // Smoothing may pull two points of a tight zigzag onto each other; such a segment has no integral.
            if (!(length > 0.0)) continue;
            const glm::dvec3 direction = (to.position - from.position) / length;
            segments_.push_back({from.position.x, from.position.y, from.position.z, static_cast<float>(direction.x),
                                 static_cast<float>(direction.y), static_cast<float>(direction.z),
                                 static_cast<float>(length), static_cast<float>(from.radius),
                                 static_cast<float>((to.radius - from.radius) / length),
                                 prepared.segment_source[ordinal]});

            const glm::dvec3 reach(kernel_.support_radii * std::max(from.radius, to.radius));
            lower_ = glm::min(lower_, glm::min(from.position, to.position) - reach);
            upper_ = glm::max(upper_, glm::max(from.position, to.position) + reach);
        }
    }
}

} // namespace ramus::field
