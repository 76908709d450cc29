// Transforms cones into eye space for a picture.
#include "core/field/skeleton.h"
#include "render/caster/vessel_cones.h"
#include "render/scene/record_flags.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <tbb/parallel_for.h>

namespace ramus::render::caster {

using record::kLine;
using record::kSolid;

namespace {

// See outline() of cone.vert: half the width of a ball's outline at depth 1.
float outline(const glm::vec3& centre, float radius) {
    const float away = glm::length(centre), sine = radius / away,
                cosine = std::sqrt(std::max(1.0F - sine * sine, 0.0F));
    const float slope = glm::length(glm::vec2(centre)) / away, straight = centre.z / away;
    return sine / (straight * (straight * cosine - slope * sine));
}

void put(float (&to)[3], const glm::vec3& v) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }
void put(float (&to)[4], const glm::vec4& v) { to[0] = v.x, to[1] = v.y, to[2] = v.z, to[3] = v.w; }

// Sets the radii and values derived from them; the axis must be set.
void set_radii(RoundCone& cone, float first, float last) {
    cone.first_radius = first;
    cone.last_radius = last;
    cone.larger_radius = std::max(first, last);
    cone.radius_change = last - first;
    cone.side_squared = cone.axis_squared - cone.radius_change * cone.radius_change;
    cone.inverse_side_squared = cone.side_squared > 0.0F ? 1.0F / cone.side_squared : 0.0F;
}

// As cone.vert: the hull of two balls in eye space. False: it is invisible.
bool project(const View& view, const glm::vec4& first, const glm::vec4& last, RoundCone& cone) {
    const glm::vec3 from(first), to(last), axis = to - from;
    cone = {};
    cone.nearest_depth = std::min(from.z - first.w, to.z - last.w);
    // Cones that reach behind the eye have no outline.
    if (!view.flat && std::min(from.z - 1.05F * first.w, to.z - 1.05F * last.w) <= 1e-4F * view.block.depth_range.y)
        return false;
    const glm::vec2 a = view.flat ? glm::vec2(from) : glm::vec2(from) / from.z;
    const glm::vec2 b = view.flat ? glm::vec2(to) : glm::vec2(to) / to.z;
    const float pixel = 1.0F / view.mm_a_pixel;
    cone.image_half_width =
        pixel * (view.flat ? std::max(first.w, last.w) : std::max(outline(from, first.w), outline(to, last.w)));
    const glm::vec2 start = pixel * a + glm::vec2(view.centre_x, view.centre_y), image_axis = pixel * (b - a);
    const glm::vec2 low = glm::min(start, start + image_axis) - cone.image_half_width,
                    high = glm::max(start, start + image_axis) + cone.image_half_width;
    if (high.x < 0.0F || high.y < 0.0F || low.x > float(view.width) || low.y > float(view.height)) return false;
    cone.image_length = glm::length(image_axis);
    const float d0 = view.flat ? from.z : 1.0F / from.z, d1 = view.flat ? to.z : 1.0F / to.z;
    put(cone.depth, {d0, d1 - d0, view.flat ? 1.0F : 0.0F});
    for (int i = 0; i < 2; ++i) {
        cone.image_from[i] = start[i];
        cone.image_direction[i] = cone.image_length > 0.0F ? image_axis[i] / cone.image_length : 0.0F;
    }
    put(cone.from, from);
    put(cone.axis, axis);
    cone.middle_depth = 0.5F * (from.z + to.z);
    cone.axis_squared = glm::dot(axis, axis);
    set_radii(cone, first.w, last.w);
    return true;
}

// Number of glass segments that one cone may replace, and how far points between may be off its axis, in pixels. Tuned
// on the kidney of 78,000 segments, most of them a pixel long. Opaque segments are not merged: a twentieth of a pixel
// would be visible.
constexpr std::size_t kMostJoined = 8;
constexpr float kMostAside = 0.075F;

} // namespace

void append_lesions(const View& view, const LookData& data, ConeList& list) {
    for (std::size_t i = 0; i < data.lesions.size(); ++i) {
        const glm::vec4& sphere = data.lesions[i];
        RoundCone ball;
        const bool seen = sphere.w > 0.0F && data.shapes[2 * i + 1].w > 0.0F && project(view, sphere, sphere, ball);
        put(ball.from_direction, {0.0F, 0.0F, 1.0F, 0.0F});
        put(ball.to_direction, {0.0F, 0.0F, 1.0F, 0.0F});
        ball.id = kSolid | static_cast<std::uint32_t>(i + 1);
        list.cones.push_back(ball);
        list.kinds.push_back(seen ? ConeList::Kind::kGlass : ConeList::Kind::kNone);
    }
}

FieldSegment FittedCones::field_segment(const Segment& segment, const glm::mat4& to_eye) const {
    const std::size_t i = segment.point;
    const glm::vec3 from = to_eye * glm::vec4(glm::vec3(thinned.points[i]), 1.0F);
    const glm::vec3 axis = glm::mat3(to_eye) * (glm::vec3(thinned.points[i + 1]) - glm::vec3(thinned.points[i]));
    const float length = std::max(glm::length(axis), 1e-6F);
    const float first = 0.5F * thinned.details[i].diameter_mm, last = 0.5F * thinned.details[i + 1].diameter_mm;
    FieldSegment made{};
    put(made.from, from);
    put(made.direction, axis / length);
    made.length = length;
    made.radius = std::max(first, 1e-6F);
    made.slope = (std::max(last, 1e-6F) - made.radius) / length;
    made.beyond = lines->smooth_radii ? static_cast<float>(field::beyond_for(made.slope)) : 0.0F;
    return made;
}

bool VesselCones::prepare(const Run& run, const Placement& placement, const std::vector<glm::vec4>& points,
                          RoundCone& cone) const {
    const auto in_eye_space = [&](std::size_t point) {
        return glm::vec3(placement.to_eye * glm::vec4(glm::vec3(points[point]), 1.0F));
    };
    const Segment &segment = fitted_->segments[run.first], &last = fitted_->segments[run.first + run.count - 1];
    const std::size_t i = segment.point, end = last.point + std::size_t{1};
    const glm::vec3 from = in_eye_space(i), to = in_eye_space(end);
    if (!project(placement.view, glm::vec4(from, points[i].w), glm::vec4(to, points[end].w), cone)) return false;
    const float length = glm::length(to - from);
    const glm::vec3 direction = length > 0.0F ? (to - from) / length : glm::vec3(0.0F, 0.0F, 1.0F);
    // At a joint the direction of the vessel is the mean of both segments' directions.
    const auto direction_at = [&](std::size_t joint, std::uint32_t beyond, float outward) {
        if (beyond >= Segment::kJoins) return glm::vec4(direction, 0.0F);
        const glm::vec3 other = outward * (in_eye_space(beyond) - in_eye_space(joint));
        const float squared = glm::dot(other, other);
        if (squared <= 0.0F) return glm::vec4(direction, 1.0F);
        const glm::vec3 middle = direction + other / std::sqrt(squared);
        const float both = glm::dot(middle, middle);
        return glm::vec4(both > 0.0F ? middle / std::sqrt(both) : direction, 1.0F);
    };
    put(cone.from_direction, direction_at(i, segment.previous, -1.0F));
    put(cone.to_direction, direction_at(end, last.next, 1.0F));
    cone.id = static_cast<std::uint32_t>(segment.branch) + 1;
    const bool by_root = placement.frame.scale.value != ColourScale::Value::kDiameter;
    const auto value_at = [&](std::size_t point) {
        return by_root ? fitted_->thinned.points[point].w : fitted_->thinned.details[point].diameter_mm;
    };
    cone.value[0] = value_at(i), cone.value[1] = value_at(end);
    return true;
}

// A centerline inside glass: as wide as centerline.vert draws it.
bool VesselCones::prepare_line(const Run& run, const Placement& placement, RoundCone& line) const {
    if (!prepare(run, placement, fitted_->on_line, line)) return false;
    const View& view = placement.view;
    const float pixels = 0.5F * std::max(1.0F, kCenterlineWidth * placement.frame.pixel_ratio);
    const float first = line.from[2], last = line.from[2] + line.axis[2];
    const float at_unit_depth = pixels * view.mm_a_pixel;
    set_radii(line, at_unit_depth * (view.flat ? 1.0F : first), at_unit_depth * (view.flat ? 1.0F : last));
    line.image_half_width = 1.5F * pixels + 1.0F;
    line.nearest_depth = std::min(first - line.first_radius, last - line.last_radius);
    line.id |= kLine;
    return true;
}

bool VesselCones::is_straight(const Run& run, const Placement& placement) const {
    const std::size_t from = fitted_->segments[run.first].point, to = from + run.count;
    for (std::size_t i = run.first; i < run.first + run.count; ++i)
        if (other_layer_.first[i] < other_layer_.first[i + 1]) return false;
    const auto& points = fitted_->fitted;
    const glm::vec4 whole = points[to] - points[from];
    const float squared = glm::dot(glm::vec3(whole), glm::vec3(whole));
    const View& view = placement.view;
    const auto depth = [&](std::size_t point) {
        return (placement.to_eye * glm::vec4(glm::vec3(points[point]), 1.0F)).z;
    };
    const float nearest = view.flat ? 1.0F : std::min(depth(from), depth(to));
    const float most = kMostAside * view.mm_a_pixel * std::max(nearest, 0.0F);
    for (std::size_t point = from + 1; point < to; ++point) {
        const glm::vec4 off = points[point] - points[from];
        const float share = squared > 0.0F ? glm::dot(glm::vec3(off), glm::vec3(whole)) / squared : 0.0F;
        const glm::vec4 aside = off - share * whole; // w: the difference of the radius
        if (share < 0.0F || share > 1.0F || glm::dot(aside, aside) > most * most) return false;
    }
    return true;
}

std::size_t VesselCones::prepare_run(const Run& run, const Placement& placement, ConeList& list) const {
    if (run.count > 1 && !is_straight(run, placement)) {
        const std::size_t half = std::bit_floor(run.count - 1);
        return prepare_run({run.first, half}, placement, list) +
               prepare_run({run.first + half, run.count - half}, placement, list);
    }
    using Kind = ConeList::Kind;
    RoundCone& cone = list.cones[run.first];
    if (!prepare(run, placement, fitted_->fitted, cone)) return 0;
    cone.near_other_layer = other_layer_.first[run.first] < other_layer_.first[run.first + 1];
    const bool glass = segment_layers_[run.first] == Layer::kGlass;
    list.kinds[run.first] = glass ? Kind::kGlass : Kind::kOpaque;
    const std::size_t line = fitted_->segments.size() + run.first;
    if (glass && prepare_line(run, placement, list.cones[line])) list.kinds[line] = Kind::kOpaque;
    return 1;
}

std::size_t VesselCones::prepare(const Frame& frame, const View& view, const glm::dmat4& to_eye,
                                 const std::vector<Layer>& layers, ConeList& list) {
    using Kind = ConeList::Kind;
    const FittedCones& fitted = *fitted_;
    find_mixed_layers(layers);
    const Placement placement{frame, view, glm::mat4(glm::translate(to_eye, fitted.thinned.origin))};
    const std::size_t segments = fitted.segments.size();
    const bool any_glass = std::ranges::find(layers, Layer::kGlass) != layers.end();
    std::vector<RoundCone>& cones = list.cones;
    std::vector<Kind>& kinds = list.kinds;
    cones.resize(any_glass ? 2 * segments : segments); // the second half: lines inside glass
    kinds.assign(cones.size(), Kind::kNone);
    field_segments_.assign(fitted.neighbours_width > 0.0F ? segments + 1 : 0, kNoSegment);
    field_ = {field_segments_.empty() ? nullptr : field_segments_.data(),
              fitted.neighbours.first.data(),
              fitted.neighbours.segments.data(),
              std::sqrt(frame.width),
              std::exp2(-frame.width),
              other_layer_.first.data(),
              other_layer_.segments.data(),
              fitted.segment_branches.data(),
              segment_layers_.data()};
    std::atomic<std::size_t> drawn{0};
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, segments, 512), [&](const auto& range) {
        std::size_t seen = 0;
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            if (segment_layers_[i] == Layer::kNone) continue;
            const Segment& segment = fitted.segments[i];
            if (!field_segments_.empty()) field_segments_[i] = fitted.field_segment(segment, placement.to_eye);
            const Centerlines::Run& branch = fitted.thinned.runs[std::size_t(segment.branch)];
            const std::size_t before = segment.point - branch.first;
            const std::size_t most = segment_layers_[i] == Layer::kGlass ? kMostJoined : 1;
            if (before % most == 0)
                seen += prepare_run({i, std::min(most, branch.count - 1 - before)}, placement, list);
        }
        drawn += seen;
    });
    for (std::size_t i = 1; i < segments; ++i) {
        if (kinds[i] != Kind::kOpaque || kinds[i - 1] != Kind::kOpaque) continue;
        cones[i].shares_first_ball =
            fitted.segments[i].previous == fitted.segments[i - 1].point && !cones[i].near_other_layer &&
            fitted.segments[i - 1].point + 1 == fitted.segments[i].point && !cones[i - 1].near_other_layer;
    }
    return drawn;
}

} // namespace ramus::render::caster
