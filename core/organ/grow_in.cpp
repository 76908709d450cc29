#include "core/organ/grow_in.h"

#include "core/base/bounds.h"
#include "core/tree/grow/exact_math.h"
#include "core/tree/grow/organ.h"
#include "core/volume/skeletonize/distance_transform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace ramus::organ {

namespace {

using tree::growth::Vec;

constexpr double kUsualVolume = 1.5e6; // mm3 of the organ that the default options are for
constexpr std::size_t kLeastVoxels = 1000;

// How much longer or shorter everything is than in an organ of the usual volume.
double scale_of(const Organ& organ) { return tree::growth::cube_root(1000.0 * organ.volume_ml() / kUsualVolume); }

class MaskedOrgan final : public tree::growth::Organ {
public:
    explicit MaskedOrgan(const ramus::organ::Organ& organ)
        : set_(organ.mask(), volume::spacing_mm(organ.to_patient())), depths_(volume::distances_to_outside(set_)),
          to_voxel_(glm::inverse(organ.to_patient())) {
        volume_mm3_ = 1000.0 * organ.volume_ml();
        capsule_mm_ = std::min(1.0, scale_of(organ));
        const glm::dvec3 spacing = volume::spacing_mm(organ.to_patient());
        half_voxel_ = 0.5 * std::min({spacing.x, spacing.y, spacing.z});
        Bounds<glm::dvec3> box;
        organ.for_voxels([&](const glm::ivec3& voxel, std::size_t) {
            const Vec centre = organ.centre_mm(voxel);
            centroid_ += centre / static_cast<double>(organ.count());
            box.hold(centre - spacing);
            box.hold(centre + spacing);
        });
        low_ = box.least;
        high_ = box.most;
    }

    // Not negative exactly where the voxel that contains the point is of the organ.
    [[nodiscard]] double depth_mm(const Vec& point) const override {
        const glm::dvec3 at = glm::dvec3(to_voxel_ * glm::dvec4(point, 1.0)) - glm::dvec3(set_.origin());
        const glm::dvec3 most(set_.bits().size() - 2);
        for (int axis = 0; axis < 3; ++axis)
            if (!(at[axis] > 0.0 && at[axis] < most[axis] + 0.5)) return -1.0;
        if (!set_.test(set_.address(glm::ivec3(at + 0.5)))) return -1.0;
        const glm::ivec3 base(at);
        const glm::dvec3 share = at - glm::dvec3(base);
        double depth = 0.0;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::ivec3 side(corner & 1, corner >> 1 & 1, corner >> 2);
            const auto address = set_.address(base + side);
            if (!set_.test(address)) continue; // 0
            double weight = 1.0;
            for (int axis = 0; axis < 3; ++axis) weight *= side[axis] == 1 ? share[axis] : 1.0 - share[axis];
            depth += weight * static_cast<double>(depths_[set_.number(address)]);
        }
        return std::max(0.0, depth - half_voxel_);
    }

    // Chooses the stem and the trunks. False: there is no room for them.
    [[nodiscard]] bool enter(const ramus::organ::Organ& organ, double root_radius_mm, tree::growth::Random& random) {
        margin_ = root_radius_mm + capsule_mm_;
        return put_hilum(root_radius_mm) && put_trunks(organ, root_radius_mm, random);
    }

private:
    [[nodiscard]] Vec deepest() const {
        std::pair<float, volume::VoxelSet::Address> most{-1.0F, 0};
        set_.for_each([&](volume::VoxelSet::Address at) {
            if (const float depth = depths_[set_.number(at)]; depth > most.first) most = {depth, at};
        });
        return glm::dvec3(glm::inverse(to_voxel_) * glm::dvec4(glm::dvec3(set_.voxel(most.second)), 1.0));
    }

    // The hilum is where the way from the middle to the outside is shortest, and deep enough for the stem.
    [[nodiscard]] bool put_hilum(double root_radius_mm) {
        const Vec middle = depth_mm(centroid_) < margin_ ? deepest() : centroid_;
        const double step = half_voxel_;
        const double longest = glm::length(high_ - low_);
        double shortest = longest;
        Vec out(0.0);
        tree::growth::Random directions(1); // of the organ alone, the same for every seed
        constexpr int kDirections = 400;
        for (int n = 0; n < kDirections; ++n) {
            const Vec way = tree::growth::direction(Vec(0.0), directions.in_ball());
            double last = 0.0; // of the organ in this direction
            for (double away = 0.0; away < longest; away += step)
                if (depth_mm(middle + away * way) >= 0.0) last = away;
            if (last < shortest) shortest = last, out = way;
        }
        root_ = middle + (shortest + 4.0 * root_radius_mm) * out;
        for (double away = shortest; away >= 0.0; away -= step) {
            hilum_ = middle + away * out;
            if (depth_mm(hilum_) >= 1.25 * margin_) return true;
        }
        return false;
    }

    [[nodiscard]] bool clear(const Vec& from, const Vec& to) const {
        const double length = glm::length(to - from);
        const int steps = 1 + static_cast<int>(length / half_voxel_);
        for (int n = 0; n <= steps; ++n)
            if (depth_mm(from + (to - from) * (static_cast<double>(n) / steps)) < margin_) return false;
        return true;
    }

    // Centroids of the halves of the organ: of the longest direction across the stem.
    [[nodiscard]] std::array<Vec, 2> halves(const ramus::organ::Organ& organ) const {
        const Vec stem = tree::growth::direction(root_, hilum_);
        const Vec any = std::abs(stem.x) < 0.6 ? Vec(1, 0, 0) : Vec(0, 1, 0);
        const Vec first = glm::normalize(glm::cross(stem, any)), second = glm::cross(stem, first);
        double aa = 0.0, ab = 0.0, bb = 0.0;
        organ.for_voxels([&](const glm::ivec3& voxel, std::size_t) {
            const Vec from_middle = organ.centre_mm(voxel) - centroid_;
            const double a = glm::dot(from_middle, first), b = glm::dot(from_middle, second);
            aa += a * a, ab += a * b, bb += b * b;
        });
        // The direction of the larger eigenvalue.
        const double half = 0.5 * (aa - bb), root = std::sqrt(half * half + ab * ab);
        Vec along = half > 0.0 ? (half + root) * first + ab * second : ab * first + (root - half) * second;
        along = glm::dot(along, along) > 0.0 ? glm::normalize(along) : first;
        std::array<Vec, 2> sums{Vec(0.0), Vec(0.0)};
        std::array<double, 2> counts{0.0, 0.0};
        organ.for_voxels([&](const glm::ivec3& voxel, std::size_t) {
            const Vec centre = organ.centre_mm(voxel);
            const std::size_t side = glm::dot(centre - centroid_, along) > 0.0 ? 1 : 0;
            sums[side] += centre;
            ++counts[side];
        });
        return {sums[0] / std::max(1.0, counts[0]), sums[1] / std::max(1.0, counts[1])};
    }

    // Each trunk ends as near as possible to the middle of the way to the centroid of its half.
    [[nodiscard]] bool put_trunks(const ramus::organ::Organ& organ, double root_radius_mm,
                                  tree::growth::Random& random) {
        const Vec stem = tree::growth::direction(root_, hilum_);
        for (const Vec& half : halves(organ)) {
            const Vec aim = hilum_ + 0.5 * (half - hilum_),
                      jitter = 0.1 * glm::length(half - hilum_) * random.in_ball();
            std::optional<Vec> best;
            const auto consider = [&](const Vec& end) {
                const Vec way = tree::growth::direction(hilum_, end);
                const bool near = glm::length(end - hilum_) < 3.0 * root_radius_mm;
                const bool back = glm::dot(stem, way) < -0.2;
                const bool narrow =
                    !trunks_.empty() && glm::dot(tree::growth::direction(hilum_, trunks_[0].end), way) > 0.5;
                if (near || back || narrow || !clear(hilum_, end)) return;
                if (!best || glm::length(end - aim) < glm::length(*best - aim)) best = end;
            };
            consider(aim + jitter);
            constexpr int kThrows = 2000;
            for (int n = 0; n < kThrows && (!best || n < kThrows / 4); ++n)
                consider(hilum_ + glm::length(half - hilum_) * random.in_ball());
            if (!best) return false;
            trunks_.push_back({-1, *best});
        }
        return true;
    }

    volume::VoxelSet set_;
    LargeArray<float> depths_; // centre to centre of the nearest voxel outside
    glm::dmat4 to_voxel_;
    double half_voxel_ = 0.0; // mm, of the shortest side
    double margin_ = 0.0;     // of the trunks' axes to the surface
    Vec centroid_{0.0};
};

} // namespace

tree::GrowOptions grow_options_for(const Organ& organ) {
    const double scale = scale_of(organ);
    tree::GrowOptions options;
    options.organ_width_mm *= scale;
    options.root_radius_mm *= scale;
    options.spacing_mm *= scale;
    return options;
}

Result<tree::GrownTree> grow_in(const Organ& organ, const tree::GrowOptions& options, Job& job) {
    if (organ.count() < kLeastVoxels)
        return fail("the organ has " + std::to_string(organ.count()) + " voxels", {},
                    "a tree can be grown in " + std::to_string(kLeastVoxels) + " voxels and more");
    tree::GrowOptions checked = options;
    checked.organ_width_mm = grow_options_for(organ).organ_width_mm;
    if (const auto error = tree::wrong_with(checked)) return tl::unexpected<Error>(*error);
    const Organ part = largest_part(organ);
    MaskedOrgan masked(part);
    tree::growth::Random random(options.seed);
    if (!masked.enter(part, options.root_radius_mm, random))
        return fail("the organ is too thin for the stem of the tree and its first fork", {},
                    "make the root's radius smaller");
    return tree::grow(checked, masked, random, job);
}

} // namespace ramus::organ
