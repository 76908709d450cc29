#include "core/validate/overlap.h"

#include "core/base/bounds.h"
#include "core/measure/deviation/packed_triangles.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <oneapi/tbb/parallel_for.h>
#include <span>
#include <vector>

namespace ramus::validate {

namespace {

// Rays along rows of voxels, with a tiny offset from the voxel centres, which may lie on edges of triangles.
constexpr std::array<glm::dvec3, 3> kRayOffsets{
    {{0.0, 1.7e-5, 2.9e-5}, {0.0, -3.1e-5, 1.3e-5}, {0.0, 2.3e-5, -1.9e-5}}};

class Rows {
public:
    Rows(const mesh::TriangleMesh& surface, const volume::BitMask& mask, const glm::dmat4& to_patient)
        : triangles_(surface), mask_(mask), to_patient_(to_patient), along_(glm::length(glm::dvec3(to_patient[0]))) {
        const glm::dmat4 to_voxels = glm::inverse(to_patient);
        Bounds<glm::dvec3> box;
        for (const glm::vec3& at : surface.positions) box.hold(glm::dvec3(to_voxels * glm::dvec4(at, 1.0)));
        first_ = glm::ivec3(glm::floor(box.least)) - 1;
        last_ = glm::ivec3(glm::ceil(box.most)) + 1;
    }
    [[nodiscard]] const glm::ivec3& first() const { return first_; }
    [[nodiscard]] const glm::ivec3& last() const { return last_; }

    // Counts the voxels of a row that are inside the surface, and those that are also in the mask.
    void count(int j, int k, std::uint64_t& inside, std::uint64_t& both) const {
        thread_local std::vector<measure::Crossing> found;
        const glm::dvec3 way = glm::dvec3(to_patient_[0]) / along_;
        for (const glm::dvec3& offset : kRayOffsets) {
            const glm::dvec3 from(to_patient_ * glm::dvec4(glm::dvec3(first_.x, j, k) + offset, 1.0));
            triangles_.crossings(from, way, along_ * (last_.x - first_.x), found);
            int turns = 0;
            for (const measure::Crossing& crossing : found) turns += crossing.out ? -1 : 1;
            if (turns == 0) break; // else the ray has missed one of two triangles at their edge
        }
        int turns = 0;
        double begin = 0.0;
        for (const measure::Crossing& crossing : found) {
            const int before = turns;
            turns += crossing.out ? -1 : 1;
            const double at = first_.x + crossing.at / along_;
            if (before == 0) begin = at;
            if (turns == 0) take(begin, at, j, k, inside, both);
        }
    }

private:
    void take(double begin, double end, int j, int k, std::uint64_t& inside, std::uint64_t& both) const {
        const int from = static_cast<int>(std::ceil(begin)), to = static_cast<int>(std::floor(end));
        for (int i = from; i <= to; ++i) {
            ++inside;
            if (mask_.test({i, j, k})) ++both;
        }
    }

    measure::PackedTriangles triangles_;
    const volume::BitMask& mask_;
    glm::dmat4 to_patient_;
    double along_; // mm of a voxel along its rows
    glm::ivec3 first_{0}, last_{0};
};

} // namespace

double Overlap::dice() const {
    return mask + surface == 0 ? 0.0 : 2.0 * static_cast<double>(both) / static_cast<double>(mask + surface);
}

Result<Overlap> overlap_of(const mesh::TriangleMesh& surface, const volume::BitMask& mask, const glm::dmat4& to_patient,
                           Job& job) {
    const Rows rows(surface, mask, to_patient);
    Overlap overlap;
    overlap.mask = mask.count();
    overlap.voxel_mm3 = std::abs(glm::determinant(glm::dmat3(to_patient)));
    std::atomic<std::uint64_t> all_inside = 0, all_both = 0;
    std::atomic<int> done = 0;
    tbb::parallel_for(rows.first().z, rows.last().z + 1, [&](int k) {
        if (job.cancelled()) return;
        std::uint64_t inside = 0, both = 0;
        for (int j = rows.first().y; j <= rows.last().y; ++j) rows.count(j, k, inside, both);
        all_inside += inside, all_both += both;
        job.report(static_cast<float>(++done) / static_cast<float>(rows.last().z - rows.first().z + 1));
    });
    if (job.cancelled()) return fail("cancelled");
    overlap.surface = all_inside, overlap.both = all_both;
    return overlap;
}

} // namespace ramus::validate
