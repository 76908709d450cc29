#include "render/renderer/passes/surface_pass.h"

#include "render/gl/gl_context.h"
#include "render/gl/gl_objects.h"
#include "render/renderer/passes/gl_state.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace ramus::render {

namespace {

// Where glass begins, an opaque vessel is open: such vessels are drawn from both sides, the inside as the lid that
// closes them. By branch: the layers of those that are closed, and of those that are open.
struct OpenAndClosed {
    std::vector<Layer> closed, open;
};
OpenAndClosed open_and_closed(const PagedMesh& mesh, const std::vector<Layer>& layers) {
    OpenAndClosed found{layers, std::vector<Layer>(layers.size(), Layer::kNone)};
    for (const auto& page : mesh.triangle_pages())
        for (const auto& pair : page->borders)
            for (const int i : {0, 1}) {
                const auto one = static_cast<std::size_t>(pair.at(static_cast<std::size_t>(i)));
                const auto other = static_cast<std::size_t>(pair.at(static_cast<std::size_t>(1 - i)));
                if (layers[one] != Layer::kOpaque || layers[other] != Layer::kGlass) continue;
                found.closed[one] = Layer::kNone;
                found.open[one] = Layer::kOpaque;
            }
    return found;
}

} // namespace

void use_for_vessels(const Program& program, const Subject& subject, const ViewSetup& view) {
    glUseProgram(program);
    glUniformMatrix4fv(kUniformToClip, 1, GL_FALSE, glm::value_ptr(glm::mat4(subject.mesh_to_clip(view))));
    glUniformMatrix3fv(kUniformToEye, 1, GL_FALSE, glm::value_ptr(view.to_eye));
}

void end_borders() { glUseProgram(0); }

Result<void> SurfacePass::make() {
    return make_programs({{&triangles_, "geometry.vert", "geometry.frag"},
                          {&borders_, "geometry.vert", "geometry.frag", "#define BORDER\n", "border.geom"}});
}

// Triangles that are cut in two inside a pixel. From 4.0 on a shader chooses samples; before, each is drawn by itself.
void SurfacePass::draw_by_sample(const ViewSetup& view, const SampleTarget& to,
                                 const std::function<void()>& draw) const {
    if (gl_has_lists()) return draw();
    glEnable(GL_SAMPLE_MASK);
    for (std::size_t s = 0; s < static_cast<std::size_t>(view.samples); ++s) {
        glSampleMaski(0, GLbitfield{1} << s);
        glProgramUniform2f(borders_, kUniformSamplePosition, to.positions.at(s).x, to.positions.at(s).y);
        draw();
    }
    glSampleMaski(0, ~GLbitfield{0});
    glDisable(GL_SAMPLE_MASK);
}

InParts<std::uint64_t> SurfacePass::draw(const Subject& subject, const ViewSetup& view, const SampleTarget& to) const {
    const GpuMesh& mesh = subject.mesh;
    const glm::dmat4 to_clip = subject.mesh_to_clip(view);
    const bool any_glass = subject.has_glass_vessels();
    const OpenAndClosed both = any_glass ? open_and_closed(*mesh.shown(), subject.scene.branch_layers().all)
                                         : OpenAndClosed{subject.layers, {}};
    std::uint64_t triangles = 0;
    for (const bool both_sides : {false, true}) {
        if (both_sides && !any_glass) continue;
        const GpuMesh::Ranges ranges = mesh.choose(both_sides ? both.open : both.closed, Layer::kOpaque, to_clip);
        for (std::size_t part = 0; part < ranges.parts(); ++part) {
            draw_opaque_into(to);
            use_for_vessels(triangles_, subject, view);
            if (both_sides) glDisable(GL_CULL_FACE);
            mesh.draw_part(ranges, part);
            co_await kPartEnds;
        }
        triangles += ranges.triangles();
    }
    const GpuMesh::Ranges borders = mesh.choose_borders(subject.layers, Layer::kOpaque, to_clip);
    for (std::size_t part = 0; part < borders.parts(); ++part) {
        draw_opaque_into(to);
        use_for_vessels(borders_, subject, view);
        if (any_glass) glDisable(GL_CULL_FACE);
        glBindTextureUnit(kUnitLayers, subject.scene.branch_layers().table);
        draw_by_sample(view, to, [&] { mesh.draw_part(borders, part); });
        end_borders();
        co_await kPartEnds;
    }
    co_return triangles + borders.triangles();
}

Result<void> CenterlinePass::make() {
    no_vertices_ = make_vertex_array();
    return make_programs(
        {{&cones_, "cone.vert", "cone.frag"}, {&lines_, "centerline.vert", "geometry.frag", "#define LINE\n"}});
}

std::uint64_t CenterlinePass::draw_cones(const Subject& subject) const {
    GpuLines& lines = subject.scene.lines();
    const Camera& camera = subject.frame.camera;
    const glm::dmat4 to_eye = glm::translate(eye_matrix(camera), lines.shown()->origin);
    const glm::dmat4 projection = projection_matrix(camera, subject.frame.size, 1.0, 2.0);
    glUseProgram(cones_);
    glBindVertexArray(no_vertices_);
    glUniformMatrix4fv(kUniformLinesToEye, 1, GL_FALSE, glm::value_ptr(glm::mat4(to_eye)));
    glUniform2f(kUniformZoom, static_cast<float>(projection[0][0]), static_cast<float>(projection[1][1]));
    glDisable(GL_CULL_FACE);
    const std::uint64_t segments = lines.thinned().draw(subject.layers, {Layer::kOpaque});
    glEnable(GL_CULL_FACE);
    return 2 * segments;
}

void CenterlinePass::draw_lines(const Subject& subject, const ViewSetup& view) const {
    const GpuLines& lines = subject.scene.lines();
    glUseProgram(lines_);
    glBindVertexArray(no_vertices_);
    const glm::mat4 to_clip(view.clip_from(lines.shown()->origin));
    glUniformMatrix4fv(kUniformToClip, 1, GL_FALSE, glm::value_ptr(to_clip));
    const float pixels = kCenterlineWidth * view.pixels_a_point(subject.frame);
    glUniform3f(kUniformHalfPicture, 0.5F * float(view.size.x), 0.5F * float(view.size.y),
                0.5F * std::max(pixels, 1.0F));
    (void)lines.whole().draw(subject.layers, {Layer::kGlass});
}

} // namespace ramus::render
