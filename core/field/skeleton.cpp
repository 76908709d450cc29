#include "core/field/skeleton.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace ramus::field {

double beyond_for(double slope) {
    const double steepness = std::abs(slope);
    return 1.0 / (1.0 + 4.0 * steepness * (1.0 + 8.0 * steepness));
}

namespace {

double kernel_radius(const tree::PreparedTree& prepared, std::uint32_t point) {
    return prepared.kernel_radii.empty() ? prepared.tree.points[point].radius : prepared.kernel_radii[point];
}

// Extends the segment beyond the cut end, at its start or its end.
void go_on_beyond(FieldSegment& segment, const CutEnd& end) {
    const glm::dvec3 start(segment.ax, segment.ay, segment.az), along(segment.ux, segment.uy, segment.uz);
    const auto more = static_cast<float>(kBeyondCut * end.radius);
    const double near = 1e-3 * end.radius;
    if (glm::dot(along, end.along) > 0.0) {
        if (glm::distance(start + double(segment.length) * along, end.at) > near) return;
    } else {
        if (glm::distance(start, end.at) > near) return;
        segment.ax -= static_cast<double>(more) * along.x;
        segment.ay -= static_cast<double>(more) * along.y;
        segment.az -= static_cast<double>(more) * along.z;
        segment.radius -= more * segment.slope;
        segment.excess -= more * segment.excess_slope;
    }
    segment.length += more;
}

} // namespace

Skeleton::Skeleton(const tree::PreparedTree& prepared, double support_radii) {
    const tree::VesselTree& tree = prepared.tree;
    const std::size_t count = tree.segment_count();
    std::vector<FieldSegment> segments(prepared.segment_index.empty() ? count : prepared.source_segments);
    std::vector<std::uint8_t> is_present(segments.size(), 0);
    extent_.lower = glm::dvec3(std::numeric_limits<double>::max());
    extent_.upper = -extent_.lower;
    extent_.thinnest = std::numeric_limits<double>::max();
    const bool smooth = prepared.centerline == tree::Centerline::kSmooth;
    cut_ends_ = std::make_shared<const std::vector<CutEnd>>(cut_ends_of(prepared));
    std::size_t ordinal = 0;
    for (const tree::Branch& branch : tree.branches) {
        for (std::size_t i = 1; i < branch.points.size(); ++i, ++ordinal) {
            const tree::Point& from = tree.points[branch.points[i - 1]];
            const tree::Point& to = tree.points[branch.points[i]];
            const double length = glm::distance(from.position, to.position);
            // Smoothing may move two points of a tight zigzag to one position. A segment of length 0 has no integral.
            if (!(length > 0.0)) continue;
            const glm::dvec3 direction = (to.position - from.position) / length;
            const double radius = kernel_radius(prepared, branch.points[i - 1]);
            const double end_radius = kernel_radius(prepared, branch.points[i]);
            const double slope = (end_radius - radius) / length;
            const std::size_t index = prepared.segment_index.empty() ? ordinal : prepared.segment_index[ordinal];
            segments[index] = {from.position.x,
                               from.position.y,
                               from.position.z,
                               static_cast<float>(direction.x),
                               static_cast<float>(direction.y),
                               static_cast<float>(direction.z),
                               static_cast<float>(length),
                               static_cast<float>(radius),
                               static_cast<float>(slope),
                               static_cast<float>(smooth ? beyond_for(slope) : 0.0),
                               prepared.segment_source[ordinal],
                               static_cast<float>(from.radius - radius),
                               static_cast<float>((to.radius - end_radius - (from.radius - radius)) / length)};
            is_present[index] = 1;
            for (const CutEnd& end : *cut_ends_) go_on_beyond(segments[index], end);

            const glm::dvec3 reach((support_radii + (cut_ends_->empty() ? 0.0 : kBeyondCut)) *
                                   std::max({radius, end_radius, double(segments[index].thickest())}));
            extent_.lower = glm::min(extent_.lower, glm::min(from.position, to.position) - reach);
            extent_.upper = glm::max(extent_.upper, glm::max(from.position, to.position) + reach);
            extent_.thinnest = std::min({extent_.thinnest, radius, end_radius});
        }
    }
    present_.reserve(count);
    for (std::uint32_t index = 0; index < segments.size(); ++index)
        if (is_present[index] != 0) present_.push_back(index);
    segments_ = std::make_shared<const std::vector<FieldSegment>>(std::move(segments));
}

Skeleton::Skeleton(const tree::PreparedTree& prepared, double support_radii, const Extent& extent)
    : Skeleton(prepared, support_radii) {
    extent_ = extent;
}

Skeleton Skeleton::without(std::span<const std::uint8_t> hidden) const {
    Skeleton rest = *this;
    std::erase_if(rest.present_, [&](std::uint32_t index) {
        const auto branch = static_cast<std::size_t>((*segments_)[index].branch);
        return branch < hidden.size() && hidden[branch] != 0;
    });
    return rest;
}

std::optional<SegmentChanges> Skeleton::changes_since(const Skeleton& before) const {
    if (extent_ != before.extent_ || segments_->size() != before.segments_->size()) return std::nullopt;
    const bool shared = segments_ == before.segments_;
    const auto same = [&](std::uint32_t index) { return shared || (*before.segments_)[index] == (*segments_)[index]; };
    SegmentChanges changes;
    auto a = before.present_.begin();
    auto b = present_.begin();
    while (a != before.present_.end() || b != present_.end()) {
        if (b == present_.end() || (a != before.present_.end() && *a < *b)) {
            changes.before.push_back(*a++);
        } else if (a == before.present_.end() || *b < *a) {
            changes.after.push_back(*b++);
        } else {
            if (!same(*a)) changes.before.push_back(*a), changes.after.push_back(*b);
            ++a, ++b;
        }
    }
    return changes;
}

} // namespace ramus::field
