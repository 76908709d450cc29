// The list of all commands and keys.
#pragma once

#include <array>

namespace ramus::app {

struct Help {
    bool open = false;
    std::array<char, 64> search{};
};

} // namespace ramus::app
