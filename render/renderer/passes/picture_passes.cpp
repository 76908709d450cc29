#include "render/renderer/passes/picture_passes.h"

#include "render/renderer/passes/gl_state.h"
#include "render/scene/look_data.h"
#include "render/scene/record_flags.h"

#include <algorithm>
#include <array>

namespace ramus::render {

namespace {

constexpr int kCastTaps = 20; // of the occlusion, as at rest

std::vector<caster::Body> bodies_of(const Frame& frame, const GpuShapes& shapes) {
    std::vector<caster::Body> bodies;
    const float point = frame.pixel_ratio;
    for (std::size_t i = 0; i < frame.context.size(); ++i) {
        const Shape* shape = shapes.of(frame.context[i], true);
        if (shape == nullptr) continue;
        bodies.push_back({&shape->made_of(), record::kSolid | record::kContext | number_of(i), frame.context[i].clear(),
                          shape->lines() ? 0.5F * kContextLineWidth * point : 0.0F});
    }
    std::size_t index = frame.lesions.spheres.size();
    for (const auto& lesion : frame.lesions.meshes) {
        const std::uint32_t number = number_of(index++);
        if (const Shape* shape = shapes.of(lesion); shape != nullptr)
            bodies.push_back({&shape->made_of(), record::kSolid | number, true, 0.0F});
    }
    return bodies;
}

caster::View view_of(const Frame& frame, const ViewSetup& from) {
    constexpr int kAcross = caster::kTile * caster::kOccludedTiles;
    const glm::vec4& pixel = from.block.pixel_to_eye;
    return {.width = from.picture.x,
            .height = from.picture.y,
            .stride = (from.picture.x + kAcross - 1) / kAcross * kAcross,
            .centre_x = pixel.x,
            .centre_y = pixel.y,
            .mm_a_pixel = pixel.z,
            .flat = frame.camera.orthographic,
            .block = from.block,
            .taps = frame.appearance.occlusion > 0.0F ? kCastTaps : 0,
            .shadows = frame.appearance.shadows > 0.0F};
}

} // namespace

void CopyPass::draw(const ViewSetup& view, const LitTarget& from, const PictureTarget& to, const Region& region) const {
    if (view.enlarged()) {
        glBindTextureUnit(kUnitImage, from.colour);
        enlarge_.draw();
        return;
    }
    const glm::ivec2 at = region.at, end = region.end();
    glBlitNamedFramebuffer(from.framebuffer, to.framebuffer, at.x, at.y, end.x, end.y, at.x, at.y, end.x, end.y,
                           GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void MeanTarget::make(glm::ivec2 size) {
    sum = make_texture(GL_RGBA16F, size.x, size.y);
    framebuffer = make_framebuffer({sum});
}

Result<void> MeanPass::make() {
    if (auto made = add_.make("add_view.frag"); !made) return made;
    return mean_.make("mean_view.frag");
}

void MeanPass::add(const ViewSetup& view, const LitTarget& from, MeanTarget& to) const {
    glBindFramebuffer(GL_FRAMEBUFFER, to.framebuffer);
    if (to.views == 0) {
        const std::array<GLfloat, 4> nothing{};
        glClearBufferfv(GL_COLOR, 0, nothing.data());
    }
    glViewport(0, 0, view.size.x, view.size.y);
    begin_blending(Blending::kAdded);
    glBindTextureUnit(kUnitImage, from.colour);
    add_.draw();
    glDisable(GL_BLEND);
    ++to.views;
}

void MeanPass::show(const ViewSetup& view, const MeanTarget& from, const LitTarget& to) const {
    glBindFramebuffer(GL_FRAMEBUFFER, to.framebuffer);
    glViewport(0, 0, view.size.x, view.size.y);
    glBindTextureUnit(kUnitImage, from.sum);
    glProgramUniform1f(mean_, kUniformShare, 1.0F / static_cast<float>(from.views));
    mean_.draw();
}

std::uint64_t CastPass::draw(const Subject& subject, const ViewSetup& view, BranchRecords& records) {
    const Frame& frame = subject.frame;
    const glm::dmat4 eye = eye_matrix(frame.camera);
    caster_.follow(frame, nullptr);
    const bool outlined = records.send(subject, false).any_selected;
    const bool glass = std::ranges::find(subject.layers, Layer::kGlass) != subject.layers.end();
    const LookData data = look_data_of(frame, frame.centerlines.get(), eye);
    const caster::Uniforms uniforms{view.block, look_of(frame, view, glass, outlined), data.block};
    const std::shared_ptr<const PagedMesh>& surface = subject.scene.whole_surface();
    return caster_.draw(frame, view_of(frame, view), eye,
                        {uniforms, outlined, subject.layers, records.records(), data,
                         bodies_of(frame, subject.scene.shapes()), surface.get(),
                         surface ? view.clip_from(surface->origin()) : glm::dmat4(1.0)});
}

void CastPass::send_picture(const PictureTarget& to) const {
    glTextureSubImage2D(to.colour, 0, 0, 0, to.size.x, to.size.y, GL_RGBA, GL_UNSIGNED_BYTE, caster_.rgba());
}

void CastPass::send_depths(const PictureTarget& picture, const ResolvedTarget& to) const {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, caster_.stride());
    glTextureSubImage2D(to.opaque_depth, 0, 0, 0, picture.size.x, picture.size.y, GL_RED, GL_FLOAT, caster_.depths());
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

} // namespace ramus::render
