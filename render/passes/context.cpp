// Context meshes: opaque ones among the vessels, clear ones and lines as panes among the glass. Backs of closed meshes
// are not drawn; open ones are seen from both sides.
#include "render/renderer_impl.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>

namespace ramus::render {

namespace {

constexpr float kLineWidth = 1.15F; // points
constexpr double kNearer = 1.5;     // pixels that lines come towards the eye, off the surface that they lie on

void place(const Shape& shape, std::size_t index, const glm::dmat4& to_clip, const Camera& camera) {
    const glm::dmat4 placed = glm::translate(to_clip, shape.bounds().centre());
    glUniformMatrix4fv(0, 1, GL_FALSE, glm::value_ptr(glm::mat4(placed)));
    glUniformMatrix3fv(1, 1, GL_FALSE, glm::value_ptr(glm::mat3(view_matrix(camera))));
    glUniform1ui(7, static_cast<GLuint>(index + 1));
    if (shape.closed())
        glEnable(GL_CULL_FACE);
    else
        glDisable(GL_CULL_FACE);
}

} // namespace

std::uint64_t Renderer::Impl::draw_solid_context(const Frame& frame) const {
    std::uint64_t triangles = 0;
    const bool quick = frame.quality == Quality::kInteractive;
    for (std::size_t i = 0; i < frame.context.size(); ++i) {
        const Shape* shape = shapes_.of(frame.context[i], quick);
        if (shape == nullptr || !frame.context[i].solid()) continue;
        glUseProgram(context_);
        place(*shape, i, projection_ * view_matrix(frame.camera), frame.camera);
        triangles += shape->draw();
    }
    glEnable(GL_CULL_FACE);
    return triangles;
}

// Into what is bound; `prepare` gives each program what it needs beside the mesh.
std::uint64_t Renderer::Impl::draw_clear_context(const Frame& frame,
                                                 const std::function<void(const Program&)>& prepare) const {
    std::uint64_t triangles = 0;
    const bool quick = frame.quality == Quality::kInteractive, flat = frame.camera.orthographic;
    const glm::dmat4 view = view_matrix(frame.camera);
    const double nearer = kNearer * double(view_.pixel_to_eye.z);
    const glm::dmat4 off = flat ? glm::translate(glm::dmat4(1.0), {0.0, 0.0, nearer})
                                : glm::scale(glm::dmat4(1.0), glm::dvec3(1.0 - nearer));
    const float point = frame.pixel_ratio * float(inner_.y) / float(size_.y);
    for (std::size_t i = 0; i < frame.context.size(); ++i) {
        const Shape* shape = shapes_.of(frame.context[i], quick);
        if (shape == nullptr || !frame.context[i].clear()) continue;
        const Program& program = shape->lines() ? context_lines_ : context_pane_;
        glUseProgram(program);
        prepare(program);
        if (shape->lines()) glUniform1f(12, 0.5F * kLineWidth * point);
        place(*shape, i, projection_ * (shape->lines() ? off : glm::dmat4(1.0)) * view, frame.camera);
        triangles += shape->draw();
    }
    glEnable(GL_CULL_FACE);
    return triangles;
}

std::uint64_t Renderer::Impl::list_context_panes(const Frame& frame, Band band) const {
    return draw_clear_context(frame, [&](const Program& program) {
        bind_panes(program, band);
        glUniform1ui(5, static_cast<GLuint>(pane_room_));
    });
}

// What draw_layer() draws of context.
std::uint64_t Renderer::Impl::draw_context_layer(const Frame& frame, int layer) const {
    return draw_clear_context(frame, [&](const Program&) {
        glUniform1i(2, static_cast<GLint>(view_.picture.z));
        glUniform1i(4, layer);
        glUniform2fv(8, kMostSamples, &sample_places_[0].x);
        glBindTextureUnit(5, depth_);
        glBindTextureUnit(6, layer_depths_.at(std::size_t(1 - layer % 2)));
    });
}

// Where clear context is, into layer_depths_[1], and into layer_panes_ what nobody reads.
std::uint64_t Renderer::Impl::draw_context_cover(const Frame& frame) const {
    glBindFramebuffer(GL_FRAMEBUFFER, layer_targets_[1]);
    take_front_faces(true);
    clear_samples();
    glBindTextureUnit(6, 0);
    const std::uint64_t triangles = draw_clear_context(frame, [&](const Program&) {
        glUniform1i(2, static_cast<GLint>(view_.picture.z));
        glUniform1i(4, 0);
        glUniform2fv(8, kMostSamples, &sample_places_[0].x);
        glBindTextureUnit(5, depth_);
    });
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    return triangles;
}

} // namespace ramus::render
