// Surfaces of labelled parts of an organ: topology, volumes, shared borders, smoothness.
#include "core/io/volumes/volume_file.h"
#include "core/organ/label_surfaces.h"
#include "tests/support/mesh_topology.h"
#include "tests/support/shared_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <doctest/doctest.h>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <oneapi/tbb/global_control.h>
#include <random>
#include <set>

using namespace ramus;
using organ::kOutside;
using organ::LabelSurfaces;
using organ::Organ;

namespace {

struct Labelled {
    Organ organ;
    std::vector<int> labels;
};

// `label_at`: the label of a voxel, or kOutside.
Labelled labelled(const glm::ivec3& size, const glm::dmat4& to_patient,
                  const std::function<int(const glm::ivec3&)>& label_at) {
    volume::BitMask mask(size);
    std::vector<int> labels;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                const int label = label_at({i, j, k});
                if (label == kOutside) continue;
                mask.set({i, j, k});
                labels.push_back(label);
            }
    return {Organ(std::move(mask), to_patient), std::move(labels)};
}

LabelSurfaces surfaces_of(const Labelled& parts) {
    Job job;
    return organ::label_surfaces(parts.organ, parts.labels, JobRange(job, 0.0F, 1.0F)).value();
}

glm::dmat4 spaced(const glm::dvec3& spacing) { return glm::scale(glm::dmat4(1.0), spacing); }

bool in_ellipsoid(const glm::ivec3& voxel, const glm::dvec3& middle, const glm::dvec3& radii) {
    const glm::dvec3 p = (glm::dvec3(voxel) - middle) / radii;
    return glm::dot(p, p) <= 1.0;
}

// A place as bits, for exact comparison.
using Place = std::array<std::uint32_t, 3>;
Place bits(const glm::vec3& p) {
    Place place;
    std::memcpy(place.data(), &p, sizeof place);
    return place;
}
using Face = std::array<Place, 3>;

// The triangles of a mesh by their places, the least corner first; `turned`: the other way round.
std::multiset<Face> faces_of(const mesh::TriangleMesh& mesh, bool turned) {
    std::multiset<Face> faces;
    for (glm::uvec3 t : mesh.triangles) {
        if (turned) std::swap(t.x, t.z);
        Face face{bits(mesh.positions[t.x]), bits(mesh.positions[t.y]), bits(mesh.positions[t.z])};
        std::rotate(face.begin(), std::ranges::min_element(face), face.end());
        faces.insert(face);
    }
    return faces;
}

// Each label and the outside: closed, one ring around each vertex, oriented outward; volumes within 1 %. All together
// have every triangle of every border twice, once from each side, so that there is no gap and no overlap.
void check_partition(const Labelled& parts, const LabelSurfaces& surfaces, double most_error = 0.01) {
    std::map<int, double> voxels{{kOutside, 0.0}};
    for (const int label : parts.labels) ++voxels[label];
    std::multiset<Face> forward, backward;
    for (const auto& one : voxels) {
        const int label = one.first;
        const double count = one.second;
        CAPTURE(label);
        CAPTURE(count);
        const mesh::TriangleMesh mesh = organ::surface_of(surfaces, label);
        const test::Topology topology = test::topology(mesh);
        CHECK(topology.closed_manifold());
        const double wanted =
            1000.0 * parts.organ.voxel_ml() * (label == kOutside ? -double(parts.labels.size()) : count);
        CHECK(topology.volume == doctest::Approx(wanted).epsilon(most_error));
        CHECK(mesh.normals.size() == mesh.positions.size());
        forward.merge(faces_of(mesh, false));
        backward.merge(faces_of(mesh, true));
    }
    CHECK(forward == backward);
    CHECK(forward.size() == 2 * surfaces.mesh.triangles.size());
}

// The largest distance of a vertex from a border between voxels of different labels, along an axis, in voxels.
float farthest_from_border(const Labelled& parts, const LabelSurfaces& surfaces) {
    std::map<std::array<int, 3>, int> label_of;
    parts.organ.for_voxels([&](const glm::ivec3& v, std::size_t number) {
        label_of[{v.x, v.y, v.z}] = parts.labels[number];
    });
    const auto label_at = [&](const glm::ivec3& v) {
        const auto found = label_of.find({v.x, v.y, v.z});
        return found == label_of.end() ? kOutside : found->second;
    };
    const glm::dmat4 to_voxels = glm::inverse(parts.organ.to_patient());
    float farthest = 0.0F;
    for (const glm::vec3& position : surfaces.mesh.positions) {
        const glm::dvec3 p(to_voxels * glm::dvec4(glm::dvec3(position), 1.0));
        double nearest = std::numeric_limits<double>::infinity();
        const glm::ivec3 from(glm::floor(p));
        for (int n = 0; n < 3 * 64; ++n) { // borders between a voxel and the next one along an axis
            const int axis = n / 64, c = n % 64;
            const glm::ivec3 here = from + glm::ivec3(c % 4, c / 4 % 4, c / 16) - 1;
            glm::ivec3 next = here;
            ++next[axis];
            if (label_at(here) == label_at(next)) continue;
            glm::dvec3 beyond = glm::abs(p - glm::dvec3(here));
            beyond[axis] = std::abs(p[axis] - here[axis] - 0.5);
            for (int other = 1; other < 3; ++other) {
                double& along = beyond[(axis + other) % 3];
                along = std::max(0.0, along - 0.5);
            }
            nearest = std::min(nearest, std::max({beyond.x, beyond.y, beyond.z}));
        }
        farthest = std::max(farthest, static_cast<float>(nearest));
    }
    return farthest;
}

// Degrees between the normals of triangles that share an edge, ascending.
std::vector<double> turns(const mesh::TriangleMesh& mesh) {
    const test::HalfEdges edges(mesh);
    const auto normal = [&](std::uint32_t t) {
        const glm::uvec3& corners = mesh.triangles[t];
        const glm::dvec3 a(mesh.positions[corners.x]);
        return glm::normalize(
            glm::cross(glm::dvec3(mesh.positions[corners.y]) - a, glm::dvec3(mesh.positions[corners.z]) - a));
    };
    std::vector<double> found;
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
        for (const test::HalfEdge& edge : edges.of(v))
            if (v < edge.to) {
                const double cosine = glm::dot(normal(edge.triangle), normal(edges.find(edge.to, v)->triangle));
                found.push_back(std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi);
            }
    std::ranges::sort(found);
    return found;
}

double share(const std::vector<double>& ascending, double fraction) {
    return ascending[static_cast<std::size_t>(fraction * double(ascending.size() - 1))];
}

} // namespace

TEST_CASE("surfaces of single voxels and of voxels that touch at an edge or a corner are closed") {
    const auto check = [](const std::vector<glm::ivec3>& voxels) {
        const Labelled parts = labelled({4, 4, 4}, spaced({1.0, 2.0, 3.0}), [&](const glm::ivec3& v) {
            const auto found = std::ranges::find(voxels, v);
            return found == voxels.end() ? kOutside : static_cast<int>(found - voxels.begin()) % 2;
        });
        check_partition(parts, surfaces_of(parts));
        const Labelled one = labelled({4, 4, 4}, spaced({1.0, 2.0, 3.0}), [&](const glm::ivec3& v) {
            return std::ranges::find(voxels, v) == voxels.end() ? kOutside : -1;
        });
        check_partition(one, surfaces_of(one));
    };
    check({{0, 0, 0}}); // at the border of the volume
    check({{1, 1, 1}, {2, 1, 1}});
    check({{1, 1, 1}, {2, 2, 1}});
    check({{1, 1, 1}, {2, 2, 2}});
    check({{1, 1, 1}, {1, 2, 2}, {2, 1, 2}, {2, 2, 1}});
}

TEST_CASE("all labellings of the eight voxels of a cell with up to three labels and the outside are manifold") {
    for (int code = 0; code < 1 << 16; code += 7) { // two bits for each voxel; every seventh
        const Labelled parts = labelled({2, 2, 2}, spaced({1.0, 1.0, 1.0}), [&](const glm::ivec3& v) {
            const int label = code >> 2 * (v.x + 2 * v.y + 4 * v.z) & 3;
            return label == 3 ? kOutside : label;
        });
        if (parts.labels.empty()) continue;
        CAPTURE(code);
        const LabelSurfaces surfaces = surfaces_of(parts);
        for (const int label : {kOutside, 0, 1, 2}) {
            const mesh::TriangleMesh mesh = organ::surface_of(surfaces, label);
            const bool closed = test::topology(mesh).closed_manifold();
            if (!closed) CAPTURE(label);
            REQUIRE(closed);
        }
    }
}

TEST_CASE("half balls, octants and random labels have their volumes, and share their borders") {
    const glm::dvec3 middle(15.3, 14.6, 14.9);
    const auto in_ball = [&](const glm::ivec3& v) { return in_ellipsoid(v, middle, glm::dvec3(13.5)); };
    std::mt19937 random(7);
    std::vector<glm::dvec3> seeds;
    for (int n = 0; n < 60; ++n)
        seeds.emplace_back(double(random() % 300) / 10.0, double(random() % 300) / 10.0, double(random() % 300) / 10.0);
    const std::map<std::string, std::function<int(const glm::ivec3&)>> labellings{
        {"half balls", [&](const glm::ivec3& v) { return in_ball(v) ? (v.x < 16 ? 0 : 1) : kOutside; }},
        {"octants",
         [&](const glm::ivec3& v) {
             return in_ball(v) ? (v.x < 15 ? 1 : 0) + (v.y < 15 ? 2 : 0) + (v.z < 15 ? 4 : 0) - 1 : kOutside;
         }},
        {"Voronoi cells",
         [&](const glm::ivec3& v) {
             if (!in_ball(v)) return kOutside;
             const auto away = [&](const glm::dvec3& seed) { return glm::distance(seed, glm::dvec3(v)); };
             return static_cast<int>(std::ranges::min_element(seeds, {}, away) - seeds.begin());
         }},
        {"noise of few labels",
         [&](const glm::ivec3& v) { return in_ball(v) ? static_cast<int>(random() % 4) + kOutside : kOutside; }},
        {"noise of many labels",
         [&](const glm::ivec3& v) { return in_ball(v) ? static_cast<int>(random() % 3000) : kOutside; }},
    };
    for (const auto& one : labellings) {
        const std::string name = one.first;
        CAPTURE(name);
        glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1.0, -2.0, 0.5)));
        turned = glm::scale(turned, glm::dvec3(0.95, -0.95, 3.75)); // mirrored
        turned[3] = glm::dvec4(-40.0, 55.0, 120.0, 1.0);
        const Labelled parts = labelled({31, 31, 31}, turned, one.second);
        const LabelSurfaces surfaces = surfaces_of(parts);
        check_partition(parts, surfaces);
        CHECK(farthest_from_border(parts, surfaces) < 0.5F);
    }
}

TEST_CASE("surfaces of labels do not depend on the number of threads, and can be cancelled") {
    const Labelled parts = labelled({40, 40, 40}, spaced({1.0, 1.0, 1.0}), [](const glm::ivec3& v) {
        return in_ellipsoid(v, glm::dvec3(20.2), glm::dvec3(18.0)) ? (v.x + v.y) / 17 : kOutside;
    });
    const LabelSurfaces all = surfaces_of(parts);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const LabelSurfaces alone = surfaces_of(parts);
    CHECK(all.mesh == alone.mesh);
    CHECK(all.sides == alone.sides);
    Job job;
    job.cancel();
    const auto cancelled = organ::label_surfaces(parts.organ, parts.labels, JobRange(job, 0.0F, 1.0F));
    REQUIRE(!cancelled);
    CHECK(cancelled.error().what == "cancelled");
}

TEST_CASE("surfaces of labels in thick slices have no steps") {
    const glm::dvec3 spacing(0.95, 0.95, 3.75), radii(47.0, 52.0, 60.0), middle(56.3, 56.6, 74.2);
    for (const bool divided : {false, true}) {
        CAPTURE(divided);
        const Labelled parts = labelled({120, 120, 40}, spaced(spacing), [&](const glm::ivec3& v) {
            if (!in_ellipsoid(v, middle / spacing, radii / spacing)) return kOutside;
            return divided ? (v.x < 60 ? 1 : 0) + (v.y + 0.3 * v.x < 78 ? 2 : 0) + (v.z < 20 ? 4 : 0) : 0;
        });
        const LabelSurfaces surfaces = surfaces_of(parts);
        const mesh::TriangleMesh outer = organ::surface_of(surfaces, kOutside);
        std::vector<double> off; // degrees between the normals of triangles and of the ellipsoid
        for (const glm::uvec3& t : outer.triangles) {
            const glm::dvec3 a(outer.positions[t.x]), b(outer.positions[t.y]), c(outer.positions[t.z]);
            const glm::dvec3 truth = glm::normalize(((a + b + c) / 3.0 - middle) / (radii * radii));
            const double cosine = -glm::dot(glm::normalize(glm::cross(b - a, c - a)), truth);
            off.push_back(std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi);
        }
        std::ranges::sort(off);
        const std::vector<double> jumps = turns(outer);
        MESSAGE("normals off: median ", share(off, 0.5), ", 95 % ", share(off, 0.95), ", 99 % ", share(off, 0.99),
                " degrees; jumps: 95 % ", share(jumps, 0.95), ", 99 % ", share(jumps, 0.99), ", all ", jumps.back());
        CHECK(share(off, 0.5) < 2.0);
        CHECK(share(off, 0.95) < 6.0);
        CHECK(share(jumps, 0.5) < 2.0);
        CHECK(share(jumps, 0.95) < 5.0);
        CHECK(share(jumps, 0.99) < 9.0);
        CHECK(jumps.back() < 45.0); // voxels have 90
        if (!divided) continue;
        // Where the border along a slanted plane meets the surface of the organ it has no notches.
        std::set<std::uint32_t> on_border, on_outside;
        for (std::size_t n = 0; n < surfaces.sides.size(); ++n) {
            const organ::Sides& sides = surfaces.sides[n];
            for (int corner = 0; corner < 3; ++corner) {
                const std::uint32_t vertex = surfaces.mesh.triangles[n][corner];
                if (sides.outside == kOutside)
                    on_outside.insert(vertex);
                else if ((sides.inside ^ sides.outside) == 2)
                    on_border.insert(vertex);
            }
        }
        std::vector<double> off_plane; // mm
        for (const std::uint32_t vertex : on_border)
            if (on_outside.contains(vertex)) {
                const glm::dvec3 p = glm::dvec3(surfaces.mesh.positions[vertex]) / spacing;
                off_plane.push_back(std::abs(p.y + 0.3 * p.x - 78.0) / std::sqrt(1.09) * spacing.x);
            }
        std::ranges::sort(off_plane);
        MESSAGE("rim off its plane: median ", share(off_plane, 0.5), ", 95 % ", share(off_plane, 0.95), " mm");
        CHECK(share(off_plane, 0.5) < 0.1);
        CHECK(share(off_plane, 0.95) < 0.3);
        // The plane between the upper and the lower half stays flat.
        std::vector<double> away;
        for (std::size_t n = 0; n < surfaces.sides.size(); ++n)
            if (surfaces.sides[n].inside / 4 == 0 && surfaces.sides[n].outside / 4 == 1)
                for (int corner = 0; corner < 3; ++corner)
                    away.push_back(
                        std::abs(surfaces.mesh.positions[surfaces.mesh.triangles[n][corner]].z - 19.5 * spacing.z));
        REQUIRE(!away.empty());
        std::ranges::sort(away);
        CHECK(share(away, 0.9) < 0.1 * spacing.z);
    }
}

TEST_CASE("surfaces of a real liver in slabs are closed, with exact volumes" * doctest::test_suite("slow")) {
    const auto path = test::shared_volume("liver_002_organ.nii.gz");
    if (!path) return;
    Job job;
    const auto volume = io::read_volume(*path, {}, job);
    REQUIRE(volume.has_value());
    Labelled parts{organ::organ_of(*volume, {}, JobRange(job, 0.0F, 1.0F)).value(), {}};
    parts.organ.for_voxels([&](const glm::ivec3& v, std::size_t) {
        parts.labels.push_back((v.x + v.y / 2) / 60 + 10 * ((v.z + v.x / 16) / 22));
    });
    const LabelSurfaces surfaces = surfaces_of(parts);
    check_partition(parts, surfaces);
    const std::vector<double> jumps = turns(organ::surface_of(surfaces, kOutside));
    MESSAGE("jumps: median ", share(jumps, 0.5), ", 95 % ", share(jumps, 0.95), ", 99 % ", share(jumps, 0.99));
    CHECK(share(jumps, 0.5) < 4.0);
    CHECK(share(jumps, 0.95) < 20.0);
}
