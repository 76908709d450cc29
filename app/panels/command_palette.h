// The field that finds commands by words.
#pragma once

#include "app/actions/command_runner.h"

#include <array>
#include <string>

namespace ramus::app {

struct CommandPalette {
    bool open = false;
    bool fresh = false;                // the keyboard is not in it yet
    int chosen = 0;                    // of those found
    const Command* asks_for = nullptr; // whose arguments the field is for; null: it is for words
    std::string trouble;               // with the arguments
    std::array<char, 256> typed{};
    void toggle(); // opens it empty, or closes it
};

} // namespace ramus::app
