// ramus info --contacts: where vessels of a tree press on each other without being connected there.
#pragma once

#include "core/tree/contacts/contacts.h"
#include "core/tree/vessel_tree.h"

#include <nlohmann/json_fwd.hpp>
#include <ostream>
#include <span>

namespace ramus::app {

// All of them, the closest first: branches and at, gap_mm (negative: an overlap), closeness, crossing, and of both
// sides branch, branches, at, radius_mm, narrowed_mm, length_mm.
[[nodiscard]] nlohmann::ordered_json contacts_json(std::span<const tree::Contact> contacts);

// How many there are, and a line for each of the closest.
void print_contacts(std::ostream& stream, const tree::VesselTree& tree, std::span<const tree::Contact> contacts);

} // namespace ramus::app
