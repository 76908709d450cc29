#include "render/renderer/passes/overlay_passes.h"

#include "render/renderer/passes/gl_state.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <utility>
#include <vector>

namespace ramus::render {

namespace {

constexpr std::size_t kMostMovingRings = 400; // per size; more delay a software rasteriser, and are drawn at rest
constexpr float kRingWidth = 1.0F;            // points

// Opacity of lines behind a surface (most are inside vessels), and of the far half of a ring.
constexpr float kHiddenLine = 0.55F, kHiddenRing = 0.25F;
constexpr glm::vec3 kLineColour{0.95F, 0.96F, 0.98F}, kRingColour{0.98F, 0.93F, 0.78F};

void set_stripe(const Frame& frame, const ViewSetup& view, float points, const glm::vec4& tint) {
    const float half = 0.5F * std::max(1.0F, points * frame.pixel_ratio);
    glUniform3f(kUniformHalfPicture, 0.5F * float(view.picture.x), 0.5F * float(view.picture.y), half);
    glUniform4f(kUniformTint, tint.x, tint.y, tint.z, tint.w);
}

struct MarkVertex {
    glm::vec2 pixel;
    glm::vec3 stripe, srgb;
};

struct Seen {
    glm::dvec2 pixel; // from the lower left
    double depth;
};

glm::dvec2 across(const glm::dvec2& from, const glm::dvec2& to) {
    const glm::dvec2 way = to - from;
    const double length = glm::length(way);
    return length > 1e-9 ? glm::dvec2(-way.y, way.x) / length : glm::dvec2(0.0);
}

// The stripe of a run of points in front of the eye.
void lay_out_run(const std::vector<Seen>& run, const MarkLine& line, double half, bool flat,
                 std::vector<MarkVertex>& out) {
    if (run.size() < 2) return;
    const double reach = half + 2.0; // with the dark edge
    const bool closed = run.size() > 3 && glm::distance(run.front().pixel, run.back().pixel) < 1e-6;
    std::vector<std::array<MarkVertex, 2>> sides;
    for (std::size_t i = 0; i < run.size(); ++i) {
        const std::size_t last = run.size() - 1;
        const auto before = i > 0 ? i - 1 : closed ? last - 1 : 0;
        const auto after = i < last ? i + 1 : closed ? 1 : last;
        glm::dvec2 a = before == i ? glm::dvec2(0.0) : across(run[before].pixel, run[i].pixel);
        glm::dvec2 b = after == i ? glm::dvec2(0.0) : across(run[i].pixel, run[after].pixel);
        if (glm::dot(a, a) == 0.0) a = b;
        if (glm::dot(b, b) == 0.0) b = a;
        const glm::dvec2 sum = a + b;
        const double squared = glm::dot(sum, sum);
        // A mitre joint; bevelled at sharp turns.
        const glm::dvec2 offset = squared > 0.25 ? 2.0 * sum / squared : b;
        constexpr double kNearest = 0.01; // relative depth below which points count as behind the eye
        const double wall =
            flat ? run[i].depth - line.inside_mm : std::max(run[i].depth - line.inside_mm, kNearest * run[i].depth);
        const double depth = flat ? wall : 1.0 / wall;
        const auto vertex = [&](double at) {
            // A negative width marks outlines of the selection.
            return MarkVertex{
                glm::vec2(run[i].pixel + at * offset), {at, line.of_selection ? -half : half, depth}, line.colour};
        };
        sides.push_back({vertex(-reach), vertex(reach)});
    }
    for (std::size_t i = 0; i + 1 < sides.size(); ++i)
        for (const MarkVertex& vertex :
             {sides[i][0], sides[i][1], sides[i + 1][1], sides[i][0], sides[i + 1][1], sides[i + 1][0]})
            out.push_back(vertex);
}

// Splits the line into runs at points behind the eye.
void lay_out(const MarkLine& line, const Frame& frame, std::vector<MarkVertex>& out) {
    std::vector<Seen> run;
    const double half = 0.5 * std::max(1.0, double(line.width) * double(frame.pixel_ratio));
    const auto end_run = [&] {
        lay_out_run(run, line, half, frame.camera.orthographic, out);
        run.clear();
    };
    for (const glm::dvec3& point : line.points) {
        const auto at = project(frame.camera, frame.size, point);
        if (at)
            run.push_back({{at->x, frame.size.y - at->y}, at->z});
        else
            end_run();
    }
    end_run();
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
    begin_cut(subject.frame, origin);
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
    GpuLines& lines = skeleton.lines();
    const GpuLines::Stretches seen =
        lines.stretches(subject.frame.camera, subject.frame.size, subject.layers, {Layer::kOpaque, Layer::kGlass});
    for (std::size_t part = 0; part < seen.parts(); ++part) lines.draw_part(seen, part);
    end_cut();
}

Result<void> MarkPass::make() { return make_programs({{&program_, "mark.vert", "mark.frag"}}); }

void MarkPass::draw(const Subject& subject, const ViewTargets& targets, GLuint ids, GLuint branches) const {
    const Frame& frame = subject.frame;
    const ViewSetup& view = targets.view;
    std::vector<MarkVertex> vertices;
    for (const MarkLine& line : frame.lines) lay_out(line, frame, vertices);
    if (vertices.empty()) return;
    const Buffer buffer = make_buffer(vertices.size() * sizeof vertices[0], vertices.data());
    const VertexArray array = make_vertex_array();
    glVertexArrayVertexBuffer(array, 0, buffer, 0, sizeof(MarkVertex));
    glVertexArrayAttribFormat(array, kAttributePixel, 2, GL_FLOAT, GL_FALSE, offsetof(MarkVertex, pixel));
    glVertexArrayAttribFormat(array, kAttributeStripe, 3, GL_FLOAT, GL_FALSE, offsetof(MarkVertex, stripe));
    glVertexArrayAttribFormat(array, kAttributeInk, 3, GL_FLOAT, GL_FALSE, offsetof(MarkVertex, srgb));
    use_attributes(array, {kAttributePixel, kAttributeStripe, kAttributeInk});
    const glm::vec2 to_inner = view.to_inner();
    glBindVertexArray(array);
    glUseProgram(program_);
    glUniform2f(kUniformSize, float(view.picture.x), float(view.picture.y));
    glUniform2f(kUniformToInner, to_inner.x, to_inner.y);
    glBindTextureUnit(kUnitOpaqueDepth, targets.seen_depth());
    glBindTextureUnit(kUnitIdNormal, ids);
    glBindTextureUnit(kUnitBranches, branches);
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()));
}

void draw_sprite(const Fullscreen& program, const Image& image, glm::ivec2 at, const Region& region) {
    const glm::ivec2 from = glm::max(at, region.at);
    const glm::ivec2 to = glm::min(at + glm::ivec2(image.width, image.height), region.end());
    if (from.x >= to.x || from.y >= to.y) return;
    const Texture texture = make_texture(GL_RGBA8, image.width, image.height);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage2D(texture, 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
    glEnable(GL_SCISSOR_TEST);
    glScissor(from.x, from.y, to.x - from.x, to.y - from.y);
    glBindTextureUnit(kUnitImage, texture);
    glProgramUniform2i(program, kUniformOrigin, at.x, at.y);
    program.draw();
    glDisable(GL_SCISSOR_TEST);
}

void SpritePass::draw(const Frame& frame, const Region& region) {
    SpriteSource source(frame);
    if (!painted_of_ || *painted_of_ != source) {
        sprites_ = painter_.paint(source);
        painted_of_ = std::move(source);
    }
    for (const auto& [image, corner] : sprites_)
        draw_sprite(program_, image, {corner.x, frame.size.y - corner.y - image.height}, region);
}

} // namespace ramus::render
