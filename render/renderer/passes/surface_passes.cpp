#include "render/renderer/passes/surface_passes.h"

#include "render/gl/gl_context.h"
#include "render/gl/gl_objects.h"
#include "render/renderer/passes/gl_state.h"
#include "render/scene/record_flags.h"

#include <algorithm>
#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace ramus::render {

namespace {

// An opaque vessel is open where glass begins. Open vessels are drawn from both sides; their inside looks like a lid.
// By branch: layers of closed and of open vessels.
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

void use_for_shape(const Shape& shape, GLuint number, const glm::dmat4& to_clip, const ViewSetup& view) {
    glUniformMatrix4fv(kUniformToClip, 1, GL_FALSE, glm::value_ptr(glm::mat4(to_clip)));
    glUniformMatrix3fv(kUniformToEye, 1, GL_FALSE, glm::value_ptr(view.to_eye));
    glUniform1ui(kUniformNumber, number);
    if (!shape.closed()) glDisable(GL_CULL_FACE);
}

} // namespace

void use_for_vessels(const Program& program, const Subject& subject, const ViewSetup& view) {
    glUseProgram(program);
    glUniformMatrix4fv(kUniformToClip, 1, GL_FALSE, glm::value_ptr(glm::mat4(subject.mesh_to_clip(view))));
    glUniformMatrix3fv(kUniformToEye, 1, GL_FALSE, glm::value_ptr(view.to_eye));
    glBindTextureUnit(kUnitLayers, subject.scene.branch_layers().table);
    if (subject.has_mesh()) begin_cut(subject.frame, subject.mesh.shown()->origin());
}

void end_borders() {
    glUseProgram(0);
    end_cut();
}

Result<void> SurfacePass::make() {
    constexpr const char *kValue = "#define VALUE\n", *kBorder = "#define BORDER\n",
                         *kBorderValue = "#define BORDER\n#define VALUE\n";
    return make_programs({{&plain_.triangles, "geometry.vert", "geometry.frag"},
                          {&plain_.borders, "geometry.vert", "geometry.frag", kBorder, "border.geom"},
                          {&valued_.triangles, "geometry.vert", "geometry.frag", kValue},
                          {&valued_.borders, "geometry.vert", "geometry.frag", kBorderValue, "border.geom"}});
}

// Draws triangles that a border divides inside pixels. From 4.0 on a shader selects samples; before, each sample is
// drawn separately.
void SurfacePass::draw_by_sample(const Program& borders, const ViewSetup& view, const SampleTarget& to,
                                 const std::function<void()>& draw) {
    if (gl_has_lists()) return draw();
    glEnable(GL_SAMPLE_MASK);
    for (std::size_t s = 0; s < static_cast<std::size_t>(view.samples); ++s) {
        glSampleMaski(0, GLbitfield{1} << s);
        glProgramUniform2f(borders, kUniformSamplePosition, to.positions.at(s).x, to.positions.at(s).y);
        draw();
    }
    glSampleMaski(0, ~GLbitfield{0});
    glDisable(GL_SAMPLE_MASK);
}

InParts<std::uint64_t> SurfacePass::draw(const Subject& subject, const ViewSetup& view, const SampleTarget& to) const {
    const GpuMesh& mesh = subject.mesh;
    const glm::dmat4 to_clip = subject.mesh_to_clip(view);
    const bool any_glass = subject.has_glass_vessels();
    const Programs& programs = subject.has_values() ? valued_ : plain_;
    const OpenAndClosed both = any_glass ? open_and_closed(*mesh.shown(), subject.scene.branch_layers().all)
                                         : OpenAndClosed{subject.layers, {}};
    const std::array<GpuMesh::Ranges, 3> chosen{mesh.choose(both.closed, Layer::kOpaque, to_clip),
                                                any_glass ? mesh.choose(both.open, Layer::kOpaque, to_clip)
                                                          : GpuMesh::Ranges(),
                                                mesh.choose_borders(subject.layers, Layer::kOpaque, to_clip)};
    std::uint64_t triangles = 0;
    for (const GpuMesh::Ranges& ranges : chosen) {
        const bool closed = &ranges == &chosen.front(), borders = &ranges == &chosen.back();
        for (std::size_t part = 0; part < ranges.parts(); ++part) {
            draw_opaque_into(to, subject.has_values());
            use_for_vessels(borders ? programs.borders : programs.triangles, subject, view);
            use_no_caps();
            const bool inside = subject.frame.camera.inside;
            glUniform1i(kUniformInside, inside ? 1 : 0);
            if (inside || (any_glass && !closed)) glDisable(GL_CULL_FACE);
            const auto draw_part = [&] { mesh.draw_part(ranges, part); };
            borders ? draw_by_sample(programs.borders, view, to, draw_part) : draw_part();
            end_borders();
            co_await kPartEnds;
        }
        triangles += ranges.triangles();
    }
    co_return triangles;
}

InParts<std::uint64_t> SurfacePass::draw_caps(const Subject& subject, const ViewSetup& view,
                                              const SampleTarget& to) const {
    const GpuMesh& mesh = subject.mesh;
    const glm::dmat4 to_clip = subject.mesh_to_clip(view);
    const Programs& programs = subject.has_values() ? valued_ : plain_;
    const std::array<GpuMesh::Ranges, 2> chosen{mesh.choose(subject.layers, Layer::kOpaque, to_clip),
                                                mesh.choose_borders(subject.layers, Layer::kOpaque, to_clip)};
    clear_caps(to);
    std::uint64_t triangles = 0;
    for (const CapStep step : {CapStep::kCount, CapStep::kMark})
        for (const GpuMesh::Ranges& ranges : chosen) {
            const bool borders = &ranges == &chosen.back();
            for (std::size_t part = 0; part < ranges.parts(); ++part) {
                begin_caps(to, step, subject.has_values());
                use_for_vessels(borders ? programs.borders : programs.triangles, subject, view);
                use_cap_normal(subject.frame, view);
                const auto draw_part = [&] { mesh.draw_part(ranges, part); };
                borders ? draw_by_sample(programs.borders, view, to, draw_part) : draw_part();
                end_borders();
                end_caps();
                co_await kPartEnds;
            }
            triangles += ranges.triangles();
        }
    co_return triangles;
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

InParts<std::uint64_t> CenterlinePass::draw_lines(const Subject& subject, const ViewSetup& view,
                                                  const SampleTarget& to) const {
    GpuLines& lines = subject.scene.lines();
    const glm::mat4 to_clip(view.clip_from(lines.shown()->origin));
    const float pixels = kCenterlineWidth * view.pixels_a_point(subject.frame);
    const GpuLines::Stretches seen =
        lines.stretches(subject.frame.camera, subject.frame.size, subject.layers, {Layer::kGlass});
    for (std::size_t part = 0; part < seen.parts(); ++part) {
        draw_opaque_into(to);
        glDisable(GL_CULL_FACE);
        glUseProgram(lines_);
        glBindVertexArray(no_vertices_);
        glUniformMatrix4fv(kUniformToClip, 1, GL_FALSE, glm::value_ptr(to_clip));
        glUniform3f(kUniformHalfPicture, 0.5F * float(view.size.x), 0.5F * float(view.size.y),
                    0.5F * std::max(pixels, 1.0F));
        begin_cut(subject.frame, lines.shown()->origin);
        lines.draw_part(seen, part);
        end_cut();
        if (part + 1 < seen.parts()) co_await kPartEnds;
    }
    co_return seen.segments();
}

Result<void> ContextPass::make() {
    return make_programs(
        {{&opaque_, "geometry.vert", "context.frag", "#define CONTEXT\n"},
         {&clear_, "geometry.vert", "context.frag", "#define CONTEXT\n#define TRANSPARENT\n"},
         {&lines_, "geometry.vert", "context.frag", "#define CONTEXT\n#define TRANSPARENT\n#define LINES\n"}});
}

InParts<std::uint64_t> ContextPass::draw_opaque(const Subject& subject, const ViewSetup& view,
                                                const SampleTarget& to) const {
    std::uint64_t triangles = 0;
    for (std::size_t i = 0; i < subject.frame.context.size(); ++i) {
        const ContextMesh& mesh = subject.frame.context[i];
        const Shape* shape = subject.scene.shapes().of(mesh, subject.quick());
        if (shape == nullptr || !mesh.solid()) continue;
        for (std::size_t part = 0; part < shape->parts(); ++part) {
            draw_opaque_into(to);
            glUseProgram(opaque_);
            const glm::dvec3 centre = shape->bounds().centre();
            use_for_shape(*shape, number_of(i), view.clip_from(centre), view);
            begin_cut(subject.frame, centre);
            use_no_caps();
            triangles += shape->draw_part(part);
            end_cut();
            co_await kPartEnds;
        }
    }
    co_return triangles;
}

InParts<std::uint64_t> ContextPass::draw_caps(const Subject& subject, const ViewSetup& view,
                                              const SampleTarget& to) const {
    std::uint64_t triangles = 0;
    for (std::size_t i = 0; i < subject.frame.context.size(); ++i) {
        const ContextMesh& mesh = subject.frame.context[i];
        const Shape* shape = subject.scene.shapes().of(mesh, subject.quick());
        if (shape == nullptr || !mesh.solid() || !shape->closed()) continue;
        const glm::dvec3 centre = shape->bounds().centre();
        clear_caps(to);
        for (const CapStep step : {CapStep::kCount, CapStep::kMark})
            for (std::size_t part = 0; part < shape->parts(); ++part) {
                begin_caps(to, step);
                glUseProgram(opaque_);
                use_for_shape(*shape, number_of(i), view.clip_from(centre), view);
                begin_cut(subject.frame, centre);
                use_cap_normal(subject.frame, view);
                triangles += shape->draw_part(part);
                end_cut();
                end_caps();
                co_await kPartEnds;
            }
    }
    co_return triangles;
}

InParts<std::uint64_t> ContextPass::draw_clear(const Subject& subject, const ViewSetup& view, Clear what, Begin begin,
                                               Prepare prepare) const {
    std::vector<ShapeDraw> draws;
    if (what == Clear::kAll) add_context(subject, view, draws);
    add_lesions(subject, view, draws);
    std::uint64_t triangles = 0;
    for (const ShapeDraw& draw : draws) {
        const Program& program = draw.shape->lines() ? lines_ : clear_;
        for (std::size_t part = 0; part < draw.shape->parts(); ++part) {
            begin();
            glUseProgram(program);
            prepare(program);
            if (draw.shape->lines())
                glUniform1f(kUniformHalfWidth, 0.5F * kContextLineWidth * view.pixels_a_point(subject.frame));
            use_for_shape(*draw.shape, draw.number, draw.to_clip, view);
            begin_cut(subject.frame, draw.origin, draw.scale);
            if (subject.frame.cut_away) glDisable(GL_CULL_FACE); // the cut shows the inside
            triangles += draw.shape->draw_part(part);
            end_cut();
            glEnable(GL_CULL_FACE);
            co_await kPartEnds;
        }
    }
    co_return triangles;
}

void ContextPass::add_context(const Subject& subject, const ViewSetup& view, std::vector<ShapeDraw>& to) const {
    const Frame& frame = subject.frame;
    const double nearer = kContextLinesNearer * double(view.block.pixel_to_eye.z);
    const glm::dmat4 off = frame.camera.orthographic ? glm::translate(glm::dmat4(1.0), {0.0, 0.0, nearer})
                                                     : glm::scale(glm::dmat4(1.0), glm::dvec3(1.0 - nearer));
    const glm::dmat4 lines_to_clip = view.projection * off * view_matrix(frame.camera);
    for (std::size_t i = 0; i < frame.context.size(); ++i) {
        const Shape* shape = subject.scene.shapes().of(frame.context[i], subject.quick());
        if (shape == nullptr || !frame.context[i].clear()) continue;
        const glm::dmat4& to_clip = shape->lines() ? lines_to_clip : view.to_clip;
        const glm::dvec3 centre = shape->bounds().centre();
        to.push_back({shape, number_of(i), glm::translate(to_clip, centre), centre});
    }
}

void ContextPass::add_lesions(const Subject& subject, const ViewSetup& view, std::vector<ShapeDraw>& to) const {
    if (!subject.has_lesions()) return;
    const Lesions& lesions = subject.frame.lesions;
    std::size_t index = 0;
    const auto add = [&](const Shape* shape, const glm::dvec3& centre, double scale) {
        const bool drawn = shape != nullptr && lesions.look(index).opacity > 0.0F;
        const GLuint number = record::kLesionFragment | number_of(index++);
        if (drawn) to.push_back({shape, number, glm::scale(view.clip_from(centre), glm::dvec3(scale)), centre, scale});
    };
    for (const glm::dvec4& sphere : lesions.spheres) add(subject.scene.shapes().ball(), glm::dvec3(sphere), sphere.w);
    for (const auto& lesion : lesions.meshes) {
        const Shape* shape = subject.scene.shapes().of(lesion);
        add(shape, shape != nullptr ? shape->bounds().centre() : glm::dvec3(0.0), 1.0);
    }
}

} // namespace ramus::render
