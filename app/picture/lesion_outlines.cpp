#include "app/picture/lesion_outlines.h"

#include "app/assets/assets.h"
#include "app/assets/plan.h"
#include "core/base/bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace ramus::app {

namespace {

// Cells covered by the mesh in the picture, with a rim of empty cells.
struct CoveredCells {
    glm::dvec2 corner{0.0};
    double step = 1.0; // pixels
    glm::ivec2 size{0};
    std::vector<char> covered;

    [[nodiscard]] bool at(int x, int y) const {
        return covered[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(x)] !=
               0;
    }
};

double side_of(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

void cover(CoveredCells& cells, const std::array<glm::dvec2, 3>& corners) {
    const glm::dvec2 least = glm::min(corners[0], glm::min(corners[1], corners[2]));
    const glm::dvec2 most = glm::max(corners[0], glm::max(corners[1], corners[2]));
    const glm::ivec2 first = glm::max(glm::ivec2(glm::ceil(least)), 0);
    const glm::ivec2 last = glm::min(glm::ivec2(glm::floor(most)), cells.size - 1);
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            const glm::dvec2 p(x, y);
            const double a = side_of(corners[0], corners[1], p), b = side_of(corners[1], corners[2], p),
                         c = side_of(corners[2], corners[0], p);
            if ((a >= 0.0 && b >= 0.0 && c >= 0.0) || (a <= 0.0 && b <= 0.0 && c <= 0.0))
                cells.covered[static_cast<std::size_t>(y) * static_cast<std::size_t>(cells.size.x) +
                              static_cast<std::size_t>(x)] = 1;
        }
}

// The borders of the covered cells, each a loop of midpoints between a covered and an empty cell, with covered cells on
// the left (marching squares).
std::vector<std::vector<glm::dvec2>> borders(const CoveredCells& cells) {
    using Place = std::pair<int, int>; // doubled, so that midpoints are integers
    std::map<Place, Place> next;
    for (int y = 0; y + 1 < cells.size.y; ++y)
        for (int x = 0; x + 1 < cells.size.x; ++x) {
            const std::array in{cells.at(x, y), cells.at(x + 1, y), cells.at(x + 1, y + 1), cells.at(x, y + 1)};
            const std::array<Place, 4> sides{
                {{2 * x + 1, 2 * y}, {2 * x + 2, 2 * y + 1}, {2 * x + 1, 2 * y + 2}, {2 * x, 2 * y + 1}}};
            // Connects each transition from covered to empty with the next one from empty to covered.
            for (std::size_t k = 0; k < 4; ++k) {
                if (!in[k] || in[(k + 1) % 4]) continue;
                std::size_t to = (k + 1) % 4;
                while (in[to] == in[(to + 1) % 4]) to = (to + 1) % 4;
                next.emplace(sides[k], sides[to]);
            }
        }
    std::vector<std::vector<glm::dvec2>> loops;
    while (!next.empty()) {
        std::vector<glm::dvec2> loop;
        Place at = next.begin()->first;
        for (auto found = next.find(at); found != next.end(); found = next.find(at)) {
            loop.emplace_back(0.5 * at.first, 0.5 * at.second);
            at = found->second;
            next.erase(found);
        }
        loops.push_back(std::move(loop));
    }
    return loops;
}

// Smooths the steps of the cells.
void smooth(std::vector<glm::dvec2>& loop) {
    constexpr int kPasses = 4;
    const std::size_t n = loop.size();
    for (int pass = 0; pass < kPasses; ++pass) {
        std::vector<glm::dvec2> next(n);
        for (std::size_t i = 0; i < n; ++i)
            next[i] = 0.25 * loop[(i + n - 1) % n] + 0.5 * loop[i] + 0.25 * loop[(i + 1) % n];
        loop = std::move(next);
    }
}

// The outline of a sphere; empty from inside.
std::vector<glm::dvec3> outline_of(const glm::dvec4& sphere, const render::Camera& camera) {
    const glm::dvec3 centre(sphere), forward = render::axes_of(camera).forward;
    if (camera.orthographic) return ring_around(centre, forward, sphere.w);
    const glm::dvec3 to_eye = camera.position - centre;
    const double away = glm::length(to_eye), share = sphere.w / away;
    if (!(share < 1.0) || glm::dot(-to_eye, forward) <= sphere.w) return {};
    return ring_around(centre + share * sphere.w * to_eye / away, to_eye / away,
                       sphere.w * std::sqrt(1.0 - share * share));
}

} // namespace

std::vector<std::vector<glm::dvec3>> silhouette(const mesh::TriangleMesh& mesh, const glm::dvec3& middle,
                                                const render::Camera& camera, glm::ivec2 size) {
    const auto there = render::project(camera, size, middle);
    std::vector<glm::dvec2> pixels;
    Bounds<glm::dvec2> box;
    pixels.reserve(mesh.positions.size());
    for (const glm::vec3& position : mesh.positions) {
        const auto at = render::project(camera, size, glm::dvec3(position));
        if (!there || !at) return {};
        pixels.emplace_back(*at);
        box.hold(pixels.back());
    }
    if (pixels.empty()) return {};
    constexpr double kCells = 100.0;
    CoveredCells cells;
    const glm::dvec2 extent = box.size();
    cells.step = std::max(1.0, std::max(extent.x, extent.y) / kCells);
    cells.corner = box.least - 1.5 * cells.step;
    cells.size = glm::ivec2(glm::ceil(extent / cells.step)) + 4;
    cells.covered.resize(static_cast<std::size_t>(cells.size.x) * static_cast<std::size_t>(cells.size.y));
    for (glm::dvec2& pixel : pixels) pixel = (pixel - cells.corner) / cells.step;
    for (const glm::uvec3& t : mesh.triangles) cover(cells, {pixels[t.x], pixels[t.y], pixels[t.z]});
    std::vector<std::vector<glm::dvec3>> lines;
    for (std::vector<glm::dvec2>& loop : borders(cells)) {
        smooth(loop);
        std::vector<glm::dvec3> line;
        for (const glm::dvec2& at : loop)
            line.push_back(render::unproject(camera, size, cells.corner + cells.step * at, there->z));
        line.push_back(line.front());
        lines.push_back(std::move(line));
    }
    return lines;
}

void outline_lesions(render::Frame& frame, const Assets& assets, const Marks& marks) {
    const auto clear = [](const render::ContextMesh& item) { return item.clear() && !item.wireframe; };
    if (std::ranges::none_of(frame.context, clear)) return;
    const auto draw = [&](std::vector<glm::dvec3> line, std::size_t lesion) {
        const glm::vec3 lighter = glm::min(1.2F * frame.lesions.look(lesion).colour, 1.0F);
        if (!line.empty()) frame.lines.push_back({std::move(line), lighter, 1.8F});
    };
    std::size_t drawn = 0;
    for (const glm::dvec4& sphere : frame.lesions.spheres) {
        if (frame.lesions.look(drawn).opacity > 0.0F) draw(outline_of(sphere, frame.camera), drawn);
        ++drawn;
    }
    if (frame.lesions.meshes.empty()) return;
    for (const Lesion& lesion : marks.lesions) {
        const auto mesh = lesion.visible ? assets.lesion_mesh(lesion) : nullptr;
        if (!mesh) continue;
        const auto& box = mesh->distance->bounds();
        for (auto& line : silhouette(mesh->coarse ? *mesh->coarse : mesh->mesh, 0.5 * (box.least + box.most),
                                     frame.camera, frame.size))
            draw(std::move(line), drawn);
        ++drawn;
    }
}

} // namespace ramus::app
