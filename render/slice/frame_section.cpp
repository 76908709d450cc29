#include "render/slice/frame_section.h"

#include "core/base/lines.h"
#include "core/slice/level_lines.h"
#include "core/slice/plane_shape.h"
#include "render/slice/branch_ink.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::render {

namespace {

std::vector<glm::dvec3> places_of(const slice::Loop& loop) {
    std::vector<glm::dvec3> places;
    places.reserve(loop.points.size());
    for (const slice::EdgePoint& point : loop.points) places.push_back(point.at);
    return places;
}

std::optional<float> value_at(const PagedMesh& mesh, const slice::EdgePoint& point) {
    if (!mesh.has_values()) return {};
    return glm::mix(mesh.value(point.first), mesh.value(point.second), point.share);
}

// The outline of one loop: a line for each stretch of one ink.
void add_outline(const PagedMesh& mesh, const slice::Loop& loop, const BranchInk& inks, FrameSection& section) {
    std::vector<SectionLine>& lines = section.lines;
    VesselLoop vessel{places_of(loop), {}, loop.closed};
    std::vector<std::optional<Ink>> ink(loop.points.size());
    for (std::size_t n = 0; n < loop.points.size(); ++n) {
        const slice::EdgePoint& point = loop.points[n];
        const int branch = branch_at(mesh, point);
        ink[n] = inks.at(branch, point.at, value_at(mesh, point));
        vessel.branches.push_back(ink[n] ? branch : kNoBranch);
    }
    section.vessels.push_back(std::move(vessel));
    const std::size_t count = loop.points.size();
    // Begins at a change of ink, if there is one.
    std::size_t begin = 0;
    while (begin < count && loop.closed && ink[begin] == ink[(begin + count - 1) % count]) ++begin;
    const auto line_of = [](const Ink& of) {
        return SectionLine{
            .points = {}, .closed = false, .colour = of.colour, .width = of.width, .opacity = of.opacity};
    };
    if (begin == count) {
        if (!ink.front()) return;
        SectionLine line = line_of(*ink.front());
        line.points = places_of(loop);
        line.closed = true;
        lines.push_back(std::move(line));
        return;
    }
    for (std::size_t n = 0; n < count;) {
        const std::size_t first = (begin + n) % count;
        std::size_t run = 1;
        while (n + run < count && ink[(begin + n + run) % count] == ink[first]) ++run;
        if (ink[first]) {
            SectionLine line = line_of(*ink[first]);
            for (std::size_t k = 0; k < run; ++k) line.points.push_back(loop.points[(first + k) % count].at);
            // Up to the first point of the next stretch, so that the outline has no gap.
            if (loop.closed || n + run < count) line.points.push_back(loop.points[(first + run) % count].at);
            lines.push_back(std::move(line));
        }
        n += run;
    }
}

// The circle in which a plane cuts a ball.
void add_circle(const glm::dvec4& sphere, const slice::Plane& plane, const SectionLine& looks,
                std::vector<SectionLine>& lines) {
    const double height = plane.height(glm::dvec3(sphere));
    const double squared = sphere.w * sphere.w - height * height;
    if (squared <= 0.0) return;
    const slice::Axes axes = slice::axes_across(plane.normal);
    const glm::dvec3 middle = glm::dvec3(sphere) - height * plane.normal;
    SectionLine line = looks;
    constexpr int kSides = 96;
    for (int k = 0; k < kSides; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / kSides;
        line.points.push_back(middle +
                              std::sqrt(squared) * (std::cos(angle) * axes.right + std::sin(angle) * axes.down));
    }
    lines.push_back(std::move(line));
}

} // namespace

namespace {

// Finds triangles that are certainly on one side of a plane, in single precision: nearly all of those in a page.
class PlaneSieve {
public:
    PlaneSieve(const PagedMesh& mesh, const TrianglePage& page, const slice::Plane& plane)
        : normal_(plane.normal), level_(static_cast<float>(-plane.height(mesh.origin()))) {
        const glm::vec3 reach = glm::max(glm::abs(page.lower), glm::abs(page.upper));
        constexpr float kRounding = 1e-6F; // of a sum of three products, with room to spare
        slack_ = kRounding * (reach.x + reach.y + reach.z + std::abs(level_));
    }
    [[nodiscard]] bool may_cross(const PagedMesh& mesh, const glm::uvec3& triangle) const {
        const float a = height(mesh, triangle.x), b = height(mesh, triangle.y), c = height(mesh, triangle.z);
        return std::min({a, b, c}) <= slack_ && std::max({a, b, c}) >= -slack_;
    }

private:
    [[nodiscard]] float height(const PagedMesh& mesh, std::uint32_t vertex) const {
        return glm::dot(normal_, mesh.vertex(vertex).position) - level_;
    }
    glm::vec3 normal_;
    float level_;
    float slack_;
};

} // namespace

std::vector<slice::Loop> section_of(const PagedMesh& mesh, const slice::Plane& plane) {
    std::vector<std::size_t> crossed;
    const auto& pages = mesh.triangle_pages();
    for (std::size_t n = 0; n < pages.size(); ++n) {
        if (!pages[n] || pages[n]->count == 0) continue;
        const Bounds<glm::dvec3> box{mesh.origin() + glm::dvec3(pages[n]->lower),
                                     mesh.origin() + glm::dvec3(pages[n]->upper)};
        if (slice::plane_crosses(plane, box)) crossed.push_back(n);
    }
    std::vector<std::vector<slice::CutTriangle>> found(crossed.size());
    tbb::parallel_for(std::size_t{0}, crossed.size(), [&](std::size_t n) {
        const TrianglePage& page = *pages[crossed[n]];
        const PlaneSieve sieve(mesh, page, plane);
        std::vector<glm::uvec3> near;
        for (const glm::uvec3& triangle : page.triangles.first(page.count))
            if (sieve.may_cross(mesh, triangle)) near.push_back(triangle);
        slice::cut_triangles(
            std::span<const glm::uvec3>(near), plane,
            [&](std::uint32_t vertex) { return mesh.origin() + glm::dvec3(mesh.vertex(vertex).position); }, found[n]);
    });
    std::vector<slice::CutTriangle> pieces;
    for (const auto& some : found) pieces.insert(pieces.end(), some.begin(), some.end());
    return slice::joined_loops(pieces);
}

int branch_at(const FrameSection& section, const slice::PixelGrid& grid, const glm::dvec2& pixel, double reach) {
    double nearest = reach;
    int found = kNoBranch;
    double around = HUGE_VAL; // distance to the outline of the innermost loop around the pixel
    int inside = kNoBranch;
    for (const VesselLoop& loop : section.vessels) {
        double own_nearest = HUGE_VAL;
        int own = kNoBranch;
        slice::Outline outline;
        outline.reserve(loop.points.size());
        for (const glm::dvec3& point : loop.points) outline.push_back(grid.pixel(point));
        const std::size_t count = outline.size();
        for (std::size_t n = 0; n + (loop.closed ? 0 : 1) < count; ++n) {
            const double away = distance_to_line(pixel, outline[n], outline[(n + 1) % count]);
            if (away < own_nearest) own_nearest = away, own = loop.branches[n];
        }
        if (own == kNoBranch) continue;
        if (own_nearest <= nearest) nearest = own_nearest, found = own;
        if (loop.closed && own_nearest < around && slice::encloses(outline, pixel)) around = own_nearest, inside = own;
    }
    return found != kNoBranch ? found : inside;
}

FrameCutter::Index& FrameCutter::index_of(const std::shared_ptr<const mesh::TriangleMesh>& mesh) {
    auto found = std::ranges::find(indices_, mesh, &Index::mesh);
    if (found == indices_.end())
        found = indices_.insert(indices_.end(), Index{mesh, std::make_unique<slice::MeshBlocks>(*mesh), nullptr});
    found->used = true;
    return *found;
}

std::vector<slice::Loop> FrameCutter::loops_of(const std::shared_ptr<const mesh::TriangleMesh>& mesh,
                                               const slice::Plane& plane) {
    return slice::section(*index_of(mesh).blocks, plane);
}

void FrameCutter::add_context(const Frame& frame, const slice::Plane& plane, FrameSection& section) {
    for (std::size_t n = 0; n < frame.context.size(); ++n) {
        const ContextMesh& item = frame.context[n];
        if (!item.shown()) continue;
        for (const slice::Loop& loop : loops_of(item.mesh, plane))
            section.lines.push_back({.points = places_of(loop),
                                     .closed = loop.closed,
                                     .colour = item.colour,
                                     .width = 1.2F,
                                     .opacity = 0.85F,
                                     .fill = item.filled_on_slices ? 0.5F * item.opacity : 0.0F,
                                     .group = static_cast<int>(n)});
    }
}

void FrameCutter::add_lesions(const Frame& frame, const slice::Plane& plane, FrameSection& section) {
    const Lesions& lesions = frame.lesions;
    for (std::size_t n = 0; n < lesions.count(); ++n) {
        const ShapeLook look = lesions.look(n);
        if (look.opacity <= 0.0F) continue;
        SectionLine line{.points = {},
                         .closed = true,
                         .colour = look.colour,
                         .width = 1.6F,
                         .opacity = 1.0F,
                         .fill = 0.25F * look.opacity,
                         .group = static_cast<int>(frame.context.size() + n)};
        if (n < lesions.spheres.size()) {
            add_circle(lesions.spheres[n], plane, line, section.lines);
            continue;
        }
        for (const slice::Loop& loop : loops_of(lesions.meshes[n - lesions.spheres.size()], plane)) {
            line.points = places_of(loop);
            line.closed = loop.closed;
            section.lines.push_back(line);
        }
    }
}

namespace {

// The visible lesions of a frame, for distances from them.
struct LesionField {
    std::vector<glm::dvec4> spheres;
    std::vector<const measure::MeshDistance*> meshes;

    [[nodiscard]] double operator()(const glm::dvec3& at) const {
        double nearest = HUGE_VAL;
        for (const glm::dvec4& sphere : spheres)
            nearest = std::min(nearest, glm::distance(at, glm::dvec3(sphere)) - sphere.w);
        for (const measure::MeshDistance* mesh : meshes) nearest = std::min(nearest, mesh->distance(at));
        return nearest;
    }
    // The pixels of a plane that may be nearer than `within_mm`.
    [[nodiscard]] slice::PixelGrid grid(const slice::Plane& plane, double within_mm) const {
        const slice::Axes axes = slice::axes_across(plane.normal);
        Bounds<glm::dvec2> box;
        const auto hold = [&](const Bounds<glm::dvec3>& of) {
            const glm::dvec3 half = 0.5 * of.size() + within_mm;
            const glm::dvec3 from = 0.5 * (of.least + of.most) - plane.point;
            if (std::abs(glm::dot(from, plane.normal)) > glm::dot(half, glm::abs(plane.normal))) return;
            const glm::dvec2 middle(glm::dot(from, axes.right), glm::dot(from, axes.down));
            const glm::dvec2 reach(glm::dot(half, glm::abs(axes.right)), glm::dot(half, glm::abs(axes.down)));
            box.hold(middle - reach);
            box.hold(middle + reach);
        };
        for (const glm::dvec4& sphere : spheres) hold({glm::dvec3(sphere) - sphere.w, glm::dvec3(sphere) + sphere.w});
        for (const measure::MeshDistance* mesh : meshes) hold(mesh->bounds());
        if (box.is_empty()) return {};
        // Lines between samples are straight: a circle of 10 mm is met to a hundredth of a mm.
        constexpr double kMostSteps = 512.0;
        const glm::dvec2 size = box.size();
        const double step = std::max({1.0, size.x / kMostSteps, size.y / kMostSteps});
        return {plane.point + box.least.x * axes.right + box.least.y * axes.down, step * axes.right, step * axes.down,
                glm::ivec2(glm::ceil(size / step)) + 1};
    }
};

} // namespace

void FrameCutter::add_margins(const Frame& frame, const slice::Plane& plane, FrameSection& section) {
    const Lesions& lesions = frame.lesions;
    LesionField field;
    for (std::size_t n = 0; n < lesions.count() && !frame.margins.bands.empty(); ++n) {
        if (lesions.look(n).opacity <= 0.0F) continue;
        if (n < lesions.spheres.size()) {
            field.spheres.push_back(lesions.spheres[n]);
            continue;
        }
        const auto& mesh = lesions.meshes[n - lesions.spheres.size()];
        if (mesh->triangles.empty()) continue;
        Index& index = index_of(mesh);
        if (!index.distance) index.distance = std::make_unique<measure::MeshDistance>(*mesh);
        field.meshes.push_back(index.distance.get());
    }
    if (field.spheres.empty() && field.meshes.empty()) return;
    std::vector<double> levels;
    for (const Margins::Band& band : frame.margins.bands) levels.push_back(static_cast<double>(band.within_mm));
    const auto lines = slice::level_lines(field.grid(plane, levels.back()), levels, field);
    for (std::size_t n = 0; n < lines.size(); ++n)
        for (const slice::Loop& loop : lines[n])
            section.lines.push_back({.points = places_of(loop),
                                     .closed = loop.closed,
                                     .colour = frame.margins.bands[n].colour,
                                     .width = 1.1F,
                                     .opacity = 0.9F});
}

namespace {

void add_crossings(const Frame& frame, const BranchInk& inks, const slice::Plane& plane, FrameSection& section) {
    if (!frame.centerlines) return;
    const Centerlines& lines = *frame.centerlines;
    for (std::size_t branch = 0; branch < lines.runs.size(); ++branch) {
        const Centerlines::Run run = lines.runs[branch];
        double before = 0.0;
        for (std::uint32_t n = 0; n < run.count; ++n) {
            const glm::dvec3 at = lines.origin + glm::dvec3(lines.points[run.first + n]);
            const double height = plane.height(at);
            if (n > 0 && (before >= 0.0) != (height >= 0.0)) {
                const glm::dvec3 last = lines.origin + glm::dvec3(lines.points[run.first + n - 1]);
                const glm::dvec3 place = last + before / (before - height) * (at - last);
                const int id = static_cast<int>(branch);
                if (const auto ink = inks.at(id, place, {})) section.crossings.push_back({place, id, ink->colour});
            }
            before = height;
        }
    }
}

} // namespace

FrameSection FrameCutter::section(const Frame& frame, const slice::Plane& plane) {
    for (Index& index : indices_) index.used = false;
    FrameSection section;
    add_context(frame, plane, section);
    add_lesions(frame, plane, section);
    add_margins(frame, plane, section);
    std::erase_if(indices_, [](const Index& index) { return !index.used; });
    const BranchInk inks(frame);
    if (frame.mesh)
        for (const slice::Loop& loop : section_of(*frame.mesh, plane)) add_outline(*frame.mesh, loop, inks, section);
    add_crossings(frame, inks, plane, section);
    return section;
}

} // namespace ramus::render
