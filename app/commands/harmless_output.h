// Escapes control characters in all that the program writes to std::cout and std::cerr. Text from files and file names
// may contain escape sequences, which a terminal would execute. JSON output has none, and is not
// changed.
#pragma once

#include <memory>

namespace ramus::app {

// Escapes output during its lifetime. Create one object, before anything is written.
class HarmlessOutput {
public:
    HarmlessOutput();
    ~HarmlessOutput();
    HarmlessOutput(const HarmlessOutput&) = delete;
    HarmlessOutput& operator=(const HarmlessOutput&) = delete;

private:
    class Stream;
    std::unique_ptr<Stream> output_, errors_;
};

} // namespace ramus::app
