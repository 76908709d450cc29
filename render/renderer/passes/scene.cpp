// What shade.frag knows of lesions, margins, scales and cuts: a uniform block and small textures.
#include "render/renderer/renderer_impl.h"
#include "render/scene/colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>

namespace ramus::render {

namespace {

static_assert(std::size_t{kMostMargins} == Margins::kMost);

// Fills a texture of few texels; room for more is made as it is needed.
void send_texels(Buffer& buffer, Texture& texture, std::size_t& capacity, const std::vector<glm::vec4>& texels) {
    const std::size_t bytes = texels.size() * sizeof(glm::vec4);
    if (bytes == 0) return;
    if (texels.size() > capacity) {
        capacity = 2 * texels.size();
        make_buffer_texture(buffer, texture, GL_RGBA32F, nullptr, capacity * sizeof(glm::vec4));
    }
    glNamedBufferSubData(buffer, 0, static_cast<GLsizeiptr>(bytes), texels.data());
}

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

glm::dmat4 eye_matrix(const Camera& camera) {
    return glm::scale(glm::dmat4(1.0), {1.0, 1.0, -1.0}) * view_matrix(camera);
}

// Five a part: the branch and which ends it has, then for each end the place and its direction.
std::vector<glm::vec4> cut_places(const std::vector<LostPart>& lost, const Centerlines& lines, const glm::dmat4& eye) {
    std::vector<glm::vec4> cuts;
    for (const LostPart& part : lost) {
        if (part.whole() || !lines.at(part.branch, 0.0)) continue;
        cuts.emplace_back(part.branch, part.from > 0.0 ? 1.0F : 0.0F, part.to < 1.0 ? 1.0F : 0.0F, 0.0F);
        for (const double fraction : {part.from, part.to}) {
            const Centerlines::Place place = *lines.at(part.branch, fraction);
            cuts.emplace_back(glm::dvec3(eye * glm::dvec4(place.position, 1.0)), place.radius_mm);
            cuts.emplace_back(glm::dvec3(eye * glm::dvec4(place.along, 0.0)), place.from_root_mm);
        }
    }
    return cuts;
}

// Returns the variants that the scene needs. What a plain tree does not need costs it nothing.
std::vector<glm::vec4> context_colours(const Frame& frame) {
    std::vector<glm::vec4> colours;
    for (const ContextMesh& one : frame.context)
        colours.push_back(linear(one.colour, (one.wireframe ? -1.0F : 1.0F) * std::clamp(one.opacity, 0.0F, 1.0F)));
    return colours;
}

unsigned Renderer::Impl::send_scene(const Frame& frame) {
    unsigned variant = 0;
    SceneBlock scene{};
    const glm::dmat4 eye = eye_matrix(frame.camera), from_eye = glm::inverse(eye);
    const Lesions& lesions = frame.lesions;

    if (!frame.margins.bands.empty()) {
        variant |= kMargins;
        std::vector<glm::vec4> spheres;
        for (const glm::dvec4& s : lesions.spheres)
            spheres.emplace_back(glm::dvec3(eye * glm::dvec4(glm::dvec3(s), 1.0)), s.w);
        send_texels(lesion_buffer_, lesion_texture_, lesion_capacity_, spheres);
        const auto bands = std::min(frame.margins.bands.size(), Margins::kMost);
        for (std::size_t i = 0; i < bands; ++i)
            scene.margins[i] = linear(frame.margins.bands[i].colour, frame.margins.bands[i].within_mm);
        scene.beyond = linear(frame.margins.beyond, 0.0F);
        scene.counts.x = static_cast<float>(spheres.size());
        scene.counts.z = static_cast<float>(bands);
        if (lesions.distances && lesions.distances->whole()) {
            const DistanceGrid& grid = *lesions.distances;
            if (distances_ != lesions.distances) distance_texture_ = distance_texture(grid);
            distances_ = lesions.distances;
            // Samples lie at the texels' centres.
            const glm::dvec3 extent = grid.step_mm * glm::dvec3(grid.size);
            scene.eye_to_grid = glm::mat4(
                glm::translate(glm::scale(glm::dmat4(1.0), 1.0 / extent), 0.5 * grid.step_mm - grid.corner) * from_eye);
            scene.counts.w = 1.0F;
            glBindTextureUnit(kUnitDistances, distance_texture_);
        }
        glBindTextureUnit(kUnitLesions, lesion_texture_);
    }

    const Centerlines* lines = lines_.shown();
    if (lines != nullptr) {
        scene.eye_to_lines = glm::mat4(glm::translate(glm::dmat4(1.0), -lines->origin) * from_eye);
        glBindTextureUnit(kUnitLinePoints, lines_.textures().points);
        glBindTextureUnit(kUnitLineDetails, lines_.textures().details);
        glBindTextureUnit(kUnitLineRuns, lines_.textures().runs);
        const ColourScale& scale = frame.scale;
        if (scale.value != ColourScale::Value::kNone && !scale.ramp.empty() && frame.margins.bands.empty()) {
            variant |= kScale;
            const bool log = scale.logarithmic;
            const float low = log ? std::log(scale.low) : scale.low, high = log ? std::log(scale.high) : scale.high;
            scene.scale = {low, high > low ? 1.0F / (high - low) : 0.0F, log ? 1.0F : 0.0F,
                           scale.value == ColourScale::Value::kRootDistance ? 1.0F : 0.0F};
            ramp_texture_ = ramp_texture(scale.ramp);
            glBindTextureUnit(kUnitRamp, ramp_texture_);
        }
        const std::vector<glm::vec4> cuts = cut_places(frame.lost, *lines, eye);
        send_texels(cut_buffer_, cut_texture_, cut_capacity_, cuts);
        scene.counts.y = static_cast<float>(cuts.size() / 5);
        if (!cuts.empty()) glBindTextureUnit(kUnitCuts, cut_texture_);
    }
    std::vector<glm::vec4> context = context_colours(frame);
    if (context.empty() && has_lesions(frame)) context.emplace_back(0.0F); // what the variant reads is there
    send_texels(context_buffer_, context_texture_, context_capacity_, context);
    if (!context.empty()) variant |= kContext;
    glNamedBufferSubData(scene_block_, 0, sizeof scene, &scene);
    glBindBufferBase(GL_UNIFORM_BUFFER, kBlockScene, scene_block_);
    return variant;
}

} // namespace ramus::render
