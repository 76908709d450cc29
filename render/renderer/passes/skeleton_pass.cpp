#include "render/renderer/passes/overlay_passes.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace ramus::render {

namespace {

constexpr std::size_t kMostMovingRings = 400; // of one size: more hold up a software rasteriser, and wait for the rest
constexpr float kRingWidth = 1.0F;            // points

// How much is left of a line behind a surface, most of which lie in vessels, and of the far half of a ring.
constexpr float kHiddenLine = 0.55F, kHiddenRing = 0.25F;
constexpr glm::vec3 kLineColour{0.95F, 0.96F, 0.98F}, kRingColour{0.98F, 0.93F, 0.78F};

void set_stripe(const Frame& frame, const ViewSetup& view, float points, const glm::vec4& tint) {
    const float half = 0.5F * std::max(1.0F, points * frame.pixel_ratio);
    glUniform3f(kUniformHalfPicture, 0.5F * float(view.picture.x), 0.5F * float(view.picture.y), half);
    glUniform4f(kUniformTint, tint.x, tint.y, tint.z, tint.w);
}

} // namespace

bool SkeletonPass::make() {
    if (lines_ != 0) return true;
    no_vertices_ = make_vertex_array();
    return make_programs({{&rings_, "skeleton.vert", "skeleton.frag", "#define RINGS\n"},
                          {&lines_, "skeleton.vert", "skeleton.frag"}})
        .has_value(); // tests compile every shader
}

void SkeletonPass::use(const Program& program, const Subject& subject, const ViewSetup& view) const {
    const Camera& camera = subject.frame.camera;
    const glm::dvec3 origin = subject.scene.skeleton().shown()->origin;
    const glm::dvec3 forward = axes_of(camera).forward;
    const glm::vec4 to_depth(glm::vec3(forward), static_cast<float>(glm::dot(forward, origin - camera.position)));
    const glm::vec2 to_inner = view.to_inner();
    glUseProgram(program);
    glUniformMatrix4fv(kUniformToClip, 1, GL_FALSE, glm::value_ptr(glm::mat4(view.clip_from(origin))));
    glUniform4f(kUniformToDepth, to_depth.x, to_depth.y, to_depth.z, to_depth.w);
    glUniform2f(kUniformToInner, to_inner.x, to_inner.y);
}

void SkeletonPass::draw_rings(const Subject& subject) const {
    const Frame& frame = subject.frame;
    const GpuSkeleton& skeleton = subject.scene.skeleton();
    glBindTextureUnit(kUnitRings, skeleton.rings());
    const GpuSkeleton::Seen seen = skeleton.seen(frame.camera, frame.size, subject.layers);
    for (const auto& [rings, steps] : {std::pair{&seen.small, subject.quick() ? kMovingRingSteps : kSmallRingSteps},
                                       std::pair{&seen.large, kLargeRingSteps}}) {
        if (rings->empty() || (subject.quick() && rings->size() > kMostMovingRings)) continue;
        const BufferTexture seen_rings = make_buffer_texture(GL_R32UI, *rings);
        glBindTextureUnit(kUnitSeenRings, seen_rings.texture);
        glUniform2f(kUniformRingSteps, float(steps), float(kLeastRingPixels));
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(6 * rings->size() * static_cast<std::size_t>(steps)));
    }
}

void SkeletonPass::draw(const Subject& subject, const ViewSetup& view, GLuint opaque_depth) {
    GpuSkeleton& skeleton = subject.scene.skeleton();
    skeleton.follow(subject.frame.skeleton);
    if (skeleton.shown() == nullptr || !make()) return;
    glBindVertexArray(no_vertices_);
    glBindTextureUnit(kUnitOpaqueDepth, opaque_depth);
    use(rings_, subject, view);
    set_stripe(subject.frame, view, kRingWidth, glm::vec4(kRingColour, kHiddenRing));
    draw_rings(subject);
    use(lines_, subject, view);
    set_stripe(subject.frame, view, kCenterlineWidth, glm::vec4(kLineColour, kHiddenLine));
    (void)skeleton.lines(subject.quick()).draw(subject.layers, {Layer::kOpaque, Layer::kGlass});
}

} // namespace ramus::render
