// Marks contacts between vessels with rings in the picture.
#pragma once

#include "app/session/numbers.h"
#include "core/tree/contacts/contacts.h"
#include "render/scene/frame.h"

#include <span>

namespace ramus::app {

inline constexpr std::size_t kMostContactMarks = 500;    // more would hide what they mark
inline constexpr std::size_t kMostNumberedContacts = 25; // more would overlap

enum class ContactMarks { kCurrent, kAll };

// Adds a ring per contact, facing the eye and large enough to be visible at any distance: yellow where tubes overlap,
// blue where there is a gap. If there are few, rings are numbered from 1. `current`: index of a contact that is
// emphasised and labelled, with its two vessels in two colours; -1: none. `branches`: number of branches of the tree.
// Contacts of hidden branches have no ring. `frame` must have states, camera, size and pixel ratio.
void mark_contacts(render::Frame& frame, std::span<const tree::Contact> contacts, ContactMarks which, int current,
                   std::size_t branches, const Lengths& lengths);

} // namespace ramus::app
