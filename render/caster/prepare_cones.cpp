// From centerlines to cones: which vessels go on into which, once for all; then, for every picture, where each cone
// lies before the eye.
#include "core/field/kernels/gaussian.h"
#include "render/caster/caster.h"
#include "render/scene/record_flags.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>

namespace ramus::render::caster {

using record::kLine;

namespace {

constexpr double kThinnedShare = 5e-5; // of the tree's extent: a twentieth of a pixel where it fills the window

// As outline() of cone.vert: half the width of a ball's outline at depth 1.
float outline(const glm::vec3& centre, float radius) {
    const float away = glm::length(centre), sine = radius / away,
                cosine = std::sqrt(std::max(1.0F - sine * sine, 0.0F));
    const float slope = glm::length(glm::vec2(centre)) / away, straight = centre.z / away;
    return sine / (straight * (straight * cosine - slope * sine));
}

void put(float (&to)[3], const glm::vec3& v) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }
void put(float (&to)[4], const glm::vec4& v) { to[0] = v.x, to[1] = v.y, to[2] = v.z, to[3] = v.w; }

// With one point more before each free end that has room for it: there the surface grows thin. In radii, of where it is
// as wide as the vessel to 0.3 % at width 5.
constexpr float kBeforeEnd = 0.8F;
Centerlines with_ends(const Centerlines& lines) {
    const std::vector<std::uint32_t> coincident = coincident_points(lines);
    std::vector<int> ends(coincident.size(), 0); // of branches, by point
    for (const Centerlines::Run& run : lines.runs)
        if (run.count > 1) ++ends[coincident[run.first]], ++ends[coincident[run.first + run.count - 1]];
    Centerlines more;
    more.origin = lines.origin;
    const auto keep = [&](const glm::vec4& point, const Centerlines::Detail& detail) {
        more.points.push_back(point);
        more.details.push_back(detail);
    };
    const auto keep_before = [&](std::uint32_t end, std::uint32_t inward) {
        const glm::vec4 &a = lines.points[end], &b = lines.points[inward];
        const Centerlines::Detail& detail = lines.details[end];
        const float before = 0.5F * kBeforeEnd * detail.diameter_mm;
        const float whole = glm::distance(glm::vec3(a), glm::vec3(b));
        if (ends[coincident[end]] > 1 || whole < 1.8F * before) return;
        const float t = before / whole;
        keep(glm::mix(a, b, t), {glm::mix(detail.diameter_mm, lines.details[inward].diameter_mm, t), detail.branch});
    };
    for (const Centerlines::Run& run : lines.runs) {
        const auto first = static_cast<std::uint32_t>(more.points.size());
        const std::uint32_t last = run.first + run.count - 1;
        for (std::uint32_t i = run.first; i < run.first + run.count; ++i) {
            if (i == last && i > run.first) keep_before(i, i - 1);
            keep(lines.points[i], lines.details[i]);
            if (i == run.first && i < last) keep_before(i, i + 1);
        }
        more.runs.push_back({first, static_cast<std::uint32_t>(more.points.size()) - first});
    }
    return more;
}

} // namespace

void Caster::follow(const std::shared_ptr<const Centerlines>& lines, bool as_field) {
    if (lines == lines_ && as_field == as_field_) return;
    lines_ = lines;
    as_field_ = as_field;
    segments_.clear();
    fitted_width_ = -1.0F;
    layers_.clear();
    other_layer_.first.clear();
    thinned_ = {};
    if (!lines || lines->points.empty()) return;
    thinned_ = lines->thinned(kThinnedShare * lines->extent_mm());
    if (as_field) thinned_ = with_ends(thinned_);
    coincident_ = coincident_points(thinned_);
    on_line_ = thinned_.points;
    for (glm::vec4& point : on_line_) point.w = 0.0F;
    for (std::size_t branch = 0; branch < thinned_.runs.size(); ++branch) {
        const Centerlines::Run run = thinned_.runs[branch];
        for (std::uint32_t i = run.first; i + 1 < run.first + run.count; ++i) {
            const bool first = i == run.first, last = i + 2 == run.first + run.count;
            segments_.push_back(
                {i, static_cast<std::int32_t>(branch), first ? Segment::kFree : i - 1, last ? Segment::kFree : i + 2});
        }
    }
    segment_branches_.assign(segments_.size() + 1, 0);
    std::ranges::transform(segments_, segment_branches_.begin(),
                           [](const Segment& segment) { return static_cast<std::uint32_t>(segment.branch); });
    find_joints();
}

void Caster::follow_width(const Frame& frame) {
    if (frame.width == fitted_width_ && frame.beyond_ends == fitted_ends_) return;
    fitted_width_ = frame.width;
    fitted_ends_ = frame.beyond_ends;
    // The vessels of larger trees are narrower than pixels, and nobody waits for what they look like in between.
    constexpr std::size_t kMostSegments = 250'000;
    neighbours_width_ = segments_.size() > kMostSegments ? 0.0F : frame.width;
    other_layer_.first.clear();
    if (neighbours_width_ > 0.0F) {
        std::vector<std::uint32_t> points(segments_.size());
        std::ranges::transform(segments_, points.begin(), &Segment::point);
        neighbours_ = find_neighbours(thinned_, coincident_, points,
                                      static_cast<float>(field::gaussian(neighbours_width_).support_radii));
    }
    fit_cones(frame.width, frame.beyond_ends);
}

FieldSegment Caster::field_segment_of(const Segment& segment, const glm::mat4& to_eye) const {
    const std::size_t i = segment.point;
    const glm::vec3 from = to_eye * glm::vec4(glm::vec3(thinned_.points[i]), 1.0F);
    const glm::vec3 axis = glm::mat3(to_eye) * (glm::vec3(thinned_.points[i + 1]) - glm::vec3(thinned_.points[i]));
    const float length = std::max(glm::length(axis), 1e-6F);
    const float first = 0.5F * thinned_.details[i].diameter_mm, last = 0.5F * thinned_.details[i + 1].diameter_mm;
    FieldSegment made{};
    put(made.from, from);
    put(made.direction, axis / length);
    made.length = length;
    made.radius = std::max(first, 1e-6F);
    made.slope = (std::max(last, 1e-6F) - made.radius) / length;
    return made;
}

// Branches that meet have an end at the very same point. There the two widest are one vessel that goes on, if they do
// not turn back; the others go into it.
void Caster::find_joints() {
    struct End {
        std::uint32_t* beyond;       // to fill in
        std::uint32_t joint, inward; // points
    };
    std::map<std::uint32_t, std::vector<End>> joints;
    const auto add = [&](std::uint32_t& beyond, std::uint32_t joint, std::uint32_t inward) {
        if (beyond == Segment::kFree) joints[coincident_[joint]].push_back({&beyond, joint, inward});
    };
    for (Segment& segment : segments_) {
        add(segment.previous, segment.point, segment.point + 1);
        add(segment.next, segment.point + 1, segment.point);
    }
    for (auto& [at, ends] : joints) {
        if (ends.size() < 2) continue;
        std::ranges::stable_sort(ends, std::greater<>(), [&](const End& end) {
            return thinned_.details[end.joint].diameter_mm + thinned_.details[end.inward].diameter_mm;
        });
        for (const End& end : ends) *end.beyond = Segment::kJoins;
        const auto inward = [&](const End& end) {
            return glm::vec3(thinned_.points[end.inward]) - glm::vec3(thinned_.points[end.joint]);
        };
        if (glm::dot(inward(ends[0]), inward(ends[1])) >= 0.0F) continue;
        *ends[0].beyond = ends[1].inward;
        *ends[1].beyond = ends[0].inward;
    }
}

void Caster::set_radii(RoundCone& cone, float first, float last) {
    cone.first_radius = first;
    cone.last_radius = last;
    cone.larger_radius = std::max(first, last);
    cone.radius_change = last - first;
    cone.side_squared = cone.axis_squared - cone.radius_change * cone.radius_change;
    cone.inverse_side_squared = cone.side_squared > 0.0F ? 1.0F / cone.side_squared : 0.0F;
}

// A ball in eye space. False: there is nothing of it to see.
bool Caster::prepare_ball(const glm::vec4& sphere, std::uint32_t id, RoundCone& cone) const {
    const glm::vec3 centre(sphere);
    cone = {};
    cone.nearest_depth = centre.z - sphere.w;
    if (!(sphere.w > 0.0F) || (!view_.flat && centre.z - 1.05F * sphere.w <= 1e-4F * view_.block.depth_range.y))
        return false;
    const float pixel = 1.0F / view_.mm_a_pixel;
    cone.image_half_width = pixel * (view_.flat ? sphere.w : outline(centre, sphere.w));
    const glm::vec2 at = pixel * (view_.flat ? glm::vec2(centre) : glm::vec2(centre) / centre.z) +
                         glm::vec2(view_.centre_x, view_.centre_y);
    if (at.x + cone.image_half_width < 0.0F || at.y + cone.image_half_width < 0.0F ||
        at.x - cone.image_half_width > float(view_.width) || at.y - cone.image_half_width > float(view_.height))
        return false;
    put(cone.depth, {view_.flat ? centre.z : 1.0F / centre.z, 0.0F, view_.flat ? 1.0F : 0.0F});
    cone.image_from[0] = at.x, cone.image_from[1] = at.y;
    put(cone.from_direction, {0.0F, 0.0F, 1.0F, 0.0F});
    put(cone.to_direction, {0.0F, 0.0F, 1.0F, 0.0F});
    put(cone.from, centre);
    cone.middle_depth = centre.z;
    set_radii(cone, sphere.w, sphere.w);
    cone.id = id;
    return true;
}

// As cone.vert. False: there is nothing of it to see.
bool Caster::prepare(const Segment& segment, const glm::mat4& to_eye, const Frame& frame,
                     const std::vector<glm::vec4>& points, RoundCone& cone) const {
    const auto in_eye_space = [&](std::size_t point) {
        return glm::vec3(to_eye * glm::vec4(glm::vec3(points[point]), 1.0F));
    };
    const std::size_t i = segment.point;
    const glm::vec3 from = in_eye_space(i), to = in_eye_space(i + 1);
    const float first = points[i].w, last = points[i + 1].w;
    const glm::vec3 axis = to - from;
    cone.nearest_depth = std::min(from.z - first, to.z - last);
    // What reaches behind the eye has no outline.
    if (!view_.flat && std::min(from.z - 1.05F * first, to.z - 1.05F * last) <= 1e-4F * view_.block.depth_range.y)
        return false;
    const glm::vec2 a = view_.flat ? glm::vec2(from) : glm::vec2(from) / from.z;
    const glm::vec2 b = view_.flat ? glm::vec2(to) : glm::vec2(to) / to.z;
    const float pixel = 1.0F / view_.mm_a_pixel;
    cone.image_half_width =
        pixel * (view_.flat ? std::max(first, last) : std::max(outline(from, first), outline(to, last)));
    const glm::vec2 start = pixel * a + glm::vec2(view_.centre_x, view_.centre_y), image_axis = pixel * (b - a);
    const glm::vec2 low = glm::min(start, start + image_axis) - cone.image_half_width,
                    high = glm::max(start, start + image_axis) + cone.image_half_width;
    if (high.x < 0.0F || high.y < 0.0F || low.x > float(view_.width) || low.y > float(view_.height)) return false;
    cone.image_length = glm::length(image_axis);
    const float d0 = view_.flat ? from.z : 1.0F / from.z, d1 = view_.flat ? to.z : 1.0F / to.z;
    put(cone.depth, {d0, d1 - d0, view_.flat ? 1.0F : 0.0F});
    cone.image_from[0] = start.x, cone.image_from[1] = start.y;
    cone.image_direction[0] = cone.image_length > 0.0F ? image_axis.x / cone.image_length : 0.0F;
    cone.image_direction[1] = cone.image_length > 0.0F ? image_axis.y / cone.image_length : 0.0F;

    const float length = glm::length(axis);
    const glm::vec3 direction = length > 0.0F ? axis / length : glm::vec3(0.0F, 0.0F, 1.0F);
    // At the joint of two segments the vessel goes half as the one, half as the other.
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
    put(cone.to_direction, direction_at(i + 1, segment.next, 1.0F));
    put(cone.from, from);
    put(cone.axis, axis);
    cone.middle_depth = 0.5F * (from.z + to.z);
    cone.axis_squared = glm::dot(axis, axis);
    set_radii(cone, first, last);
    cone.id = static_cast<std::uint32_t>(segment.branch) + 1;
    cone.near_other_layer = cone.shares_first_ball = false;
    const bool by_root = frame.scale.value != ColourScale::Value::kDiameter;
    cone.value[0] = by_root ? thinned_.points[i].w : thinned_.details[i].diameter_mm;
    cone.value[1] = by_root ? thinned_.points[i + 1].w : thinned_.details[i + 1].diameter_mm;
    return true;
}

// Inside glass, from end to end: as wide as centerline.vert draws it, wherever it is.
bool Caster::prepare_line(const Segment& segment, const glm::mat4& to_eye, const Frame& frame, RoundCone& line) const {
    if (!prepare(segment, to_eye, frame, on_line_, line)) return false;
    const float pixels = 0.5F * std::max(1.0F, kCenterlineWidth * frame.pixel_ratio);
    const float first = line.from[2], last = line.from[2] + line.axis[2];
    const float at_unit_depth = pixels * view_.mm_a_pixel;
    set_radii(line, at_unit_depth * (view_.flat ? 1.0F : first), at_unit_depth * (view_.flat ? 1.0F : last));
    line.image_half_width = 1.5F * pixels + 1.0F;
    line.nearest_depth = std::min(first - line.first_radius, last - line.last_radius);
    line.id |= kLine;
    return true;
}

} // namespace ramus::render::caster
