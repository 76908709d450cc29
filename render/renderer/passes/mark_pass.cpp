#include "render/renderer/passes/overlay_passes.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <vector>

namespace ramus::render {

namespace {

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

// The stripe of a run of points that are before the eye.
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
        // The mitre; a sharp turn is cut off.
        const glm::dvec2 offset = squared > 0.25 ? 2.0 * sum / squared : b;
        const double depth = flat ? run[i].depth : 1.0 / run[i].depth;
        const auto vertex = [&](double at) {
            return MarkVertex{glm::vec2(run[i].pixel + at * offset), {at, half, depth}, line.colour};
        };
        sides.push_back({vertex(-reach), vertex(reach)});
    }
    for (std::size_t i = 0; i + 1 < sides.size(); ++i)
        for (const MarkVertex& vertex :
             {sides[i][0], sides[i][1], sides[i + 1][1], sides[i][0], sides[i + 1][1], sides[i + 1][0]})
            out.push_back(vertex);
}

// In as many runs as there are between points that lie behind the eye.
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

Result<void> MarkPass::make() { return make_programs({{&program_, "mark.vert", "mark.frag"}}); }

void MarkPass::draw(const Frame& frame, const ViewSetup& view, GLuint opaque_depth) const {
    std::vector<MarkVertex> vertices;
    for (const MarkLine& line : frame.lines) lay_out(line, frame, vertices);
    if (vertices.empty()) return;
    const Buffer buffer = make_buffer(vertices.size() * sizeof vertices[0], vertices.data());
    const VertexArray array = make_vertex_array();
    glVertexArrayVertexBuffer(array, 0, buffer, 0, sizeof(MarkVertex));
    glVertexArrayAttribFormat(array, kAttributePixel, 2, GL_FLOAT, GL_FALSE, offsetof(MarkVertex, pixel));
    glVertexArrayAttribFormat(array, kAttributeStripe, 3, GL_FLOAT, GL_FALSE, offsetof(MarkVertex, stripe));
    glVertexArrayAttribFormat(array, kAttributeInk, 3, GL_FLOAT, GL_FALSE, offsetof(MarkVertex, srgb));
    for (const GLuint i : {kAttributePixel, kAttributeStripe, kAttributeInk}) {
        glVertexArrayAttribBinding(array, i, 0);
        glEnableVertexArrayAttrib(array, i);
    }
    const glm::vec2 to_inner = view.to_inner();
    glBindVertexArray(array);
    glUseProgram(program_);
    glUniform2f(kUniformSize, float(view.picture.x), float(view.picture.y));
    glUniform2f(kUniformToInner, to_inner.x, to_inner.y);
    glBindTextureUnit(kUnitOpaqueDepth, opaque_depth);
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()));
}

} // namespace ramus::render
