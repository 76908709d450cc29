#include "render/scene/near_surface.h"

#include "render/scene/bent_edge.h"
#include "render/scene/near_division.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace ramus::render {

namespace {

// Upper bound of the bend of the page's edges in the picture, pixels.
float most_bend_in_picture(const TrianglePage& page, const NearView& view) {
    const glm::vec3 towards_eye(view.forward.x > 0.0F ? page.lower.x : page.upper.x,
                                view.forward.y > 0.0F ? page.lower.y : page.upper.y,
                                view.forward.z > 0.0F ? page.lower.z : page.upper.z);
    const float depth = glm::dot(towards_eye - view.eye, view.forward);
    return kMostBend * page.longest_edge * view.pixels_at(depth, page.longest_edge);
}

// Visible pages with edges that may look straight; if there are too many, those where it is most visible. Ascending.
std::vector<std::size_t> pages_to_look_at(const PagedMesh& mesh, const NearView& view, float most_off,
                                          std::size_t most_triangles) {
    std::vector<std::pair<float, std::size_t>> found;
    // Slightly more than the picture, so that shifted views show the same.
    constexpr double kWithin = 0.98;
    const glm::dmat4 to_clip = glm::scale(glm::dmat4(1.0), {kWithin, kWithin, 1.0}) * view.to_clip;
    for (std::size_t i = 0; i < mesh.triangle_pages().size(); ++i) {
        const TrianglePage& page = *mesh.triangle_pages()[i];
        if (page.count == 0) continue;
        const float bend = most_bend_in_picture(page, view);
        if (bend > most_off && in_picture(page.lower, page.upper, to_clip)) found.emplace_back(bend, i);
    }
    std::ranges::sort(found, std::greater());
    std::vector<std::size_t> pages;
    std::size_t triangles = 0;
    for (const auto& [bend, page] : found) {
        triangles += mesh.triangle_pages()[page]->count;
        if (triangles > most_triangles) break;
        pages.push_back(page);
    }
    std::ranges::sort(pages);
    return pages;
}

// The pages with an edge to divide; none from afar.
std::vector<std::size_t> pages_to_divide(const PagedMesh& mesh, const std::vector<std::size_t>& pages,
                                         const NearDivision& division) {
    std::vector<std::uint8_t> any(pages.size());
    tbb::parallel_for(std::size_t{0}, pages.size(),
                      [&](std::size_t i) { any[i] = division.concerns(*mesh.triangle_pages()[pages[i]]) ? 1 : 0; });
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < pages.size(); ++i)
        if (any[i] != 0) found.push_back(pages[i]);
    return found;
}

NearSurface in_place_of(const PagedMesh& mesh, const NearDivision& division) {
    NearSurface surface;
    if (division.made.triangles.empty()) return surface;
    surface.replaced.assign(mesh.triangle_pages().size(), 0);
    for (const std::size_t page : division.replaced) surface.replaced[page] = 1;
    PagedMesh paged(division.made, glm::dvec3(0.0));
    surface.mesh =
        std::make_shared<const PagedMesh>(mesh.has_values() ? paged.with_values(division.values) : std::move(paged));
    return surface;
}

} // namespace

NearView near_view(const Camera& camera, const glm::dvec3& origin, const glm::dmat4& to_clip, int height) {
    // In perspective, mm across the line of sight at a depth of 1 mm.
    const double mm = camera.orthographic ? mm_per_pixel(camera, {height, height})
                                          : 2.0 * std::tan(glm::radians(0.5 * camera.view_angle)) / height;
    NearView view{glm::vec3(camera.position - origin), glm::vec3(axes_of(camera).forward), static_cast<float>(1.0 / mm),
                  camera.orthographic, glm::translate(to_clip, origin)};
    const glm::dmat4 rows = glm::transpose(view.to_clip);
    for (std::size_t n = 0; n < view.sides.size(); ++n) {
        const glm::dvec4 side = rows[3] + (n % 2 == 0 ? 1.0 : -1.0) * rows[static_cast<int>(n / 2)];
        view.sides.at(n) = glm::vec4(side / glm::length(glm::dvec3(side)));
    }
    return view;
}

NearSurface near_surface(const PagedMesh& mesh, const NearView& view, const NearLimits& most) {
    const std::vector<std::size_t> pages = pages_to_look_at(mesh, view, kMostOffOutline, most.looked_at);
    for (float most_off = kMostOffOutline;; most_off *= 2.0F) {
        NearDivision division(mesh, view, most_off);
        const std::vector<std::size_t> divided = pages_to_divide(mesh, pages, division);
        if (divided.empty()) return {};
        if (division.divide(divided, pages, most.made)) return in_place_of(mesh, division);
    }
}

} // namespace ramus::render
