// Standard output and standard error of the whole program: what it writes to either goes through here, so that no text
// of a file, and no name, reaches a terminal with orders for it. JSON stays what it is.
#pragma once

#include <memory>

namespace ramus::app {

// While it lives. Once, before anything is written.
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
