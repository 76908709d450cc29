// Where vessels are kept apart from each other: there are the walls between them, whose sides may meet though neither
// of them folds.
#pragma once

#include "core/mesh/untangle/triangle_boxes.h"
#include "core/tree/contacts/contacts.h"
#include "core/tree/prepare.h"

#include <vector>

namespace ramus::mesh {

// Boxes around these places, of the contacts of a tree; several may hold one place.
[[nodiscard]] std::vector<TriangleBox> places_apart(const tree::PreparedTree& prepared, const tree::Contacts& contacts);

} // namespace ramus::mesh
