// Outlines and creases of vessels near the eye, held against those of the field that they are the surface of.
#include "core/field/surface_projector.h"
#include "core/mesh/surface.h"
#include "render/renderer/view_setup.h"
#include "render/scene/near_surface.h"
#include "tests/support/built_tree.h"
#include "tests/support/small_tree.h"
#include "tests/support/tree_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <tuple>

using namespace ramus;
using namespace ramus::render;

namespace {

constexpr NearLimits kEnoughTriangles{10'000'000, 10'000'000};
constexpr glm::ivec2 kOutlinePicture{1280, 960};

// A surface as pictures have it.
PagedMesh drawn_mesh(const tree::VesselTree& tree) {
    mesh::SurfaceOptions options;
    options.rims = field::Rims::kOverlapping;
    Job job;
    auto made = mesh::make_surface(tree, options, job);
    REQUIRE(made);
    PagedMesh mesh(made->mesh, glm::dvec3(0.0));
    mesh.set_projector(made->projector);
    return mesh;
}

// The field of a tree of few segments, at any point.
class FieldAnywhere {
public:
    explicit FieldAnywhere(const tree::VesselTree& tree)
        : field_(test::make_field(tree, {}, {})), brick_(field_.in_brick()) {}

    [[nodiscard]] double operator()(const glm::dvec3& p) {
        field::GridAxes axes;
        field::LatticeAxes lattice;
        for (std::size_t n = 0; n < axes.x.size(); ++n) {
            const auto along = static_cast<double>(n);
            axes.x[n] = p.x + along, axes.y[n] = p.y + along, axes.z[n] = p.z + along;
        }
        lattice.x[0] = p.x, lattice.y[0] = p.y, lattice.z[0] = p.z;
        brick_->enter(field_.skeleton().present(), axes);
        const field::LatticePoint point{0, 0, 0};
        float value = 0.0F;
        brick_->sample_lattice(lattice, std::span(&point, 1), std::span(&value, 1));
        return static_cast<double>(value);
    }
    [[nodiscard]] double isovalue() const { return static_cast<double>(field_.isovalue()); }

private:
    field::Field field_;
    std::unique_ptr<field::BrickField> brick_;
};

struct OffSurface {
    double mm;          // inside where positive
    glm::dvec3 outward; // away from the surface
};
// How far a line of sight passes the surface by: to first order, at the line's point that is deepest inside. `place` is
// near that.
OffSurface off_surface(FieldAnywhere& field, const glm::dvec3& place, const glm::dvec3& sight, double around) {
    double from = -around, to = around;
    for (int step = 0; step < 40; ++step) {
        const double a = from + (to - from) / 3.0, b = to - (to - from) / 3.0;
        if (field(place + a * sight) < field(place + b * sight))
            from = a;
        else
            to = b;
    }
    const glm::dvec3 at = place + 0.5 * (from + to) * sight;
    const double step = 0.01 * around;
    glm::dvec3 gradient(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 aside(0.0);
        aside[axis] = step;
        gradient[axis] = (field(at + aside) - field(at - aside)) / (2.0 * step);
    }
    return {(field(at) - field.isovalue()) / glm::length(gradient), -glm::normalize(gradient)};
}

// Whether the surface bends away from the line of sight that touches it, by a fifth of what a vessel of this radius
// does at least. Where it does not, what is seen of an outline ends, or the line of sight is inside before and behind.
bool is_outline(FieldAnywhere& field, const glm::dvec3& place, const glm::dvec3& sight, double radius) {
    const double step = 0.02 * radius;
    const auto value = [&](double along, double aside, const glm::dvec3& axis) {
        return field(place + along * sight + aside * axis);
    };
    glm::dvec3 gradient(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 aside(0.0);
        aside[axis] = 1.0;
        gradient[axis] = (value(0.0, step, aside) - value(0.0, -step, aside)) / (2.0 * step);
    }
    const double bend = (value(step, 0.0, sight) + value(-step, 0.0, sight) - 2.0 * field(place)) / (step * step);
    return -bend / glm::length(gradient) > 0.2 / radius;
}

using FacingEdge = std::pair<std::tuple<float, float, float>, std::tuple<float, float, float>>;

// Edges between triangles that face the eye and that do not, in a parallel projection.
std::vector<std::array<glm::vec3, 2>> outline_of(const PagedMesh& mesh, const NearSurface& near, const NearView& view) {
    std::map<FacingEdge, bool> facing;
    const auto key = [](const glm::vec3& p) { return std::tuple(p.x, p.y, p.z); };
    const auto add = [&](const PagedMesh& of, const std::vector<std::uint8_t>& without) {
        for (std::size_t page = 0; page < of.triangle_pages().size(); ++page) {
            if (!without.empty() && without[page] != 0) continue;
            const TrianglePage& triangles = *of.triangle_pages()[page];
            for (const glm::uvec3& t : triangles.triangles.first(triangles.count)) {
                const std::array<glm::vec3, 3> p{of.vertex(t.x).position, of.vertex(t.y).position,
                                                 of.vertex(t.z).position};
                const glm::vec3 across = glm::cross(p[1] - p[0], p[2] - p[0]);
                const float longest =
                    std::max({glm::distance(p[0], p[1]), glm::distance(p[1], p[2]), glm::distance(p[2], p[0])});
                if (glm::length(across) * view.pixels < longest) continue; // thinner than a pixel, and may face any way
                const bool faces = glm::dot(across, view.forward) < 0.0F;
                for (std::size_t k = 0; k < 3; ++k) facing[{key(p.at(k)), key(p.at((k + 1) % 3))}] = faces;
            }
        }
    };
    add(mesh, near.replaced);
    if (near.mesh) add(*near.mesh, {});
    std::vector<std::array<glm::vec3, 2>> outline;
    const auto at = [](const auto& k) { return glm::vec3(std::get<0>(k), std::get<1>(k), std::get<2>(k)); };
    for (const auto& [edge, faces] : facing) {
        const auto back = facing.find({edge.second, edge.first});
        if (faces && back != facing.end() && !back->second) outline.push_back({at(edge.first), at(edge.second)});
    }
    return outline;
}

struct Looked {
    Camera camera;
    NearView view;
};

// Whether the picture shows a triangle at the place, in a parallel projection.
bool is_covered(const PagedMesh& mesh, const NearSurface& near, const Looked& looked, const glm::dvec3& place) {
    const CameraAxes axes = axes_of(looked.camera);
    const auto flat = [&](const glm::dvec3& p) {
        return glm::dvec2(glm::dot(p - place, axes.right), glm::dot(p - place, axes.up));
    };
    const auto in_any = [&](const PagedMesh& of, const std::vector<std::uint8_t>& without) {
        for (std::size_t page = 0; page < of.triangle_pages().size(); ++page) {
            if (!without.empty() && without[page] != 0) continue;
            const TrianglePage& triangles = *of.triangle_pages()[page];
            for (const glm::uvec3& t : triangles.triangles.first(triangles.count)) {
                const std::array<glm::dvec2, 3> p{flat(of.vertex(t.x).position), flat(of.vertex(t.y).position),
                                                  flat(of.vertex(t.z).position)};
                int left = 0, right = 0;
                for (std::size_t k = 0; k < 3; ++k) {
                    const glm::dvec2 &a = p.at(k), &b = p.at((k + 1) % 3);
                    (a.x * b.y - a.y * b.x > 0.0 ? left : right) += 1;
                }
                if (left == 3 || right == 3) return true;
            }
        }
        return false;
    };
    return in_any(mesh, near.replaced) || (near.mesh && in_any(*near.mesh, {}));
}

// From the side, so that what is at `focus` is as large as if the whole vessel were magnified.
Looked look_closely(const PagedMesh& mesh, const glm::dvec3& focus, double zoom) {
    Camera camera = camera_for(mesh.positions(), View::kAnterior, kOutlinePicture, true);
    camera = zoomed(centred_on(camera, focus), zoom);
    Frame frame;
    frame.camera = camera;
    frame.size = kOutlinePicture;
    ViewSetup setup;
    setup.picture = setup.size = kOutlinePicture;
    setup.look(frame, mesh.bounds(), {});
    return {camera, near_view(camera, mesh.origin(), setup.to_clip, kOutlinePicture.y)};
}

constexpr double kFartherOut = 0.1; // pixels

// Pixels that the outline in the picture is off at most.
double most_off_outline(const tree::VesselTree& tree, const PagedMesh& mesh, const Looked& looked, double radius) {
    FieldAnywhere field(tree);
    const NearSurface near = near_surface(mesh, looked.view, kEnoughTriangles);
    double most = 0.0;
    std::size_t seen = 0;
    for (const auto& [a, b] : outline_of(mesh, near, looked.view)) {
        for (const float share : {0.0F, 0.25F, 0.5F, 0.75F}) {
            const glm::dvec3 place = glm::mix(a, b, share);
            const glm::dvec4 clip = looked.view.to_clip * glm::dvec4(place, 1.0);
            if (std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) continue;
            if (!is_outline(field, place, glm::dvec3(looked.view.forward), radius)) continue;
            ++seen;
            const auto pixels = static_cast<double>(looked.view.pixels);
            const auto [mm, outward] = off_surface(field, place, glm::dvec3(looked.view.forward), 0.1 * radius);
            if (std::abs(mm) * pixels <= most) continue;
            // Behind a triangle that reaches farther out it is no outline in the picture; that triangle has its own.
            if (mm > 0.0 && is_covered(mesh, near, looked, place + kFartherOut / pixels * outward)) continue;
            most = std::abs(mm) * pixels;
        }
    }
    CHECK(seen > 20);
    return most;
}

} // namespace

TEST_CASE("outlines near the eye are those of the field: a tip and a trunk, at any zoom") {
    // A vessel that bends and thins, with a branch, as trees have them; along it all radii and curvatures differ.
    const tree::VesselTree tree = test::built_tree({{{0, 0, -25}, 4.0},
                                                    {{-0.41, 0.17, -5.9}, 3.74},
                                                    {{3, 0.75, 7.25}, 3.25},
                                                    {{8, 3, 18}, 2.4},
                                                    {{-9, 2, 10}, 1.5}},
                                                   {{0, 1}, {1, 2}, {2, 3}, {1, 4}});
    constexpr double kThick = 4.2; // mm: the thickest
    const PagedMesh mesh = drawn_mesh(tree);
    const auto outermost = [&](const glm::vec3& along) { // of all vertices
        glm::vec3 found(0.0F);
        float most = std::numeric_limits<float>::lowest();
        for (const glm::vec3& p : mesh.positions())
            if (glm::dot(p, along) > most) most = glm::dot(p, along), found = p;
        return glm::dvec3(found);
    };
    const std::array<std::pair<const char*, glm::dvec3>, 3> places{
        {{"the thick end", outermost({0, 0, -1})}, {"the tip", outermost({0.6F, 0, 1})}, {"the trunk", {4.1, 0, -10}}}};
    const Looked whole = look_closely(mesh, {0, 0, 0}, 1.0);
    const auto outline = outline_of(mesh, near_surface(mesh, whole.view, kEnoughTriangles), whole.view);
    for (const auto& [name, place] : places)
        for (const double zoom : {1.0, 10.0, 100.0}) {
            const std::string what = name;
            CAPTURE(what);
            CAPTURE(zoom);
            glm::dvec3 focus = outline.front()[0];
            for (const auto& edge : outline)
                if (glm::distance(glm::dvec3(edge[0]), place) < glm::distance(focus, place)) focus = edge[0];
            const double off = most_off_outline(tree, mesh, look_closely(mesh, focus, zoom), kThick);
            MESSAGE(what << " at zoom " << zoom << ": " << off << " pixels off its outline");
            CHECK(off < 0.25);
        }
}

namespace {

// Where a line of sight first meets an endless tube, mm along it.
std::optional<double> first_hit_of_tube(const glm::dvec3& from, const glm::dvec3& sight, const glm::dvec3& on_axis,
                                        const glm::dvec3& axis, double radius) {
    const auto across = [&](const glm::dvec3& v) { return v - glm::dot(v, axis) * axis; };
    const glm::dvec3 p = across(from - on_axis), d = across(sight);
    const double a = glm::dot(d, d), b = glm::dot(p, d), c = glm::dot(p, p) - radius * radius;
    const double root = b * b - a * c;
    if (root < 0.0) return std::nullopt;
    return (-b - std::sqrt(root)) / a;
}

} // namespace

TEST_CASE("the crease between vessels that cross is the line where their tubes meet, at any zoom" *
          doctest::test_suite("slow")) {
    constexpr double kFarOut = 34.0; // mm from the middle
    constexpr int kElsewhere = -100;
    const std::array<glm::dvec3, 2> on_axis{{{0, 0, 0}, {0, 4.0, 0}}}, axis{{{1, 0, 0}, {0, 0, 1}}};
    const std::array<double, 2> radius{4.0, 3.0};
    const tree::VesselTree tree = test::built_tree(
        {{{-40, 0, 0}, 4.0}, {{40, 0, 0}, 4.0}, {{0, 4, -40}, 3.0}, {{0, 4, 40}, 3.0}}, {{0, 1}, {2, 3}}, {0, 2});
    test::SmallTree scene(kOutlinePicture);
    scene.frame.mesh = std::make_shared<const PagedMesh>(drawn_mesh(tree));
    scene.frame.bends = true;
    const Camera beside =
        turned(camera_for(scene.frame.mesh->positions(), View::kAnterior, kOutlinePicture, true), 65.0, 25.0);
    // A place of the crease, on both tubes, on the side that is seen.
    const glm::dvec3 forward = axes_of(beside).forward;
    const double x = std::copysign(2.9, -forward.x), y = 4.0 - std::sqrt(9.0 - x * x);
    const double z = std::copysign(std::sqrt(16.0 - y * y), -forward.z);
    for (const double zoom : {1.0, 10.0, 100.0}) {
        CAPTURE(zoom);
        scene.frame.camera = zoomed(centred_on(beside, {x, y, z}), zoom);
        scene.draw();
        const BranchPicture picture = scene.renderer->read_branches();
        const CameraAxes axes = axes_of(scene.frame.camera);
        const double mm = mm_per_pixel(scene.frame.camera, kOutlinePicture);
        const auto exact = [&](int i, int j) { // as the picture's rows go
            const glm::dvec2 off = (glm::dvec2(i, j) + 0.5 - 0.5 * glm::dvec2(kOutlinePicture)) * mm;
            const glm::dvec3 from = scene.frame.camera.position + off.x * axes.right - off.y * axes.up;
            int nearest = kNoBranch;
            std::optional<double> least;
            const auto beyond = [&](double hit, const glm::dvec3& along) { // the vessels have ends
                return std::abs(glm::dot(from + hit * axes.forward, along)) > kFarOut;
            };
            for (int n = 0; n < 2; ++n) {
                const auto at = static_cast<std::size_t>(n);
                const auto hit = first_hit_of_tube(from, axes.forward, on_axis.at(at), axis.at(at), radius.at(at));
                if (hit && beyond(*hit, axis.at(at))) return kElsewhere;
                if (hit && (!least || *hit < *least)) least = hit, nearest = n;
            }
            return nearest;
        };
        std::size_t off = 0, borders = 0;
        for (int j = 1; j + 1 < kOutlinePicture.y; ++j)
            for (int i = 1; i + 1 < kOutlinePicture.x; ++i) {
                const int there = picture.at(i + 0.5, j + 0.5);
                const int wanted = exact(i, j);
                if (wanted == kElsewhere) continue;
                borders += wanted != exact(i + 1, j) ? 1 : 0;
                if (there == wanted) continue;
                bool near = false;
                for (int v = -1; v <= 1; ++v)
                    for (int u = -1; u <= 1; ++u) {
                        const int neighbour = exact(i + u, j + v);
                        near = near || neighbour == there || neighbour == kElsewhere;
                    }
                off += near ? 0 : 1;
            }
        MESSAGE("zoom " << zoom << ": " << off << " pixels are more than one off, of " << borders << " along borders");
        CHECK(borders > 100);
        CHECK(off == 0);
    }
}
