// The list of what validation found.
#pragma once

#include "app/assets/validation.h"

#include <memory>
#include <vector>

namespace ramus::app {

// What the validation's panel remembers.
struct ValidationList {
    int current = -1;                               // the finding that was gone to; -1: none
    std::shared_ptr<const std::vector<Finding>> of; // what `current` counts in
};

} // namespace ramus::app
