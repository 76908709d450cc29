#include "render/renderer/passes/scene_tables.h"

#include "render/scene/colour.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

namespace ramus::render {

namespace {

static_assert(std::size_t{kMostMargins} == Margins::kMost);

Texture distance_texture(const DistanceGrid& grid) {
    Texture texture = make_deep_texture(GL_TEXTURE_3D, GL_R32F, grid.size.x, grid.size.y, grid.size.z);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage3D(texture, 0, 0, 0, 0, grid.size.x, grid.size.y, grid.size.z, GL_RED, GL_FLOAT,
                        grid.values.data());
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return texture;
}

Texture ramp_texture(const std::vector<glm::vec3>& ramp) {
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_1D, 1, &id);
    glTextureStorage1D(id, 1, GL_RGB16F, static_cast<GLsizei>(ramp.size()));
    glTextureSubImage1D(id, 0, 0, static_cast<GLsizei>(ramp.size()), GL_RGB, GL_FLOAT, ramp.data());
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    return Texture(id);
}

} // namespace

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

std::vector<glm::vec4> context_colours(const Frame& frame) {
    std::vector<glm::vec4> colours;
    for (const ContextMesh& one : frame.context)
        colours.push_back(linear(one.colour, (one.wireframe ? -1.0F : 1.0F) * std::clamp(one.opacity, 0.0F, 1.0F)));
    return colours;
}

void SceneTables::make() { block_ = make_buffer(sizeof(SceneBlock), nullptr, GL_DYNAMIC_STORAGE_BIT); }

void SceneTables::let_go() {
    Buffer block = std::move(block_);
    *this = {};
    block_ = std::move(block);
}

void SceneTables::send_margins(const Frame& frame, const glm::dmat4& eye, SceneBlock& block) {
    std::vector<glm::vec4> spheres;
    for (const glm::dvec4& s : frame.lesions.spheres)
        spheres.emplace_back(glm::dvec3(eye * glm::dvec4(glm::dvec3(s), 1.0)), s.w);
    lesions_.send(spheres);
    const Margins& margins = frame.margins;
    const auto bands = std::min(margins.bands.size(), Margins::kMost);
    for (std::size_t i = 0; i < bands; ++i)
        block.margins[i] = linear(margins.bands[i].colour, margins.bands[i].within_mm);
    block.beyond = linear(margins.beyond, 0.0F);
    block.counts.x = static_cast<float>(spheres.size());
    block.counts.z = static_cast<float>(bands);
    glBindTextureUnit(kUnitLesions, lesions_);
}

void SceneTables::send_distances(const DistanceGrid& grid, const glm::dmat4& from_eye, SceneBlock& block) {
    // Samples lie at the texels' centres.
    const glm::dvec3 extent = grid.step_mm * glm::dvec3(grid.size);
    block.eye_to_grid = glm::mat4(
        glm::translate(glm::scale(glm::dmat4(1.0), 1.0 / extent), 0.5 * grid.step_mm - grid.corner) * from_eye);
    block.counts.w = 1.0F;
    glBindTextureUnit(kUnitDistances, distances_);
}

void SceneTables::send_scale(const ColourScale& scale, SceneBlock& block) {
    const bool log = scale.logarithmic;
    const float low = log ? std::log(scale.low) : scale.low, high = log ? std::log(scale.high) : scale.high;
    block.scale = {low, high > low ? 1.0F / (high - low) : 0.0F, log ? 1.0F : 0.0F,
                   scale.value == ColourScale::Value::kRootDistance ? 1.0F : 0.0F};
    ramp_ = ramp_texture(scale.ramp);
    glBindTextureUnit(kUnitRamp, ramp_);
}

void SceneTables::send_cuts(const Frame& frame, const Centerlines& lines, const glm::dmat4& eye, SceneBlock& block) {
    const std::vector<glm::vec4> cuts = cut_ends(frame.lost, lines, eye);
    cuts_.send(cuts);
    block.counts.y = static_cast<float>(cuts.size() / 5);
    if (!cuts.empty()) glBindTextureUnit(kUnitCuts, cuts_);
}

SceneTables::Needs SceneTables::send(const Subject& subject) {
    const Frame& frame = subject.frame;
    Needs needs;
    SceneBlock block{};
    const glm::dmat4 eye = eye_matrix(frame.camera), from_eye = glm::inverse(eye);
    needs.margins = !frame.margins.bands.empty();
    if (needs.margins) {
        send_margins(frame, eye, block);
        const auto& distances = frame.lesions.distances;
        if (distances && distances->whole()) {
            if (shown_ != distances) distances_ = distance_texture(*distances);
            shown_ = distances;
            send_distances(*distances, from_eye, block);
        }
    }
    const GpuLines& lines = subject.scene.lines();
    if (lines.shown() != nullptr) {
        block.eye_to_lines = glm::mat4(glm::translate(glm::dmat4(1.0), -lines.shown()->origin) * from_eye);
        glBindTextureUnit(kUnitLinePoints, lines.textures().points);
        glBindTextureUnit(kUnitLineDetails, lines.textures().details);
        glBindTextureUnit(kUnitLineRuns, lines.textures().runs);
        const ColourScale& scale = frame.scale;
        needs.scale = scale.value != ColourScale::Value::kNone && !scale.ramp.empty() && !needs.margins;
        if (needs.scale) send_scale(scale, block);
        send_cuts(frame, *lines.shown(), eye, block);
    }
    std::vector<glm::vec4> context = context_colours(frame);
    if (context.empty() && subject.has_lesions()) context.emplace_back(0.0F); // what the variant reads is there
    needs.context = !context.empty();
    context_.send(context);
    glBindTextureUnit(kUnitContext, context_);
    glNamedBufferSubData(block_, 0, sizeof block, &block);
    glBindBufferBase(GL_UNIFORM_BUFFER, kBlockScene, block_);
    return needs;
}

} // namespace ramus::render
