// The notice of what was written last.
#pragma once

#include <filesystem>
#include <string>

namespace ramus::app {

// What was written last, until it is put away.
struct Written {
    bool open = false;
    std::filesystem::path file;
    std::string sentence;
};

} // namespace ramus::app
