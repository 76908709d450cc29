#include "core/mesh/polygonize/join/unfolded_fan.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::mesh::bricks {

namespace {

bool all_face(std::span<const glm::vec3> corners, const glm::vec3& facing, const glm::vec3& centre) {
    for (std::size_t n = 0; n < corners.size(); ++n) {
        const glm::vec3 area = glm::cross(corners[n] - centre, corners[(n + 1) % corners.size()] - centre);
        if (!(glm::dot(area, facing) > 0.0F)) return false;
    }
    return true;
}

} // namespace

std::optional<glm::vec3> unfolded_centre(std::span<const glm::vec3> corners, const glm::vec3& facing,
                                         const glm::vec3& centre) {
    if (all_face(corners, facing, centre)) return std::nullopt;
    glm::vec3 middle(0.0F);
    for (const glm::vec3& corner : corners) middle += corner / static_cast<float>(corners.size());
    for (const float share : {0.05F, 0.1F, 0.2F, 0.3F, 0.45F, 0.6F, 0.8F, 1.0F})
        if (const glm::vec3 at = glm::mix(centre, middle, share); all_face(corners, facing, at)) return at;
    return std::nullopt;
}

} // namespace ramus::mesh::bricks
