// What is beside the tree: opaque context among the vessels, and as panes among the glass what is clear, which are
// context meshes, their lines, and lesions. Backs of closed meshes are not drawn; open ones are seen from both sides.
#include "render/renderer/renderer_impl.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>

namespace ramus::render {

namespace {

// `about` goes from mm about the middle of the shape's bounds to clip space.
void place(const Shape& shape, GLuint number, const glm::dmat4& about, const Camera& camera) {
    glUniformMatrix4fv(kUniformToClip, 1, GL_FALSE, glm::value_ptr(glm::mat4(about)));
    glUniformMatrix3fv(kUniformToEye, 1, GL_FALSE, glm::value_ptr(glm::mat3(view_matrix(camera))));
    glUniform1ui(kUniformNumber, number);
    if (shape.closed())
        glEnable(GL_CULL_FACE);
    else
        glDisable(GL_CULL_FACE);
}

} // namespace

std::uint64_t Renderer::Impl::draw_solid_context(const Frame& frame) const {
    std::uint64_t triangles = 0;
    const bool quick = frame.quality == Quality::kInteractive;
    const glm::dmat4 to_clip = projection_ * view_matrix(frame.camera);
    for (std::size_t i = 0; i < frame.context.size(); ++i) {
        const Shape* shape = shapes_.of(frame.context[i], quick);
        if (shape == nullptr || !frame.context[i].solid()) continue;
        glUseProgram(context_);
        place(*shape, number_of(i), glm::translate(to_clip, shape->bounds().centre()), frame.camera);
        triangles += shape->draw();
    }
    glEnable(GL_CULL_FACE);
    return triangles;
}

// Into what is bound; `prepare` gives each program what it needs beside the mesh.
std::uint64_t Renderer::Impl::draw_clear(const Frame& frame, Clear what, const Prepare& prepare) const {
    const std::uint64_t triangles = what == Clear::kAll ? draw_clear_context(frame, prepare) : 0;
    return triangles + draw_lesions(frame, prepare);
}

std::uint64_t Renderer::Impl::draw_clear_context(const Frame& frame, const Prepare& prepare) const {
    std::uint64_t triangles = 0;
    const bool quick = frame.quality == Quality::kInteractive, flat = frame.camera.orthographic;
    const glm::dmat4 view = view_matrix(frame.camera);
    const double nearer = kContextLinesNearer * double(view_.pixel_to_eye.z);
    const glm::dmat4 off = flat ? glm::translate(glm::dmat4(1.0), {0.0, 0.0, nearer})
                                : glm::scale(glm::dmat4(1.0), glm::dvec3(1.0 - nearer));
    const float point = frame.pixel_ratio * float(inner_.y) / float(size_.y);
    for (std::size_t i = 0; i < frame.context.size(); ++i) {
        const Shape* shape = shapes_.of(frame.context[i], quick);
        if (shape == nullptr || !frame.context[i].clear()) continue;
        const Program& program = shape->lines() ? context_lines_ : clear_context_;
        glUseProgram(program);
        prepare(program);
        if (shape->lines()) glUniform1f(kUniformHalfWidth, 0.5F * kContextLineWidth * point);
        const glm::dmat4 to_clip = projection_ * (shape->lines() ? off : glm::dmat4(1.0)) * view;
        place(*shape, number_of(i), glm::translate(to_clip, shape->bounds().centre()), frame.camera);
        triangles += shape->draw();
    }
    glEnable(GL_CULL_FACE);
    return triangles;
}

std::uint64_t Renderer::Impl::draw_lesions(const Frame& frame, const Prepare& prepare) const {
    if (!has_lesions(frame)) return 0;
    std::uint64_t triangles = 0;
    std::size_t index = 0;
    const glm::dmat4 to_clip = projection_ * view_matrix(frame.camera);
    glUseProgram(clear_context_);
    prepare(clear_context_);
    const auto draw = [&](const Shape* shape, const glm::dvec3& centre, double scale) {
        const GLuint number = record::kLesionFragment | number_of(index++);
        if (shape == nullptr) return;
        place(*shape, number, glm::scale(glm::translate(to_clip, centre), glm::dvec3(scale)), frame.camera);
        triangles += shape->draw();
    };
    for (const glm::dvec4& sphere : frame.lesions.spheres) draw(shapes_.ball(), glm::dvec3(sphere), sphere.w);
    for (const auto& lesion : frame.lesions.meshes) {
        const Shape* shape = shapes_.of(lesion);
        draw(shape, shape != nullptr ? shape->bounds().centre() : glm::dvec3(0.0), 1.0);
    }
    glEnable(GL_CULL_FACE);
    return triangles;
}

std::uint64_t Renderer::Impl::list_clear_panes(const Frame& frame, Band band) const {
    return draw_clear(frame, Clear::kAll, [&](const Program& program) {
        bind_panes(program, band);
        glUniform1ui(kUniformCapacity, static_cast<GLuint>(pane_room_));
    });
}

// What draw_layer() draws of what is clear.
std::uint64_t Renderer::Impl::draw_clear_layer(const Frame& frame, Clear what, int layer) const {
    return draw_clear(frame, what, [&](const Program&) {
        glUniform1i(kUniformSamples, static_cast<GLint>(view_.picture.z));
        glUniform1i(kUniformLayer, layer);
        glUniform2fv(kUniformSamplePositions, kMostSamples, &sample_places_[0].x);
        glBindTextureUnit(kUnitOpaqueSamples, depth_);
        glBindTextureUnit(kUnitLastLayer, layer == 0 ? 0 : GLuint(layer_depths_.at(std::size_t(1 - layer % 2))));
    });
}

// Their nearest layer alone: into layer_panes_ and the depths of `target`.
std::uint64_t Renderer::Impl::draw_first_clear_layer(const Frame& frame, Clear what, std::size_t target) const {
    glBindFramebuffer(GL_FRAMEBUFFER, layer_targets_.at(target));
    take_front_faces(true);
    clear_samples();
    const std::uint64_t triangles = draw_clear_layer(frame, what, 0);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    return triangles;
}

} // namespace ramus::render
