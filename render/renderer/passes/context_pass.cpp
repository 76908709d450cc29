#include "render/renderer/passes/context_pass.h"

#include "render/gl/gl_objects.h"
#include "render/scene/record_flags.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace ramus::render {

namespace {

// `to_clip`: from mm about the middle of the shape's bounds.
std::uint64_t draw_shape(const Shape& shape, GLuint number, const glm::dmat4& to_clip, const ViewSetup& view) {
    glUniformMatrix4fv(kUniformToClip, 1, GL_FALSE, glm::value_ptr(glm::mat4(to_clip)));
    glUniformMatrix3fv(kUniformToEye, 1, GL_FALSE, glm::value_ptr(view.to_eye));
    glUniform1ui(kUniformNumber, number);
    if (shape.closed())
        glEnable(GL_CULL_FACE);
    else
        glDisable(GL_CULL_FACE);
    return shape.draw();
}

} // namespace

Result<void> ContextPass::make() {
    return make_programs({{&opaque_, "context.vert", "context.frag"},
                          {&clear_, "context.vert", "context.frag", "#define TRANSPARENT\n"},
                          {&lines_, "context.vert", "context.frag", "#define TRANSPARENT\n#define LINES\n"}});
}

std::uint64_t ContextPass::draw_opaque(const Subject& subject, const ViewSetup& view) const {
    std::uint64_t triangles = 0;
    for (std::size_t i = 0; i < subject.frame.context.size(); ++i) {
        const ContextMesh& mesh = subject.frame.context[i];
        const Shape* shape = subject.scene.shapes().of(mesh, subject.quick());
        if (shape == nullptr || !mesh.solid()) continue;
        glUseProgram(opaque_);
        triangles += draw_shape(*shape, number_of(i), view.clip_from(shape->bounds().centre()), view);
    }
    glEnable(GL_CULL_FACE);
    return triangles;
}

std::uint64_t ContextPass::draw_clear(const Subject& subject, const ViewSetup& view, Clear what,
                                      const Prepare& prepare) const {
    const std::uint64_t triangles = what == Clear::kAll ? draw_context(subject, view, prepare) : 0;
    return triangles + draw_lesions(subject, view, prepare);
}

std::uint64_t ContextPass::draw_context(const Subject& subject, const ViewSetup& view, const Prepare& prepare) const {
    const Frame& frame = subject.frame;
    std::uint64_t triangles = 0;
    const double nearer = kContextLinesNearer * double(view.block.pixel_to_eye.z);
    const glm::dmat4 off = frame.camera.orthographic ? glm::translate(glm::dmat4(1.0), {0.0, 0.0, nearer})
                                                     : glm::scale(glm::dmat4(1.0), glm::dvec3(1.0 - nearer));
    const glm::dmat4 lines_to_clip = view.projection * off * view_matrix(frame.camera);
    for (std::size_t i = 0; i < frame.context.size(); ++i) {
        const Shape* shape = subject.scene.shapes().of(frame.context[i], subject.quick());
        if (shape == nullptr || !frame.context[i].clear()) continue;
        const Program& program = shape->lines() ? lines_ : clear_;
        glUseProgram(program);
        prepare(program);
        if (shape->lines()) glUniform1f(kUniformHalfWidth, 0.5F * kContextLineWidth * view.pixels_a_point(frame));
        const glm::dmat4& to_clip = shape->lines() ? lines_to_clip : view.to_clip;
        triangles += draw_shape(*shape, number_of(i), glm::translate(to_clip, shape->bounds().centre()), view);
    }
    glEnable(GL_CULL_FACE);
    return triangles;
}

std::uint64_t ContextPass::draw_lesions(const Subject& subject, const ViewSetup& view, const Prepare& prepare) const {
    if (!subject.has_lesions()) return 0;
    const Lesions& lesions = subject.frame.lesions;
    std::uint64_t triangles = 0;
    std::size_t index = 0;
    glUseProgram(clear_);
    prepare(clear_);
    const auto draw = [&](const Shape* shape, const glm::dvec3& centre, double scale) {
        const GLuint number = record::kLesionFragment | number_of(index++);
        if (shape == nullptr) return;
        triangles += draw_shape(*shape, number, glm::scale(view.clip_from(centre), glm::dvec3(scale)), view);
    };
    for (const glm::dvec4& sphere : lesions.spheres) draw(subject.scene.shapes().ball(), glm::dvec3(sphere), sphere.w);
    for (const auto& lesion : lesions.meshes) {
        const Shape* shape = subject.scene.shapes().of(lesion);
        draw(shape, shape != nullptr ? shape->bounds().centre() : glm::dvec3(0.0), 1.0);
    }
    glEnable(GL_CULL_FACE);
    return triangles;
}

} // namespace ramus::render
