#include "render/slice/branch_ink.h"

#include "core/base/lines.h"
#include "render/scene/record_flags.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::render {

namespace {

constexpr float kWidth = 1.6F, kThin = 1.0F, kWide = 2.6F; // points

// The point of a branch's centerline nearest to a place.
struct Foot {
    float from_root_mm, diameter_mm, value; // value: of a list
    double fraction;
};

std::optional<Foot> foot_on(const Centerlines& lines, int branch, const glm::dvec3& place, std::size_t list) {
    if (branch < 0 || static_cast<std::size_t>(branch) >= lines.runs.size()) return {};
    const Centerlines::Run run = lines.runs[static_cast<std::size_t>(branch)];
    if (run.count < 2) return {};
    double nearest = HUGE_VAL;
    std::size_t at = run.first;
    double share = 0.0;
    for (std::size_t i = run.first; i + 1 < run.first + run.count; ++i) {
        const glm::dvec3 a = lines.origin + glm::dvec3(lines.points[i]);
        const glm::dvec3 ab = glm::dvec3(lines.points[i + 1]) - glm::dvec3(lines.points[i]);
        const double t = share_along(place - a, ab);
        const glm::dvec3 off = place - a - t * ab;
        if (const double squared = glm::dot(off, off); squared < nearest) nearest = squared, at = i, share = t;
    }
    const auto mixed = [&](float first, float second) { return glm::mix(first, second, static_cast<float>(share)); };
    const float from_root = mixed(lines.points[at].w, lines.points[at + 1].w);
    const float begin = lines.points[run.first].w;
    const float length = lines.points[run.first + run.count - 1].w - begin;
    const bool listed = list < lines.lists.size();
    return Foot{from_root, mixed(lines.details[at].diameter_mm, lines.details[at + 1].diameter_mm),
                listed ? mixed(lines.lists[list][at], lines.lists[list][at + 1]) : kNotKnown,
                length > 0.0F ? static_cast<double>((from_root - begin) / length) : 0.0};
}

glm::vec3 on_ramp(const ColourScale& scale, float value) {
    const auto log_if = [&](float v) { return scale.logarithmic ? std::log(std::max(v, 1e-12F)) : v; };
    const float low = log_if(scale.low);
    const float high = log_if(scale.high);
    const float share = high > low ? std::clamp((log_if(value) - low) / (high - low), 0.0F, 1.0F) : 0.0F;
    const float at = share * static_cast<float>(scale.ramp.size() - 1);
    const auto first = std::min(static_cast<std::size_t>(at), scale.ramp.size() - 1);
    const std::size_t second = std::min(first + 1, scale.ramp.size() - 1);
    return glm::mix(scale.ramp[first], scale.ramp[second], at - static_cast<float>(first));
}

double distance_in(const DistanceGrid& grid, const glm::dvec3& place) {
    const glm::dvec3 index = (place - grid.corner) / grid.step_mm;
    const glm::dvec3 last(grid.size - 1);
    for (int axis = 0; axis < 3; ++axis)
        if (index[axis] < -0.5 || index[axis] > last[axis] + 0.5) return HUGE_VAL;
    const glm::dvec3 held = glm::clamp(index, glm::dvec3(0.0), last);
    const glm::ivec3 low(held);
    const glm::ivec3 high = glm::min(low + 1, grid.size - 1);
    const glm::dvec3 share = held - glm::dvec3(low);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        glm::ivec3 at = low;
        double weight = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            const bool up = ((corner >> axis) & 1) != 0;
            if (up) at[axis] = high[axis];
            weight *= up ? share[axis] : 1.0 - share[axis];
        }
        sum += weight * static_cast<double>(
                            grid.values[static_cast<std::size_t>(at.x) +
                                        static_cast<std::size_t>(grid.size.x) *
                                            (static_cast<std::size_t>(at.y) +
                                             static_cast<std::size_t>(grid.size.y) * static_cast<std::size_t>(at.z))]);
    }
    return sum;
}

} // namespace

BranchInk::BranchInk(const Frame& frame) : frame_(frame) {
    for (const int id : frame.selected) {
        if (id < 0) continue;
        if (static_cast<std::size_t>(id) >= selected_.size()) selected_.resize(static_cast<std::size_t>(id) + 1);
        selected_[static_cast<std::size_t>(id)] = 1;
    }
}

std::optional<glm::vec3> BranchInk::scale_colour(int branch, const glm::dvec3& place,
                                                 std::optional<float> value) const {
    const ColourScale& scale = frame_.scale;
    if (scale.value == ColourScale::Value::kNone || scale.ramp.empty()) return {};
    if (scale.value == ColourScale::Value::kSurface) {
        if (!value || *value <= kLeastKnown) return {};
        return on_ramp(scale, *value);
    }
    if (!frame_.centerlines) return {};
    const auto foot = foot_on(*frame_.centerlines, branch, place, scale.list);
    if (!foot) return {};
    const float found = scale.value == ColourScale::Value::kDiameter       ? foot->diameter_mm
                        : scale.value == ColourScale::Value::kRootDistance ? foot->from_root_mm
                                                                           : foot->value;
    if (found <= kLeastKnown) return {};
    return on_ramp(scale, found);
}

std::optional<glm::vec3> BranchInk::margin_colour(const glm::dvec3& place) const {
    if (frame_.margins.bands.empty()) return {};
    double nearest = HUGE_VAL;
    for (const glm::dvec4& sphere : frame_.lesions.spheres)
        nearest = std::min(nearest, glm::length(place - glm::dvec3(sphere)) - sphere.w);
    if (frame_.lesions.distances && frame_.lesions.distances->whole())
        nearest = std::min(nearest, distance_in(*frame_.lesions.distances, place));
    for (const Margins::Band& band : frame_.margins.bands)
        if (nearest <= static_cast<double>(band.within_mm)) return band.colour;
    return {};
}

bool BranchInk::is_lost(int branch, const glm::dvec3& place) const {
    for (const LostPart& part : frame_.lost) {
        if (part.branch != branch) continue;
        if (part.whole() || !frame_.centerlines) return true;
        const auto foot = foot_on(*frame_.centerlines, branch, place, 0);
        return foot && foot->fraction >= part.from && foot->fraction <= part.to;
    }
    return false;
}

std::optional<Ink> BranchInk::at(int branch, const glm::dvec3& place, std::optional<float> value) const {
    const auto id = static_cast<std::size_t>(std::max(branch, 0));
    const BranchState state = branch >= 0 && id < frame_.states.size() ? frame_.states[id] : BranchState::kNormal;
    if (state == BranchState::kHidden) return {};
    const Appearance& looks = frame_.appearance;
    Ink ink{branch >= 0 && id < frame_.colours.size() ? frame_.colours[id] : looks.vessel, kWidth, 1.0F};
    if (state == BranchState::kHighlighted) {
        ink.colour = looks.highlight;
    } else if (state == BranchState::kDefocused) {
        ink = {looks.glass, kThin, 0.65F};
    } else {
        if (const auto scaled = scale_colour(branch, place, value)) ink.colour = *scaled;
        if (const auto near = margin_colour(place)) ink.colour = *near;
    }
    if (is_lost(branch, place)) ink.colour = glm::mix(looks.lost, glm::vec3(1.0F), 0.25F); // readable on a dark scan
    if (branch >= 0 && id < selected_.size() && selected_[id] != 0) ink.colour = looks.selection, ink.width = kWide;
    if (branch >= 0 && branch == frame_.hovered) ink.width = kWide, ink.opacity = 1.0F;
    return ink;
}

} // namespace ramus::render
