#include "core/organ/resect/border.h"

#include <algorithm>
#include <array>
#include <glm/vec3.hpp>
#include <vector>

namespace ramus::organ {

namespace {

// Not 0: the part of a voxel of the organ; 0: it has none, or is outside of the organ.
std::uint16_t part_at(const Organ& organ, std::span<const std::uint16_t> part_of, const glm::ivec3& voxel) {
    for (int axis = 0; axis < 3; ++axis)
        if (voxel[axis] < 0 || voxel[axis] >= organ.size()[axis]) return 0;
    std::uint16_t found = 0;
    organ.for_voxels(voxel, voxel + 1, [&](const glm::ivec3&, std::size_t number) { found = part_of[number]; });
    return found;
}

} // namespace

Result<Sheet> sheet_along_border(const Organ& organ, std::span<const std::uint16_t> part_of, std::uint16_t part) {
    constexpr std::size_t kMost = 4'000; // places: more hardly change the sheet
    constexpr std::array<glm::ivec3, 6> kSteps{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
    std::vector<glm::dvec3> places;
    organ.for_voxels([&](const glm::ivec3& voxel, std::size_t number) {
        if (part_of[number] != part) return;
        for (const glm::ivec3& step : kSteps)
            if (const std::uint16_t other = part_at(organ, part_of, voxel + step); other != 0 && other != part)
                places.push_back(0.5 * (organ.centre_mm(voxel) + organ.centre_mm(voxel + step)));
    });
    if (places.empty()) return fail("this territory has no border with another", {}, "show two or more territories");
    const std::size_t each = places.size() / kMost + 1;
    std::vector<glm::dvec3> some;
    for (std::size_t n = 0; n < places.size(); n += each) some.push_back(places[n]);
    auto sheet = sheet_through(some);
    if (!sheet) return sheet;
    std::size_t above = 0, below = 0;
    organ.for_voxels([&](const glm::ivec3& voxel, std::size_t number) {
        if (part_of[number] == part) ++(height_above(*sheet, organ.centre_mm(voxel)) > 0.0 ? above : below);
    });
    sheet->removes_below = below > above;
    return sheet;
}

} // namespace ramus::organ
