#include "core/volume/isosurface.h"

#include "core/base/disk_pages.h"
#include "core/base/memory.h"
#include "core/base/run_limited.h"
#include "core/volume/slab_mesher.h"
#include "core/volume/smooth_level.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>

namespace ramus::volume {

namespace {

struct Midway {
    static constexpr double kLeast = 0.5; // least distance of a vertex from a voxel centre, in voxels
    [[nodiscard]] double at(int, const glm::ivec3&) const { return 0.5; }
};

// The position of the isovalue by linear interpolation between two voxels.
template <class Values> struct Interpolated {
    // Otherwise all vertices around a voxel with exactly the isovalue would coincide.
    static constexpr double kLeast = 1.0 / 256.0;
    const Volume& volume;
    const Values& values;
    double isovalue;

    [[nodiscard]] double at(int axis, const glm::ivec3& voxel) const {
        glm::ivec3 next = voxel;
        ++next[axis];
        if (voxel[axis] < 0 || next[axis] >= volume.size[axis]) return 0.5; // no value beyond the border
        const double here = value(voxel);
        return std::clamp((isovalue - here) / (value(next) - here), kLeast, 1.0 - kLeast);
    }
    [[nodiscard]] double value(const glm::ivec3& v) const {
        const auto x = static_cast<std::size_t>(volume.size.x);
        const auto y = static_cast<std::size_t>(volume.size.y);
        return static_cast<double>(values[static_cast<std::size_t>(v.x) +
                                          x * (static_cast<std::size_t>(v.y) + y * static_cast<std::size_t>(v.z))]);
    }
};

// The position of level 0 between two voxels.
struct Smoothed {
    static constexpr double kLeast = 1.0 / 64.0; // far more than the rounding of single precision, and not visible
    const SmoothLevel& level;

    [[nodiscard]] double at(int axis, const glm::ivec3& voxel) const {
        glm::ivec3 next = voxel;
        ++next[axis];
        const double here = level.value(voxel);
        return std::clamp(here / (here - level.value(next)), kLeast, 1.0 - kLeast);
    }
};

// Fails if the resolution of single precision, which meshes use, is too low at the position of the volume.
Result<void> check_precision(const glm::ivec3& size, const glm::dmat4& to_patient, double least) {
    double farthest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 voxel((corner & 1) != 0 ? size.x : -1, (corner & 2) != 0 ? size.y : -1,
                               (corner & 4) != 0 ? size.z : -1, 1.0);
        const glm::dvec3 place(to_patient * voxel);
        for (int axis = 0; axis < 3; ++axis) farthest = std::max(farthest, std::abs(place[axis]));
    }
    const glm::dvec3 spacing = spacing_mm(to_patient);
    const double widest =
        std::max({spacing.x * spacing.y, spacing.y * spacing.z, spacing.z * spacing.x}); // largest face of a voxel
    const double step = farthest * static_cast<double>(std::numeric_limits<float>::epsilon());
    if (4.0 * step < least * voxel_volume_mm3(to_patient) / widest) return {};
    return fail("its voxels are too small, or too far from the origin, for single precision", {},
                "check the unit of length, or move the volume to the origin");
}

template <class Crossing>
Result<mesh::TriangleMesh> make(const BitMask& mask, const glm::dmat4& to_patient, Crossing crossing,
                                const IsosurfaceOptions& options, const JobRange& job) {
    if (auto precise = check_precision(mask.size(), to_patient, Crossing::kLeast); !precise)
        return tl::unexpected(precise.error());
    SlabMesher mesher(mask, to_patient, std::move(crossing), job);
    mesher.count();
    if (job.cancelled()) return fail("cancelled");
    if (mesher.vertices() > std::numeric_limits<std::uint32_t>::max())
        return fail("the surface has more vertices than a mesh can count", {}, "crop the volume");
    const double bytes = 2.0 * sizeof(glm::vec3) * static_cast<double>(mesher.vertices()) +
                         sizeof(glm::uvec3) * static_cast<double>(mesher.triangles());
    const double left = memory_left(options.memory_bytes);
    if (bytes <= left) return mesher.make({});
    if (const double least = options.target.empty() ? bytes : DiskPages::kLeastLeft; least > left)
        return fail(takes_too_much("the surface", least, left), {}, "crop the volume, or raise --memory");
    const auto pages = std::make_shared<DiskPages>(options.target, memory_limit(options.memory_bytes));
    auto mesh = mesher.make(LargeAllocator<std::byte>(pages));
    pages->release_resident();
    return mesh;
}

Result<mesh::TriangleMesh> of_labels(const BitMask& mask, const glm::dmat4& to_patient,
                                     const IsosurfaceOptions& options, const JobRange& job) {
    if (options.steps == VoxelSteps::kKept) return make(mask, to_patient, Midway{}, options, job);
    RAMUS_TRY(level, smooth_level(mask, spacing_mm(to_patient), options.memory_bytes, job.part(0.0F, 0.7F)));
    return make(mask, to_patient, Smoothed{level}, options, job.part(0.7F, 1.0F));
}

Error at_memory_end() { return {"not enough memory for this surface", {}, "crop the volume"}; }

// Calls `done_with_values` once the values are not needed any more, if that is before the mesh is built.
template <class Done>
Result<mesh::TriangleMesh> surface_of(const Volume& volume, const Selection& selection,
                                      const IsosurfaceOptions& options, Job& job, const Done& done_with_values) {
    return run_limited(options.threads, at_memory_end, [&]() -> Result<mesh::TriangleMesh> {
        RAMUS_TRY(mask, inside(volume, selection, JobRange(job, 0.0F, 0.3F)));
        const JobRange rest(job, 0.3F, 1.0F);
        if (const auto isovalue = isovalue_of(volume, selection)) {
            return std::visit(
                [&]<class Values>(const Values& values) {
                    return make(mask, volume.to_patient, Interpolated<Values>{volume, values, *isovalue}, options,
                                rest);
                },
                volume.voxels);
        }
        done_with_values();
        return of_labels(mask, volume.to_patient, options, rest);
    });
}

} // namespace

Result<mesh::TriangleMesh> isosurface(const Volume& volume, const Selection& selection,
                                      const IsosurfaceOptions& options, Job& job) {
    return surface_of(volume, selection, options, job, [] {});
}

Result<mesh::TriangleMesh> isosurface(Volume&& volume, const Selection& selection, const IsosurfaceOptions& options,
                                      Job& job) {
    Volume taken = std::move(volume);
    return surface_of(taken, selection, options, job, [&] { taken.voxels = Voxels(); });
}

Result<mesh::TriangleMesh> mask_surface(const BitMask& mask, const glm::dmat4& to_patient,
                                        const IsosurfaceOptions& options, Job& job) {
    return run_limited(options.threads, at_memory_end,
                       [&] { return of_labels(mask, to_patient, options, JobRange(job, 0.0F, 1.0F)); });
}

Result<void> check_mask_precision(const glm::ivec3& size, const glm::dmat4& to_patient) {
    return check_precision(size, to_patient, Midway::kLeast);
}

} // namespace ramus::volume
