// Output of `ramus info --contacts`: the places where vessels of a tree touch without being connected there.
#pragma once

#include "core/tree/contacts/contacts.h"
#include "core/tree/vessel_tree.h"

#include <nlohmann/json_fwd.hpp>
#include <ostream>
#include <span>

namespace ramus::app {

// A list of all contacts, in the order of `contacts`. Members: branches, at (mm), gap_mm (negative: an overlap),
// closeness, crossing, and sides: for both vessels branch, branches, at, radius_mm, narrowed_mm and length_mm.
[[nodiscard]] nlohmann::ordered_json contacts_json(std::span<const tree::Contact> contacts);

// Prints the number of contacts, and one line for each of the first kMostListed (listing.h).
void print_contacts(std::ostream& stream, const tree::VesselTree& tree, std::span<const tree::Contact> contacts);

} // namespace ramus::app
