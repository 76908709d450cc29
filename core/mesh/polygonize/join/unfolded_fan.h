// Unfolded fans: the fan about a point on an edge folds over where a line between two of its corners passes on the
// other side of that edge, as it may between cells of different size.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>

namespace ramus::mesh::bricks {

// Where the centre of a fan goes, so that all its triangles face the same way: as near to `centre`, from which some
// face away, as the way to the middle of its corners allows. Nothing if none of them face away, or always some.
// `corners`: counter-clockwise as seen from where `facing` points to, of any length; all in one frame, mm.
[[nodiscard]] std::optional<glm::vec3> unfolded_centre(std::span<const glm::vec3> corners, const glm::vec3& facing,
                                                       const glm::vec3& centre);

} // namespace ramus::mesh::bricks
