#include "core/organ/supply.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::organ {

namespace {

// The organ at halved resolutions: a voxel of level n is set where one of its 2^n x 2^n x 2^n voxels is of the organ.
class Pyramid {
public:
    explicit Pyramid(const Organ& organ) : organ_(organ) {
        levels_.push_back(organ.mask());
        while (glm::any(glm::greaterThan(levels_.back().size(), glm::ivec3(1)))) {
            const volume::BitMask& fine = levels_.back();
            volume::BitMask coarse((fine.size() + 1) / 2);
            for (int k = 0; k < fine.size().z; ++k)
                for (int j = 0; j < fine.size().y; ++j)
                    for (int i = 0; i < fine.size().x; ++i)
                        if (fine.test({i, j, k})) coarse.set({i / 2, j / 2, k / 2});
            levels_.push_back(std::move(coarse));
        }
    }

    // Whether the centre of a voxel of the organ is within `reach` of `p`, mm.
    [[nodiscard]] bool any_within(const glm::dvec3& p, double reach) const {
        return any_within(p, reach, levels_.size() - 1, glm::ivec3(0));
    }

private:
    [[nodiscard]] bool any_within(const glm::dvec3& p, double reach, std::size_t level, const glm::ivec3& block) const {
        if (!levels_[level].test(block)) return false;
        const int side = 1 << level;
        const glm::dvec3 middle = glm::dvec3(block * side) + 0.5 * (side - 1);
        const glm::dvec3 to_middle = glm::dvec3(organ_.to_patient() * glm::dvec4(middle, 1.0)) - p;
        const double away = glm::length(to_middle);
        const glm::dmat3 axes(organ_.to_patient());
        const double half = 0.5 * (side - 1) * (glm::length(axes[0]) + glm::length(axes[1]) + glm::length(axes[2]));
        if (away - half > reach) return false;
        if (level == 0 || away + half <= reach) return true;
        for (int child = 0; child < 8; ++child)
            if (any_within(p, reach, level - 1, 2 * block + glm::ivec3(child & 1, child >> 1 & 1, child >> 2)))
                return true;
        return false;
    }

    const Organ& organ_;
    std::vector<volume::BitMask> levels_;
};

} // namespace

std::vector<std::uint8_t> points_in(const Organ& organ, const tree::VesselTree& tree) {
    const Pyramid pyramid(organ);
    const double diagonal = glm::length(volume::spacing_mm(organ.to_patient()));
    std::vector<std::uint8_t> inside(tree.points.size(), 0);
    tbb::parallel_for(std::size_t{0}, tree.points.size(), [&](std::size_t n) {
        const tree::Point& point = tree.points[n];
        inside[n] = pyramid.any_within(point.position, point.radius + diagonal) ? 1 : 0;
    });
    return inside;
}

} // namespace ramus::organ
