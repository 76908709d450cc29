#include "core/organ/resect/removal.h"

#include "core/organ/resect/box_share.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <utility>

namespace ramus::organ {

namespace {

constexpr int kLeafSide = 4; // voxels of a small block along an axis

// A small block of voxels, and the resections whose surface may pass through it, as bits.
struct Leaf {
    glm::ivec3 from{0}, to{0};
    std::uint64_t near = 0;
};

// What a small block adds.
struct LeafResult {
    double removed = 0.0; // voxels
    SurfacePieces pieces;
};

// The tightest box of voxels around an organ: [least, most].
Bounds<glm::ivec3> box_of_voxels(const Organ& organ) {
    Bounds<glm::ivec3> box;
    for (int k = 0; k < organ.size().z; ++k)
        for (int j = 0; j < organ.size().y; ++j) {
            const auto row = organ.mask().row(j, k);
            for (std::size_t w = 0; w < row.size(); ++w) {
                if (row[w] == 0) continue;
                const int first = static_cast<int>(64 * w) - 1;
                box.hold({first + std::countr_zero(row[w]), j, k});
                box.hold({first + 63 - std::countl_zero(row[w]), j, k});
            }
        }
    return box;
}

class Removing {
public:
    Removing(const Organ& organ, std::span<const Resection> resections, const JobRange& job)
        : organ_(organ), resections_(resections), job_(job), axes_(organ.to_patient()) {
        half_diagonal_ = 0.5 * longest(glm::dvec3(1.0));
    }

    Result<Removal> run() {
        Removal removal;
        removal.kept.assign(organ_.count(), 1.0F);
        const Bounds<glm::ivec3> box = box_of_voxels(organ_);
        if (box.is_empty() || resections_.empty()) return removal;
        Bounds<glm::dvec3> in_mm;
        for (int corner = 0; corner < 8; ++corner)
            in_mm.hold(place(glm::dvec3(box.least) - 0.5 +
                             (unit_corner(corner) + 0.5) * glm::dvec3(box.most - box.least + 1)));
        for (const Resection& resection : resections_) steepest_.push_back(steepest_in(resection, in_mm));
        const std::uint64_t all = ~std::uint64_t{0} >> (kMostResections - resections_.size());
        Found found = look(box.least, box.most + 1, all, removal.kept);
        removal.removed_voxels = static_cast<double>(found.whole);
        std::vector<LeafResult> results(found.leaves.size());
        tbb::parallel_for(std::size_t{0}, results.size(), [&](std::size_t n) {
            if (!job_.cancelled()) results[n] = result_of(found.leaves[n], removal.kept);
        });
        job_.report(0.8F);
        if (job_.cancelled()) return fail("cancelled");
        std::vector<SurfacePieces> pieces;
        pieces.reserve(results.size());
        for (LeafResult& result : results) {
            removal.removed_voxels += result.removed;
            pieces.push_back(std::move(result.pieces));
        }
        removal.surface = surface_of(organ_, resections_, pieces);
        removal.area_mm2 = area_mm2(removal.surface);
        job_.report(1.0F);
        return removal;
    }

private:
    struct Found {
        std::size_t whole = 0; // voxels that are removed whole
        std::vector<Leaf> leaves;
    };

    [[nodiscard]] glm::dvec3 place(const glm::dvec3& index) const {
        return glm::dvec3(organ_.to_patient() * glm::dvec4(index, 1.0));
    }
    // The longest diagonal of a box with these sides, in voxels.
    [[nodiscard]] double longest(const glm::dvec3& sides) const {
        double length = 0.0;
        for (const glm::dvec3 way : {glm::dvec3(1, 1, 1), {-1, 1, 1}, {1, -1, 1}, {1, 1, -1}})
            length = std::max(length, glm::length(axes_ * (way * sides)));
        return length;
    }

    // Halves blocks. Sets voxels that are removed whole, and returns the small blocks that the surface may cross.
    Found look(const glm::ivec3& from, const glm::ivec3& to, std::uint64_t near, std::vector<float>& kept) const {
        Found found;
        if (job_.cancelled()) return found;
        const glm::ivec3 sides = to - from;
        const glm::dvec3 middle = place(0.5 * glm::dvec3(from + to - 1));
        const double reach = 0.5 * longest(glm::dvec3(sides)) * (1.0 + 1e-9);
        std::uint64_t still = 0;
        for (std::uint64_t left = near; left != 0; left &= left - 1) {
            const auto n = static_cast<std::size_t>(std::countr_zero(left));
            const double value = value_at(resections_[n], middle);
            if (std::abs(value) <= steepest_[n] * reach) {
                still |= std::uint64_t{1} << n;
            } else if (divides_by_voxel(n)) {
                found.whole += set_by_voxel(n, from, to, kept);
            } else if (value <= 0.0) {
                found.whole += set_removed(from, to, kept);
                return found;
            }
        }
        if (still == 0) return found;
        if (glm::all(glm::lessThanEqual(sides, glm::ivec3(kLeafSide)))) {
            found.leaves.push_back({from, to, still});
            return found;
        }
        const int axis = sides.x >= sides.y && sides.x >= sides.z ? 0 : sides.y >= sides.z ? 1 : 2;
        glm::ivec3 end = to, begin = from;
        end[axis] = begin[axis] = from[axis] + std::max(kLeafSide, sides[axis] / (2 * kLeafSide) * kLeafSide);
        Found first, second;
        const auto look_first = [&] { first = look(from, end, still, kept); };
        const auto look_second = [&] { second = look(begin, to, still, kept); };
        constexpr int kWorthAThread = 32768; // voxels
        if (sides.x * sides.y * sides.z < kWorthAThread) {
            look_first();
            look_second();
        } else {
            tbb::parallel_invoke(look_first, look_second);
        }
        found.whole += first.whole + second.whole;
        found.leaves = std::move(first.leaves);
        found.leaves.insert(found.leaves.end(), second.leaves.begin(), second.leaves.end());
        return found;
    }

    // Whether the voxels of a block may be on both sides though no surface passes between them: in two arms of an organ
    // that an open surface divides.
    [[nodiscard]] bool divides_by_voxel(std::size_t n) const {
        const auto* cut = std::get_if<SurfaceCut>(&resections_[n]);
        return cut != nullptr && !cut->surface->is_closed();
    }
    std::size_t set_by_voxel(std::size_t n, const glm::ivec3& from, const glm::ivec3& to,
                             std::vector<float>& kept) const {
        const auto& cut = std::get<SurfaceCut>(resections_[n]);
        std::size_t count = 0;
        organ_.for_voxels(from, to, [&](const glm::ivec3& voxel, std::size_t number) {
            if (cut.surface->negative(voxel) == cut.other_side || kept[number] == 0.0F) return;
            kept[number] = 0.0F;
            ++count;
        });
        return count;
    }
    std::size_t set_removed(const glm::ivec3& from, const glm::ivec3& to, std::vector<float>& kept) const {
        std::size_t count = 0;
        organ_.for_voxels(from, to, [&](const glm::ivec3&, std::size_t number) {
            count += kept[number] == 0.0F ? 0 : 1;
            kept[number] = 0.0F;
        });
        return count;
    }

    // The value of one resection at the corners of the voxels of a small block.
    struct Samples {
        std::size_t resection = 0;
        std::array<double, (kLeafSide + 1) * (kLeafSide + 1) * (kLeafSide + 1)> values{};
        [[nodiscard]] static std::size_t index(const glm::ivec3& corner) {
            return static_cast<std::size_t>(corner.x + (kLeafSide + 1) * (corner.y + (kLeafSide + 1) * corner.z));
        }
        [[nodiscard]] CornerValues around(const glm::ivec3& voxel) const {
            CornerValues corners{};
            for (int c = 0; c < 8; ++c)
                corners[static_cast<std::size_t>(c)] = values[index(voxel + glm::ivec3(c & 1, c >> 1 & 1, c >> 2 & 1))];
            return corners;
        }
    };

    [[nodiscard]] std::vector<Samples> samples_of(const Leaf& leaf) const {
        std::vector<Samples> all;
        for (std::uint64_t left = leaf.near; left != 0; left &= left - 1) {
            Samples& samples = all.emplace_back();
            samples.resection = static_cast<std::size_t>(std::countr_zero(left));
            const glm::ivec3 corners = leaf.to - leaf.from;
            for (int k = 0; k <= corners.z; ++k)
                for (int j = 0; j <= corners.y; ++j)
                    for (int i = 0; i <= corners.x; ++i) {
                        const glm::ivec3 corner(i, j, k);
                        samples.values[Samples::index(corner)] =
                            value_at(resections_[samples.resection], place(glm::dvec3(leaf.from + corner) - 0.5));
                    }
        }
        return all;
    }

    // A resection whose surface passes through a voxel.
    struct Crossing {
        std::size_t resection = 0;
        unsigned removed = 0; // corners, as bits
        Linear fit;
        bool flat = true; // the fit is near the values
    };

    [[nodiscard]] LeafResult result_of(const Leaf& leaf, std::vector<float>& kept) const {
        LeafResult result;
        std::size_t count = 0;
        organ_.for_voxels(leaf.from, leaf.to, [&](const glm::ivec3&, std::size_t) { ++count; });
        if (count == 0) return result;
        const std::vector<Samples> all = samples_of(leaf);
        std::vector<Crossing> crossing;
        organ_.for_voxels(leaf.from, leaf.to, [&](const glm::ivec3& voxel, std::size_t number) {
            if (kept[number] == 0.0F) return;
            crossing.clear();
            bool whole = false;
            for (const Samples& samples : all) {
                const Crossing one = crossing_of(samples, samples.around(voxel - leaf.from), voxel);
                const bool mixed = one.removed != 0 && one.removed != 0xFFU;
                if (mixed || !one.flat)
                    crossing.push_back(one);
                else
                    whole = whole || one.removed == 0xFFU;
            }
            if (whole || !crossing.empty()) {
                const double removed = whole ? 1.0 : share_of(crossing, voxel);
                result.removed += removed;
                kept[number] = static_cast<float>(1.0 - removed);
            }
            if (!whole) add_pieces(crossing, voxel, result.pieces);
        });
        return result;
    }

    [[nodiscard]] Crossing crossing_of(const Samples& samples, const CornerValues& values,
                                       const glm::ivec3& voxel) const {
        Crossing one{samples.resection, removed_corners(values), linear_through(values)};
        const Resection& resection = resections_[samples.resection];
        const bool mixed = one.removed != 0 && one.removed != 0xFFU;
        if (std::holds_alternative<HalfSpace>(resection)) return one;
        if (std::holds_alternative<Sheet>(resection) ? !mixed : std::abs(one.fit.middle) > 2.0 * half_diagonal_)
            return one;
        const double centre = value_at(resection, place(glm::dvec3(voxel)));
        const double most = 0.1 * half_diagonal_; // tuned: less changes no volume by 0.01 %
        const auto* around = std::get_if<Around>(&resection);
        one.flat = std::abs(centre - one.fit.middle) <= most && (around == nullptr || around->margin_mm > 0.0);
        for (int corner = 0; corner < 8; ++corner)
            one.flat = one.flat &&
                       std::abs(one.fit.at(unit_corner(corner)) - values[static_cast<std::size_t>(corner)]) <= most;
        // The mean over the box, by Simpson's rule, is that of a curved surface, too.
        one.fit.middle = (one.fit.middle + 2.0 * centre) / 3.0;
        return one;
    }

    // The share of a voxel that is removed.
    [[nodiscard]] double share_of(const std::vector<Crossing>& crossing, const glm::ivec3& voxel) const {
        if (crossing.size() == 1 && crossing.front().flat) return share_below(crossing.front().fit);
        // Samples along an axis: fewer where each takes a search.
        const int side = std::ranges::all_of(crossing, &Crossing::flat) ? 6 : 4;
        int removed = 0;
        for (int n = 0; n < side * side * side; ++n) {
            const glm::dvec3 at = (glm::dvec3(n % side, n / side % side, n / (side * side)) + 0.5) / double(side) - 0.5;
            removed += std::ranges::any_of(crossing, [&](const Crossing& one) {
                return one.flat ? one.fit.at(at) <= 0.0
                                : removes(resections_[one.resection], place(glm::dvec3(voxel) + at));
            });
        }
        return removed / double(side * side * side);
    }

    // Adds the surface in a voxel.
    void add_pieces(const std::vector<Crossing>& crossing, const glm::ivec3& voxel, SurfacePieces& pieces) const {
        for (const Crossing& one : crossing)
            if (crossing.size() == 1)
                pieces.add_cell(organ_, voxel, one.removed, one.resection);
            else
                pieces.add_clipped(organ_, resections_, voxel, one.resection);
    }

    const Organ& organ_;
    std::span<const Resection> resections_;
    const JobRange& job_;
    glm::dmat3 axes_;
    double half_diagonal_ = 0.0;   // of a voxel, mm
    std::vector<double> steepest_; // by resection
};

} // namespace

Result<Removal> remove_from(const Organ& organ, std::span<const Resection> resections, const JobRange& job) {
    return Removing(organ, resections, job).run();
}

} // namespace ramus::organ
