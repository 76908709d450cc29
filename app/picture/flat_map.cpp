#include "app/picture/flat_map.h"

#include "app/picture/colouring.h"
#include "app/session/numbers.h"
#include "app/session/systems.h"
#include "core/organ/resect/resection.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace ramus::app {

namespace {

// The directions of the map in space.
struct Axes {
    glm::dvec3 right{1.0, 0.0, 0.0}, up{0.0, 0.0, 1.0};
    [[nodiscard]] glm::vec2 place(const glm::dvec3& at) const { return {glm::dot(at, right), glm::dot(at, up)}; }
};

// The eye is on the removed side. Up is superior, or anterior for a surface that is nearly axial.
Axes axes_of(const Resection& resection) {
    glm::dvec3 removed = resection.normal;
    if (resection.kind == Resection::Kind::kSheet)
        removed = (resection.sheet.removes_below ? -1.0 : 1.0) * resection.sheet.normal();
    constexpr double kAxial = 0.9;
    const glm::dvec3 above = std::abs(removed.z) < kAxial ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(above, removed));
    return {right, glm::cross(removed, right)};
}

// As an index in render::AxisNames: +x, -x, +y, ...
std::size_t side_of(const glm::dvec3& direction) {
    int axis = 0;
    for (int other = 1; other < 3; ++other)
        if (std::abs(direction[other]) > std::abs(direction[axis])) axis = other;
    return static_cast<std::size_t>(2 * axis + (direction[axis] < 0.0 ? 1 : 0));
}

// Whether the surface of a plane or a sheet passes a place.
bool is_on(const Resection& shape, const glm::dvec3& at) {
    constexpr double kSame = 1e-3; // mm
    const organ::Resection function = shape.kind == Resection::Kind::kSheet
                                          ? organ::Resection(shape.sheet)
                                          : organ::Resection(organ::HalfSpace{shape.point, shape.normal});
    return std::abs(organ::value_at(function, at)) < kSame;
}

void add_bands(FlatMap& map, const Operation::Parts& parts, const Operation::Of& of, const Axes& axes,
               const glm::vec3& beyond) {
    const std::vector<render::Legend::Swatch> margins = margin_swatches(of.bands_mm);
    for (std::size_t n = 0; n < parts.size(); ++n) {
        FlatMap::Band band{{}, beyond, {}};
        if (n + 1 < parts.size())
            band = {margins[n].text, margins[n].colour, {}};
        else if (n > 0)
            band.distance = "beyond " + rounded(of.bands_mm.back());
        const mesh::TriangleMesh& mesh = *parts[n];
        std::vector<glm::vec2> places;
        for (const glm::vec3& position : mesh.positions) places.push_back(axes.place(position));
        for (const glm::vec2& place : places) map.box.hold(place);
        for (const auto& triangle : mesh.triangles)
            band.triangles.push_back({places[triangle[0]], places[triangle[1]], places[triangle[2]]});
        map.bands.push_back(std::move(band));
    }
}

} // namespace

std::optional<FlatMap> flat_map_of(const Operation& operation, std::size_t resection, const Marks& marks) {
    const Operation::Of& of = operation.of;
    if (resection >= operation.surfaces.size() || operation.surfaces[resection].empty()) return {};
    const Resection& shape = of.resections[resection];
    if (shape.kind != Resection::Kind::kPlane && shape.kind != Resection::Kind::kSheet) return {};
    const Axes axes = axes_of(shape);
    FlatMap map;
    const Rgb beyond = Resection{}.colour;
    add_bands(map, operation.surfaces[resection], of, axes, srgb_of(beyond));
    map.sides = {side_of(-axes.right), side_of(axes.right), side_of(-axes.up), side_of(axes.up)};
    const tree::VesselTree& tree = *of.supply->of.tree;
    const Systems& systems = systems_of(tree, marks);
    for (const organ::CutVessel& vessel : operation.vessels) {
        if (vessel.resection != resection || !vessel.in_organ) continue;
        const int system = tree.branches[static_cast<std::size_t>(vessel.place.branch)].system;
        map.vessels.push_back({axes.place(vessel.at), static_cast<float>(0.5 * vessel.diameter_mm),
                               systems.empty() ? kBeyondMargins : shown_colour(systems, system), vessel.place.branch,
                               vessel.diameter_mm});
    }
    for (std::size_t lesion = 0; lesion < operation.margins.size(); ++lesion) {
        const organ::Margin& margin = operation.margins[lesion];
        if (margin.distance_mm && is_on(shape, margin.on_surface))
            map.nearest.push_back({axes.place(margin.on_surface), *margin.distance_mm, of.lesions[lesion].name});
    }
    return map;
}

} // namespace ramus::app
