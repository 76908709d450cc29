// The list of contacts.
#pragma once

#include "core/tree/contacts/contacts.h"

#include <memory>
#include <vector>

namespace ramus::app {

// What the list of contacts remembers.
struct ContactList {
    int current = -1;                                     // that was gone to; -1: none
    std::shared_ptr<const std::vector<tree::Contact>> of; // what `current` counts in
};

} // namespace ramus::app
