#include "render/caster/thick_vessels.h"

#include "render/caster/triangles.h"
#include "render/scene/bounds.h"
#include "render/scene/record_flags.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numeric>
#include <tbb/parallel_for.h>

namespace ramus::render::caster {

namespace {

// Vessels of this half width in pixels or more are drawn as triangles; the other constant limits their number, before
// dropping back faces. Tuned on the kidney at 1280 x 800: thinner vessels differ by less than a pixel, and more
// triangles take longer than the cones that they replace.
constexpr float kThick = 10.0F;
constexpr std::size_t kMostTriangles = 250'000;

using Pages = std::vector<const TrianglePage*>;

Pages pages_in_picture(const Surface& surface) {
    Pages found;
    for (const auto& page : surface.mesh.triangle_pages())
        if (page->count > 0 && in_picture(page->lower, page->upper, surface.to_clip)) found.push_back(page.get());
    return found;
}

// By branch: largest half width in the picture; 0: its triangles cannot replace its cones.
std::vector<float> widths_in_picture(const ConeList& list, std::size_t branches) {
    std::vector<float> widths(branches, 0.0F);
    for (std::size_t i = 0; i < list.cones.size(); ++i) {
        const RoundCone& cone = list.cones[i];
        if (list.kinds[i] != ConeList::Kind::kOpaque || (cone.id & record::kLine) != 0) continue;
        const std::size_t branch = cone.id - 1;
        if (branch >= branches || widths[branch] < 0.0F) continue;
        widths[branch] = cone.near_other_layer ? -1.0F : std::max(widths[branch], cone.image_half_width);
    }
    return widths;
}

// By branch, whether its triangles are drawn.
std::vector<std::uint8_t> choose(const Pages& pages, const std::vector<float>& widths) {
    std::vector<std::size_t> counts(widths.size(), 0);
    for (const TrianglePage* page : pages)
        for (const TrianglePage::Run& run : page->runs) counts[std::size_t(run.branch)] += run.count;
    std::vector<std::uint32_t> thick;
    for (std::uint32_t branch = 0; branch < widths.size(); ++branch)
        if (widths[branch] >= kThick && counts[branch] > 0) thick.push_back(branch);
    std::ranges::stable_sort(thick, std::greater<>(), [&](std::uint32_t branch) { return widths[branch]; });
    std::vector<std::uint8_t> chosen(widths.size(), 0);
    std::size_t sum = 0;
    for (const std::uint32_t branch : thick) {
        sum += counts[branch];
        if (sum > kMostTriangles) break;
        chosen[branch] = 1;
    }
    return chosen;
}

class PageProjection {
public:
    PageProjection(const Surface& surface, const View& view)
        : surface_(surface), view_(view), to_eye_(glm::translate(surface.to_eye, surface.mesh.origin())),
          turn_(surface.to_eye), eye_(glm::inverse(to_eye_)[3]), forward_(glm::transpose(turn_)[2]) {}

    void add(const glm::uvec3& t, std::uint32_t branch, std::vector<Triangle>& to) const {
        constexpr TriangleKind kSurface{true, 0.0F};
        if (faces_away(t)) return; // half of them; this test is cheaper than the rest
        project_triangle({corner(t.x), corner(t.y), corner(t.z)}, kSurface, branch + 1, view_, to);
    }
    [[nodiscard]] const GpuVertex& vertex(std::uint32_t number) const {
        return surface_.mesh.vertex_pages()[number / VertexPage::kSize]->vertices[number % VertexPage::kSize];
    }

private:
    [[nodiscard]] bool faces_away(const glm::uvec3& t) const {
        const glm::vec3 &a = vertex(t.x).position, &b = vertex(t.y).position, &c = vertex(t.z).position;
        return glm::dot(glm::cross(b - a, c - a), view_.flat ? forward_ : a - eye_) > 0.0F;
    }
    [[nodiscard]] Corner corner(std::uint32_t number) const {
        constexpr float kUnit = 1.0F / 32767.0F;
        const GpuVertex& v = vertex(number);
        const glm::vec3 normal = turn_ * (kUnit * glm::vec3(v.normal[0], v.normal[1], v.normal[2]));
        return {glm::vec3(to_eye_ * glm::vec4(v.position, 1.0F)), {normal.x, normal.y, -normal.z}};
    }

    const Surface& surface_;
    const View& view_;
    glm::mat4 to_eye_;
    glm::mat3 turn_;
    glm::vec3 eye_, forward_; // position and direction of the eye, in the mesh's space
};

// At borders a triangle belongs to the branch of most of its corners, among the branches that are drawn.
void append(const TrianglePage& page, const std::vector<std::uint8_t>& chosen, const PageProjection& projection,
            std::vector<Triangle>& to) {
    for (const TrianglePage::Run& run : page.runs)
        for (std::uint32_t i = run.first; chosen[std::size_t(run.branch)] != 0 && i < run.first + run.count; ++i)
            projection.add(page.triangles[i], std::uint32_t(run.branch), to);
    const bool any = std::ranges::any_of(page.borders, [&](const auto& pair) {
        return chosen[std::size_t(pair[0])] != 0 || chosen[std::size_t(pair[1])] != 0;
    });
    for (std::uint32_t i = page.first_border; any && i < page.count; ++i) {
        std::array<std::int32_t, 3> branches{};
        for (int k = 0; k < 3; ++k) branches[std::size_t(k)] = projection.vertex(page.triangles[i][k]).branch;
        std::int32_t owner = -1;
        std::ptrdiff_t most = 0;
        for (const std::int32_t branch : branches) {
            const std::ptrdiff_t corners = std::ranges::count(branches, branch);
            if (chosen[std::size_t(branch)] != 0 && corners > most) owner = branch, most = corners;
        }
        if (owner >= 0) projection.add(page.triangles[i], std::uint32_t(owner), to);
    }
}

} // namespace

void draw_thick_vessels(const Surface& surface, const View& view, ConeList& list, std::vector<Triangle>& triangles) {
    const auto branches = static_cast<std::size_t>(surface.mesh.branch_count());
    const std::vector<float> widths = widths_in_picture(list, branches);
    if (std::ranges::none_of(widths, [](float width) { return width >= kThick; })) return;
    const Pages pages = pages_in_picture(surface);
    const std::vector<std::uint8_t> chosen = choose(pages, widths);
    const PageProjection projection(surface, view);
    std::vector<std::vector<Triangle>> parts(pages.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pages.size(), 16), [&](const auto& range) {
        for (std::size_t page = range.begin(); page < range.end(); ++page)
            append(*pages[page], chosen, projection, parts[page]);
    });
    for (const std::vector<Triangle>& part : parts) triangles.insert(triangles.end(), part.begin(), part.end());
    for (std::size_t i = 0; i < list.cones.size(); ++i) {
        const RoundCone& cone = list.cones[i];
        if (list.kinds[i] != ConeList::Kind::kOpaque || (cone.id & record::kLine) != 0) continue;
        if (cone.id - 1 < branches && chosen[cone.id - 1] != 0) list.kinds[i] = ConeList::Kind::kNone;
    }
}

} // namespace ramus::render::caster
