#include "render/renderer/passes/scene_tables.h"

#include "render/scene/look_data.h"

#include <utility>

namespace ramus::render {

namespace {

Texture distance_texture(const DistanceGrid& grid) {
    Texture texture = make_deep_texture(GL_TEXTURE_3D, GL_R32F, grid.size.x, grid.size.y, grid.size.z);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage3D(texture, 0, 0, 0, 0, grid.size.x, grid.size.y, grid.size.z, GL_RED, GL_FLOAT,
                        grid.values.data());
    set_filter(texture, GL_LINEAR);
    return texture;
}

Texture ramp_texture(const std::vector<glm::vec3>& ramp) {
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_1D, 1, &id);
    glTextureStorage1D(id, 1, GL_RGB16F, static_cast<GLsizei>(ramp.size()));
    glTextureSubImage1D(id, 0, 0, static_cast<GLsizei>(ramp.size()), GL_RGB, GL_FLOAT, ramp.data());
    set_filter(id, GL_LINEAR);
    return Texture(id);
}

} // namespace

void SceneTables::make() { block_ = make_buffer(sizeof(SceneBlock), nullptr, GL_DYNAMIC_STORAGE_BIT); }

void SceneTables::let_go() {
    Buffer block = std::move(block_);
    *this = {};
    block_ = std::move(block);
}

SceneTables::Needs SceneTables::send(const Subject& subject) {
    const Frame& frame = subject.frame;
    const GpuLines& lines = subject.scene.lines();
    LookData data = look_data_of(frame, lines.shown(), eye_matrix(frame.camera));
    const Needs needs{data.block.counts.z > 0.0F, data.block.scale.w > 0.0F,
                      !data.context.empty() || subject.has_lesions()};
    if (needs.margins) {
        lesions_.send(data.lesions);
        glBindTextureUnit(kUnitLesions, lesions_);
    }
    if (data.block.counts.w > 0.0F) {
        const auto& distances = frame.lesions.distances;
        if (shown_ != distances) distances_ = distance_texture(*distances);
        shown_ = distances;
        glBindTextureUnit(kUnitDistances, distances_);
    }
    if (lines.shown() != nullptr) lines.whole().bind();
    if (needs.scale) {
        ramp_ = ramp_texture(frame.scale.ramp);
        glBindTextureUnit(kUnitRamp, ramp_);
    }
    cuts_.send(data.cuts);
    if (!data.cuts.empty()) glBindTextureUnit(kUnitCuts, cuts_);
    if (data.context.empty() && needs.context) data.context.emplace_back(0.0F); // what the variant reads is there
    context_.send(data.context);
    glBindTextureUnit(kUnitContext, context_);
    glNamedBufferSubData(block_, 0, sizeof data.block, &data.block);
    glBindBufferBase(GL_UNIFORM_BUFFER, kBlockScene, block_);
    return needs;
}

} // namespace ramus::render
