#include "core/field/convolution_field.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace ramus::field {

double reach_beyond_end(double width) {
    const double w = width * std::log(2.0), wanted = 1.0 - 2.0 * std::exp(-w);
    double low = 0.0, high = 6.0; // of erf's argument
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (std::erf(middle) < wanted ? low : high) = middle;
    }
    return low / std::sqrt(w);
}

Kernel::Kernel(double width)
    : w(width * std::numbers::ln2), sqrt_w(std::sqrt(w)), root_width(std::sqrt(width)), isovalue(std::exp(-w)),
      support_radii(1.7 * std::sqrt(5.0 / width)) {}

ConvolutionField::ConvolutionField(const tree::PreparedTree& prepared, double width) : kernel_(width) {
    const tree::VesselTree& tree = prepared.tree;
    const std::size_t count = tree.segment_count();
    std::vector<FieldSegment> segments(prepared.segment_place.empty() ? count : prepared.source_segments);
    std::vector<std::uint8_t> is_present(segments.size(), 0);
    frame_.lower = glm::dvec3(std::numeric_limits<double>::max());
    frame_.upper = -frame_.lower;
    frame_.thinnest = std::numeric_limits<double>::max();
    std::size_t ordinal = 0;
    for (const tree::Branch& branch : tree.branches) {
        for (std::size_t i = 1; i < branch.points.size(); ++i, ++ordinal) {
            const tree::Point& from = tree.points[branch.points[i - 1]];
            const tree::Point& to = tree.points[branch.points[i]];
            const double length = glm::distance(from.position, to.position);
            // Smoothing may pull two points of a tight zigzag onto each other; such a segment has no integral.
            if (!(length > 0.0)) continue;
            const glm::dvec3 direction = (to.position - from.position) / length;
            const std::size_t place = prepared.segment_place.empty() ? ordinal : prepared.segment_place[ordinal];
            segments[place] = {from.position.x,
                               from.position.y,
                               from.position.z,
                               static_cast<float>(direction.x),
                               static_cast<float>(direction.y),
                               static_cast<float>(direction.z),
                               static_cast<float>(length),
                               static_cast<float>(from.radius),
                               static_cast<float>((to.radius - from.radius) / length),
                               prepared.segment_source[ordinal]};
            is_present[place] = 1;

            const glm::dvec3 reach(kernel_.support_radii * std::max(from.radius, to.radius));
            frame_.lower = glm::min(frame_.lower, glm::min(from.position, to.position) - reach);
            frame_.upper = glm::max(frame_.upper, glm::max(from.position, to.position) + reach);
            frame_.thinnest = std::min({frame_.thinnest, from.radius, to.radius});
        }
    }
    present_.reserve(count);
    for (std::uint32_t place = 0; place < segments.size(); ++place)
        if (is_present[place] != 0) present_.push_back(place);
    segments_ = std::make_shared<const std::vector<FieldSegment>>(std::move(segments));
}

ConvolutionField::ConvolutionField(const tree::PreparedTree& prepared, double width, const Frame& frame)
    : ConvolutionField(prepared, width) {
    frame_ = frame;
}

ConvolutionField ConvolutionField::without(std::span<const std::uint8_t> hidden) const {
    ConvolutionField rest = *this;
    std::erase_if(rest.present_, [&](std::uint32_t place) {
        const auto branch = static_cast<std::size_t>((*segments_)[place].branch);
        return branch < hidden.size() && hidden[branch] != 0;
    });
    return rest;
}

} // namespace ramus::field
