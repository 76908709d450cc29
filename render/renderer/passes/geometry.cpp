#include "render/renderer/renderer_impl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>

namespace ramus::render {

namespace {

constexpr int kTaps = 20, kInteractiveTaps = 7;

// Of the views that a fine picture is the mean of, in sixteenths of a pixel. Found by search: with samples in the
// places that four have by convention, these tell best how much of a pixel lies beside a line, or between two.
constexpr std::array<glm::vec2, kFineViews> kShifts{{{0.0F, 0.0F}, {-3.0F, -1.0F}, {1.0F, 3.0F}, {2.0F, -2.0F}}};
constexpr std::uint64_t kMostMovingTriangles = 40'000; // more are drawn as cones while the view moves
constexpr double kOcclusionShare =
    0.055; // of the picture's height: the reach of the occlusion (tuned by eye on brain and airway trees)

} // namespace

// The near and far planes enclose all of `box`, and lesions and context beside it. Reversed depth, 1 at the near plane
// and 0 at the far one: float depth is then as fine far away as near by.
glm::dmat4 Renderer::Impl::look_at(const Frame& frame, const Box& box) {
    const Camera& camera = frame.camera;
    const CameraAxes axes = axes_of(camera);
    const double middle = glm::dot(box.centre() - camera.position, axes.forward), radius = 1.001 * box.radius();
    double far = middle + radius, near = middle - radius;
    const auto include = [&](const glm::dvec3& centre, double reach) {
        const double along = glm::dot(centre - camera.position, axes.forward);
        near = std::min(near, along - 1.001 * reach);
        far = std::max(far, along + 1.001 * reach);
    };
    for (const glm::dvec4& sphere : frame.lesions.spheres) include(glm::dvec3(sphere), sphere.w);
    for (const auto& lesion : frame.lesions.meshes)
        if (const Shape* shape = shapes_.of(lesion); shape != nullptr && !shape->bounds().empty())
            include(shape->bounds().centre(), shape->bounds().radius());
    if (const Box around = shapes_.bounds(frame.context); !around.empty()) include(around.centre(), around.radius());
    if (!camera.orthographic) {
        far = std::max(far, 1e-3 * radius);
        near = std::max(near, 1e-4 * far);
    }
    glm::dmat4 projection = projection_matrix(camera, frame.size, near, far);
    projection[2][2] = camera.orthographic ? 1.0 / (far - near) : near / (far - near);
    projection[3][2] = camera.orthographic ? far / (far - near) : near * far / (far - near);

    const glm::vec2 size(inner_), shift = kShifts.at(static_cast<std::size_t>(shift_)) / 16.0F;
    projection = glm::translate(glm::dmat4(1.0), glm::dvec3(2.0F * shift / size, 0.0)) * projection;
    projection_ = projection;

    const bool flat = camera.orthographic;
    const double mm_at_unit_depth =
        flat ? mm_per_pixel(camera, inner_) : 2.0 * std::tan(glm::radians(0.5 * camera.view_angle)) / size.y;
    const double reach = std::max(4.0, kOcclusionShare * size.y);
    // The depth cue spans the box's own depth.
    const glm::dvec3 half = 0.5 * (box.empty() ? glm::dvec3(1.0) : box.upper - box.lower);
    const double depth = std::max(glm::dot(half, glm::abs(axes.forward)), 1e-3 * radius);
    view_.clip_to_eye = flat ? glm::vec4(0.0F, -(far - near), far / (far - near), 0.0F)
                             : glm::vec4(0.0F, projection[2][2], projection[3][2], 0.0F);
    view_.pixel_to_eye = {0.5F * size.x + shift.x, 0.5F * size.y + shift.y, mm_at_unit_depth, 0.0F};
    view_.depth_range = {middle - depth, middle + depth, reach, reach * mm_at_unit_depth};
    view_.picture = {size.x, size.y, view_.picture.z, flat ? 1.0F : 0.0F};
    glNamedBufferSubData(view_block_, 0, sizeof view_, &view_);
    glBindBufferBase(GL_UNIFORM_BUFFER, kBlockView, view_block_);
    return projection * view_matrix(camera);
}

void Renderer::Impl::send_layers(const PagedMesh& mesh, const std::vector<Layer>& layers) {
    layers_ = layers;
    layers_.resize(static_cast<std::size_t>(mesh.branch_count()), Layer::kOpaque);
    if (layers_.size() > layer_capacity_) {
        layer_capacity_ = layers_.size();
        make_buffer_texture(layer_buffer_, layer_texture_, GL_R8UI, nullptr, layer_capacity_);
    }
    glNamedBufferSubData(layer_buffer_, 0, static_cast<GLsizeiptr>(layers_.size()), layers_.data());
}

// Of closed surfaces, by reversed depth.
void Renderer::Impl::take_front_faces(bool write_depth) const {
    glEnable(GL_DEPTH_TEST);
    glDepthMask(write_depth ? GL_TRUE : GL_FALSE);
    glDepthFunc(GL_GREATER);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    glEnable(GL_MULTISAMPLE);
}

// Ids and depths of what is bound: nothing is there.
void Renderer::Impl::clear_samples() const {
    const std::array<GLuint, 4> nothing{};
    const GLfloat farthest = 0.0F;
    glClearBufferuiv(GL_COLOR, 0, nothing.data());
    glClearBufferfv(GL_DEPTH, 0, &farthest);
}

// Each part begins with all the state that it needs: others may draw in between.
InParts<Result<std::uint64_t>> Renderer::Impl::draw_geometry(const Frame& frame, const GpuMesh* mesh,
                                                             const std::vector<Layer>& layers) {
    const glm::dmat4 to_clip =
        look_at(frame, mesh != nullptr ? mesh->shown()->bounds() : shapes_.bounds(frame.context));
    const auto relative_to = [&](const glm::dvec3& origin) { return glm::translate(to_clip, origin); };

    const bool glass_vessels = mesh != nullptr && std::ranges::find(layers, Layer::kGlass) != layers.end();
    has_glass_ = glass_vessels || has_lesions(frame) || std::ranges::any_of(frame.context, &ContextMesh::clear);
    if (mesh != nullptr) mesh_to_clip_ = relative_to(mesh->shown()->origin());
    if (mesh != nullptr) send_layers(*mesh->shown(), layers);
    take_front_faces(true);
    std::uint64_t triangles = 0;
    glBindFramebuffer(GL_FRAMEBUFFER, geometry_target_);
    clear_samples();
    if (mesh != nullptr) {
        const bool as_cones = moving_ && !glass_vessels && lines_.shown() != nullptr &&
                              mesh->triangles_in_picture(mesh_to_clip_) > kMostMovingTriangles;
        if (as_cones) {
            triangles += draw_cones(frame, layers);
        } else {
            InParts<std::uint64_t> surface = draw_surface(frame, *mesh, layers);
            while (surface.resume()) co_await kPartEnds;
            triangles += surface.result();
        }
    }
    glBindFramebuffer(GL_FRAMEBUFFER, geometry_target_);
    take_front_faces(true);
    triangles += draw_solid_context(frame);
    glDisable(GL_CULL_FACE);
    // Seen through the glass, and hidden by what is opaque.
    if (has_glass_ && lines_.shown() != nullptr) {
        glUseProgram(centerline_);
        glBindVertexArray(no_vertices_);
        glBindTextureUnit(kUnitLinePoints, lines_.textures().points);
        glBindTextureUnit(kUnitLineDetails, lines_.textures().details);
        glUniformMatrix4fv(kUniformToClip, 1, GL_FALSE, glm::value_ptr(glm::mat4(relative_to(lines_.shown()->origin))));
        const float pixels = kCenterlineWidth * frame.pixel_ratio * float(inner_.y) / float(size_.y);
        glUniform3f(kUniformHalfPicture, 0.5F * float(inner_.x), 0.5F * float(inner_.y), 0.5F * std::max(pixels, 1.0F));
        lines_.draw(layers, Layer::kGlass);
    }
    if (!has_glass_) {
        co_await kPartEnds;
        resolve({0, inner_.y});
    } else {
        InParts<Result<std::uint64_t>> glass = draw_glass(frame, mesh != nullptr ? *mesh : no_mesh_);
        while (glass.resume()) co_await kPartEnds;
        if (!glass.result()) co_return glass.result();
        triangles += *glass.result();
    }
    co_await kPartEnds;
    note_gl_errors("drawing surfaces");
    if (frame.appearance.occlusion > 0.0F) draw_occlusion(frame);
    note_gl_errors("the occlusion");
    co_return triangles;
}

// Mesa holds on to the program that comes right after one with a geometry shader, and would keep it for good.
void Renderer::Impl::end_borders() { glUseProgram(0); }

// Where glass begins, an opaque vessel is open: its inside is drawn as the lid that closes it.
InParts<std::uint64_t> Renderer::Impl::draw_surface(const Frame& frame, const GpuMesh& mesh,
                                                    const std::vector<Layer>& layers) const {
    const auto use = [&](const Program& program) {
        glBindFramebuffer(GL_FRAMEBUFFER, geometry_target_);
        take_front_faces(true);
        glUseProgram(program);
        glUniformMatrix4fv(kUniformToClip, 1, GL_FALSE, glm::value_ptr(glm::mat4(mesh_to_clip_)));
        glUniformMatrix3fv(kUniformToEye, 1, GL_FALSE, glm::value_ptr(glm::mat3(view_matrix(frame.camera))));
    };
    std::vector<Layer> closed = layers, open;
    const bool any_glass = std::ranges::find(layers, Layer::kGlass) != layers.end();
    if (any_glass) {
        closed = layers_;
        open.assign(layers_.size(), Layer::kNone);
        for (const auto& page : mesh.shown()->triangle_pages())
            for (const auto& pair : page->borders)
                for (const int i : {0, 1}) {
                    const auto one = static_cast<std::size_t>(pair.at(static_cast<std::size_t>(i)));
                    const auto other = static_cast<std::size_t>(pair.at(static_cast<std::size_t>(1 - i)));
                    if (layers_[one] != Layer::kOpaque || layers_[other] != Layer::kGlass) continue;
                    closed[one] = Layer::kNone;
                    open[one] = Layer::kOpaque;
                }
    }
    std::uint64_t triangles = 0;
    for (const bool both_sides : {false, true}) {
        if (both_sides && !any_glass) continue;
        const GpuMesh::Ranges ranges = mesh.choose(both_sides ? open : closed, Layer::kOpaque, mesh_to_clip_);
        for (std::size_t part = 0; part < ranges.parts(); ++part) {
            use(geometry_);
            if (both_sides) glDisable(GL_CULL_FACE);
            mesh.draw_part(ranges, part);
            co_await kPartEnds;
        }
        triangles += ranges.triangles();
    }
    const GpuMesh::Ranges borders = mesh.choose_borders(layers, Layer::kOpaque, mesh_to_clip_);
    for (std::size_t part = 0; part < borders.parts(); ++part) {
        use(border_);
        if (any_glass) glDisable(GL_CULL_FACE);
        glBindTextureUnit(kUnitLayers, layer_texture_);
        draw_by_sample(border_, [&] { mesh.draw_part(borders, part); });
        end_borders();
        co_await kPartEnds;
    }
    co_return triangles + borders.triangles();
}

// What moves fast enough that nobody sees the difference: a rectangle a segment takes a software rasteriser a tenth of
// the time that its triangles do.
std::uint64_t Renderer::Impl::draw_cones(const Frame& frame, const std::vector<Layer>& layers) {
    lines_.thin();
    const glm::dmat4 to_eye = eye_matrix(frame.camera);
    const glm::dmat4 projection = projection_matrix(frame.camera, frame.size, 1.0, 2.0);
    glUseProgram(cone_);
    glBindVertexArray(no_vertices_);
    glBindTextureUnit(kUnitLinePoints, lines_.thinned().points);
    glBindTextureUnit(kUnitLineDetails, lines_.thinned().details);
    glUniformMatrix4fv(kUniformLinesToEye, 1, GL_FALSE,
                       glm::value_ptr(glm::mat4(glm::translate(to_eye, lines_.shown()->origin))));
    glUniform2f(kUniformZoom, static_cast<float>(projection[0][0]), static_cast<float>(projection[1][1]));
    glDisable(GL_CULL_FACE);
    const std::uint64_t segments = lines_.draw_thinned(layers, Layer::kOpaque);
    glEnable(GL_CULL_FACE);
    return 2 * segments;
}

void Renderer::Impl::resolve(Band band) { resolve_by(has_glass_ ? resolve_glass_ : resolve_, band); }

void Renderer::Impl::resolve_by(const Program& program, Band band) {
    glBindFramebuffer(GL_FRAMEBUFFER, resolve_target_);
    glDepthFunc(GL_ALWAYS); // writes the covered pixels' depth
    glEnable(GL_DEPTH_TEST);
    glBindTextureUnit(kUnitSurface, surface_);
    glBindTextureUnit(kUnitDepth, depth_);
    if (has_glass_ && gl_has_lists()) bind_panes(program, band);
    if (has_glass_ && !gl_has_lists()) {
        glBindTextureUnit(kUnitFirstFragments, layer_panes_);
        glBindTextureUnit(kUnitFirstDepths, layer_depths_[0]);
        glBindTextureUnit(kUnitContextDepths, layer_depths_[1]);
    }
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, band.first, inner_.x, band.count);
    fullscreen(program);
    glDisable(GL_SCISSOR_TEST);
    if (has_glass_ && gl_has_lists()) glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void Renderer::Impl::draw_occlusion(const Frame& frame) {
    glBindTextureUnit(kUnitIdNormal, id_normal_);
    glBindTextureUnit(kUnitOpaqueDepth, opaque_depth_);
    glBindFramebuffer(GL_FRAMEBUFFER, occlusion_target_);
    glProgramUniform1i(occlude_, kUniformTaps, frame.quality == Quality::kFull ? kTaps : kInteractiveTaps);
    glProgramUniform1f(occlude_, kUniformTurned, static_cast<float>(shift_) / float{kFineViews});
    fullscreen(occlude_, Pixels::kCovered);
    for (const bool across : {true, false}) {
        glBindTextureUnit(kUnitOcclusion, across ? occlusion_ : half_blurred_);
        glBindFramebuffer(GL_FRAMEBUFFER, across ? half_blur_target_ : blur_target_);
        glProgramUniform2i(blur_, kUniformAlong, across ? 1 : 0, across ? 0 : 1);
        fullscreen(blur_, Pixels::kCovered);
    }
}

} // namespace ramus::render
