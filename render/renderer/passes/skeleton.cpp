// Centerlines and rings of the radius over the picture.
#include "render/renderer/renderer_impl.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace ramus::render {

namespace {

constexpr std::size_t kMostMovingRings = 400; // of one size: more hold up a software rasteriser, and wait for the rest
constexpr float kRingWidth = 1.0F;            // points
constexpr float kHiddenLine = 0.55F; // how much is left of a line behind a surface: most of them lie in vessels
constexpr float kHiddenRing = 0.25F; // of the far half of a ring
constexpr glm::vec3 kLineColour{0.95F, 0.96F, 0.98F}, kRingColour{0.98F, 0.93F, 0.78F};

} // namespace

// The caster's own depths, for what is drawn over its picture.
void Renderer::Impl::send_cast_depths() const {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, caster_.stride());
    glTextureSubImage2D(opaque_depth_, 0, 0, 0, size_.x, size_.y, GL_RED, GL_FLOAT, caster_.depths());
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

void Renderer::Impl::draw_skeleton(const Frame& frame, const std::vector<Layer>& layers) {
    skeleton_.follow(frame.skeleton);
    if (skeleton_.shown() == nullptr) return;
    const Centerlines& lines = *skeleton_.shown();
    for (auto [program, defines] : {std::pair{&skeleton_line_, ""}, {&skeleton_ring_, "#define RINGS\n"}}) {
        if (*program != 0) continue;
        auto made = make_program("skeleton.vert", "skeleton.frag", defines);
        if (!made) return; // tests compile every shader
        *program = std::move(*made);
    }
    const glm::mat4 to_clip(glm::translate(projection_ * view_matrix(frame.camera), lines.origin));
    const CameraAxes axes = axes_of(frame.camera);
    const glm::vec4 to_depth(glm::vec3(axes.forward),
                             static_cast<float>(glm::dot(axes.forward, lines.origin - frame.camera.position)));
    glBindVertexArray(no_vertices_);
    glBindBufferBase(GL_UNIFORM_BUFFER, kBlockView, view_block_);
    glBindTextureUnit(kUnitOpaqueDepth, opaque_depth_);
    const auto use = [&](const Program& program, float points, const glm::vec3& colour, float hidden) {
        glUseProgram(program);
        const float half = 0.5F * std::max(1.0F, points * frame.pixel_ratio);
        glUniformMatrix4fv(kUniformToClip, 1, GL_FALSE, glm::value_ptr(to_clip));
        glUniform3f(kUniformHalfPicture, 0.5F * float(size_.x), 0.5F * float(size_.y), half);
        glUniform4f(kUniformToDepth, to_depth.x, to_depth.y, to_depth.z, to_depth.w);
        glUniform4f(kUniformTint, colour.x, colour.y, colour.z, hidden);
        glUniform2f(kUniformToInner, float(inner_.x) / float(size_.x), float(inner_.y) / float(size_.y));
    };
    use(skeleton_ring_, kRingWidth, kRingColour, kHiddenRing);
    glBindTextureUnit(kUnitRings, skeleton_.rings());
    const GpuSkeleton::Seen seen = skeleton_.seen(frame.camera, frame.size, layers);
    const bool moving = frame.quality == Quality::kInteractive;
    for (const auto& [rings, steps] : {std::pair{&seen.small, moving ? kMovingRingSteps : kSmallRingSteps},
                                       std::pair{&seen.large, kLargeRingSteps}}) {
        if (rings->empty() || (moving && rings->size() > kMostMovingRings)) continue;
        Buffer buffer;
        Texture texture;
        make_buffer_texture(buffer, texture, GL_R32UI, rings->data(), rings->size() * sizeof(std::uint32_t));
        glBindTextureUnit(kUnitSeenRings, texture);
        glUniform2f(kUniformRingSteps, float(steps), float(kLeastRingPixels));
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(6 * rings->size() * static_cast<std::size_t>(steps)));
    }
    use(skeleton_line_, kCenterlineWidth, kLineColour, kHiddenLine);
    const GpuSkeleton::Lines& drawn = skeleton_.lines(moving);
    glBindTextureUnit(kUnitSkeletonPoints, drawn.points);
    glBindTextureUnit(kUnitSkeletonOwners, drawn.branches);
    drawn.draw(layers);
}

} // namespace ramus::render
