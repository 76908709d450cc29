#include "core/organ/resect/dividing_surface.h"

#include "core/mesh/close_mesh.h"

#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <oneapi/tbb/parallel_invoke.h>
#include <utility>

namespace ramus::organ {

namespace {

constexpr std::uint8_t kNoSide = 2;

} // namespace

DividingSurface::DividingSurface(mesh::TriangleMesh mesh, const Organ& organ)
    : mesh_(std::move(mesh)), triangles_(mesh_), distance_(mesh_), closed_(mesh::check_closed(mesh_, {}).has_value()),
      voxels_(closed_ ? volume::BitMask(glm::ivec3(0)) : organ.mask()), to_patient_(organ.to_patient()),
      to_voxels_(glm::inverse(to_patient_)) {}

Result<std::shared_ptr<const DividingSurface>> DividingSurface::of(mesh::TriangleMesh mesh, const Organ& organ,
                                                                   const JobRange& job) {
    std::shared_ptr<DividingSurface> made(new DividingSurface(std::move(mesh), organ));
    if (!made->closed_)
        if (auto found = made->find_sides(job); !found) return tl::unexpected(found.error());
    return made;
}

double DividingSurface::value_at(const glm::dvec3& point) const {
    const double distance = distance_.surface_distance(point);
    if (closed_) return distance_.inside(point) ? -distance : distance;
    const glm::ivec3 nearest(glm::floor(glm::dvec3(to_voxels_ * glm::dvec4(point, 1.0)) + 0.5));
    for (int ring = 0; ring < 2; ++ring) // the voxel itself, then its neighbours
        for (int n = 0; n < (ring == 0 ? 1 : 27); ++n) {
            const glm::ivec3 voxel = ring == 0 ? nearest : nearest + glm::ivec3(n % 3, n / 3 % 3, n / 9) - 1;
            if (!voxels_.test(voxel)) continue;
            const bool other = odd_crossings(point, reference(voxel));
            return negative(voxel) != other ? -distance : distance;
        }
    return distance;
}

bool DividingSurface::negative(const glm::ivec3& voxel) const {
    if (closed_) return distance_.inside(glm::dvec3(to_patient_ * glm::dvec4(glm::dvec3(voxel), 1.0)));
    return sides_[cell(voxel)] == smaller_;
}

std::size_t DividingSurface::cell(const glm::ivec3& voxel) const {
    const glm::ivec3& size = voxels_.size();
    return static_cast<std::size_t>(voxel.x) +
           static_cast<std::size_t>(size.x) * (static_cast<std::size_t>(voxel.y) +
                                               static_cast<std::size_t>(size.y) * static_cast<std::size_t>(voxel.z));
}

// The place whose side a voxel has: a little off its centre, through which meshes of modelled planes often pass.
glm::dvec3 DividingSurface::reference(const glm::ivec3& voxel) const {
    constexpr glm::dvec3 kOff(0.00037, 0.00061, 0.00053);
    return glm::dvec3(to_patient_ * glm::dvec4(glm::dvec3(voxel) + kOff, 1.0));
}

bool DividingSurface::odd_crossings(const glm::dvec3& from, const glm::dvec3& to) const {
    const double length = glm::distance(from, to);
    if (length == 0.0) return false;
    std::vector<measure::Crossing> found;
    triangles_.crossings(from, (to - from) / length, length, found);
    return found.size() % 2 == 1;
}

// Halves blocks of voxels until the mesh is far from them, or they are small.
void DividingSurface::cross_links_in(const glm::ivec3& from, const glm::ivec3& to) {
    const glm::dvec3 half = 0.5 * glm::dvec3(to - from); // with half a link on each side
    const glm::dvec3 middle(to_patient_ * glm::dvec4(glm::dvec3(from) + half, 1.0));
    const glm::dmat3 axes(to_patient_);
    const double reach = glm::length(axes[0]) * (half.x + 1.0) + glm::length(axes[1]) * (half.y + 1.0) +
                         glm::length(axes[2]) * (half.z + 1.0);
    if (distance_.surface_distance(middle) > reach) return;
    const glm::ivec3 sides = to - from;
    constexpr int kSmall = 4;
    if (glm::all(glm::lessThanEqual(sides, glm::ivec3(kSmall)))) {
        for (int k = from.z; k < to.z; ++k)
            for (int j = from.y; j < to.y; ++j)
                for (int i = from.x; i < to.x; ++i) {
                    const glm::ivec3 voxel(i, j, k);
                    if (!voxels_.test(voxel)) continue;
                    for (int axis = 0; axis < 3; ++axis) {
                        glm::ivec3 next = voxel;
                        ++next[axis];
                        if (voxels_.test(next) && odd_crossings(reference(voxel), reference(next)))
                            links_[cell(voxel)] |= static_cast<std::uint8_t>(1U << static_cast<unsigned>(axis));
                    }
                }
        return;
    }
    const int axis = sides.x >= sides.y && sides.x >= sides.z ? 0 : sides.y >= sides.z ? 1 : 2;
    glm::ivec3 end = to, begin = from;
    end[axis] = begin[axis] = (from[axis] + to[axis]) / 2;
    tbb::parallel_invoke([&, end] { cross_links_in(from, end); }, [&, begin] { cross_links_in(begin, to); });
}

// Gives a side to all voxels of the organ that are connected with `first`.
void DividingSurface::spread_from(const glm::ivec3& first, std::uint8_t side, bool& divides) {
    std::vector<glm::ivec3> open{first};
    sides_[cell(first)] = side;
    while (!open.empty()) {
        const glm::ivec3 voxel = open.back();
        open.pop_back();
        for (int axis = 0; axis < 3; ++axis)
            for (const int way : {-1, 1}) {
                glm::ivec3 next = voxel;
                next[axis] += way;
                if (!voxels_.test(next)) continue;
                const unsigned crossed = links_[cell(way > 0 ? voxel : next)] >> static_cast<unsigned>(axis) & 1U;
                const auto expected = static_cast<std::uint8_t>(sides_[cell(voxel)] ^ crossed);
                std::uint8_t& known = sides_[cell(next)];
                if (known == kNoSide) {
                    known = expected;
                    open.push_back(next);
                }
                divides = divides && known == expected;
            }
    }
}

Result<void> DividingSurface::find_sides(const JobRange& job) {
    const glm::ivec3& size = voxels_.size();
    links_.assign(volume::voxel_count(size), 0);
    sides_.assign(links_.size(), kNoSide);
    cross_links_in(glm::ivec3(0), size);
    if (job.cancelled()) return fail("cancelled");
    job.report(0.7F);
    std::array<std::size_t, 2> counts{};
    bool divides = true, any = false;
    glm::ivec3 first(0);
    for (int k = 0; k < size.z && divides; ++k)
        for (int j = 0; j < size.y && divides; ++j)
            for (int i = 0; i < size.x && divides; ++i) {
                const glm::ivec3 voxel(i, j, k);
                if (!voxels_.test(voxel)) continue;
                std::uint8_t& side = sides_[cell(voxel)];
                // The part's side: that of its first voxel, as seen from the first voxel of all.
                if (side == kNoSide)
                    spread_from(voxel, any && odd_crossings(reference(first), reference(voxel)) ? 1 : 0, divides);
                if (!any) first = voxel;
                any = true;
                ++counts[side];
            }
    if (job.cancelled()) return fail("cancelled");
    if (!divides)
        return fail("the surface ends inside the organ, and does not divide it", {},
                    "extend the surface beyond the organ's border, or close it");
    if (counts[0] == 0 || counts[1] == 0)
        return fail("the surface does not divide the organ: all of the organ is on one side", {},
                    "check that both are of one patient, and the axes of the mesh");
    smaller_ = counts[0] <= counts[1] ? 0 : 1;
    links_ = {};
    return {};
}

} // namespace ramus::organ
