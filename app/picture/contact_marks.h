// Where vessels press on each other, as rings in the picture.
#pragma once

#include "app/session/numbers.h"
#include "core/tree/contacts/contacts.h"
#include "render/scene/frame.h"

#include <span>

namespace ramus::app {

inline constexpr std::size_t kMostContactMarks = 500;    // more would hide what they mark
inline constexpr std::size_t kMostNumberedContacts = 25; // likewise

enum class ContactMarks { kCurrent, kAll };

// Adds a ring for each contact, facing the eye and wide enough to be seen from anywhere: yellow where the tubes
// overlap, blue where there is a gap. Few of them have their numbers, from 1. `current`: an index, drawn stronger and
// named, its two vessels in two colours; -1: none. `branches`: of the tree. Contacts of branches that the frame hides
// have none. The frame has its states, camera, size and pixel ratio.
void mark_contacts(render::Frame& frame, std::span<const tree::Contact> contacts, ContactMarks which, int current,
                   std::size_t branches, const Lengths& lengths);

} // namespace ramus::app
