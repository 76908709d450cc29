#include "core/organ/organ.h"

#include "core/base/disjoint_sets.h"

#include <algorithm>
#include <functional>
#include <glm/matrix.hpp>
#include <span>
#include <utility>

namespace ramus::organ {

Organ::Organ(volume::BitMask mask, const glm::dmat4& to_patient) : mask_(std::move(mask)), to_patient_(to_patient) {
    std::size_t count = 0;
    for (int k = 0; k < size().z; ++k)
        for (int j = 0; j < size().y; ++j) {
            row_starts_.push_back(count);
            for (const std::uint64_t word : std::as_const(mask_).row(j, k))
                count += static_cast<std::size_t>(std::popcount(word));
        }
    row_starts_.push_back(count);
}

double Organ::voxel_ml() const { return volume::voxel_volume_mm3(to_patient_) / 1000.0; }

Result<Organ> organ_of(const volume::Volume& volume, const volume::Selection& selection, const JobRange& job) {
    RAMUS_TRY(mask, volume::inside(volume, selection, job));
    return Organ(std::move(mask), volume.to_patient);
}

namespace {

// Voxels from..to-1 of a row.
struct Run {
    int from, to;
};

// Joins the sets of runs that have a voxel face in common. `a`, `b`: the runs of two rows, ascending; their numbers
// begin at `first_a` and `first_b`.
void join_rows(DisjointSets& sets, std::span<const Run> a, std::size_t first_a, std::span<const Run> b,
               std::size_t first_b) {
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        if (std::max(a[i].from, b[j].from) < std::min(a[i].to, b[j].to))
            (void)sets.join(static_cast<std::uint32_t>(first_a + i), static_cast<std::uint32_t>(first_b + j));
        if (a[i].to < b[j].to)
            ++i;
        else
            ++j;
    }
}

// The runs of an organ, row by row, and which of them touch by faces.
struct Runs {
    std::vector<Run> runs;
    std::vector<std::size_t> first; // by row: its first run; then the number of all runs
    DisjointSets sets;
};

Runs joined_runs(const Organ& organ) {
    Runs all;
    const glm::ivec3 size = organ.size();
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j) {
            all.first.push_back(all.runs.size());
            organ.for_voxels({0, j, k}, {size.x, j + 1, k + 1}, [&](const glm::ivec3& voxel, std::size_t) {
                if (all.runs.size() > all.first.back() && all.runs.back().to == voxel.x)
                    ++all.runs.back().to;
                else
                    all.runs.push_back({voxel.x, voxel.x + 1});
            });
        }
    all.first.push_back(all.runs.size());
    all.sets = DisjointSets(all.runs.size());
    const auto row = [&](std::size_t r) {
        return std::span(all.runs).subspan(all.first[r], all.first[r + 1] - all.first[r]);
    };
    const auto rows = static_cast<std::size_t>(size.y);
    for (std::size_t r = 0; r + 1 < all.first.size(); ++r) {
        if (r % rows > 0) join_rows(all.sets, row(r - 1), all.first[r - 1], row(r), all.first[r]);
        if (r >= rows) join_rows(all.sets, row(r - rows), all.first[r - rows], row(r), all.first[r]);
    }
    return all;
}

std::size_t length_of(const Run& run) { return static_cast<std::size_t>(run.to - run.from); }

// By run that represents its part: the part's voxels; 0 for other runs.
std::vector<std::size_t> voxels_by_part(Runs& all) {
    std::vector<std::size_t> voxels(all.runs.size(), 0);
    for (std::size_t n = 0; n < all.runs.size(); ++n)
        voxels[all.sets.find(static_cast<std::uint32_t>(n))] += length_of(all.runs[n]);
    return voxels;
}

} // namespace

std::vector<std::size_t> part_sizes(const Organ& organ) {
    Runs all = joined_runs(organ);
    std::vector<std::size_t> voxels = voxels_by_part(all);
    std::erase(voxels, std::size_t{0});
    std::ranges::sort(voxels, std::greater());
    return voxels;
}

std::vector<std::uint32_t> parts_of_voxels(const Organ& organ) {
    Runs all = joined_runs(organ);
    const std::vector<std::size_t> voxels = voxels_by_part(all);
    std::vector<std::uint32_t> order, place(all.runs.size(), 0);
    for (std::size_t n = 0; n < voxels.size(); ++n)
        if (voxels[n] > 0) order.push_back(static_cast<std::uint32_t>(n));
    std::ranges::stable_sort(order, std::greater(), [&](std::uint32_t part) { return voxels[part]; });
    for (std::size_t n = 0; n < order.size(); ++n) place[order[n]] = static_cast<std::uint32_t>(n);
    std::vector<std::uint32_t> parts;
    parts.reserve(organ.count());
    for (std::size_t n = 0; n < all.runs.size(); ++n)
        parts.insert(parts.end(), length_of(all.runs[n]), place[all.sets.find(static_cast<std::uint32_t>(n))]);
    return parts;
}

Organ largest_part(const Organ& organ) {
    const std::vector<std::uint32_t> parts = parts_of_voxels(organ);
    volume::BitMask mask(organ.size());
    organ.for_voxels([&](const glm::ivec3& voxel, std::size_t number) {
        if (parts[number] == 0) mask.set(voxel);
    });
    return {std::move(mask), organ.to_patient()};
}

} // namespace ramus::organ
