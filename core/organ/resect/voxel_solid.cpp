#include "core/organ/resect/voxel_solid.h"

#include "core/base/bounds.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <numeric>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <unordered_map>
#include <utility>

namespace ramus::organ {

namespace {

// Adds the corners of voxel boxes to a mesh, each once.
class BoxCorners {
public:
    BoxCorners(const Organ& voxels, mesh::TriangleMesh& mesh) : voxels_(voxels), mesh_(mesh) {}

    // `corner`: the corner at the lower ends of a voxel has the voxel's indices.
    std::uint32_t vertex(const glm::ivec3& corner) {
        const glm::ivec3 size = voxels_.size() + 1;
        const std::uint64_t key = static_cast<std::uint64_t>(corner.x) +
                                  static_cast<std::uint64_t>(size.x) *
                                      (static_cast<std::uint64_t>(corner.y) +
                                       static_cast<std::uint64_t>(size.y) * static_cast<std::uint64_t>(corner.z));
        const auto [found, added] = known_.try_emplace(key, static_cast<std::uint32_t>(mesh_.positions.size()));
        if (added)
            mesh_.positions.push_back(glm::vec3(voxels_.to_patient() * glm::dvec4(glm::dvec3(corner) - 0.5, 1.0)));
        return found->second;
    }

private:
    const Organ& voxels_;
    mesh::TriangleMesh& mesh_;
    std::unordered_map<std::uint64_t, std::uint32_t> known_;
};

constexpr int kNoPart = -1;

// Parts of an organ, each on a grid of its own that is no larger than the part. part_of(number): the part of a voxel,
// or kNoPart.
template <class PartOf> std::vector<Organ> cropped_parts(const Organ& organ, std::size_t count, const PartOf& part_of) {
    std::vector<Bounds<glm::ivec3>> boxes(count);
    const auto for_chosen = [&](const auto& call) {
        organ.for_voxels([&](const glm::ivec3& voxel, std::size_t number) {
            const int part = part_of(number);
            if (part != kNoPart) call(voxel, static_cast<std::size_t>(part));
        });
    };
    for_chosen([&](const glm::ivec3& voxel, std::size_t part) { boxes[part].hold(voxel); });
    std::vector<volume::BitMask> masks;
    for (const Bounds<glm::ivec3>& box : boxes)
        masks.emplace_back(box.is_empty() ? glm::ivec3(0) : box.most - box.least + 1);
    for_chosen([&](const glm::ivec3& voxel, std::size_t part) { masks[part].set(voxel - boxes[part].least); });
    std::vector<Organ> parts;
    for (std::size_t n = 0; n < count; ++n) {
        glm::dmat4 to_patient = organ.to_patient();
        if (!boxes[n].is_empty()) to_patient[3] = glm::dvec4(organ.centre_mm(boxes[n].least), 1.0);
        parts.emplace_back(std::move(masks[n]), to_patient);
    }
    return parts;
}

} // namespace

mesh::TriangleMesh surface_of_boxes(const Organ& voxels) {
    mesh::TriangleMesh mesh;
    BoxCorners corners(voxels, mesh);
    const bool mirrored = volume::mirrors(voxels.to_patient());
    voxels.for_voxels([&](const glm::ivec3& voxel, std::size_t) {
        for (int axis = 0; axis < 3; ++axis)
            for (int side = 0; side < 2; ++side) {
                glm::ivec3 next = voxel, u(0), v(0), base = voxel;
                next[axis] += side == 1 ? 1 : -1;
                if (voxels.mask().test(next)) continue;
                base[axis] += side;
                u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1;
                if ((side == 0) != mirrored) std::swap(u, v);
                const std::array<std::uint32_t, 4> ring{corners.vertex(base), corners.vertex(base + u),
                                                        corners.vertex(base + u + v), corners.vertex(base + v)};
                mesh.triangles.push_back({ring[0], ring[1], ring[2]});
                mesh.triangles.push_back({ring[0], ring[2], ring[3]});
            }
    });
    return mesh;
}

namespace {

Organ samples_of(const measure::MeshDistance& closed) {
    constexpr int kSamples = 32;
    const measure::MeshDistance::Box& box = closed.bounds();
    const glm::dvec3 sides = box.size();
    const double step = std::max(std::max({sides.x, sides.y, sides.z}) / kSamples, 1e-9);
    volume::BitMask mask(glm::ivec3(glm::ceil(sides / step)) + 1);
    const glm::dmat4 to_patient = glm::scale(glm::translate(glm::dmat4(1.0), box.least + 0.5 * step), glm::dvec3(step));
    for (int k = 0; k < mask.size().z; ++k)
        for (int j = 0; j < mask.size().y; ++j)
            for (int i = 0; i < mask.size().x; ++i)
                if (closed.inside(glm::dvec3(to_patient * glm::dvec4(i, j, k, 1.0)))) mask.set({i, j, k});
    return Organ(std::move(mask), to_patient);
}

} // namespace

VoxelSolid::VoxelSolid(Organ voxels)
    : surface_(surface_of_boxes(voxels)), to_surface_(surface_), voxels_(std::move(voxels)),
      to_voxels_(glm::inverse(voxels_.to_patient())) {}

VoxelSolid::VoxelSolid(mesh::TriangleMesh closed)
    : surface_(std::move(closed)), to_surface_(surface_), voxels_(samples_of(to_surface_)),
      to_voxels_(glm::inverse(voxels_.to_patient())), of_boxes_(false) {}

bool VoxelSolid::contains(const glm::dvec3& point) const {
    if (!of_boxes_) return to_surface_.inside(point);
    const glm::dvec3 index(to_voxels_ * glm::dvec4(point, 1.0));
    return voxels_.mask().test(glm::ivec3(glm::floor(index + 0.5)));
}

double VoxelSolid::distance(const glm::dvec3& point) const {
    return contains(point) ? 0.0 : to_surface_.surface_distance(point);
}

std::shared_ptr<const VoxelSolid> solid_of(const Organ& organ, std::span<const std::uint8_t> chosen) {
    const auto part_of = [&](std::size_t number) { return chosen.empty() || chosen[number] != 0 ? 0 : kNoPart; };
    std::vector<Organ> parts = cropped_parts(organ, 1, part_of);
    return parts.front().count() == 0 ? nullptr : std::make_shared<const VoxelSolid>(std::move(parts.front()));
}

std::vector<std::uint8_t> lost_voxels(std::span<const SystemSupply> systems, std::span<const measure::LostSpan> spans) {
    std::size_t voxels = 0;
    for (const SystemSupply& system : systems) voxels = std::max(voxels, system.branch.size());
    std::vector<std::uint8_t> lost(voxels, 0);
    if (spans.empty()) return lost;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, lost.size()), [&](const auto& range) {
        for (std::size_t voxel = range.begin(); voxel < range.end(); ++voxel)
            lost[voxel] =
                std::ranges::any_of(systems, [&](const SystemSupply& system) { return is_lost(system, spans, voxel); });
    });
    return lost;
}

std::vector<std::shared_ptr<const VoxelSolid>> solids_of(const Organ& organ, std::span<const int> parts,
                                                         std::size_t count) {
    std::vector<std::shared_ptr<const VoxelSolid>> solids;
    for (Organ& part : cropped_parts(organ, count, [&](std::size_t number) { return parts[number]; }))
        solids.push_back(std::make_shared<const VoxelSolid>(std::move(part)));
    return solids;
}

std::vector<VoxelLesion> lesions_of(const Organ& mask, const std::string& name) {
    const std::vector<std::uint32_t> numbers = parts_of_voxels(mask);
    const std::vector<int> parts(numbers.begin(), numbers.end());
    const std::size_t count = parts.empty() ? 0 : 1 + static_cast<std::size_t>(*std::ranges::max_element(parts));
    std::vector<VoxelLesion> lesions;
    for (std::shared_ptr<const VoxelSolid>& solid : solids_of(mask, parts, count))
        lesions.push_back({count == 1 ? name : name + ' ' + std::to_string(lesions.size() + 1), std::move(solid)});
    return lesions;
}

} // namespace ramus::organ
