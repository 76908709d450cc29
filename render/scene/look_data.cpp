#include "render/scene/look_data.h"

#include "render/scene/colour.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace ramus::render {

namespace {

static_assert(std::size_t{kMostMargins} == Margins::kMost);

std::vector<glm::vec4> cut_ends(const std::vector<LostPart>& lost, const Centerlines& lines, const glm::dmat4& eye) {
    std::vector<glm::vec4> cuts;
    for (const LostPart& part : lost) {
        if (part.whole() || !lines.at(part.branch, 0.0)) continue;
        cuts.emplace_back(part.branch, part.from > 0.0 ? 1.0F : 0.0F, part.to < 1.0 ? 1.0F : 0.0F, 0.0F);
        for (const double fraction : {part.from, part.to}) {
            const Centerlines::BranchPoint at = *lines.at(part.branch, fraction);
            cuts.emplace_back(glm::dvec3(eye * glm::dvec4(at.position, 1.0)), at.radius_mm);
            cuts.emplace_back(glm::dvec3(eye * glm::dvec4(at.along, 0.0)), at.from_root_mm);
        }
    }
    return cuts;
}

std::vector<glm::vec4> shape_looks(const Frame& frame) {
    std::vector<glm::vec4> looks(2 * std::max(frame.context.size(), frame.lesions.count()));
    for (std::size_t i = 0; i < frame.context.size(); ++i) {
        const ContextMesh& one = frame.context[i];
        looks[2 * i] = linear(one.colour, (one.wireframe ? -1.0F : 1.0F) * std::clamp(one.opacity, 0.0F, 1.0F));
    }
    for (std::size_t i = 0; i < frame.lesions.count(); ++i) {
        const ShapeLook look = frame.lesions.look(i);
        looks[2 * i + 1] = linear(look.colour, std::clamp(look.opacity, 0.0F, 1.0F));
    }
    return looks;
}

std::vector<glm::vec4> lesion_spheres(const Lesions& lesions, const glm::dmat4& eye) {
    std::vector<glm::vec4> spheres;
    for (const glm::dvec4& s : lesions.spheres)
        spheres.emplace_back(glm::dvec3(eye * glm::dvec4(glm::dvec3(s), 1.0)), s.w);
    return spheres;
}

void put_margins(const Margins& margins, SceneBlock& block) {
    const auto bands = std::min(margins.bands.size(), Margins::kMost);
    for (std::size_t i = 0; i < bands; ++i)
        block.margins[i] = linear(margins.bands[i].colour, margins.bands[i].within_mm);
    block.counts.z = static_cast<float>(bands);
}

// Samples lie at the texels' centres.
glm::mat4 eye_to_grid(const DistanceGrid& grid, const glm::dmat4& from_eye) {
    const glm::dvec3 extent = grid.step_mm * glm::dvec3(grid.size);
    return glm::mat4(glm::translate(glm::scale(glm::dmat4(1.0), 1.0 / extent), 0.5 * grid.step_mm - grid.corner) *
                     from_eye);
}

// Whether the values of the frame's scale exist.
bool has_values(const Frame& frame, const Centerlines* lines) {
    using Value = ColourScale::Value;
    if (frame.scale.value == Value::kNone || frame.scale.ramp.empty()) return false;
    if (frame.scale.value == Value::kSurface) return frame.mesh && frame.mesh->has_values();
    return lines != nullptr && (frame.scale.value != Value::kOfLines || frame.scale.list < lines->lists.size());
}

// Shaders identify values by the numbers of the enumerators.
static_assert(static_cast<int>(ColourScale::Value::kDiameter) == 1 &&
              static_cast<int>(ColourScale::Value::kRootDistance) == 2 &&
              static_cast<int>(ColourScale::Value::kSurface) == 3);
glm::vec4 scale_of(const ColourScale& scale) {
    const bool log = scale.logarithmic;
    const float low = log ? std::log(scale.low) : scale.low, high = log ? std::log(scale.high) : scale.high;
    // Lists of numbers replace diameters (GpuLines::bind_list).
    const auto value = scale.value == ColourScale::Value::kOfLines ? ColourScale::Value::kDiameter : scale.value;
    return {low, high > low ? 1.0F / (high - low) : 0.0F, log ? 1.0F : 0.0F, static_cast<float>(value)};
}

} // namespace

LookData look_data_of(const Frame& frame, const Centerlines* lines, const glm::dmat4& eye) {
    LookData data;
    data.lesions = lesion_spheres(frame.lesions, eye);
    const glm::dmat4 from_eye = glm::inverse(eye);
    const bool margins = !frame.margins.bands.empty();
    if (margins) {
        put_margins(frame.margins, data.block);
        const auto& grid = frame.lesions.distances;
        data.block.counts.w = grid && grid->whole() ? 1.0F : 0.0F;
        if (data.block.counts.w > 0.0F) data.block.eye_to_grid = eye_to_grid(*grid, from_eye);
    }
    if (!margins && has_values(frame, lines)) data.block.scale = scale_of(frame.scale);
    if (lines != nullptr) {
        data.block.eye_to_lines = glm::mat4(glm::translate(glm::dmat4(1.0), -lines->origin) * from_eye);
        data.cuts = cut_ends(frame.lost, *lines, eye);
    }
    data.block.counts.x = static_cast<float>(data.lesions.size());
    const std::size_t cuts = data.cuts.size() / 5;
    data.block.counts.y = static_cast<float>(cuts);
    data.shapes = shape_looks(frame);
    return data;
}

} // namespace ramus::render
